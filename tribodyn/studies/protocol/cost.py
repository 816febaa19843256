"""What the parts of a run cost: one model for all kinds, which state by counts what a run consists of."""

from collections.abc import Mapping

from tribodyn.record.schema import Layout
from tribodyn.solve.methods import Runs, runs
from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes

#: Finite elements of both gears with free ends, s.
FINITE_ELEMENTS = Estimate(shared=20.0)
#: Bytes of the outlines of teeth in a record.
OUTLINES = 0.15 * 2.0**20
#: Pairs that can touch at once, corners included, as the load contact model has them.
TOUCHING = 3
#: Load sharing: s of a position, and of every pair of places in contact; bytes of the model; entries of the
#: systems that are solved at a time, and bytes that one takes meanwhile.
SHARED_POSITION, SHARED_PLACE, SHARING_MODEL, ENTRIES, ENTRY = 4e-5, 1.8e-6, 25 * 2.0**20, 2e6, 60.0
#: Table of a mesh: segments, slots of pairs on one side; bytes and s of a node of a slot; bytes of a spline's
#: equations over the square of its nodes, s over the cube.
SEGMENTS, PAIRS, NODE_BYTES, NODE, SPLINE_BYTES, SPLINE = 2, 2, 2000.0, 2e-6, 24.0, 2e-10
#: Marching: step of an explicit method times the largest angular frequency; steps in a mesh cycle at least,
#: and those of an implicit one; s of a step, by what runs the method; of an implicit native one; of a sample.
EXPLICIT_STEP, LEAST_STEPS, IMPLICIT_STEPS = 1.25, 50.0, 3000.0
MARCHED_STEP = {Runs.NATIVE: 2.5e-6, Runs.SCIPY: 3e-4, Runs.JAX: 5e-5}
IMPLICIT_STEP, MARCHED_SAMPLE = 3e-5, 5e-6
#: Bytes of a sample of the dynamics while it is worked out.
SAMPLE_BYTES = 2800.0
#: How much less a mesh cycle takes with eight cases side by side.
SIDE_BY_SIDE = 0.3


def total(drivers: tuple[Driver, ...], *parts: Estimate) -> Estimate:
    """The program itself and the parts of a run, which grow with the keys of the drivers."""
    memory, record, seconds, shared = (
        sum(getattr(part, name) for part in parts) for name in ("memory", "record", "seconds", "shared")
    )
    return Estimate(PROGRAM + memory, record, seconds, drivers, shared)


def recorded(
    layout: Layout, sizes: Mapping[str, int], copies: float = 0.0, *, outlines: bool = False
) -> Estimate:
    """A record of these sizes, so many copies of which are in memory."""
    size = record_bytes(layout, sizes) + (OUTLINES if outlines else 0.0)
    return Estimate(copies * size, size)


def in_memory(values: float, size: float) -> Estimate:
    """Values of so many bytes each."""
    return Estimate(memory=values * size)


def load_sharing(positions: float, slices: float, at_once: float | None = None) -> Estimate:
    """Teeth pressed together at some positions, slice by slice; those at once, where they are fewer."""
    places = (TOUCHING * slices) ** 2
    entries = (positions if at_once is None else at_once) * places
    memory = SHARING_MODEL + ENTRY * min(entries, max(ENTRIES, places))
    return Estimate(memory, seconds=positions * (SHARED_POSITION + SHARED_PLACE * places))


def mesh_table(points: float, sides: int, slices: float | None = None) -> Estimate:
    """The table of a mesh: points per segment, sides of teeth; with `slices` by finite elements."""
    slots, nodes = PAIRS * sides, SEGMENTS * points * sides
    memory = NODE_BYTES * nodes * slots + SPLINE_BYTES * points**2
    seconds = 0.05 + NODE * nodes * slots + SPLINE * points**3
    if slices is not None:
        sharing = load_sharing(nodes, slices)
        memory += sharing.memory
        seconds += FINITE_ELEMENTS.shared + sides * sharing.seconds
    return Estimate(memory, OUTLINES + 8.0 * nodes * slots * (12 + slots), shared=seconds)


def marching(
    cycles: float, radians: float, method: str, most_steps: float, samples: float, *, together: bool = False
) -> Estimate:
    """Mesh cycles of so many radians of the fastest oscillation each, and samples in each.

    `together`: of many cases side by side.
    """
    explicit = min(max(LEAST_STEPS, radians / EXPLICIT_STEP), most_steps)
    native = explicit * MARCHED_STEP[Runs.NATIVE]
    steps = {
        None: min(native, IMPLICIT_STEPS * IMPLICIT_STEP),
        Runs.NATIVE: native,
        Runs.SCIPY: max(explicit, IMPLICIT_STEPS) * MARCHED_STEP[Runs.SCIPY],
        Runs.JAX: explicit * MARCHED_STEP[Runs.JAX],
    }
    cycle = steps[runs(method)] + MARCHED_SAMPLE * samples
    return Estimate(seconds=(SIDE_BY_SIDE if together else 1.0) * cycles * cycle)


def quasi_static_cycle(samples: float) -> Estimate:
    """A mesh cycle in slow rotation, its path sought, its means over it taken, and so many samples of it."""
    return Estimate(6 * 2.0**20 + 1250.0 * samples, seconds=0.2 + 6e-5 * samples)


def steady_states(speeds: float, laws: float, samples: float) -> Estimate:
    """Steady states at some speeds and of some samples of deviations, and losses by some friction laws."""
    return Estimate(100e3 * (speeds + samples), seconds=0.15 * speeds + 0.5 * laws + 0.7 * samples)


def solved_contacts(positions: float, steady: float, *, squeeze: bool, coarseness: float) -> Estimate:
    """Lubricated contacts solved: steady ones, and a way over the positions with squeeze.

    `coarseness`: step of the grid over the usual one.
    """
    seconds = 0.3 * steady + (8.0 + 0.015 * positions if squeeze else 0.0)
    return Estimate(seconds=seconds / coarseness**2)


def rolling_elements(samples: float, elements: float) -> Estimate:
    """Loads of rolling elements at some samples."""
    return Estimate(seconds=0.1 + 1e-6 * samples * elements)


def forced_periods(periods: float, radians: float) -> Estimate:
    """Periods of an oscillator's excitation, and radians of its free oscillation in them."""
    return Estimate(seconds=2e-6 * periods + 2e-7 * radians)
