"""Forces of meshes on shafts that are not drawn, shared equally by the bearings of each."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import cos, hypot, sin, tan
from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.drive import SIDES, Drive
from tribodyn.geometry.families import family
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.pair import LossData


class MeshForce(NamedTuple):
    """Force of a pair of gears at its pitch point, N, and its working radii."""

    tangential: float  # positive where the pinion drives
    radial: float  # that separates the axes of external gears
    axial: float  # on the pinion along z where that turns counter-clockwise seen from +z
    radii: tuple[float, float]  # signed, m


def mesh_force(name: str, drive: Drive, torque: float) -> MeshForce:
    """The mean force of a pair of a family without friction, by the torque on its gear, N m."""
    path = family(name).working_path(drive)
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    tangential = torque / abs(radii[1])
    reference = abs(float(drive.module * drive.gear.teeth)) / 2.0
    slope = tan(float(drive.helix_angle)) * abs(radii[1]) / reference
    return MeshForce(
        tangential,
        abs(tangential) * tan(float(path.pressure_angle(0.0))),
        tangential * slope,
        radii,
    )


def on_driven(force: MeshForce, azimuth: float, sense: int) -> Float[Array, " direction"]:
    """Force in x, y, z on the driven gear of a mesh, N.

    `azimuth` is that of the driven axis from the driver's, `sense` +1 where the driver turns
    counter-clockwise seen from +z.
    """
    towards = np.array([cos(azimuth), sin(azimuth)])
    pitch_point = towards if force.radii[1] > 0.0 else -towards
    along = sense * np.array([-pitch_point[1], pitch_point[0]])
    outwards = np.sign(force.radii[0]) * pitch_point
    x, y = force.tangential * along + force.radial * outwards
    return np.array([x, y, -sense * force.axial])


def shared_by_bearings(data: LossData, forces: Mapping[Any, Sequence[float]]) -> LossData:
    """What is asked for with forces on the bearings that are to have those of the meshes.

    `forces` are those on bodies in x, y, z, N, by number or, of a pair, by name of the gear.
    """
    shafts = []
    for shaft in data.shafts:
        x, y, z = forces.get(shaft.name if shaft.body is None else shaft.body, (0.0, 0.0, 0.0))
        bearings = tuple(
            held._replace(radial=hypot(x, y) / held.bearing.count, axial=abs(z) / held.bearing.count)
            if held.of_meshes
            else held
            for held in shaft.bearings
        )
        shafts.append(replace(shaft, bearings=bearings))
    return replace(data, shafts=tuple(shafts))


def forces_on_pair(name: str, drive: Drive, torque: float) -> dict[str, Sequence[float]]:
    """Forces on both gears of a pair in x, y, z, N."""
    force = on_driven(mesh_force(name, drive, torque), 0.0, 1)
    return {SIDES[0]: (-force).tolist(), SIDES[1]: force.tolist()}
