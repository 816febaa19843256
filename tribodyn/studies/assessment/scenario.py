"""The tables of a scenario of ``kind = "assessment"``."""

from typing import Annotated, Literal, cast

from pydantic import Field

from tribodyn.scenario import units
from tribodyn.scenario.common import Slices, Temperature, head_of
from tribodyn.scenario.quantity import (
    NotNegative,
    Positive,
    Quantity,
    Switch,
    Table,
    Text,
    model_file,
    written,
)
from tribodyn.scenario.tables.drive_data import (
    drive_of,
    lubricant_of,
    masses_of,
    materials_of,
    mean_roughness,
)
from tribodyn.scenario.tables.duty import duty_of
from tribodyn.scenario.tables.losses import LossesTable
from tribodyn.scenario.tables.model_files import Bearings, DriveTable, Lubricant
from tribodyn.scenario.tables.modification import MisalignmentTable
from tribodyn.scenario.tables.spectrum import OperatingTable, SpectrumScenario
from tribodyn.scenario.tables.temperature import TemperatureTable
from tribodyn.scenario.tables.tolerances import grade_of, tolerances_of
from tribodyn.studies.assessment.case import AssessmentCase, Settings
from tribodyn.studies.gears.by_standard import Quality, quality_of

Speeds = Annotated[int, Field(strict=True, ge=8)]
Samples = Annotated[int, Field(strict=True, ge=0, le=1000)]
Pressure = Annotated[float, Quantity(units.positive(units.PRESSURE), "1.5 GPa")]
Length = Annotated[float, Quantity(units.positive(units.LENGTH), "5 um")]


class AssessmentOperating(OperatingTable):
    """Speed, load, and the oil's temperature."""

    oil_temperature: Temperature = Field(description="where the oil enters the mesh")


class AssessmentMesh(Table):
    """How the axes stand, and in how many slices the face is taken."""

    misalignment: MisalignmentTable = written({})
    slices: Slices | None = Field(
        None, description="of the face; default: 21 where anything varies along it, else 1"
    )


class AssessmentAsked(Table):
    """What is asked beyond the duty, and what the standards need to know."""

    application_factor: Positive = Field(1.0, description="K_A, what the driven and the driving machine add")
    lubrication: Literal["dip", "spray", "submerged"] = Field(
        "dip", description="how the oil gets to the mesh"
    )
    structure_factor: Positive = Field(
        1.0, description="X_W: 1 of case-hardened steel, 1.5 nitrided (ISO/TS 6336-20, table 2)"
    )
    adequate_tip_relief: Switch = Field(
        False, description="whether the standards may count on the tip relief that the flanks have"
    )
    torque_shares: tuple[Positive, ...] = Field(
        (0.25, 0.5, 0.75, 1.0, 1.25),
        min_length=2,
        max_length=50,
        description="torques of the loaded error over the duty's, increasing",
    )
    speed_range: tuple[Positive, Positive] = Field(
        (0.2, 2.5), description="first and last speed of the steady states over the duty's"
    )
    speeds: Speeds = Field(46, description="steady states over that range, besides the duty's")
    samples: Samples = Field(
        16, description="of the deviations that the tolerance class allows: scatter of the figures; 0: none"
    )
    friction_laws: tuple[Text, ...] = Field(
        ("masjedi-khonsari", "niemann", "schlenk", "xu", "benedict-kelley", "iso-14179-1"),
        min_length=1,
        max_length=10,
        description="the first for everything, the others for the spread of the losses",
    )
    damping_ratio: NotNegative = Field(0.05, description="of the mesh")


class AssessmentLimits(Table):
    """What must hold: red on the first page where it does not. One that is not given is not judged."""

    scuffing_flash: Positive | None = Field(1.5, description="minimum safety S_B of ISO/TS 6336-20")
    scuffing_integral: Positive | None = Field(1.5, description="minimum safety S_intS of ISO/TS 6336-21")
    micropitting: Positive | None = Field(1.0, description="minimum safety S_lambda of ISO/TS 6336-22")
    dynamic_factor: Positive | None = Field(None, description="maximum K_v of the simulation at the duty")
    hertz_pressure: Pressure | None = Field(None, description="maximum, of the simulation")
    root_tension: Pressure | None = Field(None, description="maximum in either fillet, of the simulation")
    loaded_error: Length | None = Field(
        None, description="maximum peak to peak of the loaded transmission error"
    )


class AssessmentScenario(SpectrumScenario):
    """A scenario file of an assessment."""

    kind: Literal["assessment"]
    drive: Annotated[DriveTable, model_file("drives")]
    lubricant: Annotated[Lubricant, model_file("lubricants")]
    bearings: Annotated[Bearings, model_file("bearings")] = written("rigid-1e9")
    operating: AssessmentOperating
    mesh: AssessmentMesh = written({})
    temperature: TemperatureTable | None = Field(
        None, description="bulk temperature of the teeth; default: the estimate of ISO/TR 15144-1"
    )
    losses: LossesTable | None = Field(None, description="load-independent losses; default: none")
    assessment: AssessmentAsked = written({})
    limits: AssessmentLimits = written({})


Scenario = AssessmentScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> AssessmentCase:
    """Return the case of a scenario that has passed schema and rules."""
    drive, operating = scenario.drive, scenario.operating
    duty = duty_of(operating, drive.pinion.teeth, drive.gear.teeth)
    return AssessmentCase(
        **head_of(scenario, toml, sha256),
        family=drive.family,
        drive=drive_of(drive),
        materials=materials_of(drive),
        masses=masses_of(drive),
        mean_roughness=mean_roughness(drive),
        lubricant=lubricant_of(scenario.lubricant, operating.oil_temperature),
        pinion_speed=duty.pinion_speed,
        gear_torque=duty.gear_torque,
        oil_temperature=operating.oil_temperature,
        quality=cast(
            Quality,
            quality_of([grade_of(drive, one) for one in (drive.pinion, drive.gear)], tolerances_of(drive)),
        ),
        settings=Settings(**scenario.assessment.model_dump()),
        limits=scenario.limits.model_dump(),
    )
