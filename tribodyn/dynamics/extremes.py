"""Quantities whose extremes are recorded: as measures that are largest where the quantity is extreme.

The measures say where a motion is extreme. What it is there is recomputed by `outputs`, as every sample is,
so that no summary is at odds with its record.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.contact_forces import (
    COS,
    GEAR_SPEED,
    NORMAL_LOAD,
    PEAK,
    PINION_SPEED,
    RADIUS,
    RELATIVE_VELOCITY,
    SEEN_CURVATURE,
    SEEN_ENTRAINMENT,
    SEEN_LOAD,
    SEEN_SLIDING,
    SLIDING,
    TRANSMISSION_ERROR,
    WORSE,
    cubic,
    out_of_reach,
)
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, STATES, XI
from tribodyn.numerics.elementary import absolute, law, maximum, minimum, skippable, where
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.law import ActiveFilm, ActiveFriction
from tribodyn.tribology.surface_state import surface_extremes

#: Measures of the whole mesh: the rotational transmission error, up and down; and from here for the driving
#: flanks and behind them for the back flanks …
ERROR_UP, ERROR_DOWN, DRIVING, BACK = 0, 1, 2, 5
#: … the transmission error of the newest pair, up and down, and the force along the pitch tangent.
NEWEST_UP, NEWEST_DOWN, FORCE = range(3)
OF_MESH = 8
#: Measures of a pair, those of one slot after the other's: load, thinness of the film, pressure, temperature.
LOAD, FILM, PRESSURE, TEMPERATURE = range(4)
OF_PAIR = 4
#: Extremes: one per measure of the mesh, and one of all pairs per measure of a pair.
EXTREMES = OF_MESH + OF_PAIR
#: A measure that nothing has.
LOWEST = -1e300
#: Rows of measures in a search: at the start, in the middle and at the end of a step, at another place in it;
#: the rate of change over the step before, per mesh cycle; the extreme of each so far; those of surfaces
#: where they were last evaluated.
START, MIDDLE, END, TRIAL, RATE, EXTREME, SEEN = range(7)
ROWS = 7
#: By measure of a pair: exponent of load, curvature or speeds that no film thickness, pressure or temperature
#: rise surpasses while these change by less than FARTHEST.
STEEPEST = (0.0, 1.0, 0.5, 2.0)
FARTHEST = 0.5


class Extremes(NamedTuple):
    """Where motions are extreme; leading axes for the cases of a batch.

    Attributes
    ----------
    measure : (EXTREMES,)
        `LOWEST` where there is none.
    cycles : (EXTREMES,)
        Mesh cycles since the start, whole and fraction.
    segment : (EXTREMES,)
        Segment of the mesh cycle: at a boundary it says on which side.
    state : (EXTREMES, STATES)
    """

    measure: Float[Array, "*case extreme"]
    cycles: Float[Array, "*case extreme"]
    segment: Float[Array, "*case extreme"]
    state: Float[Array, "*case extreme state"]


def no_extremes(*cases: int) -> Extremes:
    """Extremes of motions of which nothing is known."""
    shape = (*cases, EXTREMES)
    return Extremes(np.full(shape, LOWEST), np.zeros(shape), np.zeros(shape), np.zeros((*shape, STATES)))


def extremes_of(extremes: Extremes, cases: Any) -> Extremes:
    """Those of one case of a batch, or copies of those of several."""
    return Extremes(*(each[cases] for each in extremes))


def put_extremes(extremes: Extremes, cases: Int[Array, " some"], some: Extremes) -> None:
    """Put those of some cases into those of all, in place."""
    for each, other in zip(extremes, some, strict=True):
        each[cases] = other


def take_in(extremes: Extremes, others: Extremes) -> None:
    """Replace, in place, what others have more extreme."""
    better = others.measure > extremes.measure
    for mine, other in zip(extremes, others, strict=True):
        mine[better] = other[better]


@law
def highest_loaded(i, segment, cell, u, model, work):
    """Contact of slot i where its line load is highest along the face: what is recorded of its surfaces."""
    if model.options.sliding == SLIDING_DYNAMIC:
        sliding = work[RELATIVE_VELOCITY, i]
    else:
        sliding = work[SLIDING, i]
    peak = cubic(model.table.channel, segment, cell, i, PEAK, u)
    speed_p, speed_g = work[PINION_SPEED, i], work[GEAR_SPEED, i]
    return local_contact(
        work[NORMAL_LOAD, i] / model.table.face_width * peak,
        1.0 / work[RADIUS, i],
        0.5 * (speed_p + speed_g),
        sliding,
        speed_p,
        speed_g,
    )


@law
def measure(phase, segment, y, model, work, measures):
    """Fill `measures`, those of pairs off the path of contact left out.

    Parameters
    ----------
    phase : float
        Inside `segment`.
    segment : int
    y : (STATES,)
    model : Model
    work : mapping
        As `contact_forces` left it, or `normal_contacts`.
    measures : mapping
    """
    measure_loads(segment, y, model, work, measures)
    cell, u, _ = locate(phase, segment, model.table)
    for i in range(model.table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        contact = highest_loaded(i, segment, cell, u, model, work)
        measure_surfaces(i, contact, model, measures)


@law
def measure_loads(segment, y, model, work, measures):
    """Fill the `measures` of the mesh and the pairs' loads."""
    table = model.table
    measures[ERROR_UP] = y[XI]
    measures[ERROR_DOWN] = -y[XI]
    driving, back = 0.0 * y[XI], 0.0 * y[XI]
    for i in range(table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        load = work[NORMAL_LOAD, i]
        side = DRIVING
        if table.side[i] > 0.0:
            driving = driving + load * work[COS, i]
        else:
            side = BACK
            back = back + load * work[COS, i]
        # slots follow each other by age
        measures[side + NEWEST_UP] = work[TRANSMISSION_ERROR, i]
        measures[side + NEWEST_DOWN] = -work[TRANSMISSION_ERROR, i]
        measures[OF_MESH + OF_PAIR * i + LOAD] = load
    measures[DRIVING + FORCE] = driving
    measures[BACK + FORCE] = back


@law
def measure_surfaces(i, contact, model, measures):
    """Fill the `measures` of slot i's surfaces."""
    film = ActiveFilm(model.options.film, model.film)
    friction = ActiveFriction(model.options.friction, model.friction)
    thickness, pressure, temperature = surface_extremes(contact, model.surfaces, film, friction)
    first = OF_MESH + OF_PAIR * i
    measures[first + FILM] = -thickness
    measures[first + PRESSURE] = pressure
    measures[first + TEMPERATURE] = temperature


@law
def see_surfaces(phase, segment, model, work, measures):
    """Keep what slots were when their surfaces were evaluated; `measures` has the rows of a search."""
    cell, u, _ = locate(phase, segment, model.table)
    for i in range(model.table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        contact = highest_loaded(i, segment, cell, u, model, work)
        _see(contact.line_load < 0.0, i, contact, START, work, measures)


@law
def _see(far, i, contact, row, work, measures):
    """Keep what slot i is where a row of measures is, except where it is far."""
    work[SEEN_LOAD, i] = where(far, work[SEEN_LOAD, i], 1.0 / contact.line_load)
    work[SEEN_CURVATURE, i] = where(far, work[SEEN_CURVATURE, i], 1.0 / contact.curvature)
    work[SEEN_ENTRAINMENT, i] = where(far, work[SEEN_ENTRAINMENT, i], 1.0 / contact.entrainment)
    sliding = maximum(absolute(contact.sliding), 1e-300)
    work[SEEN_SLIDING, i] = where(far, work[SEEN_SLIDING, i], 1.0 / sliding)
    work[WORSE, i] = where(far, work[WORSE, i], 0.0)
    for j in range(OF_MESH + OF_PAIR * i + FILM, OF_MESH + OF_PAIR * (i + 1)):
        measures[SEEN, j] = where(far, measures[SEEN, j], measures[row, j])


@law
def measure_end(idle, phase, segment, y, model, work, measures):
    """Fill the row `END` of a search; of surfaces only where they may be near an extreme.

    They are far from it where no change of load, curvature and speeds since they were last evaluated, and
    another one as large as the step's, takes them there. Then they are `LOWEST`.

    Parameters
    ----------
    idle : bool
        Of no interest.
    phase, segment, y, model, work
        As in `measure`.
    measures : mapping
        The rows of a search.
    """
    measure_loads(segment, y, model, work, measures[END])
    cell, u, _ = locate(phase, segment, model.table)
    for i in range(model.table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        contact = highest_loaded(i, segment, cell, u, model, work)
        worse = maximum(contact.line_load * work[SEEN_LOAD, i] - 1.0, 0.0)
        worse = worse + maximum(contact.curvature * work[SEEN_CURVATURE, i] - 1.0, 0.0)
        worse = worse + maximum(1.0 - contact.entrainment * work[SEEN_ENTRAINMENT, i], 0.0)
        worse = worse + maximum(absolute(contact.sliding) * work[SEEN_SLIDING, i] - 1.0, 0.0)
        reach = worse + maximum(worse - work[WORSE, i], 0.0)
        work[WORSE, i] = where(idle, work[WORSE, i], worse)
        first = OF_MESH + OF_PAIR * i
        inside = reach < FARTHEST
        for j in range(FILM, OF_PAIR):
            seen = measures[SEEN, first + j]
            inside = inside & (seen + STEEPEST[j] * reach * absolute(seen) <= measures[EXTREME, first + j])
        far = idle | inside
        _measure_unless(far, i, contact, model, measures[END])
        if not skippable(far):
            _see(far, i, contact, END, work, measures)


@law
def measure_inside(idle, row, phase, segment, y, model, work, measures):
    """Fill a row of a search inside a step; of surfaces only where both ends of the step may be extreme.

    The other arguments are those of `measure_end`.
    """
    measure_loads(segment, y, model, work, measures[row])
    cell, u, _ = locate(phase, segment, model.table)
    for i in range(model.table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        film = OF_MESH + OF_PAIR * i + FILM
        far = idle | (minimum(measures[START, film], measures[END, film]) <= LOWEST)
        contact = highest_loaded(i, segment, cell, u, model, work)
        _measure_unless(far, i, contact, model, measures[row])


@law
def _measure_unless(far, i, contact, model, measures):
    """Fill the `measures` of slot i's surfaces; `LOWEST` where they are far from extreme."""
    first = OF_MESH + OF_PAIR * i
    if skippable(far):
        for j in range(FILM, OF_PAIR):
            measures[first + j] = LOWEST
    else:
        measure_surfaces(i, contact, model, measures)
        for j in range(FILM, OF_PAIR):
            measures[first + j] = where(far, LOWEST, measures[first + j])


def measures_of(pairs: int) -> int:
    """Number of measures with so many pair slots."""
    return OF_MESH + OF_PAIR * pairs


@law
def extreme_of(row):
    """The extreme that a measure belongs to."""
    return row if row < OF_MESH else OF_MESH + (row - OF_MESH) % OF_PAIR


@law
def vertex(start, middle, end):
    """Share of a step where the parabola through a measure's three values is highest, and its value there.

    The start, where it is not highest inside, or where a value is not known.
    """
    bend = start + end - 2.0 * middle
    rise = 4.0 * middle - 3.0 * start - end
    share = -0.25 * rise / minimum(bend, -1e-300)
    known = minimum(start, end) > LOWEST
    inside = known & (bend < 0.0) & (share > 0.0) & (share < 1.0)
    return where(inside, share, 0.0), where(inside, start + 0.5 * rise * share, start)
