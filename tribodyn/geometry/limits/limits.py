"""How far a pair of gears is from the limits of its existence: signed distances, for a search.

`checks` refuses the first rule that a pair breaks; here every rule is a number, positive where it holds,
continuous, and differentiable through JAX. A pair beyond the limits has distances too.
"""

from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly, lowest_contact_radius, tip_clearance, tip_corner_gap
from tribodyn.geometry.drive import SIDES, Drive, Side
from tribodyn.geometry.helix import overlap_ratio
from tribodyn.geometry.limits.internal import away_from_pitch_point, internal_distances
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import flank_point
from tribodyn.numerics.elementary import minimum, namespace, sense, smallest
from tribodyn.numerics.shapes import Array, Float

_SAMPLES = 129
# Share of the module over which the smooth minimum blends values.
_BLENDED = 1e-3


_OF_BODY = ("undercut", "interference", "tip_corner", "tip_thickness", "clearance", "rack_tip")
#: Name of every distance -> its SI unit; what each is stands in the catalogue of quantities.
LIMITS = {f"{name}_{side}": "m" for name in _OF_BODY for side in SIDES}
LIMITS |= {"contact_ratio_above_1": "1", "trochoidal_clearance": "m", "tool_flank": "m", "base_circle": "m"}


def distances(assembly: Assembly) -> dict[str, Any]:
    """Distances of a pair from the limits of its existence, by the names of `LIMITS`; m, positive: it holds.

    Of any numbers, traced or plain, that need not pass the checks; nothing is raised. What does not exist at
    all, because the path ends before the teeth do, is NaN. `undercut_…` is a smooth minimum over the contact:
    at most 0.005 modules below the sharp one.
    """
    with np.errstate(all="ignore"):
        margins = {}
        for side in SIDES:
            of_body = _of_body(assembly, side)
            margins |= {f"{name}_{side}": of_body[name] for name in _OF_BODY}
        margins["contact_ratio_above_1"] = assembly.contact_ratio + overlap_ratio(assembly) - 1.0
        margins |= internal_distances(assembly)
    return {name: margins[name] for name in LIMITS}


def plain_distances(assembly: Assembly) -> dict[str, float]:
    """Distances of a pair of plain numbers; `beyond` where one does not exist."""
    margins = {name: float(value) for name, value in distances(assembly).items()}
    return {
        name: value if np.isfinite(value) else beyond(LIMITS[name], assembly.drive)
        for name, value in margins.items()
    }


def beyond(unit: str, drive: Drive) -> float:
    """What stands for a distance that does not exist: a module beyond the limit, or 1."""
    return -float(drive.module) if unit == "m" else -1.0


def _of_body(assembly: Assembly, side: Side) -> dict[str, Any]:
    drive, tooth = assembly.drive, assembly.tooth(side)
    start, end = assembly.limits
    r = start + (end - start) * np.linspace(0.0, 1.0, _SAMPLES)
    motion = kinematics(assembly.path, r)
    speed = motion.pinion_speed if side == "pinion" else motion.gear_speed
    speed = speed * sense(assembly.path.pinion_pitch_radius)  # in the pinion's own sense of turning
    return {
        "undercut": smooth_minimum(away_from_pitch_point(speed, r, drive.module), _BLENDED * drive.module),
        "interference": lowest_contact_radius(assembly, side) - tooth.form_radius,
        "tip_corner": minimum(tip_corner_gap(assembly, side), drive.module),
        "tip_thickness": 2 * flank_point(tooth, tooth.tip_distance)[1],
        "clearance": tip_clearance(assembly, side),
        "rack_tip": tooth.corner_limit - tooth.corner_x,
    }


def smooth_minimum(values: Float[Array, " sample"], width: Any) -> Any:
    """−width ln Σ exp(−values/width): at most width ln n below the minimum, and differentiable."""
    xp = namespace(values, width)
    lowest = smallest(values)
    return lowest - width * xp.log(xp.sum(xp.exp((lowest - values) / width)))
