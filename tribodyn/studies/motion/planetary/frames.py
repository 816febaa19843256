"""What a train's model says of frames that turn with carriers: speeds, places, levers of pins."""

from collections.abc import Sequence
from math import pi

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox, TrainMesh
from tribodyn.train.layout import TrainLayout
from tribodyn.train.planetary import CARRIER
from tribodyn.train.structure import (
    GearMesh,
    driven_arm,
    driver_arm,
)


def carried_ratio(case: Gearbox, body: int, carrier: int) -> float:
    """Speed of a carrier over the reference's in the sense of a body; of −1 nothing."""
    if carrier < 0:
        return 0.0
    other = case.bodies[carrier]
    return float(other.ratio) * other.sense * case.bodies[body].sense


def carried_of(case: Gearbox, mesh: TrainMesh, plain: GearMesh) -> dict[str, float]:
    """What `GearMesh` says of the carrier of its mesh."""
    if mesh.carrier < 0:
        return {}
    ways = [case.bodies[mesh.carrier].sense * case.bodies[body].sense for body in (mesh.driver, mesh.driven)]
    return {
        "driver_carried": carried_ratio(case, mesh.driver, mesh.carrier),
        "driven_carried": carried_ratio(case, mesh.driven, mesh.carrier),
        "carrier_arm": float(ways[0] * driver_arm(plain) - ways[1] * driven_arm(plain)),
    }


def rolling_of(case: Gearbox) -> float:
    """Speed of the reference mesh's driver against what carries it, over that of the reference body."""
    first = case.meshes[0]
    return float(case.bodies[first.driver].ratio) - carried_ratio(case, first.driver, first.carrier)


def reference_pitch(case: Gearbox) -> float:
    """Rotation of the reference body in a cycle of the reference mesh, rad."""
    return 2.0 * pi / abs(float(case.meshes[0].pair.drive.pinion.teeth)) / rolling_of(case)


def frames_of(
    case: Gearbox, bodies: Sequence[int], mass: Float[Array, " planar"]
) -> dict[str, Float[Array, "..."]]:
    """What `Bodies` says of frames that turn with carriers, of the case's bodies that move in the plane.

    These have so much `mass`, kg.
    """
    if not case.sets:
        return {}
    speed = case.source.speed / float(case.bodies[case.source.body].ratio)
    carried, frame_speed, hoop = np.zeros((3, len(bodies)))
    place = np.zeros((len(bodies), 2))
    for gearset in case.sets:
        carrier = case.bodies[gearset.members[CARRIER]]
        for row in (row for row, body in enumerate(bodies) if body in gearset.bodies):
            carried[row] = float(carrier.ratio) * carrier.sense
            frame_speed[row] = carried[row] * speed if gearset.frame_forces else 0.0
            place[row] = np.subtract(case.bodies[bodies[row]].centre, carrier.centre)
        rows = [bodies.index(planet) for planet in gearset.planets]
        pulled = mass[rows] * frame_speed[rows] ** 2 * np.sum(place[rows] ** 2, axis=1)
        hoop[bodies.index(gearset.members[CARRIER])] = np.sum(pulled)
    return {"carried": carried, "frame_speed": frame_speed, "place": place, "hoop": hoop}


def pins_of(case: Gearbox, layout: TrainLayout) -> tuple[Float[Array, "link end 2"], Float[Array, "link 2"]]:
    """Levers and offsets of the links; empty where there are no sets."""
    count = layout.links if case.sets else 0
    lever, offset = np.zeros((count, 2, 2)), np.zeros((count, 2))
    for number, link in enumerate(case.links if count else ()):
        offset[number] = link.offset
        if link.lever:
            lever[number, 1] = link.lever
    return lever, offset
