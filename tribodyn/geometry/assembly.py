"""A drive with plain numbers put together, and the margins by which it can be made and run."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tribodyn.geometry.drive import SIDES, Drive, Side, root_radius, tip_radius
from tribodyn.geometry.family import Family
from tribodyn.geometry.path import Path, contact_limits, contact_ratio, kinematics, radius, seen_from
from tribodyn.geometry.tooth import Tooth, cut_tooth, fillet_point, thickness_half_angle

_SAMPLES = 400


@dataclass(frozen=True)
class Assembly:
    """Paths, teeth and contact limits of a drive.

    Parameters
    ----------
    family, drive
        What was put together.
    path : Path
        Working path of contact.
    pinion, gear : Tooth
        The teeth as cut.
    r_start, r_end : float
        Signed distances of first and last contact, m; NaN where the tip circles do not reach the path.
    """

    family: Family
    drive: Drive
    path: Path
    pinion: Tooth
    gear: Tooth
    r_start: float
    r_end: float

    def tooth(self, side: Side) -> Tooth:
        """Return the tooth of one body."""
        return self.pinion if side == "pinion" else self.gear

    def lowest_contact(self, side: Side) -> float:
        """Signed distance (m), in the body's own view, where the mate's tip touches this body's flank."""
        return self.r_start if side == "pinion" else -self.r_end

    @property
    def contact_ratio(self) -> float:
        """Transverse contact ratio."""
        return float(contact_ratio(self.path, self.r_start, self.r_end, self.drive.pinion.teeth))


def mate_of(side: Side) -> Side:
    """Return the other body's name."""
    return "gear" if side == "pinion" else "pinion"


def assemble(family: Family, drive: Drive) -> Assembly:
    """Put a drive of plain numbers together."""
    path = family.working_path(drive)
    limits = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    pinion, gear = (cut_tooth(family, drive, side) for side in SIDES)
    return Assembly(family, drive, path, pinion, gear, float(limits[0]), float(limits[1]))


def tip_clearance(assembly: Assembly, side: Side) -> float:
    """Distance between this body's tip circle and its mate's root circle on the line of centres, m."""
    centre_distance = assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius
    drive = assembly.drive
    return float(centre_distance - tip_radius(drive, side) - root_radius(drive, mate_of(side)))


def lowest_contact_speed(assembly: Assembly, side: Side) -> float:
    """Speed of the lowest contact along this body's flank, m per rad; no flank is there unless > 0."""
    path = seen_from(assembly.path, side)
    return float(kinematics(path, assembly.lowest_contact(side)).pinion_speed)


def lowest_contact_radius(assembly: Assembly, side: Side) -> float:
    """Radius on this body at which the mate's tip touches its flank, m."""
    return float(radius(seen_from(assembly.path, side), assembly.lowest_contact(side)))


def tip_corner_gap(assembly: Assembly, side: Side) -> float:
    """Least gap (m) between this body's fillet and the corner of the mate's tip; infinite if they never meet.

    The corner is followed in the tooth's frame from the lowest contact to the line of centres, where it is
    deepest, and compared with the fillet at the same radius.
    """
    tooth, path = assembly.tooth(side), seen_from(assembly.path, side)
    r_p, r_g = path.pinion_pitch_radius, path.gear_pitch_radius
    lowest = assembly.lowest_contact(side)
    alpha = path.pressure_angle(lowest)
    tip, mate_angle = _polar(r_g - lowest * np.sin(alpha), lowest * np.cos(alpha))
    mate_turn = -mate_angle * np.linspace(0.0, 1.0, _SAMPLES)
    corner_x, corner_y = tip * np.sin(mate_angle + mate_turn), r_g - tip * np.cos(mate_angle + mate_turn)
    distance, angle = _polar(r_p + corner_y, corner_x)
    rotation = path.rotation(lowest) + mate_turn * r_g / r_p
    corner_angle = thickness_half_angle(tooth, r_p) + angle - rotation
    normal_angle = np.linspace(np.pi / 2, tooth.form_angle, _SAMPLES)
    fillet_radius, fillet_angle = _polar(*fillet_point(tooth, normal_angle))
    gap = (corner_angle - np.interp(distance, fillet_radius, fillet_angle)) * distance
    return float(np.min(np.where(distance < tooth.form_radius, gap, np.inf)))


def _polar(x: Any, y: Any) -> tuple[Any, Any]:
    return np.hypot(x, y), np.arctan2(y, x)
