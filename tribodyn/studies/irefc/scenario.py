"""A scenario of ``kind = "irefc"``, a gear with rolling elements: its case, record, cost and tables."""

from dataclasses import dataclass
from functools import partial
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.cases.cost import (
    CostKey,
    Estimate,
    in_memory,
    record_bytes,
    recorded,
    rolling_elements,
    total,
)
from tribodyn.input import units
from tribodyn.input.fields import ScenarioHead, head_of
from tribodyn.input.quantity import InUnit, NotNegative, Positive, Table, model_file, written
from tribodyn.input.tables.gears.model_files import Described
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import TIME, Layout
from tribodyn.studies.irefc.engagement import Mode, RollingFriction
from tribodyn.studies.irefc.geometry import RollingDrive
from tribodyn.studies.protocol.study import CaseHead


@dataclass(frozen=True)
class RollingCase(CaseHead):
    """One run of a gear with rolling elements, complete."""

    #: motion in time with corrected speeds, or the paper's single position with its printed formulas
    mode: Mode
    drive: RollingDrive
    input_power: float  # of the shaft, W
    input_speed: float  # of the shaft, rad/s
    friction: RollingFriction
    #: samples while an element takes its neighbour's place: a cycle, of which a revolution has Z2 + 1
    samples_per_cycle: int = 40


ELEMENT = Variable(("element",), "1", "rolling element, in the order of their angles")

_time, _each = partial(Variable, ("time",)), partial(Variable, ("time", "element"))

#: What a run records over time.
SAMPLES: dict[str, Variable] = {
    "input_angle": _time("rad", "rotation of the shaft"),
    "element_angle": _each(
        "rad",
        "angle of the element about the cage's centre from the pitch point; 0 in a depression of the cam, "
        "pi on a protrusion",
    ),
    "cam_distance": _each("m", "L_A, distance from pitch point to contact with the cam"),
    "crown_distance": _each("m", "L_B, distance from pitch point to contact with the crown"),
    "normal_load": _each("N", "normal load of the element, the same on cam and crown"),
    "slip_speed": _each(
        "m/s", "slip of the element over the cam, positive counter-clockwise about the pitch point"
    ),
    "spin_speed": _each("rad/s", "rotation of the element in the cage"),
    "power_cam": _each("W", "power lost at the cam, to rolling and sliding"),
    "power_crown": _each("W", "power lost at the crown, to rolling"),
    "power_in": _time("W", "power of the shaft"),
    "power_out": _time("W", "power of the cam, which drives the load"),
    "power_friction": _time("W", "power lost in all contacts"),
    "efficiency": _time("1", "efficiency at each moment"),
}

#: Curves and lengths of the geometry.
GEOMETRY: dict[str, Variable] = {
    "cam_outline": Variable(
        ("cam_point", "axis"), "m", "profile of the cam about its centre, as it stands at the start"
    ),
    "crown_outline": Variable(("crown_point", "axis"), "m", "profile of the crown about the shaft's axis"),
    **{
        name: Variable((), "m", about)
        for name, about in {
            "pitch_radius": "radius of the cage's pitch circle",
            "centre_circle_radius": "radius of the circle of the elements' centres",
            "element_radius": "radius of an element",
            "eccentricity": "distance of the cage's axis from the shaft's",
            "cam_pitch_radius": "radius of the cam's pitch circle",
            "crown_pitch_radius": "radius of the crown's pitch circle",
        }.items()
    },
}

LAYOUT = Layout(TIME, SAMPLES, {"element": ELEMENT}, groups={"mesh_cycle": {}, "geometry": GEOMETRY})


def estimate(case: RollingCase) -> Estimate:
    """What a run of a case takes."""
    cycle, elements = case.samples_per_cycle, case.drive.elements
    samples = 1 if case.mode == "as_published" else cycle * (elements + 1) + 1
    return total(
        (CostKey("output.samples_per_cycle", cycle, 40), CostKey("drive.elements", elements, 20)),
        recorded(LAYOUT, {"time": samples, "element": elements}, copies=0.05),  # what a picture reads
        in_memory(3.0, record_bytes(LAYOUT, {"time": cycle, "element": elements})),
        in_memory(samples, 32.0),  # what the summary keeps of every sample
        rolling_elements(float(samples) + cycle, elements),
    )


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
