"""What acts on the bodies beside the meshes: links, and the load that varies in time. For all compilers."""

from tribodyn.numerics.elementary import last_at_or_below, law, maximum, minimum, sin
from tribodyn.train.structure import IN_SPACE, TURN, place_in_space, shift_of, turn_of, turned, turning


@law
def load_torque(time, operation):
    """Torque on the output against its motion beside the constant one, N m: over time, and harmonics."""
    torque = 0.0 * time
    for i in range(operation.load_amplitudes.shape[0]):
        angle = operation.load_frequencies[i] * time + operation.load_phases[i]
        torque = torque + operation.load_amplitudes[i] * sin(angle)
    if operation.load_times.shape[0] > 1:
        times = operation.load_times
        i = last_at_or_below(times, time)
        width = times[i + 1] - times[i]
        u = minimum(maximum((time - times[i]) / width, 0.0), 1.0)
        start, end = operation.load_torques[i], operation.load_torques[i + 1]
        out, back = operation.load_slopes[i] * width, operation.load_slopes[i + 1] * width
        rise = end - start
        torque = (
            torque + start + u * (out + u * (3.0 * rise - 2.0 * out - back + u * (out + back - 2.0 * rise)))
        )
    return torque


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
    """Add the forces of all links to those in `dy`; returns the power that they take by damping, W."""
    layout, links = model.options.layout, model.links
    half = layout.half
    power = 0.0 * y[0]
    for k in range(layout.links):
        first, second = layout.first[k], layout.second[k]
        if first < layout.spatial and second < layout.spatial:
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
    return power


@law
def link_energy(y, model):
    """Strain energy of all links, J."""
    layout, links = model.options.layout, model.links
    energy = 0.0 * y[0]
    for k in range(layout.links):
        first, second = layout.first[k], layout.second[k]
        if first < layout.spatial and second < layout.spatial:
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
