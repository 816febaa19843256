"""Windage: gears that turn in air; torques at the gear's own shaft by its speed, rad/s, at least 0."""

from collections.abc import Callable

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.loss import RPM, Torque, Wheel

#: Air at 60 °C: density, kg/m³, and viscosity, mPa·s.
AIR_DENSITY, AIR_VISCOSITY = 1.06, 0.020


def dawson(wheel: Wheel, speed: Float[Array, "..."]) -> Torque:
    """Windage in free air by Dawson.

    P = n^2.9 (0.16 D^3.9 + D^2.9 b^0.75 m^1.15) 10^−20 kW with n in rpm, root diameter D, b and m in mm.

    P. H. Dawson, Proc. IMechE A 198 (1984) 51; from memory of the paper. Gears of 300 to 1160 mm.
    """
    diameter = 2e3 * wheel.root_radius
    sides = 0.16 * diameter**3.9
    teeth = diameter**2.9 * (1e3 * wheel.face_width) ** 0.75 * (1e3 * wheel.module) ** 1.15
    outside = () if 300.0 <= diameter <= 1160.0 else ("root diameter 300 to 1160 mm",)
    return Torque(1e3 / RPM * 1e-20 * (np.asarray(speed) / RPM) ** 1.9 * (sides + teeth), outside)


def anderson_loewenthal(wheel: Wheel, speed: Float[Array, "..."]) -> Torque:
    """Windage in air by Anderson & Loewenthal.

    P = 2.82e-7 (1 + 2.3 b/R) ρ^0.8 n^2.8 R^4.6 μ^0.2 kW with n in rpm, pitch radius R in m, ρ in kg/m³ and μ
    in mPa·s; of air alone, without the oil that they mix into it.

    N. E. Anderson, S. H. Loewenthal, NASA TP 1622 (1980); from memory of the report. Spur gears with solid
    bodies.
    """
    shape = (1.0 + 2.3 * wheel.face_width / wheel.pitch_radius) * wheel.pitch_radius**4.6
    air = AIR_DENSITY**0.8 * AIR_VISCOSITY**0.2
    return Torque(1e3 / RPM * 2.82e-7 * shape * air * (np.asarray(speed) / RPM) ** 1.8)


#: Methods by the names that a scenario has.
WINDAGE: dict[str, Callable[[Wheel, Float[Array, "..."]], Torque]] = {
    "dawson": dawson,
    "anderson-loewenthal": anderson_loewenthal,
}
