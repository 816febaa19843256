"""What modifications take off the flank of one gear: over the profile, along the face, and in its twist.

Lengths are along the normal of the flank, m; places over the profile are signed distances on the path of
contact of the pair (m), the pinion's root and the gear's tip at its beginning.
"""

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Side
from tribodyn.geometry.modification import FlankModification, LeadRelief, Relief
from tribodyn.geometry.path import PerContact
from tribodyn.numerics.curve import check_cover, interpolate
from tribodyn.numerics.shapes import Array, Float


def over_profile(assembly: Assembly, side: Side, flank: FlankModification, place: PerContact) -> PerContact:
    """Relief of tip and root, and error of the profile."""
    first, last = (flank.root, flank.tip) if side == "pinion" else (flank.tip, flank.root)
    total = _relieved(first, place - assembly.r_start) + _relieved(last, assembly.r_end - place)
    if flank.profile_error is not None:
        at, error = flank.profile_error
        check_cover(at, *assembly.roll_limits, f"drive.{side}.modification.profile_error")
        roll = np.clip(assembly.path.rotation(place), at[0], at[-1])
        total = total + interpolate(at, error, roll)
    return total


def along_face(lead: LeadRelief, width: float, position: Float[Array, " slice"]) -> Float[Array, " slice"]:
    """Relief at places along the face, m from its middle."""
    straight = lead.unmodified / 2.0
    share = np.maximum(np.abs(position) - straight, 0.0) / (width / 2.0 - straight)
    crowned = lead.crowning * (2.0 * position / width) ** 2 + lead.slope * position / width
    return crowned + np.where(position < 0.0, lead.start, lead.end) * share**2


def at_the_end(assembly: Assembly, side: Side, flank: FlankModification, place: PerContact) -> PerContact:
    """Twist at the end of the face, over the whole active path; linear along it, 0 in the middle."""
    middle, half = (assembly.r_start + assembly.r_end) / 2.0, (assembly.r_end - assembly.r_start) / 2.0
    return flank.bias * (1.0 if side == "pinion" else -1.0) * (place - middle) / half


def _relieved(relief: Relief, distance: PerContact) -> PerContact:
    """Relief at a distance (m, along the line of action) from the end of the active profile."""
    if relief.amount == 0.0:
        return 0.0 * distance
    share = np.clip((relief.length - distance) / relief.length, 0.0, 1.0)
    return relief.amount * share**relief.exponent
