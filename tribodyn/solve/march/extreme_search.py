"""Extremes of a motion between its samples, sought step by step while it is integrated.

Every accepted step is measured at its end (`dynamics.recorded.extremes.measure`), where the method knows
the contacts already. Where a measure is so near its extreme so far that it may pass it inside the step, it
is measured in the middle too, and where the parabola through the three values is highest, on the method's
dense output.
Both sides of every boundary between intervals are measured.

The same code seeks in one case and in many side by side: `lanes` says which of these take part, and is True
for the one. What a lane finds depends on no other.
"""

from typing import NamedTuple, Self

import numpy as np

from tribodyn.dynamics.contact_forces import normal_contacts
from tribodyn.dynamics.mesh_motion import motion_of, place_in_mesh
from tribodyn.dynamics.recorded.extremes import (
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
    measures_in,
    measures_of,
    no_extremes,
    vertex,
)
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, anywhere, law, maximum, opposite, where
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.layout import TrainLayout

#: Rise over an extreme, as a share of it, that is not worth another evaluation.
WORTH = 1e-7
#: A rate of change that is not known, and a row that no measure stands in.
UNKNOWN, NONE = 1e150, 1e9


class Search(NamedTuple):
    """What a search knows."""

    measures: Float[Array, "row measure"]
    state: Float[Array, " state"]  # scratch: a state inside a step
    extremes: Extremes  # the most extreme measures so far, and where

    @classmethod
    def begun(cls, layout: TrainLayout, pairs: int) -> Self:
        """A search that knows nothing, with so many pair slots in every mesh."""
        measures = np.zeros((ROWS, layout.meshes * measures_of(pairs)))
        return cls(measures, np.zeros(layout.states), no_extremes(layout))


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
def begin_rates(measures, extreme, of_mesh, layout):
    """Suppose, at the start of an interval, that measures rise twice as fast as any alike moved before.

    There measures have corners, and pairs other slots.
    """
    for m in range(layout.meshes):
        for which in range(EXTREMES):
            best = extreme[m * EXTREMES + which]
            fastest = 0.0 * best - 1.0
            for row in alike(m * of_mesh + which, of_mesh):
                rate = absolute(measures[RATE, row])
                fastest = maximum(fastest, where(rate < UNKNOWN, rate, -1.0))
            observed = (best > LOWEST) & (fastest >= 0.0)
            for row in alike(m * of_mesh + which, of_mesh):
                measures[RATE, row] = where(observed, 2.0 * fastest, UNKNOWN)


@law
def worthwhile(value, extreme):
    """Whether a value is so far above an extreme that it is worth an evaluation."""
    return value > extreme + WORTH * absolute(extreme)


@kernel
def contacts_at(phase, interval, y, model, work):
    """Fill `work` with the contacts of a state, but for friction."""
    for m in range(model.options.layout.meshes):
        place = place_in_mesh(m, phase, interval, model)
        normal_contacts(place, motion_of(m, y, model), model.meshes[m], model, work[m])


@kernel
def keep(lanes, row, cycles, interval, y, search, layout):
    """Replace the extremes that a row of measures, those of a state, surpasses."""
    measures, extremes = search.measures, search.extremes
    of_mesh = measures_in(measures, layout)
    for i in range(measures.shape[1]):
        value = measures[row, i]
        better = lanes & (value > measures[EXTREME, i])
        if anywhere(better):
            which = extreme_of(i, of_mesh)
            extremes.measure[which] = where(better, value, extremes.measure[which])
            extremes.cycles[which] = where(better, cycles, extremes.cycles[which])
            extremes.interval[which] = where(better, 1.0 * interval, extremes.interval[which])
            for j in range(layout.states):
                extremes.state[which, j] = where(better, y[j], extremes.state[which, j])
            for other in alike(i, of_mesh):
                measures[EXTREME, other] = extremes.measure[which]


@kernel
def open_segment(lanes, place, y, model, work, search):
    """Measure the state at the start of an interval."""
    layout = model.options.layout
    measures, extreme = search.measures, search.extremes.measure
    of_mesh = measures_in(measures, layout)
    for i in range(measures.shape[1]):
        for row in range(RATE):
            measures[row, i] = LOWEST
        measures[EXTREME, i] = extreme[extreme_of(i, of_mesh)]
    begin_rates(measures, extreme, of_mesh, layout)
    contacts_at(place.phase, place.interval, y, model, work)
    measure(place.phase, place.interval, y, model, work, measures[START])
    begin_surfaces(place.phase, place.interval, model, measures)
    keep(lanes, START, place.cycle + place.phase, place.interval, y, search, layout)


@kernel
def search_step(method, lanes, place, step, y, model, work, buffer, search):
    """Seek extremes over an accepted step from the state `y`, which ends at `place.end`."""
    measures, new = search.measures, buffer[0]
    method.contacts(place.end, place.interval, model, work, buffer)
    measure_end(opposite(lanes), place.end, step, place.interval, new, model, work, measures)
    better, inside = step < 0.0, step < 0.0
    for i in range(measures.shape[1]):
        start, end, extreme = measures[START, i], measures[END, i], measures[EXTREME, i]
        better = better | (end > extreme)
        inside = inside | promising(start, end, measures[RATE, i] * step, extreme)
    better, inside = lanes & better, lanes & inside
    if anywhere(better):
        keep(better, END, place.cycle + place.end, place.interval, new, search, model.options.layout)
    if anywhere(inside):
        look_inside(method, inside, place, step, y, model, work, buffer, search)
    per_step = 1.0 / step
    for i in range(measures.shape[1]):
        rate = rate_of(measures[START, i], measures[END, i], per_step)
        measures[RATE, i] = where(lanes, rate, measures[RATE, i])
        measures[START, i] = where(lanes, measures[END, i], measures[START, i])


@kernel
def look_inside(method, lanes, place, step, y, model, work, buffer, search):
    """Measure the middles of steps, and one after the other the places where measures are highest."""
    layout = model.options.layout
    measures = search.measures
    chosen, row, share, done = lanes, MIDDLE, 0.5 + 0.0 * step, 0.0 * step - 1.0
    while anywhere(chosen):
        phase = place.phase + share * step
        method.sample(share, step, y, buffer, search.state, layout)
        contacts_at(phase, place.interval, search.state, model, work)
        measure_inside(opposite(chosen), row, phase, place.interval, search.state, model, work, measures)
        keep(chosen, row, place.cycle + phase, place.interval, search.state, search, layout)
        row = TRIAL
        following, share = 0.0 * step + NONE, 0.0 * step
        for i in range(measures.shape[1]):
            at, value = vertex(measures[START, i], measures[MIDDLE, i], measures[END, i])
            wanted = lanes & (at > 0.0) & worthwhile(value, measures[EXTREME, i])
            wanted = wanted & (done < i) & (following == NONE)
            following = where(wanted, 1.0 * i, following)
            share = where(wanted, at, share)
        chosen = following < NONE
        done = following


@kernel
def ignore_segment(lanes, place, y, model, work, search):
    """Take the place of `open_segment` where no extremes are sought."""


@kernel
def ignore_step(method, lanes, place, step, y, model, work, buffer, search):
    """Take the place of `search_step` where no extremes are sought."""
