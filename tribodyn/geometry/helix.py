"""Helical teeth: what the helix makes of the transverse section, whose path of contact is a spur pair's.

A slice of the face at z rolls like a spur pair that is late by z tan β_w/r_w. The common normal of two flanks
in contact leans out of the transverse plane: it goes through the pitch point at an arm r_w cos α about the
axis and is perpendicular to the flank's screw motion, so that its slope is tan β_n = tan β_w cos α. For an
involute this is tan β_b all along the path. The line of contact follows the path of contact from slice to
slice, dr/dz = tan β_n, and where the pressure angle changes along the path it turns with it.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Drive, Side, body_of, internal_side, reference_radius
from tribodyn.geometry.families import Family
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
    """Hand of a gear's helix, "right" or "left"; the gear's is not the pinion's, unless one is internal."""
    as_pinion = side == "pinion" or internal_side(drive) is not None
    return "right" if (drive.helix_angle > 0) == as_pinion else "left"


def lead(drive: Drive, side: Any) -> Any:
    """Axial advance of a gear's helix in one turn, m, ≥ 0: 2π r/tan |β|; infinite for a spur gear."""
    return (
        2.0
        * np.pi
        * abs(reference_radius(drive, side))
        * abs(cos(drive.helix_angle))
        / abs(sin(drive.helix_angle))
    )


def _angle(tangent: Any) -> Any:
    return arctan2(tangent, 1.0 + 0.0 * tangent)


def face_positions(width: Any, slices: int) -> Float[Array, " slice"]:
    """Middles of equal slices of the face (S,), m from the middle of the face."""
    return ((np.arange(slices) + 0.5) / slices - 0.5) * width


# Numbers of a helical drive by the rack's normal section, as drawings have them, and by the transverse one.
#
# m_t = m_n/cos β, tan α_t = tan α_n/cos β; lengths across the rolling line stay, those along it grow by
# 1/cos β (ISO 21771). The circle that rounds the rack's tip is an ellipse in the transverse section; a
# circle of ρ_t (1 − sin α_t) = ρ_n (1 − sin α_n) stands for it, by which the straight flank ends at the same
# height: form circle and undercut are exact, the fillet below is not.


def as_written(family: Family, drive: Drive) -> Drive:
    """The drive with the numbers of its keys: of the normal section for involutes, else as it stands."""
    return normal_section(drive) if family.involute else drive


def from_written(family: Family, drive: Drive) -> Drive:
    """The transverse section of a drive with the numbers of its keys: the inverse of `as_written`."""
    return transverse_section(drive) if family.involute else drive


def transverse_section(drive: Drive) -> Drive:
    """Drive of its transverse section, from module, pressure angle and rack of the normal section."""
    return _stretched(drive, 1.0 / cos(drive.helix_angle))


def normal_section(drive: Drive) -> Drive:
    """The drive by the normal section's module, pressure angle and rack: undoes `transverse_section`."""
    return _stretched(drive, cos(drive.helix_angle))


def _stretched(drive: Drive, stretch: Any) -> Drive:
    """The section in which lengths along the rolling line are `stretch` times as long."""
    if type(drive.helix_angle) in (float, int) and drive.helix_angle == 0:
        return drive  # to the last digit
    tangent = stretch * tan(drive.pressure_angle)
    angle = arctan2(tangent, 1.0 + 0.0 * tangent)
    rounding = (1.0 - sin(drive.pressure_angle)) / (1.0 - sin(angle)) / stretch
    bodies = {}
    for side in SIDES:
        body = body_of(drive, side)
        bodies[side] = body._replace(
            profile_shift=body.profile_shift / stretch,
            addendum=body.addendum / stretch,
            dedendum=body.dedendum / stretch,
            fillet_radius=body.fillet_radius * rounding,
            thickness_allowance=body.thickness_allowance * stretch,
            cutter_shift=body.cutter_shift / stretch,
            cutter_addendum=None if body.cutter_addendum is None else body.cutter_addendum / stretch,
        )
    return drive._replace(module=drive.module * stretch, pressure_angle=angle, **bodies)


#: Points of the path between which the length per width is taken as linear; one of an involute is constant.
_PATH_POINTS = 2001
#: Phases at which lengths are compared, beside those at which lines reach the ends of path and face.
_PHASES = 1000


# Length of the lines of contact of a helical pair over the mesh cycle: all pairs, over the common face.
#
# A section of the face at z touches where a spur pair late by z tan β_w/r_w does (`helix`). The line of one
# pair is the sum over the sections that are on the path of contact, each with the line's length per width.


class ContactLines(NamedTuple):
    """Sum of the lengths of all lines of contact over the mesh cycle, m."""

    mean: float
    minimum: float
    maximum: float


def contact_line_lengths(assembly: Assembly, phase: Float[Array, " phase"]) -> Float[Array, " phase"]:
    """Sum of the lengths of all lines of contact, m, at phases of the mesh; of helical teeth, plain numbers.

    The phase, in pitches, counts from where a pair comes into contact in the middle of the face.
    """
    pitch, half = abs(float(assembly.pitch_angle)), _roll_over_face(assembly) / 2.0
    roll, summed = _stretched_roll(assembly)
    pairs = np.arange(-np.ceil(half / pitch) - 1, np.ceil((roll[-1] - roll[0] + half) / pitch) + 1)
    middle = roll[0] + (np.asarray(phase)[..., None] % 1.0 + pairs) * pitch
    late, early = (np.interp(middle + offset, roll, summed) for offset in (half, -half))
    return (late - early).sum(axis=-1) * float(assembly.common_width) / (2.0 * half)


def contact_lines(assembly: Assembly) -> ContactLines:
    """Mean, minimum and maximum of the lines' length over the mesh cycle, of helical teeth.

    Of an involute, with s = p_bt/sin β_b and e the fractions of both ratios: s ε_α ε_β = b ε_α/cos β_b,
    s [ε_α ε_β − e_α e_β + max(0, e_α + e_β − 1)], s [ε_α ε_β − e_α e_β + min(e_α, e_β)].
    """
    pitch = abs(float(assembly.pitch_angle))
    half = _roll_over_face(assembly) / 2.0 / pitch
    ratio = float(assembly.contact_ratio)
    # where a line reaches or leaves an end, its length has a corner: there lie the extremes of an involute
    corners = np.array([half, -half, ratio + half, ratio - half])
    lengths = contact_line_lengths(assembly, np.concatenate([corners, np.arange(_PHASES) / _PHASES]))
    _, summed = _stretched_roll(assembly)
    mean = float(assembly.common_width * summed[-1] / pitch)
    return ContactLines(mean, float(lengths.min()), float(lengths.max()))


def _stretched_roll(assembly: Assembly) -> tuple[Float[Array, " roll"], Float[Array, " roll"]]:
    """Pinion angles along the path, rad, and the integral over them of the line's length per width.

    In the sense in which the pinion turns, in which those of an internal one grow too.
    """
    start, end = map(float, assembly.roll_limits)
    roll = np.linspace(start, end, _PATH_POINTS)
    stretch = line_stretch(pitch_slope(assembly), assembly.path, assembly.path.signed_distance(roll))
    roll = roll * np.sign(end - start)
    steps = np.diff(roll) * (stretch[1:] + stretch[:-1]) / 2.0
    return roll, np.concatenate([[0.0], np.cumsum(steps)])


def _roll_over_face(assembly: Assembly) -> float:
    """Pinion angle, rad, by which one end of the common face is late after the other."""
    slope = abs(float(pitch_slope(assembly)))
    return float(assembly.common_width) * slope / abs(float(assembly.path.pinion_pitch_radius))
