"""Random drives of every family, for tests of what holds for all of them."""

import math

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import (
    Family,
    circular_arc,
    crc,
    cycloidal,
    involute,
    parabolic,
    points,
    s_gear,
    spline,
)
from tribodyn.geometry.limits.checks import check

FAMILIES: dict[str, Family] = {
    module.FAMILY.name: module.FAMILY
    for module in (involute, crc, cycloidal, parabolic, circular_arc, s_gear, points, spline)
}
#: Radii and rolling speeds vanish at the pitch point.
DEGENERATE = ("cycloidal", "parabolic")


def path_points(module: float, angle: float, bend: float) -> np.ndarray:
    """Points of a smooth path through P: α rises linearly with r, by `bend` rad a module."""
    r = module * np.linspace(-6.0, 6.0, 17)
    alpha = angle + bend * np.tanh(r / (3 * module))
    alpha = np.where(np.abs(r) < 1e-9 * module, angle, alpha)
    return np.stack([r * np.cos(alpha), r * np.sin(alpha)], axis=-1)


@st.composite
def shapes(draw, name: str, module: float, teeth: tuple[float, float], angle: float):
    """Shape of a family's drive, in a range where most of them can be made."""
    if name == "cycloidal":
        return cycloidal.CycloidShape(*(draw(st.floats(0.16, 0.4)) * module * teeth[0] for _ in range(2)))
    if name == "parabolic":
        return parabolic.ParabolaShape(draw(st.floats(0.15, 0.38)), draw(st.floats(0.15, 0.38)))
    if name == "circular-arc":
        diameter = st.one_of(st.floats(12.0, 80.0), st.floats(-200.0, -60.0))
        return circular_arc.ArcShape(draw(diameter) * module, draw(diameter) * module)
    if name == "s-gear":
        return s_gear.SGearShape(draw(st.floats(1.4, 1.8)), draw(st.floats(1.6, 1.9)))
    if name == "points":
        return points.PointsShape(path_points(module, angle, draw(st.floats(-0.06, 0.06))))
    if name == "spline":
        count = draw(st.integers(5, 9))
        trend = draw(st.floats(-0.06, 0.06)) * np.linspace(-1.0, 1.0, count)
        waves = [draw(st.floats(-0.006, 0.006)) for _ in range(count)]
        values = draw(st.floats(0.33, 0.42)) + trend + waves
        return spline.SplineShape(
            values, None, draw(st.floats(5.0, 7.0)) * module, draw(st.floats(-0.02, 0.02))
        )
    return ()


@st.composite
def drives(draw, names: tuple[str, ...] = tuple(FAMILIES)):
    """Draw a family and a drive that passes its checks."""
    family = FAMILIES[draw(st.sampled_from(names))]
    module = draw(st.floats(0.0005, 0.02))
    teeth = float(draw(st.integers(17, 70))), float(draw(st.integers(17, 90)))
    angle = math.radians(draw(st.floats(19.0, 25.0))) if family.pressure_angle else 0.0
    bodies = [
        GearBody(
            teeth=z,
            profile_shift=draw(st.floats(-0.1, 0.5)) if family.shiftable else 0.0,
            addendum=draw(st.floats(0.7, 1.0)),
            dedendum=1.25,
            fillet_radius=draw(st.floats(0.05, 0.2)),
            face_width=draw(st.floats(5.0, 12.0)) * module,
            bore_radius=draw(st.floats(0.2, 0.7)) * module * z / 2,
        )
        for z in teeth
    ]
    drive = Drive(module, angle, bodies[0], bodies[1], draw(shapes(family.name, module, teeth, angle)))
    try:
        check(family, drive)
    except InputError:
        assume(False)
    return family, drive
