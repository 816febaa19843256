"""A tooth as its tool cuts it: flank conjugate to the generating path, fillet from the tool's rounded tip.

The tool is a rack or, of an internal gear, a pinion-type cutter.

Everything is said in the frame of one body whose tooth lies left of the contact (see `path.MirroredPath`),
then carried to the tooth's own frame: x along the tooth's symmetry axis from the body's axis outwards, y the
half thickness. A point at (X, Y) from the pitch point, touched when the body has turned by φ, has the half
thickness angle χ = ψ + atan(X/(r_p + Y)) − φ, where ψ is the half thickness angle on the pitch circle.
Radii and half thickness angles of an internal gear are negative (ISO 21771): half thicknesses are positive,
and its tooth too points to +x, from x < 0 towards the axis at the origin.
The rack moves by r_p φ to +x, so its flank is x_c = r cos α − r_p φ, y_c = r sin α. The rolling circle of a
pinion-type cutter moves by the same arc; the curvature c of this circle, 0 of a rack, is all that tells them
apart. "The tool's frame" of a cutter has arcs of its rolling circle for x.

Where the rack's flank reaches beyond the point of zero velocity (u_p = 0), the fillet undercuts the flank:
the two then end where they cross, in a corner.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.drive import Drive, Side, body_of, tip_radius
from tribodyn.geometry.families import Family
from tribodyn.geometry.path import (
    Path,
    PerContact,
    distance_at_radius,
    kinematics,
    position,
    radius,
    sine_at_pitch_point,
)
from tribodyn.numerics.elementary import absolute, arctan2, cos, maximum, namespace, sin, sqrt, tan, within
from tribodyn.numerics.iteration import newton
from tribodyn.numerics.shapes import Array, Float

_NEWTON_STEPS = 8


class Tooth(NamedTuple):
    """One tooth as two curves: `flank_point` over r, `fillet_point` over the angle of the rack's normal."""

    path: Any  # generating path of contact, seen from the body
    half_angle: Any  # half thickness angle of the tooth on the generating pitch circle, rad
    #: form_distance, tip_distance: signed distances r (m) on the generating path where the flank begins (at
    #: the fillet) and ends
    form_distance: Any
    tip_distance: Any
    #: angle of the rack's normal where the fillet ends at the flank, rad; it grows to π/2 at the root
    form_angle: Any
    #: −u_p where the rack's flank ends, m per rad: positive if it reaches beyond the point of zero velocity,
    #: by this distance for the involute, and undercuts the tooth
    overrun: Any
    #: corner_x, corner_y: centre of the tool's rounded tip in the tool's frame at φ = 0, m
    corner_x: Any
    corner_y: Any
    corner_radius: Any  # radius of the tool's rounded tip, m
    #: symmetry axis of the tool's tooth, m: with corner_x beyond it the two rounded corners would overlap
    corner_limit: Any
    #: root_radius, form_radius, tip_radius: radii of the root circle, of the junction of fillet and flank and
    #: of the tip circle, m
    root_radius: Any
    form_radius: Any
    tip_radius: Any
    tool_curvature: Any = None  # of the rolling circle of a pinion-type cutter, 1/m; None: a rack


class ToothContact(NamedTuple):
    """Where the mate touches a tooth and how its normal load stands to the tooth's axis."""

    #: x, y: contact point in the tooth's frame, m
    x: PerContact
    y: PerContact
    #: angle α_1 (rad) from the perpendicular of the tooth's axis to the normal load F: F cos α_1 bends the
    #: tooth towards its axis, F sin α_1 presses it along the axis into the body
    load_angle: PerContact


def cut_tooth(family: Family, drive: Drive, side: Side) -> Tooth:
    """Cut a tooth of one body by its tool."""
    body = body_of(drive, side)
    path, shift = family.generating_path(drive, side)
    pitch_radius = path.pinion_pitch_radius
    # The shifted rack's tooth is thinner on the rolling line by the shift's share of both its flanks; for
    # families whose rack is not straight the shift is zero.
    widening = shift * tan(path.pressure_angle(0.0))
    curvature = None
    if not family.shiftable:  # the tool's own tooth is thicker by what the gear's is thinner
        widening = widening + body.thickness_allowance / 2
    half_angle = (np.pi * drive.module / 4 + widening) / pitch_radius
    depth = drive.module * body.dedendum - shift
    rounding = drive.module * body.fillet_radius
    if body.cutter_teeth is not None:
        if family.cutter_path is not None:
            rack, path = path, family.cutter_path(drive, side)
            half_angle = _half_angle(rack, half_angle, path.pinion_pitch_radius)
            depth = depth + path.pinion_pitch_radius - pitch_radius
            pitch_radius = path.pinion_pitch_radius
        curvature = body.teeth / (body.cutter_teeth * pitch_radius)
        if body.cutter_addendum is not None:
            outside = drive.module * (body.cutter_teeth / 2 + body.cutter_shift + body.cutter_addendum)
            depth = outside - 1 / curvature
    flank_end = tangent_distance(path, depth, rounding, curvature)
    tangent_angle = path.pressure_angle(flank_end)
    corner = _corner_on_normal(tangent_angle, depth - rounding, curvature)
    tip = tip_radius(drive, side)
    tangent = Tooth(
        path=path,
        half_angle=half_angle,
        form_distance=flank_end,
        tip_distance=distance_at_radius(path, tip),
        form_angle=tangent_angle,
        overrun=-kinematics(path, flank_end).pinion_speed * absolute(pitch_radius) / pitch_radius,
        corner_x=-corner.arc - pitch_radius * path.rotation(flank_end),
        corner_y=rounding - depth,
        corner_radius=rounding,
        corner_limit=pitch_radius * (np.pi / body.teeth - half_angle),
        root_radius=pitch_radius - depth,
        form_radius=radius(path, flank_end),
        tip_radius=tip,
        tool_curvature=curvature,
    )
    return _ended_by_undercut(tangent)


class _Corner(NamedTuple):
    """Centre of the tool's rounding where its normal through P has a given angle."""

    distance: Any  # s of the centre before P on the normal, m
    slope: Any  # q = c × distance from P to the foot of the tool's axis on the normal; sin ν of a rack
    arc: Any  # of the tool's rolling circle, from the centre to the line of centres, m


def _corner_on_normal(normal_angle: PerContact, depth: Any, curvature: Any) -> _Corner:
    """Where the centre of the rounding, `depth` (m) beyond the rolling line, lies on a normal through P.

    Its distance 1/c + h from the tool's axis gives s = h (2 + h c)/(sin ν + q), q² = sin² ν + h c (2 + h c).
    """
    sine, cosine = sin(normal_angle), cos(normal_angle)
    if curvature is None:
        distance = depth / sine
        return _Corner(distance, sine, distance * cosine)
    slope = sqrt(sine**2 + depth * curvature * (2 + depth * curvature))
    distance = depth * (2 + depth * curvature) / (sine + slope)
    angle = arctan2(curvature * distance * cosine, 1 + curvature * distance * sine)
    return _Corner(distance, slope, angle / curvature)


def tangent_distance(path: Path, depth: Any, rounding: Any, curvature: Any = None) -> Any:
    """Signed distance at which the tool's flank runs into the rounding of its tip.

    The centre of the rounding lies on the flank's normal and `rounding` above the tip line y = −depth, hence
    r sin α + ρ_f sin α = ρ_f − depth of a rack; of a cutter with a rolling circle of curvature c
    (r + ρ_f) sin α = c [(r + ρ_f)² − h²]/2 − h, h = depth − ρ_f.
    """
    sine, before, _ = sine_at_pitch_point(path)
    # Start on the path with sin α linear in the distance before P.
    half = (sine - before * rounding) / 2
    root = sqrt(maximum(half**2 + before * (depth - rounding + rounding * sine), (1e-3 * half) ** 2))
    start = -(depth - rounding + rounding * sine) / (half + root)
    curvature = 0.0 if curvature is None else curvature
    return newton(_step_to_tangency, start, _NEWTON_STEPS, path, depth, rounding, curvature)


def _step_to_tangency(
    r: Float[Array, ""], path: Path, depth: Any, rounding: Any, curvature: Any
) -> Float[Array, ""]:
    alpha, centre, below = path.pressure_angle(r), r + rounding, depth - rounding
    residual = centre * sin(alpha) + below - curvature / 2 * (centre**2 - below**2)
    slope = sin(alpha) + centre * (cos(alpha) * path.pressure_angle_slope(r) - curvature)
    return r - residual / slope


def _ended_by_undercut(tooth: Tooth) -> Tooth:
    """End fillet and flank where they cross, if the tooth is undercut; else leave it as it is.

    For a small overrun d the flank is the cusp of an involute, which the fillet crosses where the radius of
    curvature is d/2 (and 0.3 d for six teeth). Newton's method from there, in both curves' parameters.
    A sound tooth goes through the same bounded steps and discards them, for there is no branching on values.
    """
    xp = namespace(tooth)
    undercut = tooth.overrun > 0
    overrun = xp.where(undercut, tooth.overrun, -0.1 * tooth.form_distance)
    lowest = tooth.form_distance + overrun
    # The fillet's point at the radius of the flank's first: R² falls by (1 − 0.4²) d².
    rate = fillet_tangent(tooth, tooth.form_angle).rate
    arm = tooth.path.pinion_pitch_radius * cos(tooth.form_angle)
    start = (lowest + 0.4 * overrun, tooth.form_angle - 0.42 * overrun**2 / (rate * arm))

    r, normal = newton(_step_to_crossing, start, _NEWTON_STEPS, tooth, overrun)
    r = xp.where(undercut, r, tooth.form_distance)
    return tooth._replace(
        form_distance=r,
        form_angle=xp.where(undercut, normal, tooth.form_angle),
        form_radius=radius(tooth.path, r),
    )


def _step_to_crossing(
    state: tuple[Float[Array, ""], Float[Array, ""]], tooth: Tooth, overrun: Any
) -> tuple[Float[Array, ""], Float[Array, ""]]:
    xp = namespace(state, tooth)
    r, normal = state
    flank_rate, flank_angle = _flank_tangent(tooth, r)
    fillet_rate, fillet_angle, _ = fillet_tangent(tooth, normal)
    flank, fillet = flank_point(tooth, r), fillet_point(tooth, normal)
    gap_x, gap_y = flank[0] - fillet[0], flank[1] - fillet[1]
    crossing = sin(flank_angle - fillet_angle)
    crossing = xp.where(xp.abs(crossing) > 1e-12, crossing, 1e-12)
    r = r + (gap_x * sin(fillet_angle) + gap_y * cos(fillet_angle)) / (crossing * flank_rate)
    normal = normal + (gap_x * sin(flank_angle) + gap_y * cos(flank_angle)) / (crossing * fillet_rate)
    lowest = tooth.form_distance + overrun
    return (within(r, lowest + 0.01 * overrun, lowest + overrun), within(normal, tooth.form_angle, np.pi / 2))


def _flank_tangent(tooth: Tooth, r: PerContact) -> tuple[PerContact, PerContact]:
    """Differentiate the flank's point by r along its tangent (cos λ, −sin λ), and λ = α − ψ + φ."""
    flank = kinematics(tooth.path, r)
    return (
        flank.pinion_speed / flank.pinion_normal_arm,
        flank.pressure_angle - tooth.half_angle + tooth.path.rotation(r),
    )


class FilletTangent(NamedTuple):
    """Tangent (cos λ, −sin λ) of the fillet in the tooth's frame, where the rack's normal has an angle ν."""

    rate: Any  # of the point by ν along the tangent, m per rad
    angle: Any  # λ, rad
    turning: Any  # dλ/dν; the radius of curvature is rate over turning


def fillet_tangent(tooth: Tooth, normal_angle: PerContact) -> FilletTangent:
    """Differentiate the fillet's point by the normal's angle."""
    pitch_radius = tooth.path.pinion_pitch_radius
    corner = _corner_on_normal(normal_angle, -tooth.corner_y, tooth.tool_curvature)
    r = -corner.distance - tooth.corner_radius
    rotation = (-corner.arc - tooth.corner_x) / pitch_radius
    turning = corner.distance / (pitch_radius * corner.slope)
    rate = r + (r + pitch_radius * sin(normal_angle)) * turning
    return FilletTangent(rate, normal_angle - tooth.half_angle + rotation, 1.0 + turning)


def flank_point(tooth: Tooth, r: PerContact) -> tuple[PerContact, PerContact]:
    """Point (x, y) of the flank (m) that the rack touches at the signed distance r (m)."""
    point = *position(tooth.path, r), tooth.path.rotation(r)
    return _in_tooth_frame(tooth.path.pinion_pitch_radius, tooth.half_angle, *point)


def fillet_point(tooth: Tooth, normal_angle: PerContact) -> tuple[PerContact, PerContact]:
    """Point (x, y) of the fillet (m) cut where the normal of the rack's rounding has this angle (rad).

    The tool's point touches the body when its normal passes through the pitch point; the angle runs from
    π/2 (root circle) to `tooth.form_angle` (junction with the flank).
    """
    pitch_radius = tooth.path.pinion_pitch_radius
    corner = _corner_on_normal(normal_angle, -tooth.corner_y, tooth.tool_curvature)
    r = -corner.distance - tooth.corner_radius
    rotation = (-corner.arc - tooth.corner_x) / pitch_radius
    point = r * cos(normal_angle), r * sin(normal_angle), rotation
    return _in_tooth_frame(pitch_radius, tooth.half_angle, *point)


def polar(x: PerContact, y: PerContact, pitch_radius: Any) -> tuple[PerContact, PerContact]:
    """Radius (m), of the pitch radius's sign, and angle (rad) about the body's axis of a point from P.

    The angle grows with x on an external body; an internal one's axis lies beyond P, and it falls.
    """
    along, across = x / pitch_radius, 1 + y / pitch_radius
    return pitch_radius * sqrt(along**2 + across**2), arctan2(along, across)


def _in_tooth_frame(
    pitch_radius: Any, half_angle: Any, x: PerContact, y: PerContact, rotation: PerContact
) -> tuple[PerContact, PerContact]:
    distance, angle = polar(x, y, pitch_radius)
    chi = half_angle + angle - rotation
    return distance * cos(chi), distance * sin(chi)


def thickness_half_angle(tooth: Tooth, at_radius: PerContact) -> PerContact:
    """Half thickness angle of the tooth (rad) on the circle of this radius (m), above the form radius."""
    return _half_angle(tooth.path, tooth.half_angle, at_radius)


def _half_angle(path: Path, pitch_half_angle: Any, at_radius: PerContact) -> PerContact:
    r = distance_at_radius(path, at_radius)
    return pitch_half_angle + polar(*position(path, r), path.pinion_pitch_radius)[1] - path.rotation(r)


def contact_in_tooth_frame(body_path: Path, pitch_half_angle: Any, r: PerContact) -> ToothContact:
    """Contact point and direction of the normal load on a tooth, while it works with its mate.

    Path and signed distance r (m) are in the body's own view, r of the drive for the pinion, −r for the gear;
    the half thickness angle (rad) is that on the working pitch circle.
    """
    rotation = body_path.rotation(r)
    point = *position(body_path, r), rotation
    x, y = _in_tooth_frame(body_path.pinion_pitch_radius, pitch_half_angle, *point)
    return ToothContact(x, y, body_path.pressure_angle(r) - pitch_half_angle + rotation)
