"""Helical teeth: what the helix makes of the transverse section, whose path of contact is a spur pair's.

A slice of the face at z rolls like a spur pair that is late by z tan β_w/r_w. The common normal of two flanks
in contact leans out of the transverse plane: it goes through the pitch point at an arm r_w cos α about the
axis and is perpendicular to the flank's screw motion, so that its slope is tan β_n = tan β_w cos α. For an
involute this is tan β_b all along the path. The line of contact follows the path of contact from slice to
slice, dr/dz = tan β_n, and where the pressure angle changes along the path it turns with it.
"""

from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Drive, Side, reference_radius
from tribodyn.geometry.path import Path, PerContact
from tribodyn.numerics.elementary import arctan2, cos, sin, sqrt, tan
from tribodyn.numerics.shapes import Array, Float


def pitch_slope(assembly: Assembly) -> Any:
    """Slope tan β_w of the helix on the working pitch circles; > 0: right-hand pinion.

    Both gears have the same, by one lead: tan β_w = tan β r_w/r.
    """
    drive = assembly.drive
    return tan(drive.helix_angle) * assembly.path.pinion_pitch_radius / reference_radius(drive, "pinion")


def roll_shift(assembly: Assembly, z: Any) -> Any:
    """Pinion angle (rad) by which the section at z (m) is late where the helix is right-hand, z tan β_w/r_w.

    Right-hand: of a right-hand pinion that turns clockwise seen from +z.
    """
    return z * pitch_slope(assembly) / assembly.path.pinion_pitch_radius


def normal_slope(path_slope: Any, pressure_angle: PerContact) -> PerContact:
    """Slope tan β_n, axial over transverse part of the common normal, from tan β_w and α."""
    return path_slope * cos(pressure_angle)


def line_stretch(path_slope: Any, path: Path, r: PerContact) -> PerContact:
    """Length of the line of contact per width of the face: √(1 + tan² β_n (1 + (r α')²)); 1/cos β_b."""
    slope = normal_slope(path_slope, path.pressure_angle(r))
    turned = r * path.pressure_angle_slope(r)
    return sqrt(1.0 + slope**2 * (1.0 + turned**2))


def curvature_share(path_slope: Any, path: Path, r: PerContact) -> PerContact:
    """Relative curvature across the line of contact over that of the transverse section; cos β_b (involute).

    Along the line flanks have no relative curvature; across it κ_t cos β_n/sin² γ, with the angle γ between
    the line and the flank's transverse tangent (Meusnier, Euler).
    """
    slope = normal_slope(path_slope, path.pressure_angle(r))
    leaning = 1.0 + slope**2
    return line_stretch(path_slope, path, r) ** 2 / leaning**1.5


def speed_share(path_slope: Any, path: Path, r: PerContact) -> PerContact:
    """Speed across the line of contact over that along the transverse tangent, sin γ; 1 for an involute."""
    slope = normal_slope(path_slope, path.pressure_angle(r))
    return sqrt(1.0 + slope**2) / line_stretch(path_slope, path, r)


def base_helix_angle(drive: Drive) -> Any:
    """β_b of involute teeth, rad, signed as `Drive.helix_angle`: tan β_b = tan β cos α_t."""
    return _angle(tan(drive.helix_angle) * cos(drive.pressure_angle))


def normal_module(drive: Drive) -> Any:
    """m_n = m_t cos β, m."""
    return drive.module * cos(drive.helix_angle)


def normal_pressure_angle(drive: Drive) -> Any:
    """α_n of the rack, rad: tan α_n = tan α_t cos β."""
    return _angle(tan(drive.pressure_angle) * cos(drive.helix_angle))


def overlap_ratio(assembly: Assembly) -> Any:
    """ε_β = b tan β/(π m_t) ≥ 0 over the common face width."""
    slope = tan(assembly.drive.helix_angle)
    return sqrt(slope**2) * assembly.common_width / (np.pi * assembly.drive.module)


def hand_name(drive: Drive, side: Side) -> str:
    """Hand of a gear's helix, "right" or "left": the gear's is the other than the pinion's."""
    return "right" if (drive.helix_angle > 0) == (side == "pinion") else "left"


def lead(drive: Drive, side: Any) -> Any:
    """Axial advance of a gear's helix in one turn, m, ≥ 0: 2π r/tan |β|; infinite for a spur gear."""
    return (
        2.0
        * np.pi
        * reference_radius(drive, side)
        * abs(cos(drive.helix_angle))
        / abs(sin(drive.helix_angle))
    )


def _angle(tangent: Any) -> Any:
    return arctan2(tangent, 1.0 + 0.0 * tangent)


def face_positions(width: Any, slices: int) -> Float[Array, " slice"]:
    """Middles of equal slices of the face (S,), m from the middle of the face."""
    return ((np.arange(slices) + 0.5) / slices - 0.5) * width
