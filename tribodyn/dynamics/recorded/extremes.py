"""Quantities whose extremes are recorded: as measures that are largest where the quantity is extreme.

The measures say where a motion is extreme. What it is there is recomputed by `outputs`, as every sample is,
so that no summary is at odds with its record.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.approach import (
    COS,
    DRIVEN_SPEED,
    DRIVER_SPEED,
    LEAN_COS,
    LINE_LOAD,
    NORMAL_LOAD,
    PEAK,
    RADIUS,
    RELATIVE_VELOCITY,
    SLIDING,
    TRANSMISSION_ERROR,
    absent,
    cubic,
    out_of_reach,
)
from tribodyn.dynamics.mesh_motion import place_in_mesh
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC
from tribodyn.numerics.elementary import absolute, law, maximum, minimum, skippable, truncate, where
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.train.layout import TrainLayout
from tribodyn.train.structure import (
    rotational_error_of,
)
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.law import ActiveLaw
from tribodyn.tribology.surface_state import film_and_temperature

#: Measures of a whole mesh: the rotational transmission error, up and down; and from here for the driving
#: flanks and behind them for the back flanks …
ERROR_UP, ERROR_DOWN, DRIVING, BACK = 0, 1, 2, 5
#: … the transmission error of the newest pair, up and down, and the force along the pitch tangent.
NEWEST_UP, NEWEST_DOWN, FORCE = range(3)
OF_MESH = 8
#: Measures of a pair, those of one slot after the other's: load, line load times curvature, which is as the
#: square of the Hertz pressure, and by the laws in use thinness of the film and temperature.
LOAD, PRESSURE, FILM, TEMPERATURE = range(4)
OF_PAIR = 4
#: Extremes of a mesh: one per measure of the mesh, and one of all pairs per measure of a pair. Measures and
#: extremes of one mesh stand behind those of the other.
EXTREMES = OF_MESH + OF_PAIR
#: A measure that nothing has.
LOWEST = -1e300
#: Rows of measures in a search: at the start, in the middle and at the end of a step, at another place in it;
#: the rate of change over the step before, per mesh cycle; the extreme of each so far; and of the
#: pairs' laws what they were when last evaluated, and how fast they had changed before that.
START, MIDDLE, END, TRIAL, RATE, EXTREME, SEEN, PACE = range(8)
ROWS = 8
#: In the row `SEEN`: steps since all pairs were evaluated; of each pair the phase of its last evaluation and
#: the phase up to which it is far from extreme, and then its film and temperature as they were.
COUNT, AT, UNTIL = 0, LOAD, PRESSURE
#: Laws are evaluated at every step where a pair, at so many times the rate of change between its last
#: evaluations, might become extreme in the next one, and elsewhere at every so many steps.
CAUTION, EVERY = 2.0, 4.0


class Extremes(NamedTuple):
    """Where motions are extreme; leading axes for the cases of a batch."""

    measure: Float[Array, "*case extreme"]  # `EXTREMES` of every mesh; `LOWEST` where there is none
    cycles: Float[Array, "*case extreme"]  # reference cycles since the start, whole and fraction
    interval: Float[Array, "*case extreme"]  # of the schedule: at a boundary it says on which side
    state: Float[Array, "*case extreme state"]


def no_extremes(layout: TrainLayout, *cases: int) -> Extremes:
    """Extremes of motions of which nothing is known."""
    shape = (*cases, EXTREMES * layout.meshes)
    states = np.zeros((*shape, layout.states))
    return Extremes(np.full(shape, LOWEST), np.zeros(shape), np.zeros(shape), states)


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
def highest_loaded(i, place, mesh, model, work):
    """Contact of slot i where its line load is highest along the face: what is recorded of its surfaces."""
    dynamic = model.options.sliding == SLIDING_DYNAMIC
    sliding = work[RELATIVE_VELOCITY, i] if dynamic else work[SLIDING, i]
    peak = cubic(mesh.table.channel, place.segment, place.cell, i, PEAK, place.u)
    speed_1, speed_2 = work[DRIVER_SPEED, i], work[DRIVEN_SPEED, i]
    return local_contact(
        work[LINE_LOAD, i] * peak, 1.0 / work[RADIUS, i], 0.5 * (speed_1 + speed_2), sliding, speed_1, speed_2
    )


@law
def _nothing(first, measures):
    """Measures of a slice that is off the path of contact."""
    for j in range(PRESSURE, OF_PAIR):
        measures[first + j] = LOWEST


@law
def measures_in(measures, layout):
    """Number of measures of one mesh; `measures` has those of all meshes along its last axis."""
    return measures.shape[len(measures.shape) - 1] // layout.meshes


@law
def measure(phase, interval, y, model, work, measures):
    """Fill `measures`, those of pairs off the path of contact left out; `work` is from `contacts_at`."""
    measure_loads(interval, y, model, work, measures)
    of_mesh = measures_in(measures, model.options.layout)
    for m in range(model.options.layout.meshes):
        mesh = model.meshes[m]
        place = place_in_mesh(m, phase, interval, model)
        for i in range(mesh.table.side.shape[0]):
            first = m * of_mesh + OF_MESH + OF_PAIR * i
            if absent(i, work[m]):
                _nothing(first, measures)
                continue
            contact = highest_loaded(i, place, mesh, model, work[m])
            measures[first + PRESSURE] = contact.line_load * contact.curvature
            measure_surfaces(first, contact, mesh, model, measures)


@law
def measure_loads(interval, y, model, work, measures):
    """Fill the `measures` of the meshes and the pairs' loads."""
    layout = model.options.layout
    of_mesh = measures_in(measures, layout)
    for m in range(layout.meshes):
        mesh, contacts, first = model.meshes[m], work[m], m * of_mesh
        table = mesh.table
        error = rotational_error_of(m, y, model)
        measures[first + ERROR_UP] = error
        measures[first + ERROR_DOWN] = -error
        driving, back = 0.0 * error, 0.0 * error
        slices = table.face_position.shape[0]
        for i in range(table.side.shape[0]):
            if i % slices == 0 and slices > 1:  # of a pair that is cut into slices, the sum
                measures[first + OF_MESH + OF_PAIR * i + LOAD] = 0.0 * error
            if absent(i, contacts):
                continue
            load = contacts[NORMAL_LOAD, i]
            side = DRIVING
            if table.side[i] > 0.0:
                driving = driving + load * contacts[LEAN_COS, i] * contacts[COS, i]
            else:
                side = BACK
                back = back + load * contacts[LEAN_COS, i] * contacts[COS, i]
            # slots follow each other by age
            measures[first + side + NEWEST_UP] = contacts[TRANSMISSION_ERROR, i]
            measures[first + side + NEWEST_DOWN] = -contacts[TRANSMISSION_ERROR, i]
            place_of_load = first + OF_MESH + OF_PAIR * (i - i % slices) + LOAD
            if slices > 1:
                load = load + measures[place_of_load]
            measures[place_of_load] = load
        measures[first + DRIVING + FORCE] = driving
        measures[first + BACK + FORCE] = back


@law
def measure_surfaces(first, contact, mesh, model, measures):
    """Fill the `measures` of a slot that are by laws; `first` is the place of the slot's first one."""
    film = ActiveLaw(model.options.film, mesh.film)
    friction = ActiveLaw(model.options.friction, mesh.friction)
    thickness, temperature = film_and_temperature(contact, mesh.surfaces, film, friction)
    measures[first + FILM] = -thickness
    measures[first + TEMPERATURE] = temperature


@law
def begin_surfaces(phase, interval, model, measures):
    """Begin the row `SEEN` of a search at the start of an interval, where all pairs are evaluated."""
    of_mesh = measures_in(measures, model.options.layout)
    for m in range(model.options.layout.meshes):
        mesh = model.meshes[m]
        segment = truncate(model.schedule.segment[interval, m])
        for i in range(mesh.table.side.shape[0]):
            if out_of_reach(segment, i, mesh):
                continue
            first = m * of_mesh + OF_MESH + OF_PAIR * i
            measures[SEEN, first + AT] = phase
            measures[SEEN, first + UNTIL] = phase
            for j in range(FILM, OF_PAIR):
                measures[SEEN, first + j] = measures[START, first + j]
                measures[PACE, first + j] = 0.0 * phase


@law
def _see(far, first, phase, measures):
    """Keep what a pair is at the end of a step and how long it stays far from extreme, except where far."""
    per_phase = 1.0 / (phase - measures[SEEN, first + AT])
    wait = 1.0 + 0.0 * phase
    for j in range(FILM, OF_PAIR):
        value = measures[END, first + j]
        pace = absolute(value - measures[SEEN, first + j]) * per_phase
        fastest = CAUTION * maximum(pace, measures[PACE, first + j])
        short = maximum(measures[EXTREME, first + j] - value, 0.0)
        wait = where(fastest > 0.0, minimum(wait, short / where(fastest > 0.0, fastest, 1.0)), wait)
        measures[SEEN, first + j] = where(far, measures[SEEN, first + j], value)
        measures[PACE, first + j] = where(far, measures[PACE, first + j], pace)
    measures[SEEN, first + UNTIL] = where(far, measures[SEEN, first + UNTIL], phase + wait)
    measures[SEEN, first + AT] = where(far, measures[SEEN, first + AT], phase)


@law
def measure_end(idle, phase, step, interval, y, model, work, measures):
    """Fill the row `END` of a search; by laws only where a pair may be near an extreme, or its turn has come.

    Where they are left out they are `LOWEST`, and everywhere in lanes that are `idle`. `phase` is the end of
    a step, `measures` has the rows of a search.
    """
    measure_loads(interval, y, model, work, measures[END])
    count = measures[SEEN, COUNT] + 1.0
    due = count >= EVERY
    measures[SEEN, COUNT] = where(due, 0.0, count)
    of_mesh = measures_in(measures, model.options.layout)
    for m in range(model.options.layout.meshes):
        mesh = model.meshes[m]
        place = place_in_mesh(m, phase, interval, model)
        for i in range(mesh.table.side.shape[0]):
            first = m * of_mesh + OF_MESH + OF_PAIR * i
            if absent(i, work[m]):
                _nothing(first, measures[END])
                continue
            contact = highest_loaded(i, place, mesh, model, work[m])
            measures[END, first + PRESSURE] = contact.line_load * contact.curvature
            far = idle | ((count < EVERY) & (phase + step <= measures[SEEN, first + UNTIL]))
            _measure_unless(far, first, contact, mesh, model, measures[END])
            if not skippable(far):
                _see(far, first, phase, measures)


@law
def measure_inside(idle, row, phase, interval, y, model, work, measures):
    """Fill a row of a search inside a step; by laws only where both ends of the step were so measured."""
    measure_loads(interval, y, model, work, measures[row])
    of_mesh = measures_in(measures, model.options.layout)
    for m in range(model.options.layout.meshes):
        mesh = model.meshes[m]
        place = place_in_mesh(m, phase, interval, model)
        for i in range(mesh.table.side.shape[0]):
            first = m * of_mesh + OF_MESH + OF_PAIR * i
            if absent(i, work[m]):
                _nothing(first, measures[row])
                continue
            far = idle | (minimum(measures[START, first + FILM], measures[END, first + FILM]) <= LOWEST)
            contact = highest_loaded(i, place, mesh, model, work[m])
            measures[row, first + PRESSURE] = contact.line_load * contact.curvature
            _measure_unless(far, first, contact, mesh, model, measures[row])


@law
def _measure_unless(far, first, contact, mesh, model, measures):
    """Fill the `measures` of a slot that are by laws; `LOWEST` where they are far from extreme."""
    if skippable(far):
        for j in range(FILM, OF_PAIR):
            measures[first + j] = LOWEST
    else:
        measure_surfaces(first, contact, mesh, model, measures)
        for j in range(FILM, OF_PAIR):
            measures[first + j] = where(far, LOWEST, measures[first + j])


def measures_of(pairs: int) -> int:
    """Number of measures of a mesh with so many pair slots."""
    return OF_MESH + OF_PAIR * pairs


@law
def extreme_of(row, of_mesh):
    """The extreme that a measure belongs to, with so many measures of a mesh."""
    mesh, local = row // of_mesh, row % of_mesh
    return mesh * EXTREMES + (local if local < OF_MESH else OF_MESH + (local - OF_MESH) % OF_PAIR)


@law
def alike(row, of_mesh):
    """The measures that belong to the same extreme as one of them, with so many measures of a mesh."""
    mesh, local = row // of_mesh, row % of_mesh
    first = mesh * of_mesh + OF_MESH + (local - OF_MESH) % OF_PAIR
    return range(row, row + 1) if local < OF_MESH else range(first, (mesh + 1) * of_mesh, OF_PAIR)


@law
def vertex(start, middle, end):
    """Share of a step where the parabola through a measure's three values is highest, and its value there.

    The start, where it is not highest inside, or where a value is not known.
    """
    bend = start + end - 2.0 * middle
    rise = 4.0 * middle - 3.0 * start - end
    share = -0.25 * rise / minimum(bend, -1e-300)
    recorded = minimum(start, end) > LOWEST
    inside = recorded & (bend < 0.0) & (share > 0.0) & (share < 1.0)
    return where(inside, share, 0.0), where(inside, start + 0.5 * rise * share, start)
