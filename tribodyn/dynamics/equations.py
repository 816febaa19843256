"""The right-hand side: contact forces to generalised forces to derivatives. One for every solver.

Six degrees of freedom after Liu & Ni, Mechanics & Industry 23 (2022) 10, (12)-(17) with the signs restored:
pair forces on the two bodies are equal and opposite in every component.
"""

from tribodyn.dynamics.contact_energy import mesh_energy, parametric_torque
from tribodyn.dynamics.contact_forces import (
    APPROACH_RATE,
    COS,
    DISTANCE,
    ELASTIC_LOAD,
    FRICTION_FORCE,
    NORMAL_LOAD,
    RELATIVE_VELOCITY,
    SIN,
    SLIDING,
    approach,
    contact_forces,
    elastic_loads,
    out_of_reach,
)
from tribodyn.dynamics.parameters import (
    DRIVE_SHAFT,
    DRIVE_SPEED,
    ENERGY_CONSISTENT,
    LAG,
    MOTOR_SLIP,
    SLIP,
    TWIST,
    VX_G,
    VX_P,
    VY_G,
    VY_P,
    WORK_DAMPING,
    WORK_FRICTION,
    WORK_IN,
    WORK_OUT,
    WORK_PARAMETRIC,
    WORK_SLIDING,
    X_G,
    X_P,
    XI,
    XI_RATE,
    Y_G,
    Y_P,
)
from tribodyn.numerics.elementary import last_at_or_below, law, maximum, minimum, sin, sqrt, truncate


@law
def locate(phase, segment, table):
    """Cell, position in it and cells per radian at a phase (0 … 1) inside a segment of the table."""
    start = table.boundary[segment]
    cells = table.channel.shape[1]
    cells_per_cycle = cells / (table.boundary[segment + 1] - start)
    position = minimum(maximum((phase - start) * cells_per_cycle, 0.0), cells - 1e-9)
    cell = truncate(position)
    return cell, position - cell, cells_per_cycle / table.pitch_angle


@law
def load_torque(time, gear_slip, mechanics):
    """Torque on the gear against its motion, N m: constant, table over time, harmonics, speed."""
    torque = mechanics.load_torque + mechanics.load_damping * gear_slip
    for i in range(mechanics.load_amplitudes.shape[0]):
        angle = mechanics.load_frequencies[i] * time + mechanics.load_phases[i]
        torque = torque + mechanics.load_amplitudes[i] * sin(angle)
    if mechanics.load_times.shape[0] > 1:
        times = mechanics.load_times
        i = last_at_or_below(times, time)
        width = times[i + 1] - times[i]
        u = minimum(maximum((time - times[i]) / width, 0.0), 1.0)
        start, end = mechanics.load_torques[i], mechanics.load_torques[i + 1]
        out, back = mechanics.load_slopes[i] * width, mechanics.load_slopes[i + 1] * width
        rise = end - start
        torque = (
            torque + start + u * (out + u * (3.0 * rise - 2.0 * out - back + u * (out + back - 2.0 * rise)))
        )
    return torque


@law
def derivatives(phase, cycle, segment, y, model, work, dy):
    """Fill `dy` with the derivative of the state by phase, per mesh cycle, and `work` with the contacts.

    The phase, 0 … 1, lies inside `segment`, which says what pairs are in contact; `cycle` counts the mesh
    cycles before. Returns the powers of drive, load, tooth friction (≥ 0: lost), damping (lost) and
    parametric work, W, and the drive torque on the pinion or motor, N m.
    """
    mechanics, table, options = model.mechanics, model.table, model.options
    cell, u, cells_per_radian = locate(phase, segment, table)
    contact_forces(segment, cell, u, cells_per_radian, y, model, work)

    force_x = 0.0  # on the pinion; the gear gets the negative
    force_y = 0.0
    pinion_moment = 0.0  # resisting
    gear_moment = 0.0  # driving
    friction_power = 0.0
    sliding_power = 0.0
    damping_power = 0.0
    for i in range(table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        normal, tangential = work[NORMAL_LOAD, i], work[FRICTION_FORCE, i]
        cosine, sine, side = work[COS, i], work[SIN, i], table.side[i]
        lever_p = work[DISTANCE, i] + table.pinion_pitch_radius * sine
        lever_g = table.gear_pitch_radius * sine - work[DISTANCE, i]
        force_x = force_x - side * (normal * cosine + tangential * sine)
        force_y = force_y - normal * sine + tangential * cosine
        pinion_moment = pinion_moment + side * (
            normal * table.pinion_pitch_radius * cosine + tangential * lever_p
        )
        gear_moment = gear_moment + side * (normal * table.gear_pitch_radius * cosine + tangential * lever_g)
        friction_power = friction_power + tangential * work[RELATIVE_VELOCITY, i]
        sliding_power = sliding_power + tangential * work[SLIDING, i]
        damping_power = damping_power + (normal - work[ELASTIC_LOAD, i]) * work[APPROACH_RATE, i]

    pinion_speed = mechanics.nominal_speed + y[SLIP]
    ratio = table.pinion_pitch_radius / table.gear_pitch_radius
    gear_slip = ratio * y[SLIP] - y[XI_RATE] / table.gear_pitch_radius
    gear_speed = ratio * mechanics.nominal_speed + gear_slip
    nominal_time = table.pitch_angle / mechanics.nominal_speed
    time = (cycle + phase) * nominal_time + y[LAG]
    resisting = load_torque(time, gear_slip, mechanics)
    gear_acceleration = (gear_moment - resisting) / mechanics.gear_inertia

    parametric = parametric_torque(segment, cell, u, cells_per_radian, model, work)
    if options.formulation == ENERGY_CONSISTENT:
        pinion_moment = pinion_moment + parametric
        parametric = 0.0 * parametric
    parametric_power = parametric * pinion_speed

    twist_rate = 0.0
    motor_acceleration = 0.0
    if options.drive == DRIVE_SPEED:
        drive_torque = pinion_moment
        pinion_acceleration = 0.0
        power_in = drive_torque * pinion_speed
    elif options.drive == DRIVE_SHAFT:
        motor_speed = mechanics.nominal_speed + y[MOTOR_SLIP]
        twist_rate = y[MOTOR_SLIP] - y[SLIP]
        shaft_torque = mechanics.shaft_stiffness * y[TWIST] + mechanics.shaft_damping * twist_rate
        drive_torque = mechanics.drive_torque - mechanics.speed_regulation * y[MOTOR_SLIP]
        motor_acceleration = (drive_torque - shaft_torque) / mechanics.drive_inertia
        pinion_acceleration = (shaft_torque - pinion_moment) / mechanics.pinion_inertia
        damping_power = damping_power + mechanics.shaft_damping * twist_rate * twist_rate
        power_in = drive_torque * motor_speed
    else:
        drive_torque = mechanics.drive_torque - mechanics.speed_regulation * y[SLIP]
        pinion_acceleration = (drive_torque - pinion_moment) / mechanics.pinion_inertia
        power_in = drive_torque * pinion_speed

    damping_power = (
        damping_power
        + mechanics.pinion_damping_x * y[VX_P] * y[VX_P]
        + mechanics.pinion_damping_y * y[VY_P] * y[VY_P]
        + mechanics.gear_damping_x * y[VX_G] * y[VX_G]
        + mechanics.gear_damping_y * y[VY_G] * y[VY_G]
    )
    power_out = resisting * gear_speed

    rate = table.pitch_angle / pinion_speed  # seconds per mesh cycle
    pinion, gear = rate / mechanics.pinion_mass, rate / mechanics.gear_mass
    dy[X_P] = rate * y[VX_P]
    dy[Y_P] = rate * y[VY_P]
    dy[X_G] = rate * y[VX_G]
    dy[Y_G] = rate * y[VY_G]
    dy[LAG] = rate - nominal_time
    dy[XI] = rate * y[XI_RATE]
    dy[TWIST] = rate * twist_rate
    dy[VX_P] = pinion * (
        force_x - mechanics.pinion_stiffness_x * y[X_P] - mechanics.pinion_damping_x * y[VX_P]
    )
    dy[VY_P] = pinion * (
        force_y - mechanics.pinion_stiffness_y * y[Y_P] - mechanics.pinion_damping_y * y[VY_P]
    )
    dy[VX_G] = gear * (-force_x - mechanics.gear_stiffness_x * y[X_G] - mechanics.gear_damping_x * y[VX_G])
    dy[VY_G] = gear * (-force_y - mechanics.gear_stiffness_y * y[Y_G] - mechanics.gear_damping_y * y[VY_G])
    dy[SLIP] = rate * pinion_acceleration
    dy[XI_RATE] = rate * (
        table.pinion_pitch_radius * pinion_acceleration - table.gear_pitch_radius * gear_acceleration
    )
    dy[MOTOR_SLIP] = rate * motor_acceleration
    dy[WORK_IN] = rate * power_in
    dy[WORK_OUT] = rate * power_out
    dy[WORK_FRICTION] = rate * friction_power
    dy[WORK_DAMPING] = rate * damping_power
    dy[WORK_PARAMETRIC] = rate * parametric_power
    dy[WORK_SLIDING] = rate * sliding_power
    return power_in, power_out, friction_power, damping_power, parametric_power, drive_torque


@law
def strain_energy(phase, segment, y, model, work):
    """Strain energy of the contacts, J; fills the approaches and elastic loads in `work`."""
    cell, u, cells_per_radian = locate(phase, segment, model.table)
    approach(segment, cell, u, cells_per_radian, y, model, work)
    elastic_loads(segment, cell, u, model, work)
    return mesh_energy(model, work)


@law
def engagement(before, phase_before, after, phase_after, y, model, work):
    """Changes of (pinion slip, ξ', work in, parametric work) where the set of contacting pairs changes.

    The strain energy that appears or vanishes there is the parametric work of an impulse. The classical
    equations leave it unbalanced and the energy audit counts it; the energy-consistent ones take it from
    the drive (prescribed speed) or from the pinion's kinetic energy; where that is too small, the pinion
    comes to rest, and what is missing is parametric work.
    """
    step = strain_energy(phase_after, after, y, model, work) - strain_energy(
        phase_before, before, y, model, work
    )
    zero = 0.0 * step
    if model.options.formulation != ENERGY_CONSISTENT:
        return zero, zero, zero, step
    if model.options.drive == DRIVE_SPEED:
        return zero, zero, step, zero
    speed = model.mechanics.nominal_speed + y[SLIP]
    squared = speed * speed - 2.0 * step / model.mechanics.pinion_inertia
    slip = sqrt(maximum(squared, 0.0)) - speed
    missing = 0.5 * model.mechanics.pinion_inertia * maximum(-squared, 0.0)
    return slip, model.table.pinion_pitch_radius * slip, zero, missing


@law
def stored_energy(y, model, work):
    """Kinetic and strain energy of the whole model, J; `work` as `contact_forces` left it."""
    mechanics, table = model.mechanics, model.table
    pinion_speed = mechanics.nominal_speed + y[SLIP]
    gear_speed = (table.pinion_pitch_radius * pinion_speed - y[XI_RATE]) / table.gear_pitch_radius
    energy = mesh_energy(model, work)
    energy = energy + 0.5 * (
        mechanics.pinion_mass * (y[VX_P] * y[VX_P] + y[VY_P] * y[VY_P])
        + mechanics.gear_mass * (y[VX_G] * y[VX_G] + y[VY_G] * y[VY_G])
        + mechanics.pinion_inertia * pinion_speed * pinion_speed
        + mechanics.gear_inertia * gear_speed * gear_speed
        + mechanics.pinion_stiffness_x * y[X_P] * y[X_P]
        + mechanics.pinion_stiffness_y * y[Y_P] * y[Y_P]
        + mechanics.gear_stiffness_x * y[X_G] * y[X_G]
        + mechanics.gear_stiffness_y * y[Y_G] * y[Y_G]
    )
    if model.options.drive == DRIVE_SHAFT:
        motor_speed = mechanics.nominal_speed + y[MOTOR_SLIP]
        energy = energy + 0.5 * (
            mechanics.drive_inertia * motor_speed * motor_speed
            + mechanics.shaft_stiffness * y[TWIST] * y[TWIST]
        )
    return energy
