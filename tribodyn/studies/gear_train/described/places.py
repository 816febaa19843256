"""Where the gears of a recorded train and the contacts between them are, in x and y of the train."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.reader import Record
from tribodyn.train.positions import frame_of

#: What a gear is in the pair of a mesh, and which way that pair rolls it about its axis in the pair's frame.
_ENDS = (("driver_gear", "pinion", -1.0), ("driven_gear", "gear", 1.0))


class GearOutline(NamedTuple):
    """A gear as it stands where the angle of its body is 0."""

    name: str
    number: int  # along the axis of gears
    body: int
    outline: Float[Array, "point 2"]  # about its axis, m
    #: tip_radius, pitch_radius, bore_radius: m; of a gear of several meshes the pitch circle in the first
    tip_radius: float
    pitch_radius: float
    bore_radius: float


def gear_outlines(record: Record) -> list[GearOutline]:
    """The gears of a train, the largest first, so that a small one beside it stays in sight."""
    places, names = record.geometry, record["gear"]
    found: dict[int, GearOutline] = {}
    for m, mesh in enumerate(record["mesh"]):
        shape, cycle = record.of_mesh(mesh, "geometry"), record.of_mesh(mesh, "mesh_cycle")
        frame = np.array(_frame(record, m))
        pitch = 2.0 * np.pi / cycle["pinion_teeth"]
        roll = cycle["roll_start"] + places["phase"][m] * pitch
        for end, side, way in _ENDS:
            gear = int(places[end][m])
            if gear in found:
                continue
            radius = float(shape[f"{side}_pitch_radius"])
            turned = way * roll * float(shape["pinion_pitch_radius"]) / radius
            about = np.array([[np.cos(turned), np.sin(turned)], [-np.sin(turned), np.cos(turned)]])
            found[gear] = GearOutline(
                str(names[gear]),
                gear,
                int(places["gear_body"][gear]),
                np.asarray(shape[f"{side}_outline"]) @ about @ frame,
                float(shape[f"{side}_tip_radius"]),
                radius,
                float(shape[f"{side}_bore_radius"]),
            )
    return sorted(found.values(), key=lambda gear: -gear.tip_radius)


def poses(record: Record) -> Float[Array, "body time 3"]:
    """Centre (m) and rotation (rad, counter-clockwise) of every body."""
    places = record.geometry
    moved = np.nan_to_num(np.stack([record["x"], record["y"]], axis=-1)) + places["centre"]
    turned = places["sense"] * record["angle"]
    return np.swapaxes(np.concatenate([moved, turned[..., None]], axis=-1), 0, 1)


def contacts(record: Record) -> Float[Array, "time mesh pair 3"]:
    """Place (m) of every pair's contact without load, and direction (rad) of its load on the driven gear.

    NaN where a pair carries no load.
    """
    places = record.geometry
    mirrored = np.where(np.array(record.pairs) > 1, -1.0, 1.0)  # of back flanks, about the line of centres
    found = np.full((*record["normal_load"].shape, 3), np.nan)
    for m, mesh in enumerate(record["mesh"]):
        along, across = (np.array(direction) for direction in _frame(record, m))
        driver = places["centre"][int(places["gear_body"][int(places["driver_gear"][m])])]
        pitch_point = driver + record.of_mesh(mesh, "geometry")["pinion_pitch_radius"] * across
        angle = record["pressure_angle"][:, m]
        normal = (mirrored * np.cos(angle))[..., None] * along + np.sin(angle)[..., None] * across
        found[:, m, :, :2] = pitch_point + record["signed_distance"][:, m, :, None] * normal
        found[:, m, :, 2] = np.arctan2(normal[..., 1], normal[..., 0])
    return np.where(record["normal_load"][..., None] > 0.0, found, np.nan)


def _frame(record: Record, m: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Directions along and across of a mesh."""
    places = record.geometry
    driver = int(places["gear_body"][int(places["driver_gear"][m])])
    return frame_of(float(places["azimuth"][m]), int(places["sense"][driver]))


def mesh_reach(record: Record, m: int) -> tuple[tuple[float, float], float]:
    """Pitch point of a mesh, m, and half the width of a square about it that shows its path of contact."""
    places = record.geometry
    shape = record.of_mesh(record["mesh"][m], "geometry")
    driver = places["centre"][int(places["gear_body"][int(places["driver_gear"][m])])]
    x, y = driver + shape["pinion_pitch_radius"] * np.array(_frame(record, m)[1])
    return (float(x), float(y)), 1.8 * float(np.abs(shape["path_of_contact"]).max())
