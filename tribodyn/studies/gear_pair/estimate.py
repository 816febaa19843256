"""What a run of a gear pair's dynamics takes, before any work."""

import math
from typing import NamedTuple

from tribodyn.dynamics.parameters import STATES
from tribodyn.solve.methods import Runs, runs
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gear_pair.run import window_of
from tribodyn.studies.gears.estimate import (
    FINITE_ELEMENTS,
    OUTLINES,
    pressed_memory,
    pressed_seconds,
    stiffest,
)
from tribodyn.studies.gears.shared import LAYOUT
from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes

#: Stiffness of a mesh over width and modulus of elasticity: 20 N/(mm µm) of steel, ISO 6336-1.
MESH_STIFFNESS = 0.1
#: Step of an explicit method times the largest angular frequency; steps in a mesh cycle at least, and those
#: of an implicit one.
EXPLICIT_STEP, LEAST_STEPS, IMPLICIT_STEPS = 1.25, 50.0, 3000.0
#: Seconds of a step, by what runs the method; of an implicit native one; of a recorded sample.
A_STEP = {Runs.NATIVE: 2.5e-6, Runs.SCIPY: 3e-4, Runs.JAX: 5e-5}
AN_IMPLICIT_STEP, A_SAMPLE = 3e-5, 5e-6
#: Bytes of a sample while it is worked out, and how often the window's samples are held.
A_SAMPLE_HELD, WINDOW_HELD = 2800.0, 2.0
#: Share of a record that its summary and its pictures read at once.
READ = 0.05
#: Segments of a table and slots of pairs, on one side; bytes of a node of a slot, and seconds.
SEGMENTS, PAIRS, A_NODE, A_NODE_SECONDS = 2, 2, 2000.0, 2e-6
#: Bytes of a spline's equations over the square of its nodes, seconds over the cube.
SPLINE, SPLINE_SECONDS = 24.0, 2e-10
#: Mesh cycles until most steady states are found, and how much less a cycle takes with eight side by side.
STEADY_CYCLES, SIDE_BY_SIDE = 60, 0.3


class Table(NamedTuple):
    """What tabulating the mesh takes: bytes at once, in the record, and seconds."""

    memory: float
    record: float
    seconds: float


def estimate(case: Case) -> Estimate:
    """What a run of a case takes."""
    samples, cycles = float(case.output.samples_per_cycle), float(case.solver.cycles)
    slots = PAIRS * (1 if case.mesh.backlash is None else 2)
    table = tabulation(case)
    record = record_bytes(LAYOUT, {"time": int(samples * cycles) + 1, "pair": slots, "dof": 6})
    each = record / (samples * cycles + 1.0)
    block, window = min(max(cycles / 4.0, 1.0), 50.0) * samples, window_of(int(cycles)) * samples
    memory = A_SAMPLE_HELD * block * slots / PAIRS + WINDOW_HELD * each * window
    return Estimate(
        PROGRAM + memory + READ * record + table.memory,
        record + table.record,
        cycles * cycle_seconds(case),
        drivers(case),
        table.seconds,
    )


def drivers(case: Case) -> tuple[Driver, ...]:
    """Keys that make a case large."""
    return (
        Driver("output.samples_per_cycle", case.output.samples_per_cycle, 200),
        Driver("solver.cycles", case.solver.cycles, 20),
        Driver("mesh.points", case.mesh.points, 65),
        Driver("mesh.slices", case.mesh.slices, 21),
    )


def tabulation(case: Case) -> Table:
    """What the table of a case's mesh takes."""
    slots = PAIRS * (1 if case.mesh.backlash is None else 2)
    nodes = SEGMENTS * float(case.mesh.points) * slots / PAIRS
    points = float(case.mesh.points)
    memory = A_NODE * nodes * slots + SPLINE * points**2
    seconds = 0.05 + A_NODE_SECONDS * nodes * slots + SPLINE_SECONDS * points**3
    if case.mesh.at_load:
        memory += pressed_memory(nodes, case.mesh.slices)
        seconds += FINITE_ELEMENTS + slots / PAIRS * pressed_seconds(nodes, case.mesh.slices)
    return Table(memory, OUTLINES + 8.0 * nodes * slots * (12 + slots), seconds)


def cycle_seconds(case: Case) -> float:
    """Seconds of one core that a mesh cycle takes, its samples included."""
    mesh, teeth = case.mesh, float(case.drive.pinion.teeth)
    width = min(case.drive.pinion.face_width, case.drive.gear.face_width)
    modulus = min(material.youngs_modulus for material in case.materials)
    stiffness = mesh.stiffness if mesh.stiffness is not None else MESH_STIFFNESS * modulus * width
    density = min(material.density for material in case.materials)
    bearings = tuple(max(one.stiffness_x, one.stiffness_y) for one in case.bearings)
    fastest = stiffest(case.drive, stiffness, density, (bearings[0], bearings[1]))
    period = 2.0 * math.pi / (teeth * case.operating.pinion_speed)
    explicit = min(max(LEAST_STEPS, period * fastest / EXPLICIT_STEP), float(case.solver.max_steps))
    how = runs(case.solver.method)
    steps = {
        None: min(explicit * A_STEP[Runs.NATIVE], IMPLICIT_STEPS * AN_IMPLICIT_STEP),
        Runs.NATIVE: explicit * A_STEP[Runs.NATIVE],
        Runs.SCIPY: max(explicit, IMPLICIT_STEPS) * A_STEP[Runs.SCIPY],
        Runs.JAX: explicit * A_STEP[Runs.JAX],
    }
    return steps[how] + A_SAMPLE * case.output.samples_per_cycle


def swept(case: Case, cycles: int, window: int, together: int) -> Estimate:
    """What a case of a sweep takes that marches so many mesh cycles, and the memory of those together."""
    table, samples = tabulation(case), float(case.output.samples_per_cycle)
    states = together * window * samples * STATES * 8.0
    seconds = SIDE_BY_SIDE * float(cycles) * cycle_seconds(case) + A_SAMPLE * window * samples
    memory = PROGRAM + table.memory + 3.0 * states + A_SAMPLE_HELD * window * samples
    marched = () if cycles == STEADY_CYCLES else (Driver("--transient", cycles, STEADY_CYCLES),)
    return Estimate(memory, 0.0, seconds, (*drivers(case), *marched), table.seconds)
