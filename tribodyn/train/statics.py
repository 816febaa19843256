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

    `teeth` are those of each mesh's driver and driven gear, without signs; couplings join bodies, by their
    new indices. Bodies that do not turn bear any torque. In a train with loops the balance leaves open how
    these share the load: here the sum of the squares of all tangential forces, taken over their modules, is
    least.
    """
    bodies, meshes = len(motion.bodies), len(teeth)
    held = [body for body in range(bodies) if motion.ratio[body] == 0]
    balance = np.zeros((bodies, meshes + len(couplings) + 1 + len(held)))
    for mesh, (driver_arm, other) in enumerate(teeth):
        driver, driven, carrier = motion.driver[mesh], motion.driven[mesh], motion.carrier[mesh]
        balance[driver, mesh] -= driver_arm
        balance[driven, mesh] += other
        if carrier >= 0:  # the pin bears what the planet's forces have about the axis of the set
            on_both = other * motion.sense[driven] - driver_arm * motion.sense[driver]
            balance[carrier, mesh] -= motion.sense[carrier] * on_both
    scale = float(np.mean(teeth))  # a coupling's torque counts like that of a gear of the mean size
    for place, (one, two) in enumerate(couplings, start=meshes):
        balance[one, place] -= scale
        balance[two, place] += scale
    balance[motion.input, meshes + len(couplings)] = scale
    for place, body in enumerate(held, start=meshes + len(couplings) + 1):
        balance[body, place] = scale
    forces, *_ = np.linalg.lstsq(balance, np.asarray(loads, dtype=float), rcond=None)
    return Torques(
        tuple(float(force * other) for force, (_, other) in zip(forces[:meshes], teeth, strict=True)),
        float(forces[meshes + len(couplings)] * scale),
        tuple(float(torque * scale) for torque in forces[meshes : meshes + len(couplings)]),
    )
