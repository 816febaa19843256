"""The cycloidal family: teeth of epi- and hypocycloids, which two generating circles draw.

The path of contact runs along the circles that roll on the pitch circles at P: r = −d_g1 sin α in approach,
where the pinion's hypocycloid meets the gear's epicycloid, and r = +d_g2 sin α in recess (Veciana et al.
2024, section 2.3). At P α, the radii of curvature and the speeds along the flanks vanish together;
`pitch_point` says what the contact then is.
"""

from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, Side, reference_radii, reference_radius
from tribodyn.geometry.families import Family, unshifted
from tribodyn.geometry.families.circular_arc import ArcPath, arc_ends
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach
from tribodyn.numerics.parameter import Parameter


class CycloidShape(NamedTuple):
    """Diameters d_g1 (approach) and d_g2 (recess) of the generating circles, m."""

    approach_circle: Any
    recess_circle: Any


def working_path(drive: Drive) -> ArcPath:
    """Arcs of both generating circles, tangent to the line of centres' perpendicular at P."""
    return ArcPath(*reference_radii(drive), 0.0, *drive.shape)


def check(drive: Drive) -> None:
    """Refuse profile shift, and generating circles that draw no usable flank.

    The circle that rolls inside a pitch circle draws a hypocycloid on the tooth's own side only while it is
    smaller than that circle (at half of it the flank is a radial straight line). On the circle of an internal
    gear, whose radius is negative, it rolls outside and may have any size.
    """
    refuse_shift(drive)
    inside: tuple[tuple[Side, str], ...] = (("pinion", "approach_circle"), ("gear", "recess_circle"))
    for side, name in inside:
        diameter, pitch = getattr(drive.shape, name), 2 * reference_radius(drive, side)
        if not (diameter > 0 and diameter / pitch < 1):
            raise InputError(
                f"drive.shape.{name}",
                f"{1e3 * diameter:.4g} mm",
                f"it rolls inside the pitch circle of the {side}, whose diameter is {1e3 * pitch:.4g} mm",
                f"use less, such as {1e3 * pitch / 3:.4g} mm",
            )
    path = working_path(drive)
    require_reach(drive, path, *arc_ends(path), _advice)


def _advice(drive: Drive, half: int) -> tuple[str, Any, str]:
    name = "approach_circle" if half < 0 else "recess_circle"
    remedy = "use another circle, or smaller addenda and dedenda"
    return f"shape.{name}", f"{1e3 * getattr(drive.shape, name):.4g} mm", remedy


FAMILY = Family(
    "cycloidal",
    working_path,
    unshifted(working_path),
    shiftable=False,
    check=check,
    shape=CycloidShape,
    parameters=(
        Parameter(
            "approach_circle",
            "length",
            "diameter of the circle that rolls inside the pinion, d_g1",
            example='"18 mm"',
        ),
        Parameter(
            "recess_circle",
            "length",
            "diameter of the circle that rolls inside the gear, d_g2",
            example='"18 mm"',
        ),
    ),
    pressure_angle=False,
    corner=True,
    about="epi- and hypocycloids; shape.approach_circle, recess_circle: diameters of the generating circles",
)
