"""When the set of contacting pairs changes: the cycles of the reference mesh, cut into intervals.

The frequencies of a train's meshes are rational multiples of each other, so that all of them stand at their
phases again after a common period of whole reference cycles. An interval ends where any mesh comes to the
next segment of its table. In mesh 0 this is exact; in the others, whose driver may be twisted against the
reference, it falls where the nominal rotation has it from the phase at the start, to which the caller may add
the static twist (`solve.twist`); what the twist fluctuates by is some 1e-4 of a cycle.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import floor, lcm
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import law, namespace
from tribodyn.numerics.shapes import Array, Float, Int

#: Reference cycles; changes that are closer than this fall together.
TOGETHER = 1e-9


class Schedule(NamedTuple):
    """Intervals of the common period, or of a run that is shorter, with the cycle that begins at its end.

    Phases are of the reference mesh, 0 … 1 in each of its cycles.
    """

    first: Float[Array, " bound"]  # number of the interval that begins each reference cycle; last, of all
    start: Float[Array, " interval"]  # phase
    end: Float[Array, " interval"]
    segment: Float[Array, "interval mesh"]  # of the mesh's table; whole
    opens: Float[Array, "interval mesh"]  # 1 where the mesh comes to this segment at the interval's start
    rate: Float[Array, " mesh"]  # cycles of the mesh per reference cycle
    offset: Float[Array, "interval mesh"]  # phase of the mesh less its rate times the phase
    #: driver_tooth, driven_tooth: numbers of the teeth that entered last, see `with_teeth`; 0 where all teeth
    #: are alike
    driver_tooth: Float[Array, "interval mesh"]
    driven_tooth: Float[Array, "interval mesh"]

    @property
    def period(self) -> int:
        """Reference cycles that are laid out; of whole common periods, after which everything repeats."""
        return len(self.first) - 1


def of_one_mesh(boundary: Float[Array, " boundary"]) -> Schedule:
    """The schedule of a single mesh: the segments of its table. The boundary may be traced."""
    xp = namespace(boundary)
    count = boundary.shape[0] - 1
    segment = np.arange(count, dtype=float)[:, None]
    start, end = xp.asarray(boundary)[:-1], xp.asarray(boundary)[1:]
    first = np.array([0.0, count])
    offset, one, two = np.zeros((3, count, 1))
    return Schedule(first, start, end, segment, np.ones((count, 1)), np.ones(1), offset, one, two)


def common_period(rates: Sequence[Fraction]) -> int:
    """Reference cycles after which meshes of these rates stand at their phases again."""
    return lcm(*(rate.denominator for rate in rates))


def schedule_of(
    boundaries: Sequence[Float[Array, " boundary"]],
    rates: Sequence[Fraction],
    phases: Sequence[float],
    cycles: int | None = None,
) -> Schedule:
    """The schedule of meshes of given boundaries, rates and phases (mesh cycles) at the start.

    The first one is the reference, of rate 1 and phase 0. So many reference cycles are laid out, or the
    common period, which repeats, if that is shorter or none are given.
    """
    if len(boundaries) == 1:
        return of_one_mesh(boundaries[0])
    period = common_period(rates)
    count = period if cycles is None else min(period, cycles)
    parts = list(zip(boundaries, rates, phases, strict=True))
    places, numbers = [], []
    for mesh, (boundary, rate, phase) in enumerate(parts):
        passed = floor(float(phase))
        turns = np.arange(passed - 1, passed + int(count * rate) + 2)
        place = ((turns[:, None] + np.asarray(boundary)[:-1] - phase) / float(rate)).ravel()
        nearest = np.round(place)  # the reference's own cycles begin at whole numbers
        place = np.where(np.abs(place - nearest) < TOGETHER, nearest, place)
        places.append(place[(place >= 0.0) & (place < count)])
        numbers.append(np.full(len(places[-1]), mesh))
    at, by = np.concatenate(places), np.concatenate(numbers)
    order = np.lexsort((by, at))
    at, by = at[order], by[order]
    begins = np.diff(at, prepend=-1.0) >= TOGETHER
    starts = at[begins]
    opens = np.zeros((len(starts), len(parts)))
    opens[np.cumsum(begins) - 1, by] = 1.0
    ends = np.append(starts[1:], float(count))
    begun = np.floor(starts)
    segment, offset = np.zeros_like(opens), np.zeros_like(opens)
    for mesh, (boundary, rate, phase) in enumerate(parts):
        middle = phase + float(rate) * 0.5 * (starts + ends)
        inside = np.searchsorted(np.asarray(boundary), middle - np.floor(middle), side="right") - 1
        segment[:, mesh] = np.clip(inside, 0, len(boundary) - 2)
        # of whole numbers, whose quotients are exact to the last bit however many cycles there are
        turned = np.array([rate.numerator * cycle / rate.denominator for cycle in range(count)])
        offset[:, mesh] = phase + turned[begun.astype(int)] - np.floor(middle)
    first = np.searchsorted(begun, np.arange(count + 1)).astype(float)
    rate, (one, two) = np.array([float(rate) for rate in rates]), np.zeros((2, *opens.shape))
    return Schedule(first, starts - begun, ends - begun, segment, opens, rate, offset, one, two)


def with_teeth(
    schedule: Schedule, first: Sequence[tuple[int, int]], teeth: Sequence[tuple[int, int]], cycles: int
) -> Schedule:
    """The schedule of so many reference cycles, or of the hunting period if that is shorter, with its teeth.

    `schedule` has whole common periods, or at least so many cycles. `first` are the numbers of the driver's
    and the driven gear's teeth that entered each mesh last at the start, `teeth` how many these gears have.
    After as many cycles of a mesh as the least common multiple of both the same teeth meet again.
    """
    short, count = schedule.period, len(np.asarray(schedule.start))
    begun = np.searchsorted(np.asarray(schedule.first)[1:], np.arange(count), side="right")
    rate, offset = np.asarray(schedule.rate), np.asarray(schedule.offset)
    turns = np.round(offset[0] + rate * begun[:, None] - offset)  # whole cycles of every mesh since the start
    in_period = np.maximum(np.round(rate * short).astype(int), 1)
    hunting = [
        lcm(int(turned), *(abs(z) for z in both)) // int(turned)
        for turned, both in zip(in_period, teeth, strict=True)
    ]
    times = min(lcm(*hunting), -(-cycles // short) + 1)  # the end of a run belongs to what begins there
    whole = (turns + in_period * np.arange(times)[:, None, None]).reshape(times * count, -1)
    numbers = [
        np.mod(whole + [one[end] for one in first], [abs(both[end]) for both in teeth]) for end in (0, 1)
    ]
    starts = (np.asarray(schedule.first)[:-1] + count * np.arange(times)[:, None]).ravel()
    return Schedule(
        np.append(starts, float(times * count)),
        np.tile(schedule.start, times),
        np.tile(schedule.end, times),
        np.tile(schedule.segment, (times, 1)),
        np.tile(schedule.opens, (times, 1)),
        rate,
        np.tile(offset, (times, 1)),
        *numbers,
    )


@law
def phase_of(phase, interval, mesh, schedule):
    """Phase of a mesh at a phase of the reference in an interval."""
    return schedule.rate[mesh] * phase + schedule.offset[interval, mesh]


def interval_of(
    cycles: Float[Array, "*sample"], schedule: Schedule
) -> tuple[Float[Array, "*sample"], Float[Array, "*sample"], Int[Array, "*sample"]]:
    """Whole reference cycles, phase and interval at mesh cycles since the start, whole and fraction.

    What stands on a boundary belongs to the interval that begins there.
    """
    whole = np.floor(cycles + 1e-12)
    phase = np.maximum(cycles - whole, 0.0)
    first, start = np.asarray(schedule.first), np.asarray(schedule.start)
    cycle_of_start = np.searchsorted(first[1:], np.arange(len(start)), side="right")
    at = np.mod(whole, schedule.period) + phase
    interval = np.searchsorted(cycle_of_start + start, at, side="right") - 1
    return whole, phase, np.clip(interval, 0, len(start) - 1)


def intervals(schedule: Schedule, cycle: int) -> range:
    """Numbers of the intervals of a reference cycle since the start."""
    first = np.asarray(schedule.first)
    k = cycle % schedule.period
    return range(int(first[k]), int(first[k + 1]))


def sample_phases(schedule: Schedule, samples: int) -> list[Float[Array, " sample"]]:
    """Phases k/samples in every interval, to which its start belongs and its end does not."""
    phases = np.arange(samples) / max(samples, 1)
    ends = zip(np.asarray(schedule.start).tolist(), np.asarray(schedule.end).tolist(), strict=True)
    return [phases[(phases >= start) & (phases < end)] for start, end in ends]


def place_of(mesh: int, phase: Any, schedule: Schedule, interval: int) -> float:
    """Phase of the reference at which a mesh stands at a phase of its own, in an interval."""
    return float((phase - np.asarray(schedule.offset)[interval, mesh]) / np.asarray(schedule.rate)[mesh])
