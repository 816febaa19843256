"""Fields, and types of fields, that the scenarios of several kinds of study share."""

from typing import Annotated, Any

from pydantic import Field

from tribodyn.input import units
from tribodyn.input.quantity import Column, CurveTable, InUnit, Table, Text

Torque = Annotated[float, InUnit(units.TORQUE)]
Inertia = Annotated[float, InUnit(units.not_negative(units.INERTIA))]
TorsionalStiffness = Annotated[float, InUnit(units.positive(units.TORSIONAL_STIFFNESS))]
TorsionalDamping = Annotated[float, InUnit(units.not_negative(units.TORSIONAL_DAMPING))]
Angle = Annotated[float, InUnit(units.ANGLE_KIND)]
Error = Annotated[float, InUnit(units.LENGTH, "2 um")]
Temperature = Annotated[float, InUnit(units.TEMPERATURE_KIND)]
PartName = Annotated[str, Field(strict=True, pattern=r"^\w[\w-]*$")]
"""Name of a gear, a shaft, a body or a sensor: keys are made of it."""
Slices = Annotated[int, Field(strict=True, ge=1, le=501)]
Name = Annotated[str, Field(strict=True, pattern=r"^\w[\w .-]*$")]
"""A scenario's name, which also names its record."""


class ScenarioHead(Table):
    """The first keys of every scenario; each kind of study adds its `kind` and its tables."""

    title: Text
    name: Name | None = None


def head_of(scenario: Any, toml: str, sha256: str) -> dict[str, str]:
    """Return the fields of `protocol.study.CaseHead` for a scenario, a `ScenarioHead` with its `kind`."""
    named = {"title": scenario.title, "name": scenario.name or "scenario", "kind": scenario.kind}
    return named | {"toml": toml, "sha256": sha256}


RollAngles = Annotated[Column, units.ANGLE_KIND]


class TorqueCurve(CurveTable):
    """Torque over time that is added to the load; held constant outside the points."""

    time: Annotated[Column, units.TIME]
    torque: Annotated[Column, units.TORQUE]


class MotorCurve(CurveTable):
    """Torque of a motor over speed; a smooth curve through the points, straight beyond them."""

    speed: Annotated[Column, units.ANGULAR_SPEED]
    torque: Annotated[Column, units.TORQUE]


class StiffnessCurve(CurveTable):
    """Stiffness of a single pair over the pinion's roll angle from the pitch point."""

    roll_angle: RollAngles
    stiffness: Annotated[Column, units.positive(units.STIFFNESS)]


class ErrorCurve(CurveTable):
    """Error of a pair's flanks over the pinion's roll angle from the pitch point."""

    roll_angle: RollAngles
    error: Annotated[Column, units.LENGTH]


class LoadCurve(CurveTable):
    """Normal load of a pair over the pinion's roll angle from the pitch point; below 0 it counts as 0."""

    roll_angle: RollAngles
    normal_load: Annotated[Column, units.FORCE]
