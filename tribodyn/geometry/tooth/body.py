"""The whole gear from one tooth: its polygon, its mass and its inertia about the axis."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Side, body_of
from tribodyn.geometry.tooth.tooth import ToothOutline, thickness_half_angle, tooth_outline
from tribodyn.numerics.elementary import arctan2, cos, namespace, sin, sqrt
from tribodyn.numerics.shapes import Array, Float

#: Points of the root circle below half a tooth and of its tip circle, beside the ends of fillet and flank.
ROOT_POINTS, TIP_POINTS = 4, 3
# The chords of this many points leave a relative error below 1e-7 in area and inertia.
_INTEGRATION_POINTS = 400


def gear_polygon(assembly: Assembly, side: Side, flank_points: int = 40) -> Float[Array, "point 2"]:
    """Draw all teeth as a closed polygon, m, shape (points, 2); the first point is repeated at the end.

    The frame is the body's own: origin on its axis, x and y parallel to the drive's frame (`path`) while a
    pair touches at the pitch point. At a pinion angle φ the pinion's polygon is turned clockwise by φ and
    carried to (0, −r_p), the gear's counter-clockwise by φ r_p/r_g and carried to (0, r_g).
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
    count = round(float(teeth))
    index = np.arange(count)[:, None]
    # Angles from the line of centres, counter-clockwise, with the tooth left of the pitch point.
    turned = (pitch_half_angle + angle + index * (2 * np.pi / count)).reshape(-1)
    radius = xp.concatenate([radius] * count)
    upwards = 1.0 if side == "pinion" else -1.0
    points = xp.stack([-upwards * radius * sin(turned), upwards * radius * cos(turned)], axis=-1)
    return xp.concatenate([points, points[:1]])


def half_profile(shape: ToothOutline, teeth: Any) -> tuple[Float[Array, " point"], Float[Array, " point"]]:
    """Polar coordinates (m, rad) of half a tooth, from the middle of the gap towards the middle of the tip.

    First `ROOT_POINTS` points of the root circle, then the outline's, then `TIP_POINTS` of the tip circle.
    """
    xp = namespace(shape, teeth)
    x = xp.concatenate([shape.fillet_x, shape.flank_x[1:]])
    y = xp.concatenate([shape.fillet_y, shape.flank_y[1:]])
    radius, angle = sqrt(x**2 + y**2), arctan2(y, x)
    along = np.linspace(0.0, 1.0, ROOT_POINTS + 1)[:-1]
    root = np.pi / teeth + along * (shape.root_half_angle - np.pi / teeth)
    tip = angle[-1] * (1 - np.linspace(0.0, 1.0, TIP_POINTS + 2)[1:-1])
    return (
        xp.concatenate([shape.root_radius + 0 * root, radius, shape.tip_radius + 0 * tip]),
        xp.concatenate([root, angle, tip]),
    )


def section_area_and_inertia(shape: ToothOutline, teeth: Any, bore_radius: Any) -> tuple[Any, Any]:
    """Area (m²) and polar second moment of area about the axis (m⁴) of the gear's cross-section.

    Chords of the outline's points, exact arcs at root, tip and bore.
    """
    xp = namespace(shape, teeth)
    x = xp.concatenate([shape.fillet_x, shape.flank_x[1:]])
    y = xp.concatenate([shape.fillet_y, shape.flank_y[1:]])
    # The outline runs towards the tooth's axis, clockwise, so the signed triangles change their sign.
    cross = y[:-1] * x[1:] - x[:-1] * y[1:]
    square = x[:-1] ** 2 + y[:-1] ** 2 + x[1:] ** 2 + y[1:] ** 2 + x[:-1] * x[1:] + y[:-1] * y[1:]
    tip_angle = arctan2(shape.flank_y[-1], shape.flank_x[-1])
    root_angle = np.pi / teeth - shape.root_half_angle
    arcs_area = (shape.tip_radius**2 * tip_angle + shape.root_radius**2 * root_angle) / 2
    arcs_inertia = (shape.tip_radius**4 * tip_angle + shape.root_radius**4 * root_angle) / 4
    area = 2 * teeth * (cross.sum() / 2 + arcs_area) - np.pi * bore_radius**2
    inertia = 2 * teeth * ((cross * square).sum() / 12 + arcs_inertia) - np.pi / 2 * bore_radius**4
    return area, inertia


def mass_and_inertia(assembly: Assembly, side: Side, density: Any) -> tuple[Any, Any]:
    """Mass (kg) and moment of inertia about the axis (kg m²) of a body without hub, web or shaft.

    The toothed section less the bore, as wide as the teeth.
    """
    body = body_of(assembly.drive, side)
    shape = tooth_outline(assembly.tooth(side), _INTEGRATION_POINTS, _INTEGRATION_POINTS)
    area, inertia = section_area_and_inertia(shape, body.teeth, body.bore_radius)
    return density * body.face_width * area, density * body.face_width * inertia


def body_masses(
    assembly: Assembly,
    given: Sequence[tuple[float | None, float | None]],
    densities: Sequence[float],
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Mass (kg) and moment of inertia (kg m²) of pinion and gear: those given, the others from the section.

    Parameters
    ----------
    assembly : of plain numbers
    given : sequence of (mass, inertia)
        None where it is to be computed.
    densities : sequence of float
        Of both bodies, kg/m³.
    """
    masses = []
    for side, known, density in zip(SIDES, given, densities, strict=True):
        computed = (0.0, 0.0) if None not in known else mass_and_inertia(assembly, side, density)
        mass, inertia = (value if own is None else own for own, value in zip(known, computed, strict=True))
        masses.append((float(mass), float(inertia)))
    return masses[0], masses[1]
