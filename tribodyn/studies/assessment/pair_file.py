"""The tables of an assessment whose file has a pair of gears, and the pair as it is rated."""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from tribodyn.errors import InputError
from tribodyn.gears.rating.american import broken_agma
from tribodyn.gears.rating.capacity import required
from tribodyn.gears.rating.fracture import broken_fracture
from tribodyn.gears.rating.limits import OilLimits, Pressure
from tribodyn.gears.rating.settings import broken_strength_rules
from tribodyn.gears.scenario import (
    FaceTable,
    GearScenario,
    Oil,
    ShaftKeys,
    broken_gear_rules,
    gear_fields,
)
from tribodyn.geometry.families import family
from tribodyn.input import units
from tribodyn.input.fields import Temperature
from tribodyn.input.quantity import InUnit, model_file, written
from tribodyn.input.tables.bearings import Bearings
from tribodyn.input.tables.duty import OperatingTable, broken_driving_rules, duty_of, spectrum_of
from tribodyn.input.tables.gears.drive_data import materials_of
from tribodyn.input.tables.gears.quality import tolerances_of
from tribodyn.input.tables.gears.tooth_data import driving_internal
from tribodyn.input.tables.losses import LossesTable
from tribodyn.input.tables.lubricant import lubricant_of
from tribodyn.input.tables.temperature import TemperatureTable
from tribodyn.studies.assessment.case import RatedPair
from tribodyn.studies.assessment.settings import AssessmentTable, broken_settings, without_data_sheet

Length = Annotated[float, InUnit(units.positive(units.LENGTH), "5 um")]


KIND = "assessment"


class AssessmentOperating(OperatingTable):
    """Speed, load, and the oil's temperature."""

    oil_temperature: Temperature


class AssessmentMesh(FaceTable):
    """How the axes stand, and in how many slices the face is taken."""


class AssessmentLimits(OilLimits):
    """What must hold: red on the first page where it does not. One that is not given is not judged."""

    root_tension: Pressure | None = None
    loaded_error: Length | None = None


class AssessmentScenario(GearScenario):
    """A scenario file of an assessment."""

    internal_gears: ClassVar[bool] = True
    driving_rings: ClassVar[bool] = False
    kind: Literal["assessment"]
    lubricant: Oil
    bearings: Annotated[Bearings, model_file("bearings")] = written("rigid-1e9")
    shaft: ShaftKeys = None
    operating: AssessmentOperating
    mesh: AssessmentMesh = written({})
    temperature: TemperatureTable | None = None
    losses: LossesTable | None = None
    assessment: AssessmentTable = written({})
    limits: AssessmentLimits = written({})


def rated_pair(scenario: AssessmentScenario, toml: str, sha256: str) -> RatedPair:
    """Return the pair of gears of a scenario that has passed schema and rules."""
    oil_temperature = scenario.operating.oil_temperature
    teeth = scenario.drive.pinion.teeth, scenario.drive.gear.teeth
    duties = [(share, duty_of(duty.operating, *teeth)) for share, duty in spectrum_of(scenario)]
    return RatedPair(
        **gear_fields(scenario, toml, sha256),
        lubricant=lubricant_of(scenario.lubricant, oil_temperature),
        oil_temperature=oil_temperature,
        settings=scenario.assessment,
        limits=scenario.limits.model_dump() | required(scenario.assessment),
        spectrum=tuple((share, duty.pinion_speed, duty.gear_torque) for share, duty in duties),
    )


def broken_pair_rules(scenario: AssessmentScenario) -> Iterator[InputError]:
    """Go through the rules that the scenario breaks."""
    drive, data_sheet = scenario.drive, scenario.lubricant.viscosity_40 is not None
    yield from broken_gear_rules(scenario, oil=data_sheet)
    yield from driving_internal(drive)
    if None in tolerances_of(drive):
        yield InputError(
            "drive.quality",
            rule="missing: the standards reckon with the deviations of a tolerance class by ISO 1328-1",
            remedy="add quality = 6 to [drive]",
        )
    if not data_sheet:
        yield without_data_sheet("lubricant")
    yield from broken_driving_rules(
        scenario.operating,
        (drive.pinion.teeth, drive.gear.teeth),
        "the standards' formulas are those of a driving pinion",
        ", or call the driving gear the pinion",
    )
    yield from broken_strength_rules("assessment", scenario.assessment, materials_of(drive))
    least = scenario.limits.flank_fracture
    yield from broken_fracture(least, materials_of(drive), ring=drive.gear.internal)
    if scenario.assessment.standard == "agma":
        width = min(drive.pinion.face_width, drive.gear.face_width)
        helix = abs(drive.helix_angle or 0.0), drive.module, width
        others = drive.gear.internal or not family(drive.family).involute
        yield from broken_agma(helix, others, materials_of(drive))
    settings = scenario.assessment
    yield from broken_settings(settings, settings.damping_ratio, "assessment.damping_ratio")
