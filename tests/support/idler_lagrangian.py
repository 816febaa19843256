"""Equations of motion of an idler between two gears from its energies, derived by automatic differentiation.

Three gears on elastic bearings, two meshes. Nothing is assembled: masses, springs and dampers come from the
derivatives of T, V and Rayleigh's R, the friction from virtual work,

    d/dt ∂T/∂q' − ∂T/∂q + ∂V/∂q + ∂R/∂q' = Q.

The flanks' approach comes from the geometry of involutes and not from a line of action: the arcs by which the
flanks have unwound from both base circles, less the common tangent of these circles where the axes now are.
With B the sum of the base radii, d the distance of the axes, β the azimuth of their line, s the sense of the
driver and α = arccos(B/d), for the flanks that touch when it drives,

    δ = s (r_b1 θ_1 + r_b2 θ_2) − B (s β + inv α), less its value where nothing is displaced.

Coordinates (gear, 3): x, y, θ in one right-handed frame, θ counter-clockwise for all three gears. SI units.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp

from tribodyn.numerics.shapes import Array, Float

jax.config.update("jax_enable_x64", True)  # as the package does where it integrates with JAX

#: Driver and driven gear of each mesh: 0 drives the idler, 1, which drives 2.
ENDS = ((0, 1), (1, 2))


class Idler(NamedTuple):
    """What the equations depend on: arrays over the three gears, or over the two meshes."""

    mass: Float[Array, " gear"]
    inertia: Float[Array, " gear"]
    bearing_stiffness: Float[Array, "gear 2"]  # along x and y
    bearing_damping: Float[Array, "gear 2"]
    torque: Float[Array, " gear"]  # from outside, counter-clockwise
    base_radii: Float[Array, "mesh 2"]  # of driver and driven gear
    pressure_angle: Float[Array, " mesh"]  # operating
    azimuth: Float[Array, " mesh"]  # of the driven gear's axis seen from the driver's
    sense: float  # of gear 0, +1 counter-clockwise; the idler turns the other way
    stiffness: Float[Array, " mesh"]
    damping: Float[Array, " mesh"]
    distance: Float[Array, " mesh"]  # of the contact from the pitch point, > 0 in recess
    friction: Float[Array, " mesh"]  # N, on the driver along `tangent`; on the driven gear against it


def centres(idler: Idler) -> Float[Array, "gear 2"]:
    """Axes where nothing is displaced."""
    radii = jnp.asarray(idler.base_radii) / jnp.cos(jnp.asarray(idler.pressure_angle))[:, None]
    steps = [
        radii[m].sum() * jnp.array([jnp.cos(idler.azimuth[m]), jnp.sin(idler.azimuth[m])]) for m in range(2)
    ]
    return jnp.stack([jnp.zeros(2), steps[0], steps[0] + steps[1]])


def senses(idler: Idler) -> tuple[float, float, float]:
    """Senses of rotation of the three gears."""
    return (idler.sense, -idler.sense, idler.sense)


def wound(q: Float[Array, "gear 3"], idler: Idler, mesh: int) -> Float[Array, ""]:
    """Arcs that have unwound from both base circles less the common tangent, up to a constant."""
    first, second = ENDS[mesh]
    line = centres(idler)[second] + q[second, :2] - centres(idler)[first] - q[first, :2]
    # the azimuth from where it is, so that no branch of the arc tangent is crossed
    along = jnp.array([jnp.cos(idler.azimuth[mesh]), jnp.sin(idler.azimuth[mesh])])
    turned = jnp.arctan2(along[0] * line[1] - along[1] * line[0], along @ line)
    base, sense = jnp.asarray(idler.base_radii[mesh]), senses(idler)[first]
    pressure = jnp.arccos(base.sum() / jnp.linalg.norm(line))
    involute = jnp.tan(pressure) - pressure
    return sense * (base[0] * q[first, 2] + base[1] * q[second, 2]) - base.sum() * (sense * turned + involute)


def approach(q: Float[Array, "gear 3"], idler: Idler, mesh: int) -> Float[Array, ""]:
    """Approach of the flanks of a mesh, linear about the place where nothing is displaced.

    The length itself differs from this by squares of the displacements over the centre distance.
    """
    start = jnp.zeros_like(q)
    return jax.jvp(lambda at: wound(at, idler, mesh), (start,), (q,))[1]


def kinetic_energy(v: Float[Array, "gear 3"], idler: Idler) -> Float[Array, ""]:
    """T of the motion about uniform rotation; the rest is constant or a total derivative."""
    return 0.5 * jnp.sum(idler.mass * jnp.sum(v[:, :2] ** 2, axis=1) + idler.inertia * v[:, 2] ** 2)


def potential_energy(q: Float[Array, "gear 3"], idler: Idler) -> Float[Array, ""]:
    """V of bearings, meshes and the torques, which are constant."""
    bearings = 0.5 * jnp.sum(idler.bearing_stiffness * q[:, :2] ** 2)
    meshes = sum(0.5 * idler.stiffness[m] * approach(q, idler, m) ** 2 for m in range(2))
    return bearings + meshes - jnp.sum(idler.torque * q[:, 2])


def mesh_forces(q: Float[Array, "gear 3"], v: Float[Array, "gear 3"], idler: Idler) -> Float[Array, " mesh"]:
    """Normal loads of spring and damper, N."""
    springs = jnp.stack([idler.stiffness[m] * approach(q, idler, m) for m in range(2)])
    return springs + jnp.stack([idler.damping[m] * approach(v, idler, m) for m in range(2)])


def speeds(idler: Idler, speed: float) -> Float[Array, " gear"]:
    """Nominal speeds of the gears, each in its own sense, where gear 0 has `speed`."""
    base = jnp.asarray(idler.base_radii)
    return speed * jnp.cumprod(jnp.append(1.0, base[:, 0] / base[:, 1]))


def dissipation(v: Float[Array, "gear 3"], idler: Idler) -> Float[Array, ""]:
    """Rayleigh's R: half the power that bearings and meshes damp away."""
    bearings = 0.5 * jnp.sum(idler.bearing_damping * v[:, :2] ** 2)
    return bearings + sum(0.5 * idler.damping[m] * approach(v, idler, m) ** 2 for m in range(2))


def normal(idler: Idler, mesh: int) -> Float[Array, " 2"]:
    """Direction of the normal load on the driven gear: how its displacement diminishes the approach."""
    gradient = jax.grad(lambda q: wound(q, idler, mesh))(jnp.zeros((3, 3)))
    return -gradient[ENDS[mesh][1], :2]


def tangent(idler: Idler, mesh: int) -> Float[Array, " 2"]:
    """Direction across the normal, outwards from the driver's axis to the driven gear's."""
    x, y = normal(idler, mesh)
    across = jnp.array([-y, x])
    outwards = jnp.array([jnp.cos(idler.azimuth[mesh]), jnp.sin(idler.azimuth[mesh])])
    return jnp.sign(across @ outwards) * across


def contact_point(idler: Idler, mesh: int) -> Float[Array, " 2"]:
    """Where the flanks touch: at `distance` along the normal from the pitch point."""
    first, second = ENDS[mesh]
    base, places = jnp.asarray(idler.base_radii[mesh]), centres(idler)
    pitch_point = (base[1] * places[first] + base[0] * places[second]) / base.sum()
    return pitch_point + idler.distance[mesh] * normal(idler, mesh)


def carried(q: Float[Array, "gear 3"], idler: Idler, gear: int, point: Float[Array, " 2"]) -> Array:
    """Where a gear takes the point of it that stands at `point` where nothing is displaced."""
    arm = point - centres(idler)[gear]
    c, s = jnp.cos(q[gear, 2]), jnp.sin(q[gear, 2])
    return centres(idler)[gear] + q[gear, :2] + jnp.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]])


def sliding(idler: Idler, mesh: int, speed: float) -> Float[Array, ""]:
    """Velocity along `tangent` of the driver's flank against the driven one's, uniform rotation, m/s.

    `speed` is that of gear 0, > 0, rad/s.
    """
    rotation = jnp.zeros((3, 3)).at[:, 2].set(speeds(idler, speed) * jnp.array(senses(idler)))
    point = contact_point(idler, mesh)
    velocities = [
        jax.jvp(lambda q, gear=gear: carried(q, idler, gear, point), (jnp.zeros((3, 3)),), (rotation,))[1]
        for gear in ENDS[mesh]
    ]
    return tangent(idler, mesh) @ (velocities[0] - velocities[1])


def friction_forces(idler: Idler) -> Float[Array, "gear 3"]:
    """Generalised forces of the friction: δW = Σ F·δ(point of the gear), at the undisplaced place."""

    def work(q: Array) -> Array:
        total = jnp.zeros(())
        for mesh, (first, second) in enumerate(ENDS):
            point = contact_point(idler, mesh)
            moved = carried(q, idler, first, point) - carried(q, idler, second, point)
            total += idler.friction[mesh] * (tangent(idler, mesh) @ moved)
        return total

    return jax.grad(work)(jnp.zeros((3, 3)))


def accelerations(
    q: Float[Array, "gear 3"], v: Float[Array, "gear 3"], idler: Idler
) -> Float[Array, "gear 3"]:
    """Second derivatives of the coordinates at displacements q and velocities v, by Lagrange's equations."""
    forces = friction_forces(idler) - jax.grad(potential_energy)(q, idler) - jax.grad(dissipation)(v, idler)
    inertia = jax.hessian(kinetic_energy)(v, idler).reshape(9, 9)
    return jnp.linalg.solve(inertia, forces.ravel()).reshape(3, 3)
