"""Jacobian of the right-hand side, from its structure and a few differences.

The contacts of a mesh see its bodies through their relative position and motion alone: through two numbers of
position and three or four of velocity, and three of each more where they move in space. Differences in these
give the mesh's matrix k, from which its columns in the bodies' coordinates follow, Pᵀ k P; links are linear,
but where their laws have slopes of their own. What the reference's speed and the time do is differenced in
the whole right-hand side, where they are switched on.
"""

from typing import NamedTuple

from tribodyn.dynamics.approach import Motion
from tribodyn.dynamics.contact_forces import contact_forces, reversals_per_velocity
from tribodyn.dynamics.equations import resultants
from tribodyn.dynamics.loads import carried_along, load_on, load_slopes
from tribodyn.dynamics.mesh_motion import motion_of, on_body, place_in_mesh
from tribodyn.dynamics.parameters import DRIVE_SPEED, ENERGY_CONSISTENT
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, by_chain_rule, independent, law
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.link_jacobian import SHARE, differentiate_clutches, differentiate_links
from tribodyn.solve.right_hand_side import rhs
from tribodyn.train.coupling import differentiate_couplings, spread_column
from tribodyn.train.motor import motor_torque
from tribodyn.train.structure import (
    ACROSS,
    ALONG_Z,
    AXIAL,
    DAMPING,
    FRICTION,
    IN,
    IN_SPACE,
    LEAN_ACROSS,
    LEAN_ALONG,
    MOVES,
    OF_MESHES,
    OUT,
    PARAMETRIC,
    TOWARDS,
    WORKS_OF_MESH,
    driven_arm,
    driver_arm,
    place_in_space,
    rolling_ratio,
    shift_of,
    slip_of,
    speed_of,
    turn_of,
)
from tribodyn.train.structure import SLIDING as WORK_SLIDING

#: Difference of a velocity over the sliding velocity at which friction has reversed, at most.
SHARE_OF_REVERSAL = 1e-4
#: Difference of the phase, reference cycles.
PHASE_DIFFERENCE = 1e-7
#: What of a mesh's motion is differenced: `structure.MOVES`, and from here their rates; and the driven body's
#: rotation and the driver's. In the plane only the first two of both.
RATES, DRIVEN_RATE, DRIVER_RATE, NUMBERS = MOVES, 2 * MOVES, 2 * MOVES + 1, 2 * MOVES + 2


class Differences(NamedTuple):
    """Where the derivatives go."""

    trial: Float[Array, " state"]  # scratch
    jacobian: Float[Array, "state mechanical"]  # or more columns; receives ∂f/∂y
    slope: Float[Array, " state"]  # receives ∂f/∂φ


@kernel
def column(j, difference, place, y, f, model, work, into):
    """One column by a forward difference, returns 1 for the evaluation; `y` is as before afterwards."""
    kept = y[j]
    y[j] = kept + difference
    exact = y[j] - kept
    rhs(place.phase, place.cycle, place.interval, y, model, work, into.trial)
    y[j] = kept
    for i in range(model.options.layout.states):
        into.jacobian[i, j] = (into.trial[i] - f[i]) / exact
    return 1


@law
def _moved(motion, which, by, mesh):
    """A motion with one of its numbers changed: lengths in m, velocities in m/s at the pitch circle."""
    driver = by if which == DRIVER_RATE else 0.0
    driven = by if which == DRIVEN_RATE else 0.0
    return Motion(
        motion.towards + (by if which == TOWARDS else 0.0),
        motion.across + (by if which == ACROSS else 0.0),
        motion.along_rate + (by if which == RATES + TOWARDS else 0.0),
        motion.turning_rate + (driver - driven),
        motion.across_rate + (by if which == RATES + ACROSS else 0.0),
        motion.driver_speed + driver / mesh.driver_radius,
        motion.driven_speed + driven / mesh.driven_radius,
        motion.phase_rate,
        motion.axial + (by if which == ALONG_Z else 0.0),
        motion.lean_along + (by if which == LEAN_ALONG else 0.0),
        motion.lean_across + (by if which == LEAN_ACROSS else 0.0),
        motion.axial_rate + (by if which == RATES + ALONG_Z else 0.0),
        motion.lean_along_rate + (by if which == RATES + LEAN_ALONG else 0.0),
        motion.lean_across_rate + (by if which == RATES + LEAN_ACROSS else 0.0),
    )


@kernel
def differentiate_mesh(m, place, y, scale, model, work, jacobian):
    """Add what a mesh does to the forces, and fill its works; returns how often its contacts were evaluated.

    Rows of rates receive forces and torques, those of work in and parametric work torques on the reference.
    `work` is as the right-hand side left it.
    """
    layout = model.options.layout
    half, works = layout.half, layout.mechanical
    mesh, contacts = model.meshes[m], work[m]
    driver, driven = layout.driver[m], layout.driven[m]
    ratio = rolling_ratio(m, model)
    at = place_in_mesh(m, place.phase, place.interval, model)
    of_bodies = motion_of(m, y, model)
    motion = independent(of_bodies, contacts)
    reversals = reversals_per_velocity(ratio, mesh, model)
    before = by_chain_rule(resultants(at, mesh, model, contacts), of_bodies, contacts)
    turn_1, turn_2 = turn_of(driver, layout), turn_of(driven, layout)
    of_mesh = works + OF_MESHES + WORKS_OF_MESH * m
    radius = absolute(mesh.driven_radius)  # a size; that of an internal gear is negative
    length = SHARE * scale[turn_2] * radius
    velocity = min(SHARE * scale[half + turn_2] * radius, SHARE_OF_REVERSAL / reversals)
    in_space = layout.spatial > 0
    rims = layout.rim_count[m] if layout.modes > 0 else 0
    count = 0
    for which in range(NUMBERS):
        if which == DRIVER_RATE and driver == 0:
            continue
        move = which % RATES
        relative = which < DRIVEN_RATE
        if relative and move > ACROSS and not in_space:
            continue
        by = length if which < RATES else velocity
        if relative and move > ALONG_Z:
            by /= radius
        contact_forces(at, _moved(motion, which, by, mesh), reversals, mesh, model, contacts)
        count += 1
        after = by_chain_rule(resultants(at, mesh, model, contacts), of_bodies, contacts)
        along, across = (after[0] - before[0]) / by, (after[1] - before[1]) / by
        axial = (after[2] - before[2]) / by
        leaning_along, leaning_across = (after[3] - before[3]) / by, (after[4] - before[4]) / by
        resisting, driving = (after[5] - before[5]) / by, (after[6] - before[6]) / by
        friction, sliding = (after[7] - before[7]) / by, (after[8] - before[8]) / by
        damping, parametric = (after[9] - before[9]) / by, ratio * (after[10] - before[10]) / by
        first = 0 if which < RATES else half
        # columns: x, y, z and tilts of the driver and of the driven body, their rotations, those of a rim
        for k in range(2 * IN_SPACE + 2 + rims):
            direction, end = k % IN_SPACE, k // IN_SPACE
            if k >= 2 * IN_SPACE + 2:
                if not relative or move > ACROSS:
                    continue
                j = first + layout.rim_first[m] + k - 2 * IN_SPACE - 2
                share = mesh.rim[move, k - 2 * IN_SPACE - 2]
            elif k >= 2 * IN_SPACE:
                turns_driver = k == 2 * IN_SPACE
                if turns_driver and driver == 0:
                    continue  # the reference has no micro-rotation
                j = first + (turn_1 if turns_driver else turn_2)
                if which == TOWARDS:
                    share = driver_arm(mesh) if turns_driver else -driven_arm(mesh)
                elif which == DRIVER_RATE and turns_driver:
                    share = driver_arm(mesh)
                elif which == DRIVEN_RATE and not turns_driver:
                    share = driven_arm(mesh)
                else:
                    continue
            else:
                body = driver if end == 0 else driven
                if not relative or body >= (layout.planar if direction < AXIAL else layout.spatial):
                    continue
                j = first + place_in_space(body, direction, layout)
                share = mesh.moves[end, move, direction]
            if share == 0.0:
                continue
            for row in range(2 * IN_SPACE):
                direction, end = row % IN_SPACE, row // IN_SPACE
                body = driver if end == 0 else driven
                if body < (layout.planar if direction < AXIAL else layout.spatial):
                    force = on_body(end, direction, along, across, axial, leaning_along, leaning_across, mesh)
                    jacobian[half + place_in_space(body, direction, layout), j] += share * force
            for e in range(rims):
                force = mesh.rim[TOWARDS, e] * along + mesh.rim[ACROSS, e] * across
                jacobian[half + layout.rim_first[m] + e, j] += share * force
            jacobian[half + turn_1, j] -= share * mesh.driver_sense * resisting
            jacobian[half + turn_2, j] += share * mesh.driven_sense * driving
            jacobian[works + DAMPING, j] += share * damping
            jacobian[works + PARAMETRIC, j] += share * parametric
            jacobian[of_mesh + FRICTION, j] += share * friction
            jacobian[of_mesh + WORK_SLIDING, j] += share * sliding
    return count


@kernel
def differentiate(place, y, f, scale, model, work, into):
    """Jacobian and slope of the right-hand side at a `marching.Place`; `f` is its value there.

    `scale` are sizes of the states, `work` is as the right-hand side left it. Returns how many right-hand
    sides it took, evaluations of a mesh counted as its share of one.
    """
    operation, bodies, options = model.operation, model.bodies, model.options
    layout = options.layout
    half, works, states = layout.half, layout.mechanical, layout.states
    jacobian = into.jacobian
    reference_speed = operation.nominal_speed + slip_of(y, layout)
    rate = operation.pitch_angle / reference_speed
    time = (place.cycle + place.phase) * operation.pitch_angle / operation.nominal_speed + y[layout.lag]
    for i in range(states):
        for j in range(works):
            jacobian[i, j] = 0.0
    contacts = 0
    for m in range(layout.meshes):
        contacts += differentiate_mesh(m, place, y, scale, model, work, jacobian)
    evaluations = (contacts + layout.meshes - 1) // layout.meshes
    differentiate_links(y, scale, model, jacobian)
    if layout.clutches > 0:
        differentiate_clutches(time, y, model, jacobian)
    if layout.coupled > 0:
        differentiate_couplings(place.cycle + place.phase, y, model, works, jacobian)
    if options.bearings.number > 0:
        turns = (place.cycle + place.phase) * operation.pitch_angle
        options.bearings.differentiate(turns, y, scale, model, jacobian)
    if layout.frames > 0:
        for b in range(layout.planar):
            x, speed = shift_of(b), bodies.frame_speed[b]
            if b > 0:
                jacobian[half + turn_of(b, layout), turn_of(b, layout)] -= bodies.hoop[b]
            jacobian[half + x, half + x + 1] += 2.0 * bodies.mass[b] * speed
            jacobian[half + x + 1, half + x] -= 2.0 * bodies.mass[b] * speed
            jacobian[half + x, x] += bodies.mass[b] * speed * speed
            jacobian[half + x + 1, x + 1] += bodies.mass[b] * speed * speed
    consistent = options.formulation == ENERGY_CONSISTENT
    prescribed = options.drive == DRIVE_SPEED
    for b in range(1, layout.bodies):  # loads and drive; what the reference's speed does is differenced below
        i = half + turn_of(b, layout)
        stiffness, damping = load_slopes(b, model)
        jacobian[i, turn_of(b, layout)] -= stiffness
        jacobian[i, i] -= damping
        jacobian[works + OUT, turn_of(b, layout)] += stiffness * speed_of(b, y, model)
        jacobian[works + OUT, i] += load_on(b, time, y, model) + damping * speed_of(b, y, model)
        if b == layout.input and not prescribed:
            torque, slope = motor_torque(b, y, model)
            jacobian[i, i] += slope
            jacobian[works + IN, i] += torque + slope * speed_of(b, y, model)
    for j in range(works):
        if consistent:
            jacobian[half + layout.lag, j] -= jacobian[works + PARAMETRIC, j]
            jacobian[works + PARAMETRIC, j] = 0.0
        if layout.inertial > 0:
            spread_column(j, model, jacobian)
        on_reference = jacobian[half + layout.lag, j]
        if prescribed:
            jacobian[works + IN, j] -= on_reference * reference_speed
            acceleration = 0.0
        else:
            acceleration = on_reference / bodies.inertia[0]
        jacobian[half + layout.lag, j] = rate * acceleration
        jacobian[works + PARAMETRIC, j] *= reference_speed
        for b in range(layout.bodies):
            if b > 0:
                i = half + turn_of(b, layout)
                jacobian[i, j] = rate * (jacobian[i, j] / bodies.inertia[b] - bodies.ratio[b] * acceleration)
            if b < layout.planar:
                x = half + shift_of(b)
                jacobian[x, j] *= rate / bodies.mass[b]
                jacobian[x + 1, j] *= rate / bodies.mass[b]
                if layout.frames > 0:
                    jacobian[x, j] -= rate * carried_along(b, 0, acceleration, model)
                    jacobian[x + 1, j] -= rate * carried_along(b, 1, acceleration, model)
            if b < layout.spatial:
                z = half + layout.tilts + 3 * b
                jacobian[z, j] *= rate / bodies.mass[b]
                jacobian[z + 1, j] *= rate / bodies.tilting[b]
                jacobian[z + 2, j] *= rate / bodies.tilting[b]
        for i in range(2 * half - layout.modes, 2 * half):
            jacobian[i, j] *= rate
        for i in range(works, states):
            jacobian[i, j] *= rate
    for i in range(half):
        if i != layout.lag:
            jacobian[i, half + i] = rate

    if not prescribed or operation.acceleration != 0.0:
        difference = min(SHARE * scale[half + layout.lag], SHARE * operation.nominal_speed)
        evaluations += column(half + layout.lag, difference, place, y, f, model, work, into)
    over_time = operation.load_amplitudes.shape[0] > 0 or operation.load_times.shape[0] > 1
    if over_time or layout.clutches > 0 or operation.output_drive.stiffness != 0.0:
        evaluations += column(layout.lag, SHARE * scale[layout.lag], place, y, f, model, work, into)
    difference = PHASE_DIFFERENCE if place.phase + PHASE_DIFFERENCE < place.end else -PHASE_DIFFERENCE
    moved = place.phase + difference
    rhs(moved, place.cycle, place.interval, y, model, work, into.trial)
    for i in range(states):
        into.slope[i] = (into.trial[i] - f[i]) / (moved - place.phase)
    return evaluations + 1
