"""What a run takes, estimated before it begins, and the limits above which it has to be allowed.

One model of what the parts of a run cost for all kinds, which state by counts what a run consists of.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.numerics.parameter import Variable
from tribodyn.numerics.processes.work import foretell
from tribodyn.record.schema import Layout
from tribodyn.solve.methods import Runs, runs

GIB = 2.0**30
#: Bytes of the program itself, its libraries and compiled kernels, and of a record without its samples.
PROGRAM, HEAD = 160 * 2.0**20, 30e3


class CostKey(NamedTuple):
    """A key that an estimate grows with."""

    key: str
    #: value, usual: here, and usually; or anything of that ratio, where there is a `remedy`
    value: float
    usual: float
    remedy: str = ""  # what to do about it, where that is not to reduce the value


class Estimate(NamedTuple):
    """What a run takes."""

    #: bytes at once, the program included; true within a factor of about two where it is large
    memory: float = 0.0
    record: float = 0.0  # bytes of the record; while it is concluded there are two of it
    seconds: float = 0.0  # of one core, compiling not included; of the right order
    drivers: Sequence[CostKey] = ()  # what to reduce
    shared: float = 0.0  # seconds, in addition, that cases of a sweep which share a table spend once


#: Above any of these a run is refused unless it is asked for; from this share on `check` says the estimate.
LIMITS = Estimate(memory=8 * GIB, record=64 * GIB, seconds=1000 * 3600.0)
WORTH_SAYING = 0.05
#: Seconds of one core from which a run says beforehand what it takes.
LONG = 60.0


def record_bytes(layout: Layout, sizes: Mapping[str, int]) -> float:
    """Bytes of a record with so many values along its dimensions; datasets with another one are left out."""
    every = *layout.along.values(), *layout.scales.values(), *layout.others.values()
    return HEAD + variable_bytes(every, sizes)


def variable_bytes(variables: Iterable[Variable], sizes: Mapping[str, int]) -> float:
    """Bytes of datasets, those along an axis without a size left out.

    NumPy's names of types end in the bytes of a number: "<f8", "i1", "S24".
    """
    return sum(
        math.prod(float(sizes[dim]) for dim in variable.dims) * int(variable.dtype.lstrip("<>|=")[1:])
        for variable in variables
        if all(dim in sizes for dim in variable.dims)
    )


def share_of_limits(estimate: Estimate) -> float:
    """The largest of what is taken over what is allowed."""
    return max(amount / most for amount, most in zip(estimate[:3], LIMITS[:3], strict=True))


def described(estimate: Estimate) -> str:
    """What a run takes, in words."""
    return (
        f"{_size(estimate.memory)} of memory, a record of {_size(estimate.record)} "
        f"and {_time(estimate.seconds + estimate.shared)} of one core"
    )


def as_data(estimate: Estimate) -> dict[str, float]:
    """What a run takes, for programs: bytes and seconds."""
    return {
        "memory": estimate.memory,
        "record": estimate.record,
        "core_seconds": estimate.seconds + estimate.shared,
    }


def say_beforehand(estimate: Estimate) -> None:
    """Say what is going to take longer than `LONG`, to whoever shows progress."""
    if estimate.seconds + estimate.shared >= LONG:
        foretell(f"takes about {described(estimate)}")


def refuse_large(estimate: Estimate, allow_large: bool) -> None:
    """Refuse what takes more than `LIMITS`, unless it is allowed; name the key furthest above usual."""
    whole = estimate._replace(seconds=estimate.seconds + estimate.shared)
    if allow_large or share_of_limits(whole) <= 1.0 or not estimate.drivers:
        return
    worst = max(estimate.drivers, key=lambda driver: driver.value / driver.usual)
    allowed = f"{_size(LIMITS.memory)}, {_size(LIMITS.record)} and {_time(LIMITS.seconds)}"
    raise InputError(
        worst.key,
        None if worst.remedy else f"{worst.value:.10g}",
        f"takes about {described(estimate)}, above the limits: {allowed}",
        f"{worst.remedy or f'reduce it ({worst.usual:g} is usual)'}, or add --allow-large",
    )


def _size(size: float) -> str:
    for unit, name in ((GIB, "GiB"), (2.0**20, "MiB")):
        if size >= unit:
            return f"{size / unit:.3g} {name}"
    return f"{size / 1024:.3g} KiB"


def _time(seconds: float) -> str:
    for unit, name in ((86400.0, "days"), (3600.0, "hours"), (60.0, "minutes")):
        if seconds >= 2 * unit:
            return f"{seconds / unit:.3g} {name}"
    return f"{seconds:.0f} s" if seconds >= 10.0 else f"{seconds:.2g} s"


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


def total(drivers: tuple[CostKey, ...], *parts: Estimate) -> Estimate:
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
    """Steady states at some speeds, losses by some friction laws, and both of some samples."""
    return Estimate(100e3 * (speeds + 7.0 * samples), seconds=0.15 * speeds + 0.5 * laws + 1.5 * samples)


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
