"""The right-hand side: contact forces to generalised forces to derivatives. One for every solver, any train.

A pair of gears on two bearings is the six-degree model of Liu & Ni, Mechanics & Industry 23 (2022) 10,
(12)-(17) with the signs restored: the forces of a mesh on its two bodies are equal and opposite in every
component. Of several meshes each adds its own.
"""

from tribodyn.dynamics.approach import (
    APPROACH_RATE,
    AXIAL_PLACE,
    COS,
    DISTANCE,
    ELASTIC_LOAD,
    FRICTION_FORCE,
    LEAN_COS,
    LEAN_SIN,
    NORMAL_LOAD,
    RELATIVE_VELOCITY,
    SIN,
    SLIDING,
    absent,
    sliced,
)
from tribodyn.dynamics.contact_forces import contact_forces, reversals_per_velocity
from tribodyn.dynamics.energy import parametric_torque
from tribodyn.dynamics.loads import add_frame_forces, carried_along, clutch_forces, link_forces, load_on
from tribodyn.dynamics.mesh_motion import motion_of, on_body, place_in_mesh
from tribodyn.dynamics.parameters import BY_TIME, DRIVE_SPEED, ENERGY_CONSISTENT
from tribodyn.numerics.elementary import by_chain_rule, independent, law, plain
from tribodyn.train.coupling import carry_along, coupling_forces, spread_forces
from tribodyn.train.motor import motor_torque
from tribodyn.train.structure import (
    ACROSS,
    AXIAL,
    DAMPING,
    FRICTION,
    IN,
    IN_SPACE,
    OF_MESHES,
    OUT,
    PARAMETRIC,
    TOWARDS,
    WORKS_OF_MESH,
    place_in_space,
    rolling_ratio,
    shift_of,
    slip_of,
    speed_of,
    turn_of,
)
from tribodyn.train.structure import SLIDING as WORK_SLIDING


@law
def resultants(place, mesh, model, work):
    """What the contacts of a mesh add up to, from `work` as `contact_forces` left it.

    Forces and moments on the driver that go with `structure.MOVES` (N, N m); moments that resist the driver
    and drive the driven body (N m), powers of friction on the moving bodies, on bodies that only rotate, of
    damping (W), and `parametric_torque`.
    """
    table = mesh.table
    along = 0.0
    across = 0.0
    axial = 0.0
    bend_along = 0.0
    bend_across = 0.0
    resisting = 0.0
    driving = 0.0
    friction = 0.0
    sliding = 0.0
    damping = 0.0
    for i in range(table.side.shape[0]):
        if absent(i, work):
            continue
        normal, tangential = work[NORMAL_LOAD, i], work[FRICTION_FORCE, i]
        cosine, sine, side = work[COS, i], work[SIN, i], table.side[i]
        driver_lever = work[DISTANCE, i] + mesh.driver_radius * sine
        driven_lever = mesh.driven_radius * sine - work[DISTANCE, i]
        damping = damping + (normal - work[ELASTIC_LOAD, i]) * work[APPROACH_RATE, i]
        if sliced(mesh):
            push = -work[LEAN_SIN, i] * normal  # along z
            normal = work[LEAN_COS, i] * normal
            on_along = -side * (normal * cosine + tangential * sine)
            on_across = tangential * cosine - normal * sine
            z, distance = work[AXIAL_PLACE, i], work[DISTANCE, i]
            axial = axial + push
            bend_along = bend_along + z * on_along - side * distance * cosine * push
            bend_across = bend_across + z * on_across - distance * sine * push
        along = along - side * (normal * cosine + tangential * sine)
        across = across - normal * sine + tangential * cosine
        resisting = resisting + side * (normal * mesh.driver_radius * cosine + tangential * driver_lever)
        driving = driving + side * (normal * mesh.driven_radius * cosine + tangential * driven_lever)
        friction = friction + tangential * work[RELATIVE_VELOCITY, i]
        sliding = sliding + tangential * work[SLIDING, i]
    return (
        along,
        across,
        axial,
        bend_along,
        bend_across,
        resisting,
        driving,
        friction,
        sliding,
        damping,
        parametric_torque(place, mesh, model, work),
    )


@law
def derivatives(phase, cycle, interval, y, model, work, dy):
    """Fill `dy` with the derivative of the state per reference cycle, and `work` with the contacts.

    By time it is per cycle of nominal speed.

    The phase, 0 … 1, lies inside `interval`, which says what pairs are in contact; `cycle` counts the
    reference cycles before. `work` has one for every mesh. Compiled code carries no derivatives of works.
    Returns the powers of drive, load, tooth friction (≥ 0: lost), damping (lost) and parametric work, W, and
    the drive torque on the input, N m.
    """
    operation, bodies, options = model.operation, model.bodies, model.options
    layout = options.layout
    half = layout.half
    reference_speed = operation.nominal_speed + slip_of(y, layout)
    nominal_time = operation.pitch_angle / operation.nominal_speed
    zero = 0.0 * y[0]
    if options.variable == BY_TIME:
        rate = nominal_time + zero  # seconds per step of 1 of what the derivatives are by
        passing = reference_speed / operation.nominal_speed  # reference cycles per that
    else:
        rate = operation.pitch_angle / reference_speed
        passing = 1.0 + zero
    for i in range(half, layout.mechanical):  # forces and torques first, in the direction of the motion
        dy[i] = zero
    friction_power = zero
    damping_power = zero
    parametric = zero  # on the reference
    for m in range(layout.meshes):
        mesh = model.meshes[m]
        driver, driven = layout.driver[m], layout.driven[m]
        place = place_in_mesh(m, phase, interval, model)
        reversals = reversals_per_velocity(rolling_ratio(m, model), mesh, model)
        motion = motion_of(m, y, model)
        contact_forces(place, independent(motion, work[m]), reversals, mesh, model, work[m])
        (
            along,
            across,
            axial,
            bend_along,
            bend_across,
            resisting,
            driving,
            friction,
            sliding,
            damping,
            torque,
        ) = by_chain_rule(resultants(place, mesh, model, work[m]), motion, work[m])
        x = mesh.along_x * along + mesh.across_x * across
        z = mesh.along_y * along + mesh.across_y * across
        if driver < layout.planar:
            a = half + shift_of(driver)
            dy[a] = dy[a] + x
            dy[a + 1] = dy[a + 1] + z
        if driven < layout.planar:
            b = half + shift_of(driven)
            dy[b] = dy[b] - x
            dy[b + 1] = dy[b + 1] - z
        for direction in range(AXIAL, IN_SPACE):
            if driver < layout.spatial:
                a = half + place_in_space(driver, direction, layout)
                dy[a] = dy[a] + on_body(0, direction, along, across, axial, bend_along, bend_across, mesh)
            if driven < layout.spatial:
                b = half + place_in_space(driven, direction, layout)
                dy[b] = dy[b] + on_body(1, direction, along, across, axial, bend_along, bend_across, mesh)
        if layout.modes > 0:
            for e in range(layout.rim_count[m]):
                a = half + layout.rim_first[m] + e
                dy[a] = dy[a] + (mesh.rim[TOWARDS, e] * along + mesh.rim[ACROSS, e] * across)
        a, b = half + turn_of(driver, layout), half + turn_of(driven, layout)
        dy[a] = dy[a] - mesh.driver_sense * resisting
        dy[b] = dy[b] + mesh.driven_sense * driving
        friction_power = friction_power + friction
        damping_power = damping_power + damping
        parametric = parametric + rolling_ratio(m, model) * torque
        of_mesh = layout.mechanical + OF_MESHES + WORKS_OF_MESH * m
        dy[of_mesh + FRICTION] = plain(rate * friction)
        dy[of_mesh + WORK_SLIDING] = plain(rate * sliding)
    time = (cycle + phase) * nominal_time + y[layout.lag]
    damping_of_links, put_in, taken_out = link_forces(y, model, dy)
    damping_power = damping_power + damping_of_links
    if layout.clutches > 0:
        clutch_forces(time, rate, y, model, dy)
    if layout.coupled > 0:
        by_damping, torque = coupling_forces(cycle + phase, y, model, dy)
        damping_power = damping_power + by_damping
        parametric = parametric + torque
    if layout.frames > 0:
        add_frame_forces(y, model, dy)
    of_cages = zero
    if options.bearings.number > 0:
        of_cages = options.bearings.act((cycle + phase) * operation.pitch_angle, y, model, dy)

    power_out = taken_out
    for b in range(layout.bodies):
        resisting = load_on(b, time, y, model)
        place_of_torque = half + turn_of(b, layout)
        dy[place_of_torque] = dy[place_of_torque] - resisting
        power_out = power_out + resisting * speed_of(b, y, model)

    if options.formulation == ENERGY_CONSISTENT:
        dy[half + layout.lag] = dy[half + layout.lag] - parametric
        parametric = 0.0 * parametric
    parametric_power = parametric * reference_speed
    if options.bearings.number > 0:
        parametric_power = parametric_power + of_cages

    driven_body = layout.input
    drive_torque = zero
    if options.drive != DRIVE_SPEED:
        drive_torque, _ = motor_torque(driven_body, y, model)
        place_of_torque = half + turn_of(driven_body, layout)
        dy[place_of_torque] = dy[place_of_torque] + drive_torque
    acceleration = zero + operation.acceleration  # of the reference, rad/s²
    if layout.inertial > 0:
        if options.drive == DRIVE_SPEED:
            carry_along(acceleration, model, dy)
        spread_forces(y, model, dy)
    if options.drive == DRIVE_SPEED:
        drive_torque = bodies.inertia[0] * acceleration - dy[half + layout.lag]
        power_in = put_in + drive_torque * reference_speed
    else:
        acceleration = dy[half + layout.lag] / bodies.inertia[0]
        power_in = put_in + drive_torque * speed_of(driven_body, y, model)

    for b in range(layout.bodies):
        i = turn_of(b, layout)
        if b > 0:
            dy[half + i] = rate * (dy[half + i] / bodies.inertia[b] - bodies.ratio[b] * acceleration)
            dy[i] = rate * y[half + i]
        else:
            dy[half + i] = rate * acceleration
            dy[i] = rate - nominal_time * passing
        if b < layout.planar:
            x = shift_of(b)
            share = rate / bodies.mass[b]
            dy[half + x] = share * dy[half + x]
            dy[half + x + 1] = share * dy[half + x + 1]
            if layout.frames > 0:
                dy[half + x] = dy[half + x] - rate * carried_along(b, 0, acceleration, model)
                dy[half + x + 1] = dy[half + x + 1] - rate * carried_along(b, 1, acceleration, model)
            dy[x] = rate * y[half + x]
            dy[x + 1] = rate * y[half + x + 1]
        if b < layout.spatial:
            z = layout.tilts + 3 * b
            dy[half + z] = rate / bodies.mass[b] * dy[half + z]
            dy[z] = rate * y[half + z]
            for i in range(z + 1, z + 3):
                dy[half + i] = rate / bodies.tilting[b] * dy[half + i]
                dy[i] = rate * y[half + i]
    for i in range(half - layout.modes, half):
        dy[half + i] = rate * dy[half + i]
        dy[i] = rate * y[half + i]
    works = layout.mechanical
    dy[works + IN] = plain(rate * power_in)
    dy[works + OUT] = plain(rate * power_out)
    dy[works + DAMPING] = plain(rate * damping_power)
    dy[works + PARAMETRIC] = plain(rate * parametric_power)
    return power_in, power_out, friction_power, damping_power, parametric_power, drive_torque
