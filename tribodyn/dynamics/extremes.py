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
    SLIDING,
    TRANSMISSION_ERROR,
    cubic,
    out_of_reach,
)
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, STATES, XI
from tribodyn.numerics.elementary import law, minimum, where
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
        As `contact_forces` left it.
    measures : mapping
    """
    table = model.table
    cell, u, _ = locate(phase, segment, table)
    measures[ERROR_UP] = y[XI]
    measures[ERROR_DOWN] = -y[XI]
    driving, back = 0.0 * y[XI], 0.0 * y[XI]
    film = ActiveFilm(model.options.film, model.film)
    friction = ActiveFriction(model.options.friction, model.friction)
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
        contact = highest_loaded(i, segment, cell, u, model, work)
        thickness, pressure, temperature = surface_extremes(contact, model.surfaces, film, friction)
        first = OF_MESH + OF_PAIR * i
        measures[first + LOAD] = load
        measures[first + FILM] = -thickness
        measures[first + PRESSURE] = pressure
        measures[first + TEMPERATURE] = temperature
    measures[DRIVING + FORCE] = driving
    measures[BACK + FORCE] = back


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

    The start, where it is not highest inside.
    """
    bend = start + end - 2.0 * middle
    rise = 4.0 * middle - 3.0 * start - end
    share = -0.25 * rise / minimum(bend, -1e-300)
    inside = (bend < 0.0) & (share > 0.0) & (share < 1.0)
    return where(inside, share, 0.0), where(inside, start + 0.5 * rise * share, start)
