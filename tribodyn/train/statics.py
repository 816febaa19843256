"""Torques of a train that turns steadily without losses."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.train.kinematics import TrainSpeeds


class Torques(NamedTuple):
    """Nominal torques of a train, N m; positive where power flows from the input to the loads."""

    driven: tuple[float, ...]  # of each mesh on its driven gear
    source: float  # on the body at which power enters
    #: of each coupling, on its second body in that body's sense of rotation
    coupling: tuple[float, ...]


def nominal_torques(
    motion: TrainSpeeds,
    teeth: Sequence[tuple[int, int]],
    couplings: Sequence[tuple[int, int]],
    loads: Sequence[float],
) -> Torques:
    """Balance the loads (N m, of every body against its motion) through meshes and couplings.

    `teeth` are those of each mesh's driver and driven gear; couplings join bodies, by their new indices. In a
    train with loops the balance leaves open how these share the load: here the sum of the squares of all
    tangential forces, taken over their modules, is least.
    """
    bodies, meshes = len(motion.bodies), len(teeth)
    balance = np.zeros((bodies, meshes + len(couplings) + 1))
    for mesh, (own, other) in enumerate(teeth):
        balance[motion.driver[mesh], mesh] -= own
        balance[motion.driven[mesh], mesh] += other
    scale = float(np.mean(teeth))  # a coupling's torque counts like that of a gear of the mean size
    for place, (one, two) in enumerate(couplings, start=meshes):
        balance[one, place] -= scale
        balance[two, place] += scale
    balance[motion.input, -1] = scale
    found, *_ = np.linalg.lstsq(balance, np.asarray(loads, dtype=float), rcond=None)
    return Torques(
        tuple(float(force * other) for force, (_, other) in zip(found[:meshes], teeth, strict=True)),
        float(found[-1] * scale),
        tuple(float(torque * scale) for torque in found[meshes:-1]),
    )
