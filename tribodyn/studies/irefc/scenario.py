"""The tables of a scenario of ``kind = "irefc"``: a gear with rolling elements."""

from typing import Annotated, Literal

from pydantic import Field

from tribodyn.input import units
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import InUnit, NotNegative, Positive, Table, model_file, written
from tribodyn.input.tables.gears.material import Described
from tribodyn.studies.irefc.case import RollingCase
from tribodyn.studies.irefc.engagement import RollingFriction
from tribodyn.studies.irefc.geometry import RollingDrive


class RollingDriveTable(Described):
    """A gear with rolling elements (`models/drives/`)."""

    pitch_radius: Annotated[float, InUnit(units.positive(units.LENGTH), "20 mm")]
    elements: Annotated[int, Field(strict=True, gt=0, le=200)]
    displacement: Positive
    element_radius: Annotated[float, InUnit(units.positive(units.LENGTH), "2 mm")]


class RollingOperating(Table):
    """How the shaft is driven."""

    input_power: Annotated[float, InUnit(units.positive(units.POWER))]
    input_speed: Annotated[float, InUnit(units.positive(units.ANGULAR_SPEED))]


class RollingFrictionTable(Table):
    """Friction between the elements and both profiles."""

    rolling_arm: Annotated[float, InUnit(units.not_negative(units.LENGTH), "0.01 mm")]
    sliding_coefficient: NotNegative


class RollingOutput(Table):
    """What is recorded: one revolution of the shaft."""

    samples_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 40


class RollingScenario(ScenarioHead):
    """A scenario file of a gear with rolling elements."""

    kind: Literal["irefc"]
    mode: Literal["corrected", "as_published"] = "corrected"
    drive: Annotated[RollingDriveTable, model_file("drives")]
    operating: RollingOperating
    friction: RollingFrictionTable
    output: RollingOutput = written({})


Scenario = RollingScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> RollingCase:
    """Return the case of a scenario that has passed the schema."""
    drive = scenario.drive
    return RollingCase(
        **head_of(scenario, toml, sha256),
        mode=scenario.mode,
        drive=RollingDrive(drive.pitch_radius, drive.elements, drive.displacement, drive.element_radius),
        input_power=scenario.operating.input_power,
        input_speed=scenario.operating.input_speed,
        friction=RollingFriction(scenario.friction.rolling_arm, scenario.friction.sliding_coefficient),
        samples_per_cycle=scenario.output.samples_per_cycle,
    )
