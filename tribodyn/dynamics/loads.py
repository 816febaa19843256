"""What acts on the bodies beside the meshes: links, and the load that varies in time. For all compilers."""

from tribodyn.numerics.elementary import law, plain, sin
from tribodyn.numerics.smooth import cubic_rise, place_between
from tribodyn.train.clutches import clutch_friction, work_of_clutch
from tribodyn.train.structure import (
    BRAKES,
    IN_SPACE,
    TURN,
    place_in_space,
    shift_of,
    slip_of,
    slip_of_body,
    turn_of,
    turned,
    turning,
)


@law
def load_torque(time, operation):
    """Torque on the output against its motion beside the constant one, N m: over time, and harmonics."""
    torque = operation.output_torque + 0.0 * time
    for i in range(operation.load_amplitudes.shape[0]):
        angle = operation.load_frequencies[i] * time + operation.load_phases[i]
        torque = torque + operation.load_amplitudes[i] * sin(angle)
    if operation.load_times.shape[0] > 1:
        i, width, u = place_between(operation.load_times, time)
        start, end = operation.load_torques[i], operation.load_torques[i + 1]
        out, back = operation.load_slopes[i] * width, operation.load_slopes[i + 1] * width
        torque = torque + start + cubic_rise(u, end - start, out, back)
    return torque


@law
def drive_of_output(time, y, model):
    """Torque of the shaft beside the output, against its motion, N m; see `parameters.OutputDrive`."""
    layout, shaft = model.options.layout, model.operation.output_drive
    passed = time - shaft.since
    nominal = model.bodies.ratio[layout.output] * model.operation.nominal_speed
    ahead = turned(layout.output, y, layout) - nominal * y[layout.lag]  # of the nominal rotation
    angle = shaft.angle + passed * (shaft.slip + 0.5 * shaft.acceleration * passed)
    slip = shaft.slip + shaft.acceleration * passed
    slipping = slip_of_body(layout.output, y, model) - slip
    return shaft.stiffness * (ahead - angle) + shaft.damping * slipping


@law
def load_on(body, time, y, model):
    """Torque of the load on a body against its motion, N m."""
    bodies, layout = model.bodies, model.options.layout
    torque = bodies.load[body] + bodies.load_damping[body] * slip_of_body(body, y, model)
    if body == layout.output:
        torque = torque + load_torque(time, model.operation) + drive_of_output(time, y, model)
    return torque


@law
def load_slopes(body, model):
    """Slopes of `load_on` over the rotation of the body and over its speed, N m/rad, N m s/rad."""
    damping = model.bodies.load_damping[body]
    if body == model.options.layout.output:
        shaft = model.operation.output_drive
        return shaft.stiffness, damping + shaft.damping
    return 0.0 * damping, damping


@law
def joins_in_space(k, layout):
    """Whether a link is a matrix over x, y, z and tilts; of pins `coupling.Couplings` has all but x and y."""
    return layout.first[k] < layout.spatial and layout.second[k] < layout.spatial and not layout.pins[k] > 0


@law
def apart_in_space(first, second, direction, rates, y, layout):
    """How far the ends of a link are apart in x, y, z or a tilt; `rates` is 0, or `half` for the rate."""
    apart = y[rates + place_in_space(first, direction, layout)]
    if second >= 0:
        apart = apart - y[rates + place_in_space(second, direction, layout)]
    return apart


@law
def apart_in_plane(k, direction, rates, y, model):
    """How far the ends of a link are apart in x or y (0, 1), m; `rates` is 0, or `half` for the rate.

    Where it is a pin, by the rotations of its bodies too.
    """
    layout = model.options.layout
    first, second = layout.first[k], layout.second[k]
    apart = y[rates + shift_of(first) + direction]
    if second >= 0:
        apart = apart - y[rates + shift_of(second) + direction]
    if layout.pins[k] > 0:
        lever = model.links.lever
        if first > 0:  # the reference has no micro-rotation
            apart = apart + lever[k, 0, direction] * y[rates + turn_of(first, layout)]
        if second > 0:
            apart = apart - lever[k, 1, direction] * y[rates + turn_of(second, layout)]
    return apart


@law
def stretch_in_plane(k, direction, y, model):
    """What of it strains the link, m."""
    apart = apart_in_plane(k, direction, 0, y, model)
    if model.options.layout.pins[k] > 0:
        apart = apart - model.links.offset[k, direction]
    return apart


@law
def link_forces(y, model, dy):
    """Add the forces of all links to those in `dy`; returns powers, W: lost to damping, put in, taken out.

    The latter two are of what holds bodies at speeds of their own, in proportion to the reference's.
    """
    layout, links = model.options.layout, model.links
    half = layout.half
    power, put_in, taken_out = 0.0 * y[0], 0.0 * y[0], 0.0 * y[0]
    for k in range(layout.links):
        first, second = layout.first[k], layout.second[k]
        if joins_in_space(k, layout):
            for row in range(IN_SPACE):
                force, damping = 0.0 * y[0], 0.0 * y[0]
                for direction in range(IN_SPACE):
                    moved = apart_in_space(first, second, direction, 0, y, layout)
                    moving = apart_in_space(first, second, direction, half, y, layout)
                    force = force + links.stiffness_in_space[k, row, direction] * moved
                    damping = damping + links.damping_in_space[k, row, direction] * moving
                power = power + damping * apart_in_space(first, second, row, half, y, layout)
                i = half + place_in_space(first, row, layout)
                dy[i] = dy[i] - (force + damping)
                if second >= 0:
                    j = half + place_in_space(second, row, layout)
                    dy[j] = dy[j] + (force + damping)
        elif first < layout.planar and second < layout.planar:
            for direction in range(TURN):
                i = half + shift_of(first) + direction
                apart_rate = apart_in_plane(k, direction, half, y, model)
                damping = links.damping[k, direction] * apart_rate
                force = links.stiffness[k, direction] * stretch_in_plane(k, direction, y, model) + damping
                power = power + damping * apart_rate
                dy[i] = dy[i] - force
                if second >= 0:
                    j = half + shift_of(second) + direction
                    dy[j] = dy[j] + force
                if layout.pins[k] > 0:
                    i = half + turn_of(first, layout)
                    dy[i] = dy[i] - links.lever[k, 0, direction] * force
                    if second >= 0:
                        j = half + turn_of(second, layout)
                        dy[j] = dy[j] + links.lever[k, 1, direction] * force
        if second >= 0 or layout.holds[k] > 0:
            i = half + turn_of(first, layout)
            twist = turned(first, y, layout) - turned(second, y, layout)
            twist_rate = turning(first, y, layout) - turning(second, y, layout)
            laws = model.options.links
            elastic, _, share = laws.act(k, twist, links.stiffness[k, TURN], links.own, laws)
            damping = links.damping[k, TURN] * share * twist_rate
            torque = elastic + damping
            power = power + damping * twist_rate
            dy[i] = dy[i] - torque
            if second >= 0:
                j = half + turn_of(second, layout)
                dy[j] = dy[j] + torque
            if layout.holds[k] > 0:
                speed = model.bodies.ratio[first] * (model.operation.nominal_speed + slip_of(y, layout))
                if layout.holds[k] == BRAKES:
                    taken_out = taken_out + torque * speed
                else:
                    put_in = put_in - torque * speed
    return power, put_in, taken_out


@law
def clutch_forces(time, rate, y, model, dy):
    """Add the friction of clutches and brakes to the torques in `dy`, and put what it takes among the works.

    `rate`: s per reference cycle.
    """
    layout = model.options.layout
    half = layout.half
    for c in range(layout.clutches):
        first, second = layout.clutch_first[c], layout.clutch_second[c]
        slip, torque, _ = clutch_friction(c, time, y, model)
        i = half + turn_of(first, layout)
        dy[i] = dy[i] - torque
        if second >= 0:
            j = half + turn_of(second, layout)
            dy[j] = dy[j] + torque
        dy[work_of_clutch(c, layout)] = plain(rate * torque * slip)


@law
def link_energy(y, model):
    """Strain energy of all links, J."""
    layout, links = model.options.layout, model.links
    energy = 0.0 * y[0]
    for k in range(layout.links):
        first, second = layout.first[k], layout.second[k]
        if joins_in_space(k, layout):
            for row in range(IN_SPACE):
                one = apart_in_space(first, second, row, 0, y, layout)
                for direction in range(IN_SPACE):
                    other = apart_in_space(first, second, direction, 0, y, layout)
                    energy = energy + 0.5 * links.stiffness_in_space[k, row, direction] * one * other
        elif first < layout.planar and second < layout.planar:
            for direction in range(TURN):
                stretch = stretch_in_plane(k, direction, y, model)
                energy = energy + 0.5 * links.stiffness[k, direction] * stretch * stretch
        if second >= 0 or layout.holds[k] > 0:
            twist = turned(first, y, layout) - turned(second, y, layout)
            laws = model.options.links
            energy = energy + laws.act(k, twist, links.stiffness[k, TURN], links.own, laws)[1]
    return energy


# Inertia of bodies in a frame that turns with a carrier. For all compilers.
#
# The frame turns with the reference's actual rotation; x and y of its bodies are from where they are carried
# along. At a place r from its axis a body is accelerated by u'' + Ω' × r and, where these are switched on,
# by 2 Ω × u' − Ω² (r + u), Ω nominal. Levers and directions of meshes stay those of undisplaced bodies, so
# that the pins of a carrier that is turned by ϑ would turn it back by Σ m r² Ω² ϑ: that is taken off.


@law
def add_frame_forces(y, model, dy):
    """Add Coriolis and centrifugal forces to those in `dy`, N."""
    layout, bodies = model.options.layout, model.bodies
    half = layout.half
    for b in range(layout.planar):
        x = shift_of(b)
        speed, mass = bodies.frame_speed[b], bodies.mass[b]
        outward = mass * speed * speed
        dy[half + x] = (
            dy[half + x] + 2.0 * mass * speed * y[half + x + 1] + outward * (bodies.place[b, 0] + y[x])
        )
        dy[half + x + 1] = (
            dy[half + x + 1] - 2.0 * mass * speed * y[half + x] + outward * (bodies.place[b, 1] + y[x + 1])
        )
        i = turn_of(b, layout)
        dy[half + i] = dy[half + i] - bodies.hoop[b] * turned(b, y, layout)


@law
def carried_along(b, direction, acceleration, model):
    """How the frame accelerates a body in x or y (0, 1) where the reference does, m/s²."""
    bodies = model.bodies
    if direction == 0:
        return -bodies.carried[b] * acceleration * bodies.place[b, 1]
    return bodies.carried[b] * acceleration * bodies.place[b, 0]


@law
def frame_energy(b, y, model):
    """Kinetic energy of a body less ½ m |u'|², and the potential of what `add_frame_forces` adds, J.

    With these forces at prescribed speed exact to m Ω³ r × u, W, u from where the carrier takes the body; a
    speed that varies adds to it.
    """
    layout, bodies = model.options.layout, model.bodies
    x = shift_of(b)
    carried = bodies.carried[b] * (model.operation.nominal_speed + slip_of(y, layout))
    speed, mass = bodies.frame_speed[b], bodies.mass[b]
    right, up = bodies.place[b, 0], bodies.place[b, 1]
    across = right * y[layout.half + x + 1] - up * y[layout.half + x]
    squared = right * right + up * up
    along = right * y[x] + up * y[x + 1]
    moved = squared + 2.0 * along + y[x] * y[x] + y[x + 1] * y[x + 1]
    kinetic = carried * across + 0.5 * carried * carried * squared
    turn = turned(b, y, layout)
    energy = mass * (kinetic - 0.5 * speed * speed * moved + 2.0 * speed * carried * along)
    return energy + 0.5 * bodies.hoop[b] * turn * turn
