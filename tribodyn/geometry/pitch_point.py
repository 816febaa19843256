"""What the contact is at the pitch point of a path whose pressure angle is zero there.

On a cycloid's or a parabola's path sin α grows like |r|/D from zero at P. Radii of curvature and the speeds
along the flanks then vanish like |r|, but the way s along a flank only grows like r²: radii and speeds go
like √s, and a contact of finite width never sees the point itself. With κ = dα/dφ beside P, U = u/r (per rad
of the pinion) and s = U r²/(2 r_p), a flank's curvature at s is (1 + κ)/√(2 r_p U_p s) for the pinion and
(w − κ)/√(2 r_p U_g s) for the gear. Contact at P has the recess's flanks on its one side and the approach's
on the other: relative curvatures k_1/√s and k_2/√s.

The parabola that carries the same load on the same half-width a has the flanks' relative curvature averaged
with the weight of Hertz's pressure, for a gap f presses with E*∫ x f' dx/√(a² − x²) = E*∫ √(a² − x²) f'' dx:

    1/ρ̄ = 2/(π a²) ∫ √(a² − x²) (k_1 + k_2)/√x dx over 0 … a  =  (2 J/π) (k_1 + k_2)/√a,

J = ½ B(1/4, 3/2). So ρ̄² = M a, with one length M that the geometry gives (`averaged_radius`
carries it on to contacts beside P).
"""

import math
from typing import Any, NamedTuple

from tribodyn.geometry.path import Path, sine_at_pitch_point
from tribodyn.numerics.elementary import exp, law, log, maximum, namespace, sqrt

_BETA = math.gamma(0.25) * math.gamma(1.5) / math.gamma(1.75) / 2
# A pressure angle at P below this (rad) is zero but for rounding.
_ZERO_ANGLE = 1e-9


class PitchPoint(NamedTuple):
    """How radii and speeds vanish at the pitch point; both zero where they do not.

    Parameters
    ----------
    length : float
        M, m: the equivalent radius averaged over a contact at P is √(M a).
    speed_per_radius : float
        Entrainment (m per rad of the pinion) over equivalent radius (m), the mean of both sides of P, 1/rad.
    """

    length: Any
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
    harmless = 1 + ratio
    for kappa in (xp.where(vanishes, r_p * after, harmless), xp.where(vanishes, -r_p * before, -harmless)):
        sign = 1.0 if not curvatures else -1.0
        pinion, gear = sign * (1 + 2 * kappa), sign * (2 * kappa - ratio)
        over_root = (1 + kappa) / sqrt(pinion) + (ratio - kappa) / sqrt(gear)
        curvatures.append(over_root / sqrt(2 * r_p))
        rates.append((pinion + gear) / 2 * ((1 + kappa) / pinion + (ratio - kappa) / gear))
    length = (2 * _BETA / math.pi * (curvatures[0] + curvatures[1])) ** -2
    return PitchPoint(xp.where(vanishes, length, 0.0), xp.where(vanishes, (rates[0] + rates[1]) / 2, 0.0))


@law
def averaged_radius(radius, line_load, effective_modulus, pitch_point_length):
    """Equivalent radius averaged over the half width a of its own contact, m; for one that vanishes at P.

    The exact mean at P is ρ̄² = M a (the module's docstring). A contact beside P covers P while that is nearer
    than a; for it there is no closed form, but ρ⁴ = ρ̄⁴ + 14 (M a)² − 15 (M a)⁴/ρ̄⁴ is exact at P and where the
    contact's edge is at P, goes over to ρ̄ = ρ far away, and between meets the mean over a flank of curvature
    k/√s to 10 %. With a² = 8 w' ρ̄/(π E') it is a polynomial in ρ̄, to whose root Newton's steps come down.
    A load below 1 N/m counts as that; with M = 0 the radius stays as it is.
    """
    scale = pitch_point_length * pitch_point_length * 8.0 * maximum(line_load, 1.0)
    scale = exp(log(maximum(scale / (math.pi * effective_modulus), 1e-60)) / 3.0)  # ρ̄ at P
    fourth = (radius / scale) * (radius / scale) * (radius / scale) * (radius / scale)
    root = sqrt(1.0 + (radius / scale) * (radius / scale))
    for _ in range(6):
        square = root * root
        cube = square * root
        value = cube * cube + 14.0 * cube - 15.0 - fourth * square
        root = root - value / (6.0 * cube * square + 42.0 * square - 2.0 * fourth * root)
    return scale * root
