"""What the links do in the Jacobian of the right-hand side; laws without own slopes by differences."""

from tribodyn.dynamics.loads import apart_in_space, joins_in_space
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import law, maximum
from tribodyn.train.clutches import clutch_friction, work_of_clutch
from tribodyn.train.structure import (
    BRAKES,
    DAMPING,
    IN,
    IN_SPACE,
    OUT,
    TURN,
    place_in_space,
    shift_of,
    slip_of,
    turn_of,
    turned,
    turning,
)

#: Difference over the scale of a state: rounding then costs 1e-8 of a derivative, and the curvature of the
#: contact law over its width 1e-5; both are far below what the step needs.
SHARE = 1e-7


@law
def _differentiate_in_space(k, first, second, row, direction, y, model, jacobian):
    """Add what one element of a link's matrices does."""
    layout, links = model.options.layout, model.links
    half, lost = layout.half, layout.mechanical + DAMPING
    stiffness, damping = (
        links.stiffness_in_space[k, row, direction],
        links.damping_in_space[k, row, direction],
    )
    moving = apart_in_space(first, second, row, half, y, layout)
    i, j = place_in_space(first, row, layout), place_in_space(first, direction, layout)
    jacobian[half + i, j] -= stiffness
    jacobian[half + i, half + j] -= damping
    jacobian[lost, half + j] += 2.0 * damping * moving
    if second >= 0:
        other_i, other_j = place_in_space(second, row, layout), place_in_space(second, direction, layout)
        jacobian[half + other_i, j] += stiffness
        jacobian[half + other_i, half + j] += damping
        jacobian[half + i, other_j] += stiffness
        jacobian[half + i, half + other_j] += damping
        jacobian[half + other_i, other_j] -= stiffness
        jacobian[half + other_i, half + other_j] -= damping
        jacobian[lost, half + other_j] -= 2.0 * damping * moving


@law
def _place_and_share(k, end, direction, model):
    """Coordinate that moves a pin's end, and by how much: x or y of a body, or its rotation (ends 2, 3)."""
    layout = model.options.layout
    body = layout.first[k] if end % 2 == 0 else layout.second[k]
    sign = 1.0 if end % 2 == 0 else -1.0
    if end < 2:
        return shift_of(body) + direction, sign
    return turn_of(body, layout), sign * model.links.lever[k, end - 2, direction]


@law
def _differentiate_pin(k, direction, y, model, jacobian):
    """Add what a link does in x or y whose ends have levers."""
    layout, links = model.options.layout, model.links
    half, lost = layout.half, layout.mechanical + DAMPING
    stiffness, damping = links.stiffness[k, direction], links.damping[k, direction]
    rate = 0.0 * y[0]
    for column in range(4):
        body = layout.first[k] if column % 2 == 0 else layout.second[k]
        if body >= 0 and not (column >= 2 and body == 0):
            j, moved = _place_and_share(k, column, direction, model)
            rate += moved * y[half + j]
    for column in range(4):
        body = layout.first[k] if column % 2 == 0 else layout.second[k]
        if body < 0 or (column >= 2 and body == 0):  # the reference has no micro-rotation
            continue
        j, moved = _place_and_share(k, column, direction, model)
        jacobian[lost, half + j] += 2.0 * damping * rate * moved
        for row in range(4):
            if row % 2 == 1 and layout.second[k] < 0:
                continue
            i, share = _place_and_share(k, row, direction, model)
            jacobian[half + i, j] -= share * stiffness * moved
            jacobian[half + i, half + j] -= share * damping * moved


@kernel
def differentiate_links(y, scale, model, jacobian):
    """Add what the links do to the forces, and to the power that damping takes."""
    layout, links = model.options.layout, model.links
    half, lost = layout.half, layout.mechanical + DAMPING
    for k in range(layout.links):
        first, second = layout.first[k], layout.second[k]
        in_space = joins_in_space(k, layout)
        if in_space:
            for row in range(IN_SPACE):
                for direction in range(IN_SPACE):
                    _differentiate_in_space(k, first, second, row, direction, y, model, jacobian)
        for direction in range(TURN + 1):
            if in_space and direction < TURN:
                continue
            if direction == TURN:
                if second < 0 and layout.holds[k] == 0:
                    continue
                i = turn_of(first, layout)
                j = turn_of(second, layout) if second >= 0 else i
                rate = turning(first, y, layout) - turning(second, y, layout)
            else:
                if first >= layout.planar or second >= layout.planar:
                    continue
                if layout.pins[k] > 0:
                    _differentiate_pin(k, direction, y, model, jacobian)
                    continue
                i, j = shift_of(first) + direction, shift_of(second) + direction
                rate = y[half + i]
                if second >= 0:
                    rate = rate - y[half + j]
            stiffness, damping = links.stiffness[k, direction], links.damping[k, direction]
            turns = direction == TURN
            lost_by_twist = 0.0
            if turns:
                laws = model.options.links
                twist = turned(first, y, layout) - turned(second, y, layout)
                _, _, share = laws.act(k, twist, stiffness, links.own, laws)
                by = SHARE * maximum(scale[i], scale[j])
                slope, rise = laws.slope(k, twist, by, stiffness, links.own, laws)
                lost_by_twist = damping * rise * rate * rate
                stiffness, damping = slope + damping * rise * rate, damping * share
                if layout.holds[k] > 0 and first > 0:
                    works = layout.mechanical + (OUT if layout.holds[k] == BRAKES else IN)
                    speed = model.bodies.ratio[first] * (model.operation.nominal_speed + slip_of(y, layout))
                    given = speed if layout.holds[k] == BRAKES else -speed
                    jacobian[works, i] += stiffness * given
                    jacobian[works, half + i] += damping * given
            if not (turns and first == 0):  # the reference has no micro-rotation
                jacobian[half + i, i] -= stiffness
                jacobian[half + i, half + i] -= damping
                jacobian[lost, half + i] += 2.0 * damping * rate
                jacobian[lost, i] += lost_by_twist
                if second >= 0:
                    jacobian[half + j, i] += stiffness
                    jacobian[half + j, half + i] += damping
            if second >= 0 and not (turns and second == 0):
                jacobian[half + j, j] -= stiffness
                jacobian[half + j, half + j] -= damping
                jacobian[lost, half + j] -= 2.0 * damping * rate
                jacobian[lost, j] -= lost_by_twist
                jacobian[half + i, j] += stiffness
                jacobian[half + i, half + j] += damping


@kernel
def differentiate_clutches(time, y, model, jacobian):
    """Add what clutches and brakes do to the torques, and to the power that each takes."""
    layout = model.options.layout
    half = layout.half
    for c in range(layout.clutches):
        first, second = layout.clutch_first[c], layout.clutch_second[c]
        slip, torque, slope = clutch_friction(c, time, y, model)
        i, lost = half + turn_of(first, layout), work_of_clutch(c, layout)
        j = half + turn_of(second, layout) if second >= 0 else i
        if first > 0:  # what the reference's speed does is differenced
            jacobian[i, i] -= slope
            jacobian[lost, i] += torque + slope * slip
            if second >= 0:
                jacobian[j, i] += slope
        if second > 0:
            jacobian[j, j] -= slope
            jacobian[lost, j] -= torque + slope * slip
            jacobian[i, j] += slope
