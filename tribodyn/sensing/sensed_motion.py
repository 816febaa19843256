"""What sensors see of a motion beside what is recorded: velocities, bearing forces, torques of shafts.

In the axes of the housing, also of bodies whose coordinates turn with a carrier.
"""

import numpy as np

from tribodyn.dynamics.loads import load_torque
from tribodyn.dynamics.recorded.outputs import Evaluated, bearing_force
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.structure import (
    AXIAL,
    TURN,
    place_in_space,
    shift_of,
    slip_of,
    slip_of_body,
    turned,
    turning,
)


def time_of(samples: Evaluated) -> Float[Array, " sample"]:
    """Time since the start, s."""
    operation = samples.model.operation
    nominal = samples.cycles * operation.pitch_angle / operation.nominal_speed
    return nominal + samples.y[samples.model.layout.lag]


def _in_housing(x: np.ndarray, y: np.ndarray, body: int, samples: Evaluated) -> tuple[np.ndarray, np.ndarray]:
    """Turn a vector from the frame of a body's coordinates into the housing's."""
    carried = np.asarray(samples.model.bodies.carried)
    if body >= len(carried) or carried[body] == 0.0:
        return x, y
    angle = carried[body] * samples.cycles * samples.model.operation.pitch_angle
    cosine, sine = np.cos(angle), np.sin(angle)
    return cosine * x - sine * y, sine * x + cosine * y


def velocity(body: int, direction: int, samples: Evaluated) -> Float[Array, " sample"]:
    """Velocity of a body in x, y or z (0, 1, 2), m/s, beside that of the point that carries it along.

    What a sensor on it has is the slope of this over time: unlike accelerations, velocities do not jump where
    the set of pairs in contact changes.
    """
    model, y, layout = samples.model, samples.y, samples.model.layout
    half = layout.half
    if direction == AXIAL:
        return y[half + place_in_space(body, AXIAL, layout)]
    place = shift_of(body)
    along, across = y[half + place], y[half + place + 1]
    carried = np.asarray(model.bodies.carried)
    if body < len(carried) and carried[body] != 0.0:
        turn = carried[body] * (model.operation.nominal_speed + slip_of(y, layout))
        along, across = along - turn * y[place + 1], across + turn * y[place]
    return _in_housing(along, across, body, samples)[direction]


def force_on_bearing(link: int, direction: int, samples: Evaluated) -> Float[Array, " sample"]:
    """Force of the first body of a link on what holds it, in x, y or z (0, 1, 2), N; 0 where it has none."""
    model, y, layout = samples.model, samples.y, samples.model.layout
    body = layout.first[link]
    if direction == AXIAL:
        in_space = body < layout.spatial and layout.second[link] < layout.spatial
        return bearing_force(link, AXIAL, y, model) if in_space else np.zeros(samples.size)
    forces = [np.broadcast_to(bearing_force(link, row, y, model), samples.size) for row in (0, 1)]
    return _in_housing(forces[0], forces[1], body, samples)[direction]


def torque_of_link(link: int, samples: Evaluated) -> Float[Array, " sample"]:
    """Torque of a shaft that gives way, N m, positive where its first end is ahead."""
    model, y, layout = samples.model, samples.y, samples.model.layout
    first, second = layout.first[link], layout.second[link]
    twist = turned(first, y, layout) - turned(second, y, layout)
    rate = turning(first, y, layout) - turning(second, y, layout)
    laws, links = model.options.links, model.links
    elastic, _, share = laws.act(link, twist, links.stiffness[link, TURN], links.own, laws)
    return elastic + links.damping[link, TURN] * share * rate


def output_torque(samples: Evaluated) -> Float[Array, " sample"]:
    """Torque of the load on the output, against its motion, N m."""
    model, y = samples.model, samples.y
    body, bodies = model.layout.output, samples.model.bodies
    steady = bodies.load[body] + bodies.load_damping[body] * slip_of_body(body, y, model)
    return steady + load_torque(time_of(samples), model.operation)
