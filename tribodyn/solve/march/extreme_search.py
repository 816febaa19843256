"""Extremes of a motion between its samples, sought step by step while it is integrated.

Every accepted step is measured at its end (`dynamics.extremes.measure`), where the method knows the contacts
already. Where a measure is so near its extreme so far that it may pass it inside the step, it is measured in
the middle too, and where the parabola through the three values is highest, on the method's dense output.
Both sides of every boundary between segments are measured.
"""

from typing import NamedTuple, Self

import numpy as np

from tribodyn.dynamics.contact_forces import normal_contacts
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.extremes import (
    END,
    EXTREME,
    EXTREMES,
    LOWEST,
    MIDDLE,
    RATE,
    ROWS,
    START,
    TRIAL,
    Extremes,
    alike,
    begin_surfaces,
    extreme_of,
    measure,
    measure_end,
    measure_inside,
    measures_of,
    vertex,
)
from tribodyn.dynamics.parameters import STATES
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, law, maximum, where
from tribodyn.numerics.shapes import Array, Float

#: Rise over an extreme, as a share of it, that is not worth another evaluation.
WORTH = 1e-7
#: A rate of change that is not known.
UNKNOWN = 1e150


class Search(NamedTuple):
    """What a search knows."""

    measures: Float[Array, "row measure"]  # (ROWS, measures)
    state: Float[Array, " state"]  # (STATES,); scratch: a state inside a step
    #: extreme, cycles, segments: (EXTREMES,); the most extreme measures so far, and where; as in `Extremes`
    extreme: Float[Array, " extreme"]
    cycles: Float[Array, " extreme"]
    segments: Float[Array, " extreme"]
    states: Float[Array, "extreme state"]  # (EXTREMES, STATES)

    @classmethod
    def begun(cls, pairs: int) -> Self:
        """A search that knows nothing, with so many pair slots."""
        return cls(
            np.zeros((ROWS, measures_of(pairs))),
            np.zeros(STATES),
            np.full(EXTREMES, LOWEST),
            np.zeros(EXTREMES),
            np.zeros(EXTREMES),
            np.zeros((EXTREMES, STATES)),
        )

    def found(self) -> Extremes:
        """What was found."""
        return Extremes(self.extreme, self.cycles, self.segments, self.states)


@law
def promising(start, end, change_before, extreme):
    """Whether a measure may pass its extreme inside a step.

    That is so if a parabola through both ends of the step does which bends twice as much as the one through
    the step before, over which the measure changes by `change_before` in a phase as long as this step. With
    the change d over a step, a parabola that bends by 2 b, its second difference, rises above both ends by
    (b − |d|)²/(4 b), if b is more than |d|. With an end that is not known, `LOWEST`, it never is.
    """
    change = end - start
    bend = absolute(change - change_before)
    over = bend - absolute(change)
    top = where(end > start, end, start)
    short = where(top > extreme, top, extreme) - top + WORTH * absolute(top)
    return (over > 0.0) & (over * over > 4.0 * bend * short)


@law
def rate_of(start, end, per_step):
    """Rate of change of a measure over a step, if both are known; `per_step` is one over the step."""
    return where((start > LOWEST) & (end > LOWEST), (end - start) * per_step, UNKNOWN)


@law
def begin_rates(measures, extreme, rows):
    """Suppose, at the start of a segment, that measures rise twice as fast as any alike moved before.

    There measures have corners, and pairs other slots.
    """
    for which in range(EXTREMES):
        fastest = 0.0 * extreme[which] - 1.0
        for row in alike(which, rows):
            rate = absolute(measures[RATE, row])
            fastest = maximum(fastest, where(rate < UNKNOWN, rate, -1.0))
        known = (extreme[which] > LOWEST) & (fastest >= 0.0)
        for row in alike(which, rows):
            measures[RATE, row] = where(known, 2.0 * fastest, UNKNOWN)


@law
def worthwhile(value, extreme):
    """Whether a value is so far above an extreme that it is worth an evaluation."""
    return value > extreme + WORTH * absolute(extreme)


@kernel
def contacts_at(phase, segment, y, model, work):
    """Fill `work` with the contacts of a state, but for friction."""
    cell, u, cells_per_radian = locate(phase, segment, model.table)
    normal_contacts(segment, cell, u, cells_per_radian, y, model, work)


@kernel
def keep(row, cycles, segment, y, search):
    """Replace the extremes that a row of measures, those of a state, surpasses."""
    for i in range(search.measures.shape[1]):
        value = search.measures[row, i]
        which = extreme_of(i)
        if value > search.extreme[which]:
            search.extreme[which] = value
            search.cycles[which] = cycles
            search.segments[which] = segment
            for j in range(STATES):
                search.states[which, j] = y[j]
            for other in alike(i, search.measures.shape[1]):
                search.measures[EXTREME, other] = value


@kernel
def open_segment(place, y, model, work, search):
    """Measure the state at the start of a segment."""
    for i in range(search.measures.shape[1]):
        for row in range(RATE):
            search.measures[row, i] = LOWEST
        search.measures[EXTREME, i] = search.extreme[extreme_of(i)]
    begin_rates(search.measures, search.extreme, search.measures.shape[1])
    contacts_at(place.phase, place.segment, y, model, work)
    measure(place.phase, place.segment, y, model, work, search.measures[START])
    begin_surfaces(place.phase, place.segment, model, search.measures)
    keep(START, place.cycle + place.phase, place.segment, y, search)


@kernel
def search_step(method, place, step, y, model, work, buffer, search):
    """Seek extremes over an accepted step from the state `y`, which ends at `place.end`."""
    measures = search.measures
    method.contacts(place.end, place.segment, model, work, buffer)
    measure_end(False, place.end, step, place.segment, buffer[0], model, work, measures)
    better, inside = False, False
    for i in range(measures.shape[1]):
        start, end, extreme = measures[START, i], measures[END, i], measures[EXTREME, i]
        better |= end > extreme
        inside |= promising(start, end, measures[RATE, i] * step, extreme)
    if better:
        keep(END, place.cycle + place.end, place.segment, buffer[0], search)
    if inside:
        look_inside(method, place, step, y, model, work, buffer, search)
    per_step = 1.0 / step
    for i in range(measures.shape[1]):
        measures[RATE, i] = rate_of(measures[START, i], measures[END, i], per_step)
        measures[START, i] = measures[END, i]


@kernel
def ignore_segment(place, y, model, work, search):
    """Take the place of `open_segment` where no extremes are sought."""


@kernel
def ignore_step(method, place, step, y, model, work, buffer, search):
    """Take the place of `search_step` where no extremes are sought."""


@kernel
def look_inside(method, place, step, y, model, work, buffer, search):
    """Measure the middle of a step, and the place where that says that a measure is highest."""
    measures = search.measures
    row, share = MIDDLE, 0.5
    for i in range(-1, measures.shape[1]):
        if i >= 0:
            which = extreme_of(i)
            share, value = vertex(measures[START, i], measures[MIDDLE, i], measures[END, i])
            if not (share > 0.0 and worthwhile(value, search.extreme[which])):
                continue
            row = TRIAL
        phase = place.phase + share * step
        method.sample(share, step, y, buffer, search.state)
        contacts_at(phase, place.segment, search.state, model, work)
        measure_inside(False, row, phase, place.segment, search.state, model, work, measures)
        keep(row, place.cycle + phase, place.segment, search.state, search)
