"""The tables of a scenario of ``kind = "load-contact"``: teeth in slow rotation under load."""

from typing import Annotated, Literal

from pydantic import Field

from tribodyn.scenario import units
from tribodyn.scenario.common import Slices, head_of
from tribodyn.scenario.drive_data import drive_of, materials_of, modifications_of, slices_of
from tribodyn.scenario.duty import duty_of
from tribodyn.scenario.model_files import DriveTable
from tribodyn.scenario.modification import MisalignmentTable
from tribodyn.scenario.quality import DeviationSample, with_sample
from tribodyn.scenario.quantity import (
    Count,
    NotNegative,
    Quantity,
    Switch,
    Table,
    model_file,
    written,
)
from tribodyn.scenario.spectrum import OperatingTable, SpectrumScenario
from tribodyn.studies.load_contact.case import LoadContactCase

Load = Annotated[float, Quantity(units.positive(units.TORQUE))]


class LoadContactOperating(OperatingTable):
    """The load, against the gear's motion; a speed only where the load is given as power."""

    gear_torques: tuple[Load, ...] = Field(
        (), max_length=1000, description="of the Harris map, in increasing order"
    )


class LoadContactMesh(Table):
    """Slices of the face, friction, and how the axes stand."""

    slices: Slices | None = Field(
        None, description="of the face; default: 21 where anything varies along it, else 1"
    )
    slice_coupling: Switch = Field(True, description="slices of one tooth hold each other")
    friction_coefficient: NotNegative = Field(0.0, description="of all pairs")
    deviation_sample: DeviationSample | None = Field(
        None, description="number of the sample of deviations drawn from the quality; default: none"
    )
    misalignment: MisalignmentTable = written({})


class LoadContactOutput(Table):
    """What is recorded."""

    positions_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 60
    cycles: Count = Field(1, description="mesh cycles; more than one where teeth differ")


class LoadContactScenario(SpectrumScenario):
    """A scenario file of a load contact study."""

    kind: Literal["load-contact"]
    drive: Annotated[DriveTable, model_file("drives")]
    operating: LoadContactOperating
    mesh: LoadContactMesh = written({})
    output: LoadContactOutput = written({})


Scenario = LoadContactScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> LoadContactCase:
    """Return the case of a scenario that has passed schema and rules."""
    drive, mesh = scenario.drive, scenario.mesh
    modifications = with_sample(
        drive,
        modifications_of(drive, mesh.misalignment),
        mesh.deviation_sample,
        every_tooth=True,
        slices=mesh.slices,
    )
    return LoadContactCase(
        **head_of(scenario, toml, sha256),
        family=drive.family,
        drive=drive_of(drive),
        materials=materials_of(drive),
        gear_torque=duty_of(scenario.operating, drive.pinion.teeth, drive.gear.teeth).gear_torque,
        gear_torques=scenario.operating.gear_torques,
        friction_coefficient=mesh.friction_coefficient,
        modifications=modifications,
        slices=slices_of(mesh.slices, modifications),
        slice_coupling=mesh.slice_coupling,
        positions_per_cycle=scenario.output.positions_per_cycle,
        cycles=scenario.output.cycles,
    )
