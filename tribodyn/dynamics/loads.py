"""What acts on the bodies beside the meshes: links, and the load that varies in time. For all compilers."""

from tribodyn.numerics.elementary import last_at_or_below, law, maximum, minimum, sin
from tribodyn.train.structure import TURN, shift_of, turn_of, turned, turning


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
def link_forces(y, model, dy):
    """Add the forces of all links to those in `dy`; returns the power that they take by damping, W."""
    layout, links = model.options.layout, model.links
    half = layout.half
    power = 0.0 * y[0]
    for k in range(layout.links):
        first, second = layout.first[k], layout.second[k]
        if first < layout.planar and second < layout.planar:
            for direction in range(TURN):
                i = shift_of(first) + direction
                apart, apart_rate = y[i], y[half + i]
                if second >= 0:
                    j = shift_of(second) + direction
                    apart, apart_rate = apart - y[j], apart_rate - y[half + j]
                damping = links.damping[k, direction] * apart_rate
                force = links.stiffness[k, direction] * apart + damping
                power = power + damping * apart_rate
                dy[half + i] = dy[half + i] - force
                if second >= 0:
                    j = shift_of(second) + direction
                    dy[half + j] = dy[half + j] + force
        if second >= 0:
            i, j = half + turn_of(first, layout), half + turn_of(second, layout)
            twist = turned(first, y, layout) - turned(second, y, layout)
            twist_rate = turning(first, y, layout) - turning(second, y, layout)
            laws = model.options.links
            elastic, _, share = laws.act(k, twist, links.stiffness[k, TURN], links.own, laws)
            damping = links.damping[k, TURN] * share * twist_rate
            torque = elastic + damping
            power = power + damping * twist_rate
            dy[i] = dy[i] - torque
            dy[j] = dy[j] + torque
    return power


@law
def link_energy(y, model):
    """Strain energy of all links, J."""
    layout, links = model.options.layout, model.links
    energy = 0.0 * y[0]
    for k in range(layout.links):
        first, second = layout.first[k], layout.second[k]
        if first < layout.planar and second < layout.planar:
            for direction in range(TURN):
                apart = y[shift_of(first) + direction]
                if second >= 0:
                    apart = apart - y[shift_of(second) + direction]
                energy = energy + 0.5 * links.stiffness[k, direction] * apart * apart
        if second >= 0:
            twist = turned(first, y, layout) - turned(second, y, layout)
            laws = model.options.links
            energy = energy + laws.act(k, twist, links.stiffness[k, TURN], links.own, laws)[1]
    return energy
