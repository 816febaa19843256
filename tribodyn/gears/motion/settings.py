"""Tables of scenarios that run gears over time: mesh, friction, solver, output, what drives; their rules."""

from collections.abc import Iterator, Sequence
from math import ceil
from typing import Annotated, Any, Literal

from pydantic import Field

from tribodyn.compliance.foundation import Foundation, Support
from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.gears.case import OutputData
from tribodyn.gears.scenario import (
    FaceSlices,
    broken_stiffness_rules,
    mesh_data,
)
from tribodyn.input import fields, units
from tribodyn.input.quantity import (
    Count,
    InUnit,
    Names,
    NotNegative,
    Positive,
    Switch,
    Table,
    Text,
    csv_file,
    written,
)
from tribodyn.input.tables.bearings import Stiffness
from tribodyn.input.tables.duty import DutyTable, OiledOperatingTable
from tribodyn.input.tables.gears.drive_data import backlash_of
from tribodyn.input.tables.gears.model_files import MisalignmentTable
from tribodyn.input.tables.gears.quality import DeviationSample
from tribodyn.input.tables.gears.single_teeth import ToothSampleNumber
from tribodyn.input.tables.laws import FrictionTable
from tribodyn.mesh.table import MeshData
from tribodyn.solve.methods import AUTO, METHODS, SOLVERS, SolverData, in_time

#: Cosines in a load or an error: a curve is given by points.
MOST_HARMONICS = 1000

Smoothing = Annotated[float, InUnit(units.positive(units.LENGTH), "0.1 um")]


class TorqueHarmonic(Table):
    """A cosine in the load torque."""

    amplitude: fields.Torque
    frequency: Annotated[float, InUnit(units.positive(units.ANGULAR_FREQUENCY))]
    phase: fields.Angle = written("0 deg")


def harmonics_of(harmonics: Sequence[TorqueHarmonic]) -> tuple[tuple[float, float, float], ...]:
    """Amplitude (N m), angular frequency (rad/s) and phase (rad) of cosines."""
    return tuple((cosine.amplitude, cosine.frequency, cosine.phase) for cosine in harmonics)


class Operating(OiledOperatingTable):
    """How a gearbox is driven and loaded: nominal speed, constant part of the load, and more."""

    source: Literal["speed", "torque"] = "speed"
    output_torque_table: Annotated[fields.TorqueCurve, csv_file("time", "torque")] | None = None
    output_torque_harmonics: tuple[TorqueHarmonic, ...] = Field((), max_length=MOST_HARMONICS)
    load_inertia: fields.Inertia = written("0 kg*m**2")
    load_damping: fields.TorsionalDamping = written("0 N*m*s/rad")
    drive_inertia: fields.Inertia = written("0 kg*m**2")
    shaft_stiffness: fields.TorsionalStiffness | None = None
    shaft_damping: fields.TorsionalDamping = written("0 N*m*s/rad")
    speed_regulation: fields.TorsionalDamping = written("0 N*m*s/rad")
    torque_speed_curve: Annotated[fields.MotorCurve, csv_file("speed", "torque")] | None = None
    start_speed: Annotated[float, InUnit(units.not_negative(units.ANGULAR_SPEED))] | None = None

    @property
    def motor_torque(self) -> float | None:
        """Torque of the motor, given beside the load; None: it balances the load without losses."""
        load_given = self.output_torque is not None or self.power is not None
        return self.input_torque if load_given else None

    @property
    def load(self) -> DutyTable:
        """Speed and load, without the torque of the motor."""
        return self if self.motor_torque is None else self.model_copy(update={"input_torque": None})


class ErrorHarmonic(Table):
    """A cosine in the static transmission error, over the mesh cycle."""

    order: Count
    amplitude: fields.Error
    phase: fields.Angle = written("0 deg")


class TransmissionError(Table):
    """Static transmission error e of a pair, positive where material is missing."""

    harmonics: tuple[ErrorHarmonic, ...] = Field((), max_length=MOST_HARMONICS)
    table: Annotated[fields.ErrorCurve, csv_file("roll_angle", "error")] | None = None


class Mesh(Table):
    """How the teeth in contact deflect, damp, separate and err."""

    damping_ratio: NotNegative
    compliance: Literal["energy", "fem", "constant", "table"] = "energy"
    hertz: Literal["linear", "load-dependent"] = "linear"
    foundation: Foundation = "sainsot-velex"
    foundation_coupling: Switch = True
    body: Support = "free"
    stiffness: Stiffness | None = None
    table: Annotated[fields.StiffnessCurve, csv_file("roll_angle", "stiffness")] | None = None
    formulation: Literal["classical", "energy-consistent"] = "classical"
    contact_width: Smoothing = written("0.1 um")
    backlash: Annotated[float, InUnit(units.not_negative(units.LENGTH), "0.1 mm")] | None = None
    points: Annotated[int, Field(strict=True, ge=5)] = 65
    transmission_error: TransmissionError = written({})
    deviation_sample: DeviationSample | None = None
    tooth_sample: ToothSampleNumber = None
    misalignment: MisalignmentTable = written({})
    slices: FaceSlices = None
    slice_coupling: Switch = True


class Friction(FrictionTable):
    """Which law acts between the flanks, and the law's own keys."""

    sliding: Literal["kinematic", "dynamic"] = "dynamic"
    reversal_width: Smoothing = written("20 um")


class Solver(Table):
    """How the equations are solved."""

    method: Annotated[Text, Names(SOLVERS)] = AUTO
    rtol: Annotated[float, Field(strict=True, ge=1e-13, le=1e-2)] = 1e-6
    cycles: Count = 20
    revolutions: Positive | None = None
    duration: Annotated[float, InUnit(units.positive(units.TIME))] | None = None
    max_steps: Annotated[int, Field(strict=True, gt=0, le=10**9)] = 1_000_000
    initial: Literal["static", "unloaded"] = "static"


class Output(Table):
    """What is recorded."""

    samples_per_cycle: Annotated[int, Field(strict=True, ge=8)] = 200
    window: Literal["all"] | tuple[NotNegative, Positive] | None = None


def moving_mesh_of(scenario: Any, **fields: Any) -> MeshData:
    """Return what a scenario's `drive` and its table `mesh`, a `Mesh`, say of the mesh; see `mesh_data`."""
    mesh, error = scenario.mesh, scenario.mesh.transmission_error
    return mesh_data(
        scenario,
        error=error.table.in_si() if error.table else None,
        table=mesh.table.in_si() if mesh.table else None,
        error_harmonics=tuple((cosine.order, cosine.amplitude, cosine.phase) for cosine in error.harmonics),
        backlash=backlash_of(scenario.drive, mesh.backlash),
        tilting=True,
        **fields,
    )


def solver_data(solver: Solver, teeth: int) -> SolverData:
    """Return what a table [solver] says; `teeth` are those of the gear that drives the first mesh."""
    cycles = solver.cycles
    if solver.revolutions is not None:
        cycles = max(1, ceil(solver.revolutions * teeth - 1e-9))
    settings = solver.model_dump(include={"method", "rtol", "max_steps", "initial", "duration"})
    return SolverData(cycles=cycles, **settings)


def output_data(output: Output, solver: Solver, teeth: int, *, differ: bool) -> OutputData:
    """Return what a table [output] says; `differ`: whether teeth differ."""
    cycles = solver_data(solver, teeth).cycles
    window = output.window
    if window is None and solver.revolutions is not None:
        window = max(0.0, cycles / teeth - 1.0), cycles / teeth
    kept = None
    if isinstance(window, tuple):
        first, last = (min(cycles, round(revolutions * teeth)) for revolutions in window)
        kept = min(first, cycles - 1), max(last, first + 1)
    by_revolution = differ or solver.revolutions is not None or output.window is not None
    return OutputData(output.samples_per_cycle, kept, teeth if by_revolution else 0)


def broken_output_rules(output: Output, solver: Solver, teeth: int) -> Iterator[InputError]:
    """Go through what contradicts in a table [output]."""
    if not isinstance(output.window, tuple):
        return
    first, last = output.window
    whole = solver_data(solver, teeth).cycles / teeth
    shown = f"{first:g} to {last:g} revolutions"
    if last <= first:
        yield InputError("output.window", shown, "ends before it begins", "write it like [9, 10]")
    elif first >= whole:
        rule = f"begins behind the end of the run, which has {whole:.4g} revolutions"
        yield InputError(
            "output.window", shown, rule, "choose an earlier one, or run longer: solver.revolutions"
        )


def broken_solver_rules(solver: Solver) -> Iterator[InputError]:
    """Go through what contradicts in a table [solver]."""
    if solver.method not in SOLVERS:
        yield unknown_name("solver.method", solver.method, SOLVERS, "solver")


def broken_rules_in_time(scenario: Any) -> Iterator[InputError]:
    """Go through what a run by time cannot have; nothing of other runs."""
    solver, operating, mesh = scenario.solver, scenario.operating, scenario.mesh
    if solver.duration is None:
        return
    key = "solver.duration"
    if operating.source == "speed":
        rule = 'is of gears that a motor drives, and with source = "speed" the rotation is prescribed'
        yield InputError(key, None, rule, 'write source = "torque", or give solver.cycles')
    if solver.method in METHODS and not in_time(solver.method):
        rule = "integrates over the rotation, and with solver.duration the gears may stand"
        others = ", ".join(filter(in_time, METHODS))
        yield InputError("solver.method", quoted(solver.method), rule, f'use "auto", {others}')
    if solver.revolutions is not None:
        yield InputError("solver.revolutions", None, "contradicts solver.duration", "give one of them")
    if scenario.output.window is not None:
        rule = "counts revolutions, and with solver.duration the gears may stand"
        yield InputError("output.window", None, rule, "leave it out")
    if getattr(mesh, "formulation", "classical") != "classical":
        rule = "takes energy from the rotation as pairs enter, of which gears that stand have none"
        yield InputError("mesh.formulation", quoted(mesh.formulation), rule, 'use "classical"')
    if scenario.sensor:
        rule = "hears a run over the rotation, and with solver.duration the gears may stand"
        yield InputError("sensor", None, rule, "leave the sensors out, or give solver.cycles")


def broken_source_rules(operating: Operating) -> Iterator[InputError]:
    """Go through what contradicts in how a gearbox is driven."""
    if operating.torque_speed_curve is not None:
        yield from _broken_curve(operating)
    elif operating.source == "speed":
        of_motor = ("drive_inertia", "shaft_stiffness", "shaft_damping", "speed_regulation")
        motor_values = {name: getattr(operating, name) for name in of_motor}
        for name, value in {"input_torque": operating.motor_torque, **motor_values}.items():
            if value:
                yield InputError(
                    f"operating.{name}",
                    f"{value:g} (SI)",
                    'contradicts source = "speed": a prescribed rotation needs no motor',
                    f'leave {name} out, or write source = "torque"',
                )
        if operating.start_speed is not None:
            shown, rule = f"{operating.start_speed:g} rad/s", "is the motor's, and the rotation is prescribed"
            yield InputError("operating.start_speed", shown, rule, 'write source = "torque", or leave it out')
    if operating.source == "speed":
        return
    if operating.shaft_stiffness is None and operating.shaft_damping:
        yield InputError(
            "operating.shaft_damping",
            f"{operating.shaft_damping:g} N*m*s/rad",
            "a rigid shaft has no damping",
            "add shaft_stiffness, or leave shaft_damping out",
        )
    elif operating.shaft_stiffness is not None and operating.drive_inertia == 0:
        yield InputError(
            "operating.drive_inertia",
            "0 kg*m**2",
            "a compliant shaft needs a motor with inertia at its end",
            'add drive_inertia = "0.01 kg*m**2", or leave shaft_stiffness out',
        )


def _broken_curve(operating: Operating) -> Iterator[InputError]:
    """Go through what contradicts the curve of a motor's torque."""
    key, curve = "operating.torque_speed_curve", operating.torque_speed_curve
    if operating.source == "speed":
        rule = 'is a motor\'s, and with source = "speed" the rotation is prescribed'
        yield InputError(key, None, rule, 'write source = "torque", or leave it out')
    for name, given in (
        ("input_torque", operating.motor_torque),
        ("speed_regulation", operating.speed_regulation),
    ):
        if given:
            rule = "is said by torque_speed_curve too"
            yield InputError(f"operating.{name}", None, rule, "leave one of them out")
    if curve is not None and len(curve.speed.values) < 2:
        yield InputError(key, None, "has one point", "give at least two")


def broken_mesh_rules(mesh: Mesh) -> Iterator[InputError]:
    """Go through what a table [mesh] lacks, or says twice, of its compliance and its error."""
    yield from broken_stiffness_rules(mesh)
    error = mesh.transmission_error
    if error.harmonics and error.table is not None:
        yield InputError(
            "mesh.transmission_error.table",
            rule="contradicts mesh.transmission_error.harmonics",
            remedy="give the one or the other",
        )


def broken_flank_rules(key: str, torque: float, back_flanks: bool, mesh: Mesh) -> Iterator[InputError]:
    """Refuse a load that no flank can carry, what it leaves without effect, and no load where one is needed.

    `torque` (N m) on the driven gear is what stands at `key`; `back_flanks` says whether they can touch.
    """
    if torque <= 0 and not back_flanks:
        yield InputError(
            key,
            f"{torque:g} N*m",
            "must be greater than zero: without backlash only the driving flanks can carry load",
            'write a torque such as "500 N*m", or add mesh.backlash',
        )
    for name in ("harmonics", "table"):
        if torque < 0 and getattr(mesh.transmission_error, name):
            yield InputError(
                f"mesh.transmission_error.{name}",
                rule="is of the driving flanks, but under a negative output_torque the back flanks carry",
                remedy="leave it out, or reverse the load",
            )
    if torque < 0 and mesh.deviation_sample is not None:
        yield InputError(
            "mesh.deviation_sample",
            mesh.deviation_sample,
            "is of the driving flanks, but under a load that drives the gear the back flanks carry",
            "leave it out, or reverse the load",
        )
    if torque == 0 and back_flanks and mesh.compliance == "fem":
        yield InputError(
            key,
            "0 N*m",
            'contradicts compliance = "fem", which is taken at this load',
            'write a torque such as "500 N*m", or use compliance = "energy"',
        )
