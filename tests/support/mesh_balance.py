"""What the meshes of a record do to their bodies: forces, moments and powers in one frame, and what is left.

From loads, friction, angles and velocities as they are recorded, by vectors alone: a wrong sign or arm in the
equations that made the record shows as momentum or energy that nobody brought. SI units.

A record is a mapping with these arrays; x, y in one right-handed frame, pairs out of contact NaN or 0:

- ``time`` (time)
- ``velocity`` (time, body, 3): x, y and the whole speed of rotation, positive in the body's own sense
- ``normal_load``, ``friction_force``, ``pressure_angle``, ``signed_distance`` (time, mesh, pair): friction on
  the driver along t = (−sin α, cos α) in the mesh's frame, whose x is the motion at the pitch point and whose
  y points to the driven body; the distance of the contact from the pitch point, > 0 in recess.

A `Mesh` says where it is and which way its driver turns; its stiffness is not read.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from tests.support.train_matrices import DRIVING, Mesh, cross, pitch_motion, towards_driven
from tribodyn.numerics.shapes import Array, Float, Int

#: Ends of a mesh in the arrays below.
DRIVER, DRIVEN = 0, 1


class Actions(NamedTuple):
    """What each mesh does to its driver and its driven body: all pairs together, global frame."""

    force: Float[Array, "time mesh 2 2"]  # (…, end, direction), N
    moment: Float[Array, "time mesh 2"]  # about the axis of the body at the end, counter-clockwise, N m
    power: Float[Array, "time mesh 2"]  # on the body at the end, W
    deformation_power: Float[Array, "time mesh"]  # Σ normal load · approach rate of the flanks, W
    friction_power: Float[Array, "time mesh"]  # Σ friction force · sliding speed, W


def mesh_actions(
    record: Mapping[str, Array],
    meshes: Sequence[Mesh],
    senses: Int[Array, " body"],
    flanks: Sequence[int] | None = None,
) -> Actions:
    """Forces, moments and powers of every mesh.

    Parameters
    ----------
    senses : of the bodies' nominal rotation, +1 counter-clockwise
    flanks : per pair, DRIVING or BACK; all DRIVING if None. Back flanks live in the world mirrored about the
        line of centres, where the bodies turn the other way: n = (−cos α, sin α), t = (sin α, cos α)
    """
    count = len(record["time"])
    actions = Actions(*(np.zeros((count, len(meshes), *rest)) for rest in ((2, 2), (2,), (2,), (), ())))
    for m, mesh in enumerate(meshes):
        load, friction, alpha, distance = (
            np.nan_to_num(np.asarray(record[name])[:, m])
            for name in ("normal_load", "friction_force", "pressure_angle", "signed_distance")
        )
        side = np.asarray([DRIVING] * load.shape[1] if flanks is None else flanks)
        along, outwards = pitch_motion(mesh), towards_driven(mesh)
        cosine, sine, side = np.cos(alpha)[..., None], np.sin(alpha)[..., None], side[:, None]
        normal, tangent = side * cosine * along + sine * outwards, cosine * outwards - side * sine * along
        on_driven = load[..., None] * normal - friction[..., None] * tangent
        point = distance[..., None] * normal  # from the pitch point
        arms = (mesh.radii[0] * outwards + point, -mesh.radii[1] * outwards + point)
        speeds = []
        for end, (body, force) in enumerate(zip(mesh.ends, (-on_driven, on_driven), strict=True)):
            moved = np.asarray(record["velocity"])[:, body]
            turning = senses[body] * moved[:, None, 2, None]
            speeds.append(moved[:, None, :2] + turning * _quarter_turn(arms[end]))
            actions.force[:, m, end] = force.sum(axis=1)
            actions.moment[:, m, end] = cross(arms[end], force).sum(axis=1)
            actions.power[:, m, end] = np.sum(force * speeds[end], axis=(1, 2))
        relative = speeds[DRIVER] - speeds[DRIVEN]
        actions.deformation_power[:, m] = np.sum(load * np.sum(normal * relative, axis=-1), axis=1)
        # friction on the driver opposes its motion against the driven flank
        actions.friction_power[:, m] = -np.sum(friction * np.sum(tangent * relative, axis=-1), axis=1)
    return actions


def _quarter_turn(vectors: Float[Array, "*points 2"]) -> Float[Array, "*points 2"]:
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def residuals(actions: Actions, meshes: Sequence[Mesh]) -> dict[str, float]:
    """What does not cancel at the meshes, over the maximum of what should: force, moment, power.

    - force: on driver and driven body together
    - moment: of both about the driver's axis
    - power: on both bodies, with what deforms the teeth and what the friction takes
    """
    away = np.array([sum(mesh.radii) * towards_driven(mesh) for mesh in meshes])
    left = {
        "force": (actions.force.sum(axis=2), actions.force),
        "moment": (actions.moment.sum(axis=2) + cross(away, actions.force[:, :, DRIVEN]), actions.moment),
        "power": (
            actions.power.sum(axis=2) + actions.deformation_power + actions.friction_power,
            actions.power,
        ),
    }
    return {name: float(np.max(np.abs(rest)) / np.max(np.abs(of))) for name, (rest, of) in left.items()}


def forces_on_bodies(actions: Actions, meshes: Sequence[Mesh], bodies: int) -> Float[Array, "time body 3"]:
    """Force and moment of all meshes on every body, counter-clockwise."""
    total = np.zeros((len(actions.force), bodies, 3))
    for m, mesh in enumerate(meshes):
        for end, body in enumerate(mesh.ends):
            total[:, body, :2] += actions.force[:, m, end]
            total[:, body, 2] += actions.moment[:, m, end]
    return total
