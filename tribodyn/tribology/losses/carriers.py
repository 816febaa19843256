"""Churning of planet carriers: a drum in oil; torques at the carrier by its speed, rad/s, at least 0."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.churning import changenet_velex
from tribodyn.tribology.losses.loss import OilState, Sump, Torque, Wheel


@dataclass(frozen=True)
class CarrierInOil:
    """A planet carrier with its planets, seen as a drum."""

    diameter: float  # m
    width: float  # m
    immersion: float  # depth of its lowest point below the oil's level at rest, m
    clearance: float  # to the housing, at faces and rim, m; smooth_wheel does not read it


def enclosed_drum(carrier: CarrierInOil, speed: Float[Array, "..."], oil: OilState, sump: Sump) -> Torque:
    """A drum in a housing: both faces by Daily & Nece, the rim by Bilgen & Boulos, as far as oil wets them.

    Faces M = ½ C ρ ω² R⁵, C the largest of 2π/(G Re), 3.70 G^0.1 Re^−½, 0.080 G^−⅙ Re^−¼ and
    0.102 G^0.1 Re^−⅕ with G = s/R and Re = ω R²/ν; the rim M = ½ π C ρ ω² R⁴ b, C the largest of 10, 2, 1.03
    and 0.065 times G^0.3 over Re_s, Re_s^0.6, Re_s^½ and Re_s^⅕, Re_s = ω R s/ν. Wetted: the share of a face,
    and of the rim, below the level at rest. Planets that stand out push oil before them: not in it.

    J. W. Daily, R. E. Nece, J. Basic Eng. 82 (1960) 217; E. Bilgen, R. Boulos, J. Fluids Eng. 95 (1973) 122;
    from memory. 0.01 ≤ G ≤ 0.22.
    """
    radius, gap = 0.5 * carrier.diameter, carrier.clearance
    narrow = gap / radius
    speed = np.asarray(speed, dtype=float)
    # C/2 times ω²: powers of the speed that stay finite at 0
    rate = oil.density / oil.viscosity
    turning = np.where(speed > 0.0, speed, 1e-30)
    reynolds, thin = rate * turning * radius**2, rate * turning * radius * gap
    face = np.maximum.reduce(
        np.broadcast_arrays(
            2.0 * math.pi / (narrow * reynolds),
            3.70 * narrow**0.1 * reynolds**-0.5,
            0.080 * narrow ** (-1.0 / 6.0) * reynolds**-0.25,
            0.102 * narrow**0.1 * reynolds**-0.2,
        )
    )
    rim = np.maximum.reduce(
        np.broadcast_arrays(10.0 / thin, 2.0 * thin**-0.6, 1.03 * thin**-0.5, 0.065 * thin**-0.2)
    )
    half = math.acos(min(max(1.0 - carrier.immersion / radius, -1.0), 1.0))
    of_face = (half - math.sin(half) * math.cos(half)) / math.pi
    of_rim = half / math.pi
    torque = 0.5 * oil.density * speed**2 * radius**4
    torque = torque * (of_face * face * radius + of_rim * math.pi * rim * narrow**0.3 * carrier.width)
    outside = () if 0.01 <= narrow <= 0.22 else ("clearance 0.01 to 0.22 of the carrier's radius",)
    return Torque(torque, outside)


def smooth_wheel(carrier: CarrierInOil, speed: Float[Array, "..."], oil: OilState, sump: Sump) -> Torque:
    """`changenet_velex` of a wheel of the drum's size without teeth."""
    radius = 0.5 * carrier.diameter
    wheel = Wheel(radius, radius, radius, carrier.width, 1.0, 0.0, carrier.immersion)
    return changenet_velex(wheel, speed, oil, sump)


#: Methods by the names that a scenario has.
CARRIERS: dict[str, Callable[[CarrierInOil, Float[Array, "..."], OilState, Sump], Torque]] = {
    "enclosed-drum": enclosed_drum,
    "changenet-velex": smooth_wheel,
}
