"""Outlines, path and circles of a gear pair, as records keep them for pictures."""

from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, body_of, tip_radius
from tribodyn.geometry.path import position
from tribodyn.geometry.tooth.body import gear_polygon
from tribodyn.numerics.variable import Variable

#: Curves and radii.
GEOMETRY: dict[str, Variable] = {
    "pinion_outline": Variable(
        ("pinion_point", "axis"),
        "m",
        "outline of the pinion about its axis, turned as when a pair touches at the pitch point",
    ),
    "gear_outline": Variable(
        ("gear_point", "axis"),
        "m",
        "outline of the gear about its axis, turned as when a pair touches at the pitch point",
    ),
    "path_of_contact": Variable(
        ("path_point", "axis"), "m", "path of contact, origin at the pitch point, x along the pitch tangent"
    ),
    **{
        f"{side}_{circle}_radius": Variable((), "m", f"radius of the {side}'s {what}")
        for side in ("pinion", "gear")
        for circle, what in (
            ("tip", "tip circle"),
            ("root", "root circle"),
            ("pitch", "pitch circle"),
            ("bore", "bore"),
        )
    },
}


def geometry_arrays(assembly: Assembly) -> dict[str, Any]:
    """Outlines, path and circles, in each body's own frame, m."""
    path, drive = assembly.path, assembly.drive
    start, end = assembly.roll_limits
    roll = np.linspace(start, end, 201)
    x, y = position(path, path.signed_distance(roll))
    arrays: dict[str, Any] = {"path_of_contact": np.stack([x, y], axis=-1)}
    for side in SIDES:
        arrays[f"{side}_outline"] = np.asarray(gear_polygon(assembly, side))
        arrays[f"{side}_tip_radius"] = float(tip_radius(drive, side))
        arrays[f"{side}_root_radius"] = float(assembly.tooth(side).root_radius)
        arrays[f"{side}_pitch_radius"] = float(getattr(path, f"{side}_pitch_radius"))
        arrays[f"{side}_bore_radius"] = float(body_of(drive, side).bore_radius)
    return arrays
