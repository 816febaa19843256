"""The circle family: a path of contact that is one circular arc through the pitch point.

The chord from the pitch point to a point of a circle of diameter D makes asin(r/D) with the tangent, so that
α = α_P + asin(r/D) with the signed distance r. With D > 0 the pressure angle grows from approach to recess,
with D < 0 it falls, and as |D| grows the path becomes the straight line of the involute.
"""

import math
from typing import Any, NamedTuple

from tribodyn import Family, InputError, Parameter
from tribodyn.geometry.drive import Drive, reference_radius
from tribodyn.geometry.families import unshifted
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach
from tribodyn.geometry.path import integrated_rotation, inverted_rotation
from tribodyn.numerics.elementary import namespace, sqrt


class CirclePath(NamedTuple):
    """One arc; see `tribodyn.geometry.path.Path`. Lengths in m, angles in rad."""

    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    angle: Any
    diameter: Any

    def pressure_angle(self, r: Any) -> Any:
        """Pressure angle α; NaN beyond the ends of the diameter."""
        sine = r / self.diameter
        return self.angle + namespace(sine).arcsin(sine)

    def pressure_angle_slope(self, r: Any) -> Any:
        """Slope dα/dr, rad/m."""
        return 1.0 / (self.diameter * sqrt(1.0 - (r / self.diameter) ** 2))

    def rotation(self, r: Any) -> Any:
        """Pinion angle φ."""
        return integrated_rotation(self, r)

    def signed_distance(self, rotation: Any) -> Any:
        """Signed distance r at the pinion angle φ."""
        return inverted_rotation(self, rotation)


class Shape(NamedTuple):
    """What a drive's table ``[shape]`` holds."""

    diameter: Any


def working_path(drive: Drive) -> CirclePath:
    """Path of contact of the pair."""
    radii = reference_radius(drive, "pinion"), reference_radius(drive, "gear")
    return CirclePath(*radii, drive.pressure_angle, drive.shape.diameter)


def check(drive: Drive) -> None:
    """Refuse profile shift, no circle at all, one that ends before the teeth do, and undercut."""
    refuse_shift(drive)
    diameter = drive.shape.diameter
    if diameter == 0:
        raise InputError("drive.shape.diameter", "0 mm", "a circle needs a diameter", "use another one")
    # from where α would fall to 0 to where it would reach 90°, and no further than any tooth does
    ends = -diameter * math.sin(drive.pressure_angle), diameter * math.cos(drive.pressure_angle)
    reach = 50 * drive.module
    lower, upper = max(0.999 * min(ends), -reach), min(0.999 * max(ends), reach)
    require_reach(drive, working_path(drive), lower, upper, _advice)


def _advice(drive: Drive, half: int) -> tuple[str, Any, str]:
    remedy = "use a greater diameter of either sign, or lower teeth"
    return "shape.diameter", f"{1e3 * drive.shape.diameter:.4g} mm", remedy


FAMILY = Family(
    "circle",
    working_path,
    unshifted(working_path),
    shiftable=False,
    check=check,
    shape=Shape,
    parameters=(
        Parameter("diameter", "signed length", "of the circle; negative: pressure angle falls in recess"),
    ),
    about="path of one circular arc; pressure_angle at the pitch point, shape.diameter",
)
