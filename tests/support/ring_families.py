"""A planet and its ring of every family of paths of contact beside the involute."""

import math
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family
from tribodyn.geometry.families.circular_arc import ArcShape
from tribodyn.geometry.families.cycloidal import CycloidShape
from tribodyn.geometry.families.parabolic import ParabolaShape
from tribodyn.geometry.families.points import PointsShape
from tribodyn.geometry.families.s_gear import SGearShape
from tribodyn.geometry.families.spline import SplineShape
from tribodyn.geometry.limits.checks import check

MODULE = 3e-3
_R = MODULE * np.linspace(-4.0, 4.0, 9)
_POINTS = np.stack([_R * np.cos(0.38 - 6.0 * _R), _R * np.sin(0.38 - 6.0 * _R)], axis=-1)
_ANGLES = np.radians([26.7, 25.2, 23.9, 22.8, 22.0, 21.5, 21.25])
#: Shape, pressure angle at P, addendum of the ring, rounding of the planet's rack.
SHAPES: dict[str, tuple[Any, float, float, float]] = {
    "cycloidal": (CycloidShape(24e-3, 30e-3), 0.0, 0.9, 0.25),
    "parabolic": (ParabolaShape(-0.12, 0.3), 0.0, 0.8, 0.25),
    "crc": ((), math.radians(24.0), 0.8, 0.2),
    "circular-arc": (ArcShape(60e-3, 70e-3), math.radians(18.0), 0.9, 0.25),
    "s-gear": (SGearShape(1.6, 1.8), 0.0, 0.9, 0.25),
    "points": (PointsShape(_POINTS), 0.38, 0.9, 0.25),
    "spline": (SplineShape(_ANGLES, None, 18e-3), 0.0, 0.9, 0.25),
}


def drive(name: str, teeth: tuple[int, int] = (24, -72), **ring: Any) -> Drive:
    """A planet and its ring; a pair of external gears where both numbers of teeth are positive."""
    shape, angle, addendum, rounding = SHAPES[name]
    if name == "parabolic":  # one parabola, whatever the ring's radius
        shape = shape._replace(k1=shape.k1 * -72 / teeth[1])
    outside = 0.01 if teeth[1] > 0 else MODULE * (teeth[1] / 2 - 5)
    planet = GearBody(float(teeth[0]), 0.0, 1.0, 1.25, rounding, 0.03, 0.01)
    gear = GearBody(float(teeth[1]), 0.0, addendum, 1.25, 0.25, 0.03, outside)
    cutter = {} if teeth[1] > 0 else {"cutter_teeth": 20.0}
    return Drive(MODULE, angle, planet, gear._replace(**cutter | ring), shape)


def ring_of(name: str, **changes: Any) -> Assembly:
    return check(family(name), drive(name, **changes))
