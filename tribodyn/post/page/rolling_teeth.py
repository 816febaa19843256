"""What the page needs to roll the teeth through mesh: outlines, path of contact, contact points, angles."""

from typing import Any

import numpy as np

from tribodyn.post.page.series import packed
from tribodyn.record.reader import Record

#: Positions of the gears that are kept, evenly over the run.
MOST_FRAMES = 6000


def rolling_teeth(record: Record) -> dict[str, Any] | None:
    """Outlines about their own axes, and for every frame roll angle, contact points and directions of load.

    All in metres and radians from the pitch point, x along the pitch tangent, y along the line of centres to
    the gear's. The pinion stands turned by −roll about (0, −r_p), the gear by roll r_p/r_g about (0, r_g).
    None for a record without outlines, or without a rotation.
    """
    if not {"geometry", "mesh_cycle"} <= set(record.groups):
        return None
    shape, cycle = record.geometry, record.mesh_cycle
    needed = {"pinion_outline", "gear_outline", "path_of_contact"}
    if not needed <= set(shape) or not {"phase", "signed_distance", "pressure_angle"} <= set(cycle):
        return None
    phase = _phase(record, cycle)
    if phase is None or not len(phase):
        return None
    frames = np.unique(np.linspace(0, len(phase) - 1, min(len(phase), MOST_FRAMES)).round().astype(int))
    within = phase[frames] % 1.0
    pitch = 2.0 * np.pi / cycle["pinion_teeth"]
    front = np.flatnonzero(np.asarray(cycle["side"]) > 0)
    at = {name: _at(within, cycle, name)[:, front] for name in ("signed_distance", "pressure_angle")}
    touching = _at(within, cycle, "in_contact")[:, front] > 0.5
    x, y = (
        at["signed_distance"] * np.cos(at["pressure_angle"]),
        at["signed_distance"] * np.sin(at["pressure_angle"]),
    )
    return {
        "frames": None if len(frames) == len(phase) else packed(frames, "<u4"),
        "roll": packed(cycle["roll_start"] + phase[frames] * pitch, "<f8"),
        "pairs": len(front),
        "x": packed(np.where(touching, x, np.nan)),
        "y": packed(np.where(touching, y, np.nan)),
        "alpha": packed(at["pressure_angle"]),
        "pinion": packed(shape["pinion_outline"]),
        "gear": packed(shape["gear_outline"]),
        "path": packed(shape["path_of_contact"]),
        "radii": [float(shape["pinion_pitch_radius"]), float(shape["gear_pitch_radius"])],
    }


def _phase(record: Record, cycle: dict[str, Any]) -> np.ndarray | None:
    """Mesh cycles since the start, of every sample."""
    if "pinion_angle" in record:
        return np.asarray(record["pinion_angle"]) * cycle["pinion_teeth"] / (2.0 * np.pi)
    return np.asarray(record["phase"]) if record.axis == "phase" else None


def _at(phase: np.ndarray, cycle: dict[str, Any], name: str) -> np.ndarray:
    """A quantity of every pair slot at phases; each segment of the table by itself."""
    nodes, values = np.asarray(cycle["phase"]), np.asarray(cycle[name])
    columns = [np.interp(phase, nodes, column) for column in values.T]
    return np.stack(columns, axis=1)
