"""The tables of a scenario of ``kind = "efficiency"``: loads, friction and losses without dynamics."""

from typing import Annotated, Literal

from pydantic import Field

from tribodyn.compliance.foundation import Foundation
from tribodyn.dynamics.data import OperatingData
from tribodyn.mesh.data import MeshData
from tribodyn.scenario.common import Slices, head_of
from tribodyn.scenario.quantity import (
    Switch,
    Table,
    model_file,
    written,
)
from tribodyn.scenario.tables.drive_data import (
    lubricant_of,
    modifications_of,
    slices_of,
    teeth_of,
)
from tribodyn.scenario.tables.duty import duty_of
from tribodyn.scenario.tables.laws import FilmTable, FrictionTable, film_data, friction_values
from tribodyn.scenario.tables.losses import LossesTable, losses_of
from tribodyn.scenario.tables.model_files import DriveTable, Lubricant
from tribodyn.scenario.tables.modification import MisalignmentTable
from tribodyn.scenario.tables.quality import DeviationSample, error_with_sample, with_sample
from tribodyn.scenario.tables.spectrum import OiledOperatingTable, SpectrumScenario, spectrum_of
from tribodyn.scenario.tables.temperature import TemperatureTable, temperature_of
from tribodyn.studies.efficiency.case import EfficiencyCase
from tribodyn.tribology.data import FrictionData


class EfficiencyMesh(Table):
    """How the pairs in contact share the load, and the compliance they share it by."""

    compliance: Literal["energy", "fem"] = Field(
        "energy",
        description="what elastic load sharing goes by: the energy method; or the load contact model on "
        "finite elements, in which pairs touch beyond their path of contact as well",
    )
    load_sharing: Literal["elastic", "uniform", "single-pair"] = Field(
        "elastic",
        description="by the compliances; equally; one pair about the pitch point. "
        "Of the samples: the summary has all three",
    )
    hertz: Literal["linear", "load-dependent"] = Field("linear", description="contact part of the compliance")
    foundation: Foundation = Field(
        "sainsot-velex", description="compliance of a gear body: fitted polynomials, or the elastic ring"
    )
    foundation_coupling: Switch = Field(True, description="pairs that share a body share its foundation")
    deviation_sample: DeviationSample | None = Field(
        None, description="number of the sample of deviations drawn from the quality; default: none"
    )
    misalignment: MisalignmentTable = written({})
    slices: Slices | None = Field(
        None, description="of the face; default: 21 where anything varies along it, else 1"
    )
    slice_coupling: Switch = Field(True, description="slices of one tooth hold each other")


class EfficiencyFriction(FrictionTable):
    """Which law acts between the flanks, and the law's own keys."""


class EfficiencyOutput(Table):
    """What is recorded: one mesh cycle."""

    samples_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 200


class EfficiencyScenario(SpectrumScenario):
    """A scenario file of an efficiency study."""

    kind: Literal["efficiency"]
    drive: Annotated[DriveTable, model_file("drives")]
    lubricant: Annotated[Lubricant, model_file("lubricants")]
    operating: OiledOperatingTable
    mesh: EfficiencyMesh = written({})
    temperature: TemperatureTable | None = Field(None, description="bulk temperature of the teeth")
    losses: LossesTable | None = Field(None, description="load-independent losses")
    film: FilmTable | None = Field(None, description="which law gives the film")
    friction: EfficiencyFriction
    output: EfficiencyOutput = written({})


Scenario = EfficiencyScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> EfficiencyCase:
    """Return the case of a scenario that has passed schema and rules."""
    drive, mesh, operating = scenario.drive, scenario.mesh, scenario.operating
    modifications = modifications_of(drive, mesh.misalignment)
    error, sample = None, mesh.deviation_sample
    if mesh.compliance == "fem":
        modifications = with_sample(drive, modifications, sample, every_tooth=False, slices=mesh.slices)
    else:
        error = error_with_sample(drive, None, sample)
    return EfficiencyCase(
        **head_of(scenario, toml, sha256),
        **teeth_of(drive),
        lubricant=lubricant_of(scenario.lubricant, operating.oil_temperature),
        operating=OperatingData("speed", *duty_of(operating, drive.pinion.teeth, drive.gear.teeth)),
        mesh=MeshData(
            mesh.compliance,
            damping_ratio=0.0,
            hertz=mesh.hertz,
            foundation=mesh.foundation,
            foundation_coupling=mesh.foundation_coupling,
            error_table=error,
            modifications=modifications,
            slices=slices_of(mesh.slices, modifications),
            slice_coupling=mesh.slice_coupling,
        ),
        friction=FrictionData(scenario.friction.law, friction_values(scenario.friction)),
        load_sharing=mesh.load_sharing,
        samples_per_cycle=scenario.output.samples_per_cycle,
        film=film_data(scenario),
        temperature=temperature_of(scenario.temperature),
        losses=losses_of(scenario.losses),
        spectrum=tuple(
            (share, case_of(one, toml, sha256))
            for share, one in (spectrum_of(scenario) if operating.duty is None else ())
        ),
    )
