"""Rounded tips: where the rounding of a tooth's edge leaves the flank."""

from typing import Any

from tribodyn.geometry.drive import Drive, Side, tip_circle_radius
from tribodyn.geometry.family import Family
from tribodyn.geometry.path import distance_at_radius
from tribodyn.numerics.elementary import cos, sqrt


def flank_angle_at_tip(family: Family, drive: Drive, side: Side) -> Any:
    """Sine and cosine of the angle between the flank at the tip circle and the radius there.

    The flank's normal passes the axis at the arm r_p cos α: the cosine is this arm over the tip's radius.
    """
    path, _ = family.generating_path(drive, side)
    outer = tip_circle_radius(drive, side)
    arm = path.pinion_pitch_radius * cos(path.pressure_angle(distance_at_radius(path, outer)))
    cosine = arm / outer
    return sqrt(1.0 - cosine**2), cosine


def tip_break(family: Family, drive: Drive, side: Side, rounding: float) -> Any:
    """Height below the tip circle, m, at which a rounding of radius ρ ends on the flank: ρ (1 − sin α_a)."""
    sine, _ = flank_angle_at_tip(family, drive, side)
    return rounding * (1.0 - sine)
