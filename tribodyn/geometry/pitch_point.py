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

J = ½ B(1/4, 3/2). So ρ̄² = M a, with one length M that the geometry gives
(`tribology.contact.averaged_radius` carries it on to contacts beside P).
"""

import math
from typing import Any, NamedTuple

from tribodyn.geometry.path import Path, sine_at_pitch_point
from tribodyn.numerics.elementary import absolute, namespace, sense, sqrt

_BETA = math.gamma(0.25) * math.gamma(1.5) / math.gamma(1.75) / 2
# A pressure angle at P below this (rad) is zero but for rounding.
_ZERO_ANGLE = 1e-9


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
