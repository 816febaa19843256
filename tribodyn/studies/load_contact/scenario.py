"""The tables of a scenario of ``kind = "load-contact"``: teeth in slow rotation under load."""

from typing import Annotated, Literal

from pydantic import Field

from tribodyn.scenario import units
from tribodyn.scenario.common import Slices, head_of
from tribodyn.scenario.quantity import (
    Count,
    NotNegative,
    Quantity,
    Switch,
    Table,
    model_file,
    written,
)
from tribodyn.scenario.tables.drive_data import lubricant_of, modifications_of, slices_of, teeth_of
from tribodyn.scenario.tables.duty import duty_of
from tribodyn.scenario.tables.laws import FilmTable, film_of
from tribodyn.scenario.tables.model_files import DriveTable, Lubricant
from tribodyn.scenario.tables.modification import MisalignmentTable
from tribodyn.scenario.tables.quality import DeviationSample, with_sample
from tribodyn.scenario.tables.spectrum import OiledOperatingTable, SpectrumScenario
from tribodyn.studies.load_contact.case import LoadContactCase, Oiled

Load = Annotated[float, Quantity(units.positive(units.TORQUE))]


class LoadContactOperating(OiledOperatingTable):
    """The load, against the gear's motion; a speed only where the load is given as power, or for the film."""

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
    lubricant: Annotated[Lubricant, model_file("lubricants")] | None = Field(
        None, description="for the film over the face; default: none is computed"
    )
    operating: LoadContactOperating
    mesh: LoadContactMesh = written({})
    film: FilmTable | None = Field(None, description="which law gives the film")
    output: LoadContactOutput = written({})


Scenario = LoadContactScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> LoadContactCase:
    """Return the case of a scenario that has passed schema and rules."""
    drive, mesh, operating = scenario.drive, scenario.mesh, scenario.operating
    teeth, duty = teeth_of(drive), duty_of(operating, drive.pinion.teeth, drive.gear.teeth)
    oiled = None
    if scenario.lubricant is not None:
        lubricant = lubricant_of(scenario.lubricant, operating.oil_temperature)
        oiled = Oiled(**teeth, lubricant=lubricant, operating=duty, film=film_of(scenario.film))
    modifications = with_sample(
        drive,
        modifications_of(drive, mesh.misalignment),
        mesh.deviation_sample,
        every_tooth=True,
        slices=mesh.slices,
    )
    return LoadContactCase(
        **head_of(scenario, toml, sha256),
        family=teeth["family"],
        drive=teeth["drive"],
        materials=teeth["materials"],
        gear_torque=duty.gear_torque,
        gear_torques=operating.gear_torques,
        friction_coefficient=mesh.friction_coefficient,
        modifications=modifications,
        slices=slices_of(mesh.slices, modifications),
        slice_coupling=mesh.slice_coupling,
        positions_per_cycle=scenario.output.positions_per_cycle,
        cycles=scenario.output.cycles,
        oiled=oiled,
    )
