"""The path of contact, and everything about a gear pair that follows from it alone.

Frame: origin P, the pitch point; x along the common pitch tangent, the way both flanks move at P; y along
the line of centres, the pinion's axis at (0, −r_p), the gear's at (0, +r_g). The radii of an internal gear
are negative (ISO 21771), and its axis lies on the pinion's side. A contact point is
C = r (cos α, sin α) with the signed distance r (r < 0 approach, r > 0 recess) and the pressure angle α(r) in
(0, π/2). The pinion turns by φ from φ = 0 at P, and meshing demands dr/dφ = r_p cos α.
"""

import math
from typing import Any, NamedTuple, Protocol

import numpy as np

from tribodyn.geometry.drive import Side
from tribodyn.numerics.elementary import (
    absolute,
    cos,
    maximum,
    minimum,
    namespace,
    sense,
    sin,
    sqrt,
    where,
    within,
)
from tribodyn.numerics.iteration import newton
from tribodyn.numerics.shapes import Array, Float

#: One number per contact: of any shape, the same for all that a call takes and returns.
PerContact = Float[Array, "*contact"]

# Twelve Gauss-Legendre points resolve 1/(r_p cos α) from P to any contact to rounding (test_geometry_path).
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_NODES, _WEIGHTS = (1 + _NODES) / 2, _WEIGHTS / 2
# Newton starts within a few per cent of the root: the error is at rounding after four steps.
_NEWTON_STEPS = 6
# Where a path is steep at its end, some steps go to find its end first.
_BRACKETED_STEPS = 12
# Where the flanks' speeds and radii vanish (a cycloid's pitch point), a radius of this share
# of the pitch radius stands for zero. The same distance separates the two sides of the pitch point.
_VANISHING = 1e-12
_BESIDE = 1e-9


class Path(Protocol):
    """A path of contact: α as a function of r, and the pinion angle that belongs to it."""

    @property
    def pinion_pitch_radius(self) -> Any:
        """Working pitch radius of the pinion, m."""

    @property
    def gear_pitch_radius(self) -> Any:
        """Working pitch radius of the gear, m."""

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle α at the signed distance r (m), rad."""

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Slope dα/dr, rad/m."""

    def rotation(self, r: PerContact) -> PerContact:
        """Pinion angle φ at the signed distance r, rad; 0 at the pitch point."""

    def signed_distance(self, rotation: PerContact) -> PerContact:
        """Signed distance r (m) at the pinion angle φ (rad): the inverse of `rotation`."""


class Kinematics(NamedTuple):
    """State of the contact at each signed distance; every field is shaped like r."""

    #: signed_distance, pressure_angle: r (m) and α (rad)
    signed_distance: PerContact
    pressure_angle: PerContact
    #: pinion_normal_arm, gear_normal_arm: arms of the normal load about the axes, r_p cos α and r_g cos α, m
    pinion_normal_arm: PerContact
    gear_normal_arm: PerContact
    #: pinion_friction_arm, gear_friction_arm: arms of the friction force, r + r_p sin α and r_g sin α − r, m
    pinion_friction_arm: PerContact
    gear_friction_arm: PerContact
    #: pinion_curvature, gear_curvature: curvatures of the flanks, 1/m, convex > 0. Curvature and not radius,
    #: because a radius is infinite where a flank is straight
    pinion_curvature: PerContact
    gear_curvature: PerContact
    #: their sum, one over the equivalent radius, 1/m. Like the flanks' own it is huge but finite where the
    #: equivalent radius vanishes: at the pitch point of a path whose pressure angle is zero there.
    relative_curvature: PerContact
    #: pinion_speed, gear_speed: speeds of the contact along each flank, m per radian of pinion rotation
    pinion_speed: PerContact
    gear_speed: PerContact
    #: entrainment, sliding: half the sum and the difference of the two, m per radian
    entrainment: PerContact
    sliding: PerContact


def kinematics(path: Path, r: PerContact) -> Kinematics:
    """Lever arms, curvatures and speeds at the signed distances r (m).

    With κ = dα/dφ and w = r_p/r_g: ρ_p = r + r_p sin α/(1 + κ), ρ_g = r_p sin α/(w − κ) − r,
    u_p = ω_p (rκ + r + r_p sin α), u_g = ω_p (rκ + w (r_g sin α − r)), so that u_p = ω_p ρ_p (1 + κ) and
    u_g = ω_p ρ_g (w − κ). The r κ term is the motion of the contact itself and vanishes for the involute.
    """
    alpha = path.pressure_angle(r)
    pinion_normal_arm = path.pinion_pitch_radius * cos(alpha)
    ratio = path.pinion_pitch_radius / path.gear_pitch_radius
    kappa = pinion_normal_arm * path.pressure_angle_slope(r)
    pinion_friction_arm = r + path.pinion_pitch_radius * sin(alpha)
    gear_friction_arm = path.gear_pitch_radius * sin(alpha) - r
    pinion_speed = pinion_friction_arm + r * kappa
    gear_speed = ratio * gear_friction_arm + r * kappa
    floor = _VANISHING * path.pinion_pitch_radius  # of the speeds' own sign
    size = absolute(floor)
    pinion_curvature = (1 + kappa) / where(absolute(pinion_speed) < size, floor, pinion_speed)
    gear_curvature = (ratio - kappa) / where(absolute(gear_speed) < size, floor, gear_speed)
    return Kinematics(
        signed_distance=r,
        pressure_angle=alpha,
        pinion_normal_arm=pinion_normal_arm,
        gear_normal_arm=path.gear_pitch_radius * cos(alpha),
        pinion_friction_arm=pinion_friction_arm,
        gear_friction_arm=gear_friction_arm,
        pinion_curvature=pinion_curvature,
        gear_curvature=gear_curvature,
        relative_curvature=pinion_curvature + gear_curvature,
        pinion_speed=pinion_speed,
        gear_speed=gear_speed,
        entrainment=(pinion_speed + gear_speed) / 2,
        sliding=pinion_speed - gear_speed,
    )


def sine_at_pitch_point(path: Path) -> tuple[Any, Any, Any]:
    """Evaluate sin α at the pitch point, and its rate d(sin α)/d|r| (1/m) just before and just after it.

    The rates are each other's negative unless the path has a corner there.
    """
    offset = _BESIDE * absolute(path.pinion_pitch_radius)
    xp = namespace(path)
    r = xp.stack([0.0 * offset, -offset, offset])
    alpha, slope = path.pressure_angle(r), path.pressure_angle_slope(r)
    return sin(alpha[0]), -cos(alpha[0]) * slope[1], cos(alpha[0]) * slope[2]


def position(path: Path, r: PerContact) -> tuple[PerContact, PerContact]:
    """Contact point (x, y) in the fixed frame, m."""
    alpha = path.pressure_angle(r)
    return r * cos(alpha), r * sin(alpha)


def radius(path: Path, r: PerContact) -> PerContact:
    """Distance of the contact point from the pinion's axis, m; of the sign of its pitch radius."""
    r_p = path.pinion_pitch_radius
    return r_p * sqrt(1 + r / r_p * (2 * sin(path.pressure_angle(r)) + r / r_p))


def distance_at_radius(path: Path, pinion_radius: PerContact) -> PerContact:
    """Signed distance r (m) at which the contact is at `pinion_radius` (m) from the pinion's axis.

    The radius has the sign of the pitch radius. The derivative of the squared radius is 2 u_p/ω_p,
    so the root is unique where the flank is not undercut.
    """
    xp = namespace(path, pinion_radius)
    r_p = path.pinion_pitch_radius
    sine, before, after = sine_at_pitch_point(path)
    # Start on the path with sin α linear on either side of P: exact for the involute and for the cycloid.
    share = (xp.asarray(pinion_radius, dtype=float) / r_p) ** 2 - 1  # r (r + 2 r_p sin α)/r_p²
    recess = share * r_p > 0
    quadratic = 1 + 2 * r_p * xp.where(recess, after, -before)
    root = sqrt(maximum(sine**2 + quadratic * share, (1e-3 * sine) ** 2 + _BESIDE**2))
    start = r_p * share / (sine + root)
    # Beyond the pitch circle |r| ≤ √|R² − r_p²|; within it the radius is smallest, the path at an end, before
    # |r| = |r_p|.
    furthest = r_p * xp.where(share < 0, -1.0, sqrt(maximum(share, 0.0)))
    lower, upper = minimum(furthest, 0.0), maximum(furthest, 0.0)
    state = within(start, lower, upper), lower, upper
    return newton(_step_to_radius, state, _BRACKETED_STEPS, path, pinion_radius)[0]


def _step_to_radius(
    state: tuple[PerContact, PerContact, PerContact], path: Path, pinion_radius: PerContact
) -> Any:
    """Newton's step between bounds, of which r becomes one; to their middle where it goes beyond that.

    So a corner of a steep path does not send the steps to and fro.
    """
    r, lower, upper = state
    r_p = path.pinion_pitch_radius
    alpha = path.pressure_angle(r)
    # both over r_p: R²/r_p of a gear grows with r, and so does that of an internal one
    residual = (r**2 - pinion_radius**2) / r_p + 2 * r * sin(alpha) + r_p
    slope = 2 * (r / r_p + sin(alpha) + r * cos(alpha) * path.pressure_angle_slope(r))
    beyond = slope < -_VANISHING  # the minimum radius, where it grows again
    short = (residual < 0) | beyond
    lower, upper = where(short, r, lower), where(short, upper, r)
    following = r - residual / where(absolute(slope) < _VANISHING, _VANISHING, slope)
    far = beyond | (absolute(following - r) > (upper - lower) / 2 + _BESIDE * absolute(r_p))
    return where(far, (lower + upper) / 2, following), lower, upper


def contact_limits(
    path: Path, pinion_tip_radius: Float[Array, ""], gear_tip_radius: Float[Array, ""]
) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Signed distances r_start < r_end (m) at which the tip circles cut the path.

    Contact begins at the gear's tip and ends at the pinion's. The pitch point lies between them, but for some
    internal pairs, whose flanks slide one way only.
    """
    return (-distance_at_radius(mirrored(path), gear_tip_radius), distance_at_radius(path, pinion_tip_radius))


def contact_ratio(
    path: Path, r_start: Float[Array, ""], r_end: Float[Array, ""], pinion_teeth: Float[Array, ""]
) -> Float[Array, ""]:
    """Pinion angle from first to last contact over the pitch angle 2π/Z_p."""
    return (path.rotation(r_end) - path.rotation(r_start)) * pinion_teeth / (2 * np.pi)


def integrated_rotation(path: Path, r: PerContact) -> PerContact:
    """φ(r) = ∫ dr/(r_p cos α) from 0 to r: `rotation` for a family without a closed form.

    The quadrature never crosses P, so α(r) may have a kink there.
    """
    xp = namespace(path, r)
    r = xp.asarray(r)
    integrand = 1 / (path.pinion_pitch_radius * cos(path.pressure_angle(r[..., None] * _NODES)))
    return r * (integrand @ _WEIGHTS)


def inverted_rotation(path: Path, rotation: PerContact) -> PerContact:
    """r(φ) by Newton's method: `signed_distance` for a family without a closed form."""
    xp = namespace(path, rotation)
    rotation = xp.asarray(rotation)
    start = rotation * path.pinion_pitch_radius * cos(path.pressure_angle(xp.zeros_like(rotation)))
    return newton(_step_to_rotation, start, _NEWTON_STEPS, path, rotation)


def _step_to_rotation(r: PerContact, path: Path, rotation: PerContact) -> PerContact:
    residual = path.rotation(r) - rotation
    return r - residual * path.pinion_pitch_radius * cos(path.pressure_angle(r))


class MirroredPath(NamedTuple):
    """The same path looked at from the gear: the gear is this path's pinion, and time runs backwards.

    The frame is turned by half a turn, r' = −r and α'(r') = α(−r'), so that the body is below, its tooth
    left of the contact and the flank moving to +x, exactly as the pinion's in its own frame.
    """

    path: Any

    @property
    def pinion_pitch_radius(self) -> Any:
        """Working pitch radius of the body, m."""
        return self.path.gear_pitch_radius

    @property
    def gear_pitch_radius(self) -> Any:
        """Working pitch radius of its mate, m."""
        return self.path.pinion_pitch_radius

    def pressure_angle(self, r: PerContact) -> PerContact:
        """Pressure angle α(−r), rad."""
        return self.path.pressure_angle(-r)

    def pressure_angle_slope(self, r: PerContact) -> PerContact:
        """Slope dα/dr, rad/m."""
        return -self.path.pressure_angle_slope(-r)

    def rotation(self, r: PerContact) -> PerContact:
        """Angle of the body, rad."""
        return -self.path.rotation(-r) * (self.gear_pitch_radius / self.pinion_pitch_radius)

    def signed_distance(self, rotation: PerContact) -> PerContact:
        """Signed distance r (m) at the body's angle."""
        return -self.path.signed_distance(-rotation * (self.pinion_pitch_radius / self.gear_pitch_radius))


def mirrored(path: Path) -> Path:
    """Look at the path from its gear."""
    return path.path if isinstance(path, MirroredPath) else MirroredPath(path)


def seen_from(path: Path, side: Side) -> Path:
    """Look at the path from one body, which is that path's pinion."""
    return path if side == "pinion" else mirrored(path)


_BETA = math.gamma(0.25) * math.gamma(1.5) / math.gamma(1.75) / 2
# A pressure angle at P below this (rad) is zero but for rounding.
_ZERO_ANGLE = 1e-9


# What the contact is at the pitch point of a path whose pressure angle is zero there.
#
# On a cycloid's or a parabola's path sin α grows like |r|/D from zero at P. Radii of curvature and the
# speeds along the flanks then vanish like |r|, but the way s along a flank only grows like r²: radii and
# speeds go like √s, and a contact of finite width never sees the point itself. With κ = dα/dφ beside P, U =
# u/r (per rad of the pinion) and s = U r²/(2 r_p), a flank's curvature at s is (1 + κ)/√(2 r_p U_p s) for
# the pinion and (w − κ)/√(2 r_p U_g s) for the gear. Contact at P has the recess's flanks on its one side
# and the approach's on the other: relative curvatures k_1/√s and k_2/√s.
#
# The parabola that carries the same load on the same half-width a has the flanks' relative curvature
# averaged with the weight of Hertz's pressure, for a gap f presses with E*∫ x f' dx/√(a² − x²) = E*∫ √(a² −
# x²) f'' dx:
#
# 1/ρ̄ = 2/(π a²) ∫ √(a² − x²) (k_1 + k_2)/√x dx over 0 … a = (2 J/π) (k_1 + k_2)/√a,
#
# J = ½ B(1/4, 3/2). So ρ̄² = M a, with one length M that the geometry gives
# (`tribology.contact.averaged_radius` carries it on to contacts beside P).


class PitchPoint(NamedTuple):
    """How radii and speeds vanish at the pitch point; both zero where they do not."""

    length: Any  # M, m: the equivalent radius averaged over a contact at P is √(M a)
    #: entrainment (m per rad of the pinion) over equivalent radius (m), the mean of both sides of P, 1/rad
    speed_per_radius: Any


def pitch_point(path: Path) -> PitchPoint:
    """Evaluate how the contact degenerates at the pitch point of a path, if it does."""
    xp = namespace(path)
    sine, before, after = sine_at_pitch_point(path)
    r_p = path.pinion_pitch_radius
    ratio = r_p / path.gear_pitch_radius
    vanishes = sine < _ZERO_ANGLE
    # A regular path goes through the same formulas, with a harmless κ, and is discarded.
    curvatures, rates = [], []
    inwards = sense(r_p)  # speeds of an internal pinion are negative, and so is r_p
    harmless = inwards * (1 + absolute(ratio))
    for kappa in (xp.where(vanishes, r_p * after, harmless), xp.where(vanishes, -r_p * before, -harmless)):
        sign = 1.0 if not curvatures else -1.0
        pinion, gear = sign * (1 + 2 * kappa), sign * (2 * kappa - ratio)
        over_root = (1 + kappa) / sqrt(2 * r_p * pinion) + (ratio - kappa) / sqrt(2 * r_p * gear)
        curvatures.append(inwards * over_root)
        rates.append((pinion + gear) / 2 * ((1 + kappa) / pinion + (ratio - kappa) / gear))
    length = (2 * _BETA / math.pi * (curvatures[0] + curvatures[1])) ** -2
    return PitchPoint(xp.where(vanishes, length, 0.0), xp.where(vanishes, (rates[0] + rates[1]) / 2, 0.0))
