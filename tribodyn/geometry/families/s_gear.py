"""S-gears: the rack's flank is a power law, point-symmetric about the pitch line.

Half the rack's flank is η = a_P (1 − (1 − ξ)^n), in modules from the pitch point, the other half its image by
half a turn (Hlebanja's S-gears, whose form factor and exponent a_P and n are). Its normal meets the pitch
line where cot α = dη/dξ, so that at the height |y| over the pitch line, h = |y|/m,

    cot α = n a_P (1 − h/a_P)^((n − 1)/n),

and the path of contact is r = y/sin α, where the pinion has turned by r_p φ = y cot α + m ξ. Contact is
convex-concave at both ends and like an involute's at P, where the pressure angle acot(n a_P) is the smallest.
The power law serves up to one module from the pitch line, as high as the teeth are; the rack goes on straight
from there to its rounded tip. Soon above (at 1.02 modules for the usual a_P = 1.31, n = 1.9) r would
reach its maximum and the path turn back.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Drive, reference_radii, reference_radius, tip_radius
from tribodyn.geometry.families import Family, unshifted
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach
from tribodyn.geometry.path import PerContact, inverted_rotation
from tribodyn.numerics.elementary import arctan2, cos, maximum, minimum, namespace, sin, where, within
from tribodyn.numerics.iteration import newton
from tribodyn.numerics.parameter import Parameter

_NEWTON_STEPS = 6


class PowerRackPath(NamedTuple):
    """Path of contact of a rack whose flank is a power law."""

    #: pinion_pitch_radius, gear_pitch_radius: pitch radii, m
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    module: Any  # unit of the rack's height, m
    #: form, exponent: a_P and n
    form: Any
    exponent: Any

    def _cotangent(self, y: PerContact) -> tuple[PerContact, PerContact]:
        """Cotangent of α at the height y ≥ 0, and its derivative by y."""
        inside = 1.0 * (y < self.module)
        height_left = self._left(y)
        cotangent = self.exponent * self.form * height_left**self._power
        return cotangent, -inside * self._power * cotangent / (height_left * self.form * self.module)

    @property
    def _power(self) -> Any:
        return (self.exponent - 1) / self.exponent

    def _left(self, y: PerContact) -> PerContact:
        """Share 1 − h/a_P of the power law's height that is left above y."""
        return 1 - within(y, 0.0, self.module) / (self.form * self.module)

    def _height(self, r: PerContact) -> PerContact:
        """Height |y| of the contact over the pitch line at the signed distance r: y √(1 + cot² α) = |r|."""
        distance = abs(namespace(self, r).asarray(r, dtype=float))
        stretch = (1 + self._cotangent(self.module)[0] ** 2) ** 0.5
        # From below, where the concave r(y) brings the steps up to the root one-sidedly.
        reached = minimum(distance, self.module * stretch)
        start = reached / (1 + (self.exponent * self.form) ** 2) ** 0.5
        return newton(_step_to_height, start, _NEWTON_STEPS, self, reached) + (distance - reached) / stretch

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle, rad."""
        cotangent, _ = self._cotangent(self._height(r))
        return arctan2(1.0 + 0.0 * cotangent, cotangent)

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Slope dα/dr, rad/m; at P itself the recess's."""
        y = self._height(r)
        cotangent, rate = self._cotangent(y)
        alpha = arctan2(1.0 + 0.0 * cotangent, cotangent)
        # dα = −sin² α d(cot α); r = y/sin α, so that dr/dy = (1 − r cos α dα/dy)/sin α
        by_height = -(sin(alpha) ** 2) * rate
        slope = by_height * sin(alpha) / (1 - y / sin(alpha) * cos(alpha) * by_height)
        return where(namespace(r).asarray(r) < 0, -slope, slope)

    def rotation(self, r: PerContact) -> PerContact:
        """Pinion angle φ, rad: the rack goes on by the contact's x and by the flank's."""
        y = self._height(r)
        cotangent, _ = self._cotangent(y)
        flank = self.module * (1 - self._left(y) ** (1 / self.exponent))
        flank = flank + maximum(y - self.module, 0.0) / cotangent
        turned = (y * cotangent + flank) / self.pinion_pitch_radius
        return where(namespace(r).asarray(r) < 0, -turned, turned)

    signed_distance = inverted_rotation


def _step_to_height(y: PerContact, path: PowerRackPath, distance: PerContact) -> PerContact:
    """Euler's step, to the parabola's root: Newton's would only halve the way close to the maximum of r."""
    xp = namespace(y, path, distance)
    y = where(y < path.module, y, path.module * (1 - 1e-15))  # the mean of `minimum` may lie beyond
    height_left = path.form * path.module - y
    cotangent, rate = path._cotangent(y)
    stretch = (1 + cotangent**2) ** 0.5
    product = cotangent * rate  # ½ d(cot² α)/dy
    first = product / stretch
    second = product * (1 - 2 * path._power) / (height_left * stretch) - first**2 / stretch
    residual = y * stretch - distance
    slope, bend = stretch + y * first, 2 * first + y * second
    return y - 2 * residual / (slope + xp.sqrt(maximum(slope**2 - 2 * residual * bend, 0.0)))


class SGearShape(NamedTuple):
    """Form factor a_P (in modules) and exponent n of the rack's flank."""

    form_factor: Any
    exponent: Any


def working_path(drive: Drive) -> PowerRackPath:
    """Path of the drive's rack."""
    return PowerRackPath(*reference_radii(drive), drive.module, *drive.shape)


def check(drive: Drive) -> None:
    """Refuse profile shift, a rack that is no S, and one that ends before the teeth do."""
    refuse_shift(drive)
    a, n = drive.shape
    if not 1 < n <= 4:
        raise InputError("drive.shape.exponent", n, "must be above 1 and at most 4", "use 1.9")
    if not (a > 1 and 0.5 <= n * a <= 12):
        angle = np.degrees(np.arctan2(1, n * a))
        rule = f"must be above 1, with acot(n a_P) = {angle:.3g}°, the pressure angle at P, from 5° to 63°"
        raise InputError("drive.shape.form_factor", a, rule, "use 1.31 with the exponent 1.9")
    path = working_path(drive)
    y = drive.module * np.linspace(0.0, 1.0, 501)
    if not np.all(np.diff(y * np.hypot(1.0, path._cotangent(y)[0])) > 0):
        rule = "the path of contact turns back before the teeth's height of one module"
        raise InputError("drive.shape.form_factor", a, rule, "use a larger one, such as 1.31 for n = 1.9")
    for side in SIDES:
        height = (tip_radius(drive, side) - reference_radius(drive, side)) / drive.module
        if height > 1 + 1e-9:
            rule = "the flank of an S-gear is a power law up to one module from the pitch line only"
            raise InputError(f"drive.{side}.addendum", float(height), rule, "use at most 1")
    reach = 50 * drive.module
    advice = "shape.form_factor", drive.shape.form_factor, "use a larger one, or lower teeth and racks"
    require_reach(drive, path, -reach, reach, lambda *_: advice)


FAMILY = Family(
    "s-gear",
    working_path,
    unshifted(working_path),
    shiftable=False,
    check=check,
    shape=SGearShape,
    parameters=(
        Parameter("form_factor", "number", "a_P of the rack's flank, height in modules", example="1.6"),
        Parameter("exponent", "number", "n of the rack's flank", example="1.8"),
    ),
    pressure_angle=False,
    corner=True,
    about="rack with a power-law flank; shape.form_factor, exponent",
)
