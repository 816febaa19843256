"""The CRC family: constant relative curvature along the whole path of contact (Liu & Ni 2022).

With A = r_p sin α, κ = dα/dφ equals dA/dr, and asking for the equivalent radius ρ_0 of the pitch point at
every r gives r²κ² + κ [2Ar + r²(1 − w)] + A² + Ar(1 − w) − r²w − A A_0 = 0. In ξ = r/A_0 and a = A/A_0
(A_0 = r_p sin α_p) this is one polynomial equation with the single parameter w = r_p/r_g:

    p² + (1 − w) ξ p − w ξ² − a = 0,   p = ξ a' + a,

regular at ξ = 0 (a = 1, a' = (w − 1)/3) and through α = 90°. In other words (p + ξ)(p − wξ) = a: the product
of the two flank speeds goes with sin α. It is solved by Chebyshev collocation.

The root 2p = √((1 + w)² ξ² + 4a) − (1 − w) ξ is real for every w while sin α > 0, and both flank speeds,
p + ξ and p − wξ, are then positive: no flank is undercut. p is the rate of the height ξa over ξ. It stays
positive but for an internal gear, w < 0, on the side of whose root the path turns back to the pitch line
where a = −w ξ²: 0.85, 0.70, 0.61, 0.55, 0.50, 0.46, 0.41 times r_p sin² α_p from it for −w = 0.1, 0.2, 0.3,
0.4, 0.5, 0.6, 0.8. No rack cuts the mate's tooth beyond, where it must end. For w = −1/2 the solution is
a = 1 − ξ/2: the ring's flank is straight and the planet's an arc of the radius 2 r_p sin α_p = ρ_0.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Drive, Side, body_of, reference_radii, reference_radius, tip_radius
from tribodyn.geometry.families import Family, unshifted
from tribodyn.geometry.limits.sizes import refuse_shift, require_reach
from tribodyn.geometry.path import PerContact, integrated_rotation, inverted_rotation
from tribodyn.numerics.elementary import maximum, namespace, sin, sqrt, within
from tribodyn.numerics.iteration import newton
from tribodyn.numerics.remembered import remembered
from tribodyn.numerics.shapes import Array, Float

# Nearest complex singularities are at ξ ≈ ±1.4i: degree 48 converges to rounding for intervals up to |ξ| ≈ 3.
DEGREE = 48
_NEWTON_STEPS = 8
# The path is solved this much further than the teeth reach, so that Newton's iterates stay inside.
_REACH_MARGIN = 1.1

_POINTS = np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
_VALUE = np.polynomial.chebyshev.chebvander(_POINTS, DEGREE)
_DERIVATIVE = np.vstack([np.polynomial.chebyshev.chebder(row) for row in np.eye(DEGREE + 1)]).T
_SLOPE = _VALUE[:, :DEGREE] @ _DERIVATIVE


def chebyshev_basis(x: PerContact) -> Float[Array, "*contact degree"]:
    """Evaluate T_0(x) … T_DEGREE(x) along a new last axis, as cos(k arccos x); constant beyond −1 … 1."""
    xp = namespace(x)
    # Beside ±1, by more than `within` rounds, the derivative of arccos is finite.
    angle = xp.arccos(within(xp.asarray(x), -1 + 1e-12, 1 - 1e-12))
    return xp.cos(angle[..., None] * np.arange(DEGREE + 1))


class CRCPath(NamedTuple):
    """Path of contact whose equivalent radius is the same everywhere.

    It is known from `lower` to `upper` only; beyond them α keeps its last value and nothing else holds.
    """

    #: pinion_pitch_radius, gear_pitch_radius: pitch radii, m
    pinion_pitch_radius: Any
    gear_pitch_radius: Any
    #: lower, upper: signed distances (m) between which the path is solved: as far as rack and mate reach, and
    #: a margin
    lower: Any
    upper: Any
    coefficients: Any  # Chebyshev coefficients of sin α over lower … upper, (DEGREE + 1,)

    def _sine(self, r: PerContact) -> tuple[PerContact, PerContact]:
        basis = chebyshev_basis((2 * r - self.lower - self.upper) / (self.upper - self.lower))
        slope = (_DERIVATIVE @ self.coefficients) * 2 / (self.upper - self.lower)
        return basis @ self.coefficients, basis[..., :DEGREE] @ slope

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle, rad; NaN where sin α would exceed 1."""
        sine, _ = self._sine(r)
        return namespace(sine).arcsin(sine)

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Slope dα/dr of the interpolant, rad/m."""
        sine, slope = self._sine(r)
        return slope / sqrt(1 - sine**2)

    rotation = integrated_rotation
    signed_distance = inverted_rotation


def solve(ratio: Any, lower: Any, upper: Any) -> Float[Array, " degree"]:
    """Chebyshev coefficients of a(ξ) over lower … upper for w = `ratio`, by fixed Newton steps."""
    half = (upper - lower) / 2
    # Start on the first two terms of the series about the pitch point.
    kappa = (ratio - 1) / 3
    constant, linear = np.eye(DEGREE + 1)[:2]
    start = (1 + kappa * (lower + upper) / 2) * constant + kappa * half * linear
    return newton(_step, start, _NEWTON_STEPS, ratio, (lower + upper) / 2, half)


def _step(
    coefficients: Float[Array, " degree"], ratio: Any, middle: Any, half: Any
) -> Float[Array, " degree"]:
    xp = namespace(coefficients, ratio, middle, half)
    xi = middle + half * _POINTS
    product = xi[:, None] * _SLOPE / half + _VALUE
    p = product @ coefficients
    residual = p**2 + (1 - ratio) * xi * p - ratio * xi**2 - _VALUE @ coefficients
    jacobian = (2 * p + (1 - ratio) * xi)[:, None] * product - _VALUE
    return coefficients - xp.linalg.solve(jacobian, residual)


def reach(ratio: Any, height: Any) -> Any:
    """ξ at which the path is `height` above the pitch point, in units of A_0²/r_p (so that ξ a = height).

    The height rises monotonically with ξ at the rate p > 0; a coarse fourth-order march is enough, for the
    result only bounds the interval of the solution.
    """
    steps = 4
    step = height / steps

    def rate(h: Any, xi: Any) -> Any:
        return 2 / (sqrt(xi**2 * (1 + ratio) ** 2 + 4 * h / xi) - xi * (1 - ratio))

    # One step of the series a = 1 + (w − 1)/3 ξ leaves the point where h/ξ is 0/0.
    xi = step - (ratio - 1) / 3 * step**2
    for i in range(1, steps):
        h = i * step
        k1 = rate(h, xi)
        k2 = rate(h + step / 2, xi + step / 2 * k1)
        k3 = rate(h + step / 2, xi + step / 2 * k2)
        k4 = rate(h + step, xi + step * k3)
        xi = xi + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return xi


@remembered(16)
def working_path(drive: Drive) -> CRCPath:
    """Path of contact from the depth of the pinion's rack to the depth of the gear's."""
    r_p, r_g = reference_radii(drive)
    sine = sin(drive.pressure_angle)
    arm = r_p * sine
    ratio = r_p / r_g
    xp = namespace(drive)
    # arrays: beyond what can be made there are square roots of negative numbers, NaN
    below = maximum(xp.asarray(drive.module * drive.pinion.dedendum), tip_radius(drive, "gear") - r_g)
    above = maximum(xp.asarray(drive.module * drive.gear.dedendum), tip_radius(drive, "pinion") - r_p)
    ends = -below * r_p / arm**2, above * r_p / arm**2
    lower, upper = (
        _REACH_MARGIN
        * (reach(ratio, end) if body.cutter_teeth is None else _reach_in_ring(drive, side) / arm)
        for side, body, end in zip(SIDES, (drive.pinion, drive.gear), ends, strict=True)
    )
    return CRCPath(r_p, r_g, lower * arm, upper * arm, sine * solve(ratio, lower, upper))


def _reach_in_ring(drive: Drive, ring: Side) -> Any:
    """Signed distance (m) to which mate and cutter of an internal gear touch it on the side of its root.

    Where their tip circles R cut the path, r² + 2 r r_b sin α = R² − r_b², with sin α by the first two terms
    of the series, a = 1 + (w − 1)/3 ξ, which are the path itself for w = −1/2.
    """
    way, mate = (1.0, drive.pinion) if ring == "gear" else (-1.0, drive.gear)
    r_ring, cutter = reference_radius(drive, ring), body_of(drive, ring)
    r_mate = drive.module * mate.teeth / 2
    cutter_radius = drive.module * cutter.cutter_teeth / 2
    height = cutter.dedendum if cutter.cutter_addendum is None else cutter.cutter_addendum
    reaches = []
    for circle, tip in (
        (r_mate, tip_radius(drive, "pinion" if ring == "gear" else "gear")),
        (cutter_radius, cutter_radius + drive.module * height),
    ):
        arm, power = circle * sin(drive.pressure_angle), tip**2 - circle**2
        bend = 1 - 2 * (1 - r_mate / r_ring) / 3 * circle / r_mate
        # where the series ends before the tip the path may still reach it
        reaches.append(power / (arm + sqrt(maximum(arm**2 + bend * power, (0.1 * arm) ** 2))))
    return way * maximum(*reaches)


def check(drive: Drive) -> None:
    """Refuse profile shift, and teeth that reach further than a path of constant relative curvature does."""
    refuse_shift(drive)
    with np.errstate(all="ignore"):
        path = working_path(drive)
        inner = np.linspace(path.lower, path.upper, 201) / _REACH_MARGIN
        sine = np.sin(path.pressure_angle(inner))
        tail = np.abs(path.coefficients[-4:]).max()
    if not (np.all(np.isfinite(sine)) and sine.min() > 0 and tail < 1e-10):
        raise InputError(
            "drive.pressure_angle",
            f"{math.degrees(drive.pressure_angle):.4g}°",
            "the path of constant relative curvature does not reach the depth of the teeth",
            "use a larger pressure angle, more teeth, or a smaller addendum and dedendum",
        )
    require_reach(drive, path, float(path.lower), float(path.upper), _advice)


def _advice(drive: Drive, half: int) -> tuple[str, Any, str]:
    shown = f"{math.degrees(drive.pressure_angle):.4g}°"
    return "pressure_angle", shown, "use a larger one, or a smaller addendum and dedendum"


FAMILY = Family(
    "crc",
    working_path,
    unshifted(working_path),
    False,
    check,
    about="constant relative curvature (Liu & Ni); pressure_angle is the one at the pitch point",
)
