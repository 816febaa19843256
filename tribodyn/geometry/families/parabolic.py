"""The parabolic family: a path of contact of two parabolas with their common vertex at the pitch point.

Recess x² = 2 p1 y with p1 = 2 k1 r_g, approach x² = −2 p2 y with p2 = 2 k2 r_p (Jia et al. 2022, (26)-(36)).
The k that belongs to the negative radius of an internal gear is negative too.
With tan α = |x|/(2p), sin α = |r|/(p + √(p² + r²)), and the pinion turns by φ = (x + x³/(6p²))/r_p, Jia's
(10). At P α vanishes as on a cycloid's path; see `pitch_point`.
"""

import math
from typing import Any, NamedTuple

from tribodyn.errors import InputError
from tribodyn.geometry.drive import Drive, Side, body_of, reference_radii, reference_radius
from tribodyn.geometry.families import Family, unshifted
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach
from tribodyn.geometry.path import PerContact
from tribodyn.numerics.elementary import namespace, sqrt, where
from tribodyn.numerics.parameter import Parameter


class ParabolaPath(NamedTuple):
    """Two half parabolas; closed forms throughout."""

    #: pinion_pitch_radius, gear_pitch_radius: pitch radii, m
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    #: approach_parameter, recess_parameter: p2 and p1: semi-latus rectum of either parabola, m
    approach_parameter: Any
    recess_parameter: Any

    def _parameter(self, r: PerContact) -> PerContact:
        return where(r < 0, -self.approach_parameter, self.recess_parameter)

    def _sine(self, r: PerContact) -> tuple[PerContact, PerContact]:
        """Sine of α, and √(p² + r²) with the sign of r."""
        p = namespace(self, r).asarray(self._parameter(r))  # of the wrong sign 0/0 at P is NaN
        root = where(r < 0, -1.0, 1.0) * sqrt(p**2 + r**2)
        return r / (p + root), root

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle, rad."""
        sine, _ = self._sine(r)
        return namespace(sine).arcsin(sine)

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Slope dα/dr, rad/m; at P itself the recess's."""
        sine, root = self._sine(r)
        return self._parameter(r) / (root * (self._parameter(r) + root) * sqrt(1 - sine**2))

    def rotation(self, r: PerContact) -> PerContact:
        """Pinion angle φ, rad."""
        sine, _ = self._sine(r)
        x = r * sqrt(1 - sine**2)
        return (x + x**3 / (6 * self._parameter(r) ** 2)) / self.pinion_pitch_radius

    def signed_distance(self, rotation: PerContact) -> PerContact:
        """Signed distance r (m) at the pinion angle φ: the root of Jia's cubic in x."""
        xp = namespace(self, rotation)
        rolled = xp.asarray(self.pinion_pitch_radius * rotation)
        p = self._parameter(rolled)
        angle = xp.arcsinh(3 * rolled / (2 * math.sqrt(2) * p)) / 3
        x = 2 * math.sqrt(2) * p * xp.sinh(angle)
        return x * sqrt(1 + (x / (2 * p)) ** 2)


class ParabolaShape(NamedTuple):
    """Jia's parabola coefficients: k1 = p1/(2 r_g) of the recess, k2 = p2/(2 r_p) of the approach."""

    k1: Any
    k2: Any


def working_path(drive: Drive) -> ParabolaPath:
    """Parabolas of the drive's coefficients."""
    r_p, r_g = reference_radii(drive)
    return ParabolaPath(r_p, r_g, 2 * drive.shape.k2 * r_p, 2 * drive.shape.k1 * r_g)


def maximum_coefficient(drive: Drive, half: int) -> float:
    """Maximum k at which the mate's actual tip still meets sound flank: k1 for half = +1, k2 for −1.

    There contact ends, on the mate's tip circle, at the point of zero velocity of this body's flank, which
    stands at the height y = r − p = r (1 − 2k) on its parabola; found by bisection. The flank of an internal
    gear has no such point on the side of y > 0: 0, for its k < 0.
    """
    side: Side = "gear" if half > 0 else "pinion"
    mate: Side = "pinion" if half > 0 else "gear"
    r, mate_r = reference_radius(drive, side), reference_radius(drive, mate)
    tip = mate_r + drive.module * body_of(drive, mate).addendum

    def sound(k: float) -> bool:
        p = 2 * k * r
        middle, power = p + mate_r, tip**2 - mate_r**2
        if middle**2 + power < 0:  # the tip circle does not reach the parabola
            return False
        y = power / (middle + math.copysign(math.sqrt(middle**2 + power), middle))
        # The contact's speed along the flank is zero where its distance from the body's axis (0, r) is
        # stationary along the path, x x' + (y − r) y' = 0. On x² = 2 p y, x x' = p y', hence p + y − r = 0.
        return p + y - r < 0

    if r < 0:
        return 0.0
    good, bad = 0.0, 0.5
    for _ in range(60):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if sound(middle) else (good, middle)
    return good


def check(drive: Drive) -> None:
    """Refuse profile shift, and coefficients that are not positive or undercut the working flank."""
    refuse_shift(drive)
    for half, name in ((1, "k1"), (-1, "k2")):
        k, most = getattr(drive.shape, name), maximum_coefficient(drive, half)
        side: Side = "gear" if half > 0 else "pinion"
        internal = body_of(drive, side).teeth < 0
        if internal and not k < 0:
            rule = f"must be less than 0: the radius of the internal {side} is negative"
            raise InputError(f"drive.shape.{name}", k, rule, f"use {-abs(k) or -0.1:g}")
        if not internal and not 0 < k < most:
            raise InputError(
                f"drive.shape.{name}",
                k,
                f"must be greater than 0 and less than {most:.4g}, or the working flank of the {side} "
                "is undercut",
                f"use {0.7 * most:.2g}",
            )
    reach = 50 * drive.module
    require_reach(drive, working_path(drive), -reach, reach, _advice)


def _advice(drive: Drive, half: int) -> tuple[str, Any, str]:
    name = "k1" if half > 0 else "k2"
    return f"shape.{name}", getattr(drive.shape, name), "use a smaller one, or lower teeth"


FAMILY = Family(
    "parabolic",
    working_path,
    unshifted(working_path),
    shiftable=False,
    check=check,
    shape=ParabolaShape,
    parameters=(
        Parameter("k1", "number", "p1/(2 r_g) of the parabola in recess (Jia et al.)", example="0.32"),
        Parameter("k2", "number", "p2/(2 r_p) of the parabola in approach", example="0.32"),
    ),
    pressure_angle=False,
    corner=True,
    about="parabolic path of contact (Jia et al.); shape.k1 of the recess, k2 of the approach",
)
