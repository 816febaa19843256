"""Drag of rolling bearings in the oil, without load."""

import math
from dataclasses import dataclass

from tribodyn.tribology.losses.loss import Loss

#: f_0 in an oil bath by type: Harris, Rolling Bearing Analysis, 4th edition, chapter 14 (from memory).
DRAG_FACTORS = {
    "deep-groove-ball": 2.0,
    "angular-contact-ball": 3.3,
    "cylindrical-roller": 3.0,
    "tapered-roller": 6.0,
    "needle-roller": 12.0,
    "self-aligning-ball": 1.75,
    "spherical-roller": 5.0,
    "four-point-contact-ball": 6.5,  # as two rows of angular contact
}
#: ν n, mm²/s times rpm, below which the moment no longer depends on it.
SLOW = 2000.0


@dataclass(frozen=True)
class BearingDragData:
    """Bearings of a shaft, alike: mean diameter d_m = (bore + outside)/2 (m), factor f_0, number."""

    mean_diameter: float
    drag_factor: float
    count: int


def palmgren(bearings: BearingDragData, speed: float, viscosity: float, density: float) -> Loss:
    """Loss of the load-independent moment by Palmgren, as Harris gives it, at a shaft's speed (rad/s, > 0).

    M_0 = 10^−7 f_0 (ν n)^⅔ d_m³ N mm for ν n ≥ 2000, else 160 · 10^−7 f_0 d_m³, with ν in mm²/s, n in rpm and
    d_m in mm; viscosity (dynamic, Pa·s) and density (kg/m³) are the oil's.
    """
    flow = 1e6 * viscosity / density * speed * 30.0 / math.pi
    size = bearings.drag_factor * (1e3 * bearings.mean_diameter) ** 3
    moment = 1e-7 * size * flow ** (2.0 / 3.0) if flow >= SLOW else 160e-7 * size
    return Loss(bearings.count * 1e-3 * moment * speed)
