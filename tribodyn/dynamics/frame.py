"""Inertia of bodies in a frame that turns with a carrier. For all compilers.

The frame turns with the reference's actual rotation; x and y of its bodies are from where they are carried
along. At a place r from its axis a body is accelerated by u'' + Ω' × r and, where these are switched on,
by 2 Ω × u' − Ω² (r + u), Ω nominal. Levers and directions of meshes stay those of undisplaced bodies, so that
the pins of a carrier that is turned by ϑ would turn it back by Σ m r² Ω² ϑ: that is taken off.
"""

from tribodyn.numerics.elementary import law
from tribodyn.train.structure import shift_of, slip_of, turn_of, turned


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
