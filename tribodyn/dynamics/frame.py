"""Inertia of bodies in a frame that turns with a carrier. For all compilers.

The frame turns with the reference's actual rotation; x and y of its bodies are from where they are carried
along. At a place r from its axis a body is accelerated by u'' + Ω' × r and, where these are switched on,
by 2 Ω × u' − Ω² (r + u), Ω nominal. Levers and directions of meshes stay those of undisplaced bodies: what a
centrifugal force turns the carrier by is exact to the displacement over the radius.
"""

from tribodyn.numerics.elementary import law
from tribodyn.train.structure import shift_of, slip_of


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

    With these forces at prescribed speed exact to m Ω³ r × u, W, see above; a speed that varies adds to it.
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
    return mass * (kinetic - 0.5 * speed * speed * moved + 2.0 * speed * carried * along)
