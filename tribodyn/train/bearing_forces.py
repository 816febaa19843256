"""Forces of rolling bearings in time, of every element where the cage has brought it. For all compilers.

Elements pass the load zone with the cage, which turns by a fixed share of the shaft's rotation φ: they roll
on a raceway at rest and on one that turns with the shaft, θ = ½ (1 − D cos α/d_m) φ. Rings are rigid, and
elements have no inertia. The strain energy V(u, θ) of all contacts gives the forces ∂V/∂u over the
displacement u of the inner ring against the outer one, and the torque ∂V/∂θ on the cage, which carries loaded
elements on. As of meshes, the classical equations leave that torque off the shaft and count its power as
parametric work; in the energy-consistent ones it acts on the shaft.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import (
    RuntimeIndices,
    StaticInt,
    compiled_as,
    cos,
    is_jax,
    law,
    sin,
    skippable,
    sqrt,
)
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.element_contact import (
    BALL_EXPONENT,
    ROLLER_EXPONENT,
    ball_contact,
    roller_contact,
)
from tribodyn.train.structure import IN_SPACE, PARAMETRIC, slip_of, speed_of, turn_of, turned

#: Types of rolling elements, and columns of `structure.BearingNumbers.point`.
BALLS, ROLLERS = range(2)
RADIUS, OFFSET, RADIAL_REST, AXIAL_REST = range(4)
#: Ends of a bearing: the node of the shaft and the seat.
ENDS = 2
#: Points times samples that are evaluated at once in arrays, beyond which elements go one by one.
_AT_ONCE = 10**6
#: Difference over the scale of a state, as of the links.
_SHARE = 1e-7


class BearingForces(NamedTuple):
    """What is switched: the functions that kernels are compiled with, and what the bearings consist of."""

    #: (turns of the reference in rad, state, model, dy) -> power that cages bring in, W
    act: Callable[..., Any]
    #: (turns, state, scales, model, Jacobian): adds to its rows of forces and of parametric work
    differentiate: Callable[..., Any]
    energy: Callable[..., Any]  # (turns, state, model) -> strain energy, J
    number: int = 0  # of rows
    places: RuntimeIndices = RuntimeIndices(())  # of every bearing ten coordinates of the state
    bodies: RuntimeIndices = RuntimeIndices(())  # whose rotation turns the inner ring
    types: RuntimeIndices = RuntimeIndices(())
    elements: RuntimeIndices = RuntimeIndices(())  # first of each bearing, and the end
    points: RuntimeIndices = RuntimeIndices(())  # likewise on each of its elements
    #: numbers among all bearings of drawn shafts; every row of rolling elements is one here
    bearings: RuntimeIndices = RuntimeIndices(())


@law
def no_bearings(turns, y, model, dy):
    """No bearing acts in time."""
    return 0.0 * y[0]


@law
def no_slopes(turns, y, scale, model, jacobian):
    """No bearing acts in time."""


@law
def no_energy(turns, y, model):
    """No bearing acts in time."""
    return 0.0 * y[0]


#: All bearings are linear.
LINEAR = BearingForces(no_bearings, no_slopes, no_energy, StaticInt(0))


@law
def _moved(k, direction, y, model):
    """Displacement of the inner ring against the outer one in one of five directions, m or rad."""
    places, moves = model.options.bearings.places, model.links.bearings.moves
    i = ENDS * IN_SPACE * k + direction
    return moves[k, direction] * y[places[i]] + moves[k, IN_SPACE + direction] * y[places[i + IN_SPACE]]


@law
def cage_angle(k, turns, y, model):
    """Angle of a cage about +z, rad, after so many rad of the reference."""
    body, layout = model.options.bearings.bodies[k], model.options.layout
    rotation = model.bodies.ratio[body] * turns + turned(body, y, layout)
    return model.links.bearings.cage[k] * rotation


class RingMotion(NamedTuple):
    """Angle of a cage, and displacement of the inner ring against the outer one; m, rad."""

    angle: Any
    x: Any
    y: Any
    z: Any
    tilt_x: Any
    tilt_y: Any


@law
def _motion(k, turns, y, model):
    return RingMotion(
        cage_angle(k, turns, y, model),
        _moved(k, 0, y, model),
        _moved(k, 1, y, model),
        _moved(k, 2, y, model),
        _moved(k, 3, y, model),
        _moved(k, 4, y, model),
    )


@law
def _at_point(k, i, cosine, sine, motion, model):
    """What a point of an element of a bearing, whose angle has these functions, adds to `bearing_answer`."""
    numbers = model.links.bearings
    radius, offset = numbers.point[i, RADIUS], numbers.point[i, OFFSET]
    tipped, swung = (
        motion.tilt_x * sine - motion.tilt_y * cosine,
        motion.tilt_x * cosine + motion.tilt_y * sine,
    )
    radial = motion.x * cosine + motion.y * sine - offset * tipped
    axial = motion.z + radius * tipped
    zero = 0.0 * radial
    if model.options.bearings.types[k] == BALLS:
        radial, axial = radial + numbers.point[i, RADIAL_REST], axial + numbers.point[i, AXIAL_REST]
        length = sqrt(radial * radial + axial * axial)
        if skippable(length <= numbers.apart[k]):
            return zero, zero, zero, zero, zero, zero, zero
        load, pressed = ball_contact(length, numbers.apart[k], numbers.constant[k])
        outwards, along = load * radial / length, load * axial / length
        energy = load * pressed / (1.0 + BALL_EXPONENT)
    else:
        toward = numbers.normal[k, 0] * radial + numbers.normal[k, 1] * axial + numbers.point[i, RADIAL_REST]
        if skippable(toward <= 0.0):
            return zero, zero, zero, zero, zero, zero, zero
        load, pressed = roller_contact(toward, numbers.constant[k])
        outwards, along = numbers.normal[k, 0] * load, numbers.normal[k, 1] * load
        energy = load * pressed / (1.0 + ROLLER_EXPONENT)
    lever = radius * along - offset * outwards
    on_cage = outwards * (motion.y * cosine - motion.x * sine) + lever * swung
    return outwards * cosine, outwards * sine, along, lever * sine, -lever * cosine, on_cage, energy


@law
def _one_by_one(k, turns, y, model):
    forces, motion = model.options.bearings, _motion(k, turns, y, model)
    zero = 0.0 * (motion.x + motion.angle)
    on_x, on_y, on_z, about_x, about_y, on_cage, energy = zero, zero, zero, zero, zero, zero, zero
    for element in range(forces.elements[k], forces.elements[k + 1]):
        place = motion.angle + model.links.bearings.around[element]
        cosine, sine = cos(place), sin(place)
        for i in range(forces.points[k], forces.points[k + 1]):
            more_x, more_y, more_z, more_about_x, more_about_y, more_cage, more = _at_point(
                k, i, cosine, sine, motion, model
            )
            on_x, on_y, on_z = on_x + more_x, on_y + more_y, on_z + more_z
            about_x, about_y = about_x + more_about_x, about_y + more_about_y
            on_cage, energy = on_cage + more_cage, energy + more
    return on_x, on_y, on_z, about_x, about_y, on_cage, energy


@compiled_as(_one_by_one)
def bearing_answer(k, turns, y, model):
    """Forces of the shaft on a bearing along x, y, z (N), moments about x and y, ∂V/∂θ (N m); energy, J.

    Of arrays many elements at once.
    """
    forces, motion = model.options.bearings, _motion(k, turns, y, model)
    if type(motion.x) is float:
        return _one_by_one(k, turns, y, model)
    ones = (1,) * max(np.ndim(number) for number in motion)
    points = np.arange(forces.points[k], forces.points[k + 1]).reshape(-1, *ones)
    elements = np.arange(forces.elements[k], forces.elements[k + 1]).reshape(-1, 1, *ones)
    place = motion.angle + model.links.bearings.around[elements]
    cosine, sine = cos(place), sin(place)
    if is_jax(motion.x) or np.size(cosine) * len(points) < _AT_ONCE:
        parts = _at_point(k, points, cosine, sine, motion, model)
        return tuple(part.sum(axis=(0, 1)) for part in parts)
    each = [_at_point(k, points, *trig, motion, model) for trig in zip(cosine, sine, strict=True)]
    return tuple(sum(np.sum(part, axis=0) for part in parts) for parts in zip(*each, strict=True))


@law
def _component(direction, on_x, on_y, on_z, about_x, about_y):
    """One of five."""
    if direction < 2:
        return on_x if direction == 0 else on_y
    return on_z if direction == 2 else about_x if direction == 3 else about_y


@law
def act(turns, y, model, dy):
    """Add the forces of all bearings to those in `dy`; returns the power that cages bring in, W."""
    options, layout, moves = model.options, model.options.layout, model.links.bearings.moves
    power = 0.0 * y[0]
    for k in range(options.bearings.number):
        on_x, on_y, on_z, about_x, about_y, on_cage, _ = bearing_answer(k, turns, y, model)
        for c in range(ENDS * IN_SPACE):
            i = layout.half + options.bearings.places[ENDS * IN_SPACE * k + c]
            force = _component(c % IN_SPACE, on_x, on_y, on_z, about_x, about_y)
            dy[i] = dy[i] - moves[k, c] * force
        body = options.bearings.bodies[k]
        torque = model.links.bearings.cage[k] * on_cage
        if options.formulation > 0:  # energy-consistent
            i = layout.half + turn_of(body, layout)
            dy[i] = dy[i] - torque
        else:
            power = power + torque * speed_of(body, y, model)
    return power


@law
def energy_of_all(turns, y, model):
    """Strain energy of all bearings, J."""
    energy = 0.0 * y[0]
    for k in range(model.options.bearings.number):
        _, _, _, _, _, _, of_bearing = bearing_answer(k, turns, y, model)
        energy = energy + of_bearing
    return energy


@law
def differentiate(turns, y, scale, model, jacobian):
    """Add what the bearings do to the forces of a Jacobian and to its row of parametric work, by differences.

    That row is over the reference's speed.
    """
    options, layout, moves = model.options, model.options.layout, model.links.bearings.moves
    half, parametric = layout.half, layout.mechanical + PARAMETRIC
    reference = model.operation.nominal_speed + slip_of(y, layout)
    for k in range(options.bearings.number):
        body, cage = options.bearings.bodies[k], model.links.bearings.cage[k]
        turn = turn_of(body, layout)
        before_x, before_y, before_z = 0.0, 0.0, 0.0
        before_about_x, before_about_y, before_cage = 0.0, 0.0, 0.0
        for c in range(-1, ENDS * IN_SPACE + 1):  # as it is; its coordinates; the rotation
            j = turn if c < 0 or c == ENDS * IN_SPACE else options.bearings.places[ENDS * IN_SPACE * k + c]
            if c == ENDS * IN_SPACE:
                if body == 0:  # the reference has no micro-rotation
                    continue
            elif c >= 0 and moves[k, c] == 0.0:
                continue
            kept = y[j]
            if c >= 0:
                y[j] = kept + _SHARE * scale[j]
            by = y[j] - kept
            on_x, on_y, on_z, about_x, about_y, on_cage, _ = bearing_answer(k, turns, y, model)
            y[j] = kept
            if c < 0:
                before_x, before_y, before_z = on_x, on_y, on_z
                before_about_x, before_about_y, before_cage = about_x, about_y, on_cage
                continue
            for r in range(ENDS * IN_SPACE):
                i = half + options.bearings.places[ENDS * IN_SPACE * k + r]
                rise = _component(
                    r % IN_SPACE,
                    on_x - before_x,
                    on_y - before_y,
                    on_z - before_z,
                    about_x - before_about_x,
                    about_y - before_about_y,
                )
                jacobian[i, j] -= moves[k, r] * rise / by
            torque = cage * (on_cage - before_cage) / by
            if options.formulation > 0:
                jacobian[half + turn, j] -= torque
            else:
                jacobian[parametric, j] += torque * speed_of(body, y, model) / reference
        if options.formulation == 0 and body > 0:
            jacobian[parametric, half + turn] += cage * before_cage / reference


def bearing_answers(cycles: Any, y: Any, model: Any) -> tuple[Any, ...]:
    """Of all bearings what `bearing_answer` gives, after so many reference cycles."""
    turns = cycles * model.operation.pitch_angle
    return tuple(bearing_answer(k, turns, y, model) for k in range(model.options.bearings.number))


def cage_power(answers: Sequence[Any], y: Any, model: Any) -> Any:
    """Power with which cages carry loaded elements on, W, of what `bearing_answer` gives of all bearings."""
    bodies, cage = model.options.bearings.bodies, model.links.bearings.cage
    powers = (
        ratio * answer[5] * speed_of(body, y, model)
        for ratio, body, answer in zip(cage, bodies, answers, strict=True)
    )
    return sum(powers, 0.0 * y[0])


def tangents(model: Any) -> Float[Array, "coordinate coordinate"]:
    """Stiffness of the bearings in time at the mean loads, by the coordinates; N/m, N, N m."""
    stiffness = np.zeros((model.options.layout.half,) * 2)
    forces, numbers = model.options.bearings, model.links.bearings
    for k in range(forces.number):
        rows = np.zeros((IN_SPACE, len(stiffness)))
        for c in range(ENDS * IN_SPACE):
            rows[c % IN_SPACE, forces.places[ENDS * IN_SPACE * k + c]] += numbers.moves[k, c]
        stiffness += rows.T @ numbers.tangent[k] @ rows
    return stiffness


#: The forces of the bearings in time.
IN_TIME = BearingForces(act, differentiate, energy_of_all)
