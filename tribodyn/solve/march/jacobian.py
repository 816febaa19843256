"""Jacobian of the right-hand side, from its structure and a few differences.

The contacts see the bodies through their relative position and motion alone, so a column of the gear's is the
pinion's with the sign changed, but for the bearings, which are linear. Five differences give all columns of
the six degrees of freedom; what drive and load add is differenced where they are switched on.
"""

from typing import NamedTuple

from tribodyn.dynamics.parameters import (
    DRIVE_SHAFT,
    DRIVE_SPEED,
    LAG,
    MECHANICAL,
    MOTOR_SLIP,
    SLIP,
    STATES,
    TWIST,
    VX_G,
    VX_P,
    VY_G,
    VY_P,
    WORK_DAMPING,
    X_G,
    X_P,
    XI,
    XI_RATE,
    Y_G,
    Y_P,
)
from tribodyn.kernels.native import kernel
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.right_hand_side import rhs

#: Difference over the scale of a state: rounding then costs 1e-8 of a derivative, and the curvature of the
#: contact law over its width 1e-5; both are far below what the step needs.
SHARE = 1e-7
#: Difference of a velocity over the sliding velocity at which friction has reversed, at most.
SHARE_OF_REVERSAL = 1e-4
#: Difference of the phase, mesh cycles.
PHASE_DIFFERENCE = 1e-7


class Differences(NamedTuple):
    """Where the derivatives go."""

    trial: Float[Array, " state"]  # (STATES,); scratch
    jacobian: Float[Array, "state mechanical"]  # (STATES, MECHANICAL or more); receives ∂f/∂y
    slope: Float[Array, " state"]  # (STATES,); receives ∂f/∂φ


@kernel
def column(j, difference, place, y, f, model, work, into):
    """One column by a forward difference, returns 1 for the evaluation; `y` is as before afterwards."""
    kept = y[j]
    y[j] = kept + difference
    exact = y[j] - kept
    rhs(place.phase, place.cycle, place.segment, y, model, work, into.trial)
    y[j] = kept
    for i in range(STATES):
        into.jacobian[i, j] = (into.trial[i] - f[i]) / exact
    return 1


@kernel
def differentiate(place, y, f, scale, model, work, into):
    """Jacobian and slope of the right-hand side at a `marching.Place`; `f` is its value there.

    `scale` (STATES,) are sizes of the states. Returns how many right-hand sides it took.
    """
    jacobian = into.jacobian
    mechanics, table = model.mechanics, model.table
    speed = mechanics.nominal_speed
    rate = table.pitch_angle / (speed + y[SLIP])
    ratio = table.pinion_pitch_radius / table.gear_pitch_radius
    maximum = SHARE_OF_REVERSAL * (1.0 + ratio) * mechanics.reversal_width * speed
    for i in range(STATES):
        for j in range(MECHANICAL):
            jacobian[i, j] = 0.0
    evaluations = 0
    for j in range(MECHANICAL):
        difference = SHARE * scale[j]
        wanted = j == XI or j == Y_P or j == VX_P or j == VY_P or j == XI_RATE
        if j == VX_P or j == VY_P or j == XI_RATE:
            difference = min(difference, maximum)
        elif j == SLIP:
            wanted = model.options.drive != DRIVE_SPEED
            difference = min(difference, SHARE * speed)
        elif j == TWIST or j == MOTOR_SLIP:
            wanted = model.options.drive == DRIVE_SHAFT
        elif j == LAG:
            wanted = mechanics.load_amplitudes.shape[0] > 0 or mechanics.load_times.shape[0] > 1
        if wanted:
            evaluations += column(j, difference, place, y, f, model, work, into)

    pinion, gear = rate / mechanics.pinion_mass, rate / mechanics.gear_mass
    for i in range(STATES):
        jacobian[i, X_P] = jacobian[i, XI]
        jacobian[i, X_G] = -jacobian[i, XI]
        jacobian[i, Y_G] = -jacobian[i, Y_P]
        jacobian[i, VX_G] = -jacobian[i, VX_P]
        jacobian[i, VY_G] = -jacobian[i, VY_P]
    # the pinion's differenced columns hold its bearings, which came over to the gear's with a minus
    jacobian[VX_P, X_P] -= pinion * mechanics.pinion_stiffness_x
    jacobian[VX_G, X_G] -= gear * mechanics.gear_stiffness_x
    jacobian[VY_P, Y_G] -= pinion * mechanics.pinion_stiffness_y
    jacobian[VY_G, Y_G] -= gear * mechanics.gear_stiffness_y
    jacobian[X_P, VX_G] += rate
    jacobian[Y_P, VY_G] += rate
    jacobian[X_G, VX_G] += rate
    jacobian[Y_G, VY_G] += rate
    jacobian[VX_P, VX_G] -= pinion * mechanics.pinion_damping_x
    jacobian[VY_P, VY_G] -= pinion * mechanics.pinion_damping_y
    jacobian[VX_G, VX_G] -= gear * mechanics.gear_damping_x
    jacobian[VY_G, VY_G] -= gear * mechanics.gear_damping_y
    jacobian[WORK_DAMPING, VX_G] += (
        2.0 * rate * (mechanics.pinion_damping_x * y[VX_P] + mechanics.gear_damping_x * y[VX_G])
    )
    jacobian[WORK_DAMPING, VY_G] += (
        2.0 * rate * (mechanics.pinion_damping_y * y[VY_P] + mechanics.gear_damping_y * y[VY_G])
    )

    difference = PHASE_DIFFERENCE if place.phase + PHASE_DIFFERENCE < place.end else -PHASE_DIFFERENCE
    moved = place.phase + difference
    rhs(moved, place.cycle, place.segment, y, model, work, into.trial)
    for i in range(STATES):
        into.slope[i] = (into.trial[i] - f[i]) / (moved - place.phase)
    return evaluations + 1
