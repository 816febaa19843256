"""The tables of a scenario file: what is done with a drive.

Field names are the interface of the command line (`--set operating.gear_torque="600 N*m"`). Defaults stand
as they would be written in TOML. Rules that tie fields together stand in `rules`; names of laws, families and
solvers in their registries.
"""

from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.compliance.foundation import Foundation
from tribodyn.dynamics.data import OperatingData
from tribodyn.mesh.table import MeshData
from tribodyn.scenario import fields, units
from tribodyn.scenario.quantity import Count, InUnit, NotNegative, Table, Text, csv_file, model_file, written
from tribodyn.scenario.tables.bearings import Bearings, Stiffness, bearings_of
from tribodyn.scenario.tables.drive_data import backlash_of
from tribodyn.scenario.tables.duty import DutyTable, OiledOperatingTable, duty_of
from tribodyn.scenario.tables.laws import FrictionTable
from tribodyn.scenario.tables.model_files import MisalignmentTable
from tribodyn.solve.methods import SolverData
from tribodyn.studies.gear_pair.case import Case, OutputData
from tribodyn.studies.gears.prepare import with_chosen_laws
from tribodyn.studies.gears.scenario import (
    FaceSlices,
    FilmKeys,
    FoundationCoupling,
    GearScenario,
    LossKeys,
    Oil,
    SampleNumber,
    SliceCoupling,
    TemperatureKeys,
    gear_fields,
    mesh_of,
    oil_fields,
)

#: Cosines in a load or an error: a curve is given by points.
MOST_HARMONICS = 1000

Smoothing = Annotated[float, InUnit(units.positive(units.LENGTH), "0.1 um")]


class TorqueHarmonic(Table):
    """A cosine in the load torque."""

    amplitude: fields.Torque
    frequency: Annotated[float, InUnit(units.positive(units.ANGULAR_FREQUENCY))]
    phase: fields.Angle = written("0 deg")


class ErrorHarmonic(Table):
    """A cosine in the static transmission error, over the mesh cycle."""

    order: Count = Field(description="1: mesh frequency, 2: twice that, …")
    amplitude: fields.Error
    phase: fields.Angle = written("0 deg")


class Operating(OiledOperatingTable):
    """How the drive is driven and loaded: nominal speed, constant part of the load, and more."""

    source: Literal["speed", "torque"] = Field(
        "speed", description="speed: the pinion's rotation is prescribed; torque: a motor with inertia"
    )
    gear_torque_table: Annotated[fields.TorqueCurve, csv_file("time", "torque")] | None = Field(
        None, description="over time, added to the load"
    )
    gear_torque_harmonics: tuple[TorqueHarmonic, ...] = Field(
        (), max_length=MOST_HARMONICS, description="added to the load"
    )
    load_inertia: fields.Inertia = written("0 kg*m**2")
    load_damping: fields.TorsionalDamping = written(
        "0 N*m*s/rad", description="load that grows with speed above nominal"
    )
    drive_inertia: fields.Inertia = written("0 kg*m**2", description="of the motor")
    shaft_stiffness: Annotated[float, InUnit(units.positive(units.TORSIONAL_STIFFNESS))] | None = Field(
        None, description="between motor and pinion; default: rigid"
    )
    shaft_damping: fields.TorsionalDamping = written("0 N*m*s/rad")
    speed_regulation: fields.TorsionalDamping = written(
        "0 N*m*s/rad", description="the motor's torque falls by this with speed above nominal"
    )

    @property
    def motor_torque(self) -> float | None:
        """Torque of the motor, given beside the load; None: it balances the load without losses."""
        beside = self.gear_torque is not None or self.power is not None
        return self.pinion_torque if beside else None

    @property
    def load(self) -> DutyTable:
        """Speed and load, without the torque of the motor."""
        return self if self.motor_torque is None else self.model_copy(update={"pinion_torque": None})


class TransmissionError(Table):
    """Static transmission error e of a pair, positive where material is missing."""

    harmonics: tuple[ErrorHarmonic, ...] = Field((), max_length=MOST_HARMONICS)
    table: Annotated[fields.ErrorCurve, csv_file("roll_angle", "error")] | None = None


class Mesh(Table):
    """How the teeth in contact deflect, damp, separate and err."""

    damping_ratio: NotNegative
    compliance: Literal["energy", "fem", "constant", "table"] = "energy"
    hertz: Literal["linear", "load-dependent"] = Field(
        "linear", description="contact part of the energy method's compliance"
    )
    foundation: Foundation = Field(
        "sainsot-velex", description="compliance of a gear body: fitted polynomials, or the elastic ring"
    )
    foundation_coupling: FoundationCoupling = True
    stiffness: Stiffness | None = Field(None, description='of a single pair, with compliance = "constant"')
    table: Annotated[fields.StiffnessCurve, csv_file("roll_angle", "stiffness")] | None = Field(
        None, description='of a single pair, with compliance = "table"'
    )
    formulation: Literal["classical", "energy-consistent"] = Field(
        "classical", description="whether the varying stiffness acts on the rotations"
    )
    contact_width: Smoothing = written("0.1 um", description="deflection over which contact sets in")
    backlash: Annotated[float, InUnit(units.not_negative(units.LENGTH), "0.1 mm")] | None = Field(
        None, description="normal backlash at the pitch point; default: the drive's, see there"
    )
    points: Annotated[int, Field(strict=True, ge=5)] = Field(65, description="nodes per segment of the table")
    transmission_error: TransmissionError = written({})
    deviation_sample: SampleNumber = None
    misalignment: MisalignmentTable = written({})
    slices: FaceSlices = None
    slice_coupling: SliceCoupling = True


class Friction(FrictionTable):
    """Which law acts between the flanks, and the law's own keys."""

    sliding: Literal["kinematic", "dynamic"] = Field(
        "dynamic", description="sliding speed from nominal rotation or from the vibrating bodies"
    )
    reversal_width: Smoothing = written("20 um", description="along the path, over which friction turns at P")


class Solver(Table):
    """How the equations are solved."""

    method: Text = "auto"
    rtol: Annotated[float, Field(strict=True, ge=1e-13, le=1e-2)] = 1e-6
    cycles: Count = Field(20, description="mesh cycles to run")
    max_steps: Annotated[int, Field(strict=True, gt=0, le=10**9)] = Field(
        1_000_000, description="steps allowed in one mesh cycle"
    )
    initial: Literal["static", "unloaded"] = Field("static", description="state at the start")


class Output(Table):
    """What is recorded."""

    samples_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 200


class GearPairScenario(GearScenario):
    """A scenario file."""

    kind: Literal["gear-pair"] = "gear-pair"
    lubricant: Oil
    bearings: Annotated[Bearings, model_file("bearings")] = written("rigid-1e9")
    operating: Operating
    mesh: Mesh
    temperature: TemperatureKeys = None
    losses: LossKeys = None
    film: FilmKeys = None
    friction: Friction
    solver: Solver = written({})
    output: Output = written({})


Scenario = GearPairScenario


def case_of(scenario: Scenario, toml: str, sha256: str) -> Case:
    """Return the case of a scenario that has passed schema and rules."""
    own: dict[str, Any] = {"operating": _operating(scenario), "mesh": _mesh(scenario)}
    case = Case(
        **gear_fields(scenario, toml, sha256) | own,
        **oil_fields(scenario),
        bearings=bearings_of(scenario.bearings),
        solver=SolverData(**scenario.solver.model_dump()),
        output=OutputData(**scenario.output.model_dump()),
    )
    return with_chosen_laws(case)


def _operating(scenario: Scenario) -> OperatingData:
    operating, drive = scenario.operating, scenario.drive
    curve = operating.gear_torque_table
    return OperatingData(
        **duty_of(operating.load, drive.pinion.teeth, drive.gear.teeth)._asdict(),
        pinion_torque=operating.motor_torque,
        torque_table=curve.in_si() if curve else None,
        torque_harmonics=tuple(
            (cosine.amplitude, cosine.frequency, cosine.phase) for cosine in operating.gear_torque_harmonics
        ),
        **operating.model_dump(
            exclude={"gear_torque_table", "gear_torque_harmonics", *OiledOperatingTable.model_fields}
        ),
    )


def _mesh(scenario: Scenario) -> MeshData:
    mesh, error = scenario.mesh, scenario.mesh.transmission_error
    return mesh_of(
        scenario,
        error=error.table.in_si() if error.table else None,
        table=mesh.table.in_si() if mesh.table else None,
        error_harmonics=tuple((cosine.order, cosine.amplitude, cosine.phase) for cosine in error.harmonics),
        backlash=backlash_of(scenario.drive, mesh.backlash),
    )
