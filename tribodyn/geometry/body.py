"""Outlines from one tooth: half a tooth, the whole gear with its mass and inertia, the rack that cuts it.

Frame of the rack: x along the rolling line from the axis of one of its teeth, y across from the rolling line,
positive away from the body, so that the tool's tip lies at y = −depth.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Side, body_of, tip_radius
from tribodyn.geometry.path import PerContact, position
from tribodyn.geometry.tooth import Tooth, fillet_point, flank_point, tangent_distance, thickness_half_angle
from tribodyn.numerics.elementary import absolute, arctan2, cos, namespace, sin, sqrt
from tribodyn.numerics.parameter import Variable
from tribodyn.numerics.remembered import remembered
from tribodyn.numerics.shapes import Array, Float


class ToothOutline(NamedTuple):
    """Half a tooth as points, from the root circle over the fillet and the flank to the tip circle."""

    #: fillet_x, fillet_y, flank_x, flank_y: points (m) in the tooth's frame; the fillet's last point is the
    #: flank's first
    fillet_x: Float[Array, " fillet"]
    fillet_y: Float[Array, " fillet"]
    flank_x: Float[Array, " flank"]
    flank_y: Float[Array, " flank"]
    #: root_radius, form_radius, tip_radius: radii of the root circle, of the junction and of the tip circle,
    #: m
    root_radius: Any
    form_radius: Any
    tip_radius: Any
    #: angle between the tooth's axis and the point where the fillet meets the root circle, rad
    root_half_angle: Any
    tip_half_thickness: Any  # half thickness at the tip circle, m; negative where the tooth would be pointed


def tooth_outline(tooth: Tooth, flank_points: int = 60, fillet_points: int = 30) -> ToothOutline:
    """Points of half a tooth: even steps of r along the flank, of the rack's normal along the fillet.

    The fillet starts at the root circle; its last point is the flank's first.
    """
    along = np.linspace(0.0, 1.0, flank_points)
    flank_x, flank_y = flank_point(
        tooth, tooth.form_distance + along * (tooth.tip_distance - tooth.form_distance)
    )
    along = np.linspace(0.0, 1.0, fillet_points)
    fillet_x, fillet_y = fillet_point(tooth, np.pi / 2 + along * (tooth.form_angle - np.pi / 2))
    return ToothOutline(
        fillet_x=fillet_x,
        fillet_y=fillet_y,
        flank_x=flank_x,
        flank_y=flank_y,
        root_radius=tooth.root_radius,
        form_radius=tooth.form_radius,
        tip_radius=tooth.tip_radius,
        root_half_angle=tooth.half_angle + tooth.corner_x / tooth.path.pinion_pitch_radius,
        tip_half_thickness=flank_y[-1],
    )


#: Points of the root circle below half a tooth and of its tip circle, beside the ends of fillet and flank.
ROOT_POINTS, TIP_POINTS = 4, 3
# The chords of this many points leave a relative error below 1e-7 in area and inertia.
_INTEGRATION_POINTS = 400


def gear_polygon(assembly: Assembly, side: Side, flank_points: int = 40) -> Float[Array, "point 2"]:
    """Draw all teeth as a closed polygon, m, shape (points, 2); the first point is repeated at the end.

    The frame is the body's own: origin on its axis, x and y parallel to the drive's frame (`path`) while a
    pair touches at the pitch point. At a pinion angle φ the pinion's polygon is turned clockwise by φ and
    carried to (0, −r_p), the gear's counter-clockwise by φ r_p/r_g and carried to (0, r_g).
    That of an internal gear goes round its hole.
    The number of teeth must be a plain number.
    """
    tooth, teeth = assembly.tooth(side), body_of(assembly.drive, side).teeth
    shape = tooth_outline(tooth, flank_points, max(flank_points // 2, 8))
    xp = namespace(tooth)
    half_radius, half_angle = half_profile(shape, teeth)
    # The middle of the gap belongs to the next tooth.
    radius = xp.concatenate([half_radius, half_radius[:0:-1]])
    angle = xp.concatenate([-half_angle, half_angle[:0:-1]])
    pitch_half_angle = thickness_half_angle(tooth, assembly.path_of(side).pinion_pitch_radius)
    count = abs(round(float(teeth)))
    index = np.arange(count)[:, None]
    # Angles from the line of centres, counter-clockwise, with the tooth left of the pitch point.
    turned = (pitch_half_angle + angle + index * (2 * np.pi / teeth)).reshape(-1)
    radius = xp.concatenate([radius] * count)
    upwards = 1.0 if side == "pinion" else -1.0
    points = xp.stack([-upwards * radius * sin(turned), upwards * radius * cos(turned)], axis=-1)
    return xp.concatenate([points, points[:1]])


def half_profile(
    shape: ToothOutline, teeth: Any, root_points: int = ROOT_POINTS, tip_points: int = TIP_POINTS
) -> tuple[Float[Array, " point"], Float[Array, " point"]]:
    """Polar coordinates (m, rad) of half a tooth, from the middle of the gap towards the middle of the tip.

    First `root_points` points of the root circle, then the outline's, then `tip_points` of the tip circle.
    """
    xp = namespace(shape, teeth)
    x = xp.concatenate([shape.fillet_x, shape.flank_x[1:]])
    y = xp.concatenate([shape.fillet_y, shape.flank_y[1:]])
    radius, angle = x * sqrt(1 + (y / x) ** 2), arctan2(y / x, 1.0)
    along = np.linspace(0.0, 1.0, root_points + 1)[:-1]
    root = np.pi / teeth + along * (shape.root_half_angle - np.pi / teeth)
    tip = angle[-1] * (1 - np.linspace(0.0, 1.0, tip_points + 2)[1:-1])
    return (
        xp.concatenate([shape.root_radius + 0 * root, radius, shape.tip_radius + 0 * tip]),
        xp.concatenate([root, angle, tip]),
    )


def section_area_and_inertia(shape: ToothOutline, teeth: Any, bore_radius: Any) -> tuple[Any, Any]:
    """Area (m²) and polar second moment of area about the axis (m⁴) of the gear's cross-section.

    Chords of the outline's points, exact arcs at root, tip and bore. An internal gear's section lies between
    outline and bore, which is its outside, the other way round.
    """
    xp = namespace(shape, teeth)
    x = xp.concatenate([shape.fillet_x, shape.flank_x[1:]])
    y = xp.concatenate([shape.fillet_y, shape.flank_y[1:]])
    # The outline runs towards the tooth's axis, clockwise, so the signed triangles change their sign.
    cross = y[:-1] * x[1:] - x[:-1] * y[1:]
    square = x[:-1] ** 2 + y[:-1] ** 2 + x[1:] ** 2 + y[1:] ** 2 + x[:-1] * x[1:] + y[:-1] * y[1:]
    tip_angle = arctan2(shape.flank_y[-1] / shape.flank_x[-1], 1.0)
    root_angle = np.pi / teeth - shape.root_half_angle
    arcs_area = (shape.tip_radius**2 * tip_angle + shape.root_radius**2 * root_angle) / 2
    arcs_inertia = (shape.tip_radius**4 * tip_angle + shape.root_radius**4 * root_angle) / 4
    area = 2 * teeth * (cross.sum() / 2 + arcs_area) - np.pi * bore_radius**2
    inertia = 2 * teeth * ((cross * square).sum() / 12 + arcs_inertia) - np.pi / 2 * bore_radius**4
    outwards = absolute(teeth) / teeth
    return outwards * area, outwards * inertia


@remembered(8)
def mass_and_inertia(assembly: Assembly, side: Side, density: Any) -> tuple[Any, Any]:
    """Mass (kg) and moment of inertia about the axis (kg m²) of a body without hub, web or shaft.

    The toothed section less the bore, as wide as the teeth.
    """
    body = body_of(assembly.drive, side)
    shape = tooth_outline(assembly.tooth(side), _INTEGRATION_POINTS, _INTEGRATION_POINTS)
    area, inertia = section_area_and_inertia(shape, body.teeth, body.bore_radius)
    return density * body.face_width * area, density * body.face_width * inertia


def body_masses(
    assembly: Assembly, masses_given: Sequence[tuple[float | None, float | None]], densities: Sequence[float]
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Mass (kg) and inertia (kg m²) of pinion and gear: those given, the others from section and density."""
    masses = []
    for side, pair, density in zip(SIDES, masses_given, densities, strict=True):
        computed = (0.0, 0.0) if None not in pair else mass_and_inertia(assembly, side, density)
        mass, inertia = (
            value if stated is None else stated for stated, value in zip(pair, computed, strict=True)
        )
        masses.append((float(mass), float(inertia)))
    return masses[0], masses[1]


#: Bottom clearance of the basic rack in modules, ISO 53 profiles A and B.
CLEARANCE = 0.25
_ROUNDING_POINTS = 16


class RackOutline(NamedTuple):
    """One pitch of a rack cutter: one tooth of the tool between the middles of its two gaps."""

    #: x, y: points (m) from x = −pitch/2 to pitch/2, symmetric about the tooth's axis x = 0
    x: Float[Array, " point"]
    y: Float[Array, " point"]
    pitch: float  # distance between neighbouring teeth, m
    #: tip_height, root_height: y of the tool's tip and root, m
    tip_height: float
    root_height: float


def rack_flank(tooth: Tooth, r: PerContact) -> tuple[PerContact, PerContact]:
    """Point (x, y) of the tool's left flank (m) that touches the body at the signed distance r (m)."""
    x, y = position(tooth.path, r)
    return x - tooth.path.pinion_pitch_radius * tooth.path.rotation(r) - tooth.corner_limit, y


def rack_outline(assembly: Assembly, side: Side, flank_points: int = 60) -> RackOutline:
    """One pitch of the rack cutter that makes one body of a drive of plain numbers.

    The flank is the one that generates: from the rounded tip to where it leaves the body's tip. Above, where
    it cuts nothing, it goes on along its tangent to the tool's root, a bottom clearance above the body's tip
    circle, or to the middle of the gap if that comes first.
    """
    drive, tooth = assembly.drive, assembly.tooth(side)
    pitch_radius = float(tooth.path.pinion_pitch_radius)
    pitch = 2 * np.pi * pitch_radius / float(body_of(drive, side).teeth)
    depth = pitch_radius - float(tooth.root_radius)
    # An undercut tooth's own flank begins above the point where the tool's flank ends.
    end = float(tangent_distance(tooth.path, depth, tooth.corner_radius))
    flank_x, flank_y = rack_flank(tooth, np.linspace(float(tooth.tip_distance), end, flank_points))
    normal = np.linspace(float(tooth.path.pressure_angle(end)), np.pi / 2, _ROUNDING_POINTS)[1:]
    rounding_x = tooth.corner_x - tooth.corner_limit - tooth.corner_radius * cos(normal)
    rounding_y = tooth.corner_y - tooth.corner_radius * sin(normal)

    angle = float(tooth.path.pressure_angle(tooth.tip_distance))
    root = float(tooth.tip_radius) - pitch_radius + CLEARANCE * float(drive.module)
    room = float(flank_x[0]) + pitch / 2
    root = min(root, float(flank_y[0]) + room / np.tan(angle))
    root_x = max(-pitch / 2, float(flank_x[0]) - np.tan(angle) * (root - float(flank_y[0])))

    half_x = np.concatenate([[-pitch / 2, root_x], flank_x, rounding_x])
    half_y = np.concatenate([[root, root], flank_y, rounding_y])
    x, y = np.concatenate([half_x, -half_x[::-1]]), np.concatenate([half_y, half_y[::-1]])
    # A root or a tip that has shrunk to a point would repeat it.
    kept = np.concatenate([[True], np.hypot(np.diff(x), np.diff(y)) > 1e-12 * pitch])
    return RackOutline(x[kept], y[kept], pitch, -depth, root)


#: Curves and radii.
GEOMETRY: dict[str, Variable] = {
    **{
        f"{side}_outline": Variable(
            (f"{side}_point", "axis"),
            "m",
            f"outline of the {side} about its axis, turned as when a pair touches at the pitch point",
        )
        for side in SIDES
    },
    "path_of_contact": Variable(
        ("path_point", "axis"), "m", "path of contact, origin at the pitch point, x along the pitch tangent"
    ),
    **{
        f"{side}_{circle}_radius": Variable((), "m", f"radius of the {side}'s {what}")
        for side in SIDES
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
