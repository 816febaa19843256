"""Windage: gears that turn in air; torques at the gear's own shaft by its speed, rad/s, at least 0."""

from collections.abc import Callable

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.loss import RPM, OilState, Torque, Wheel


def dawson(wheel: Wheel, speed: Float[Array, "..."], _oil: OilState) -> Torque:
    """Windage in free air by Dawson.

    P = n^2.9 (0.16 D^3.9 + D^2.9 b^0.75 m^1.15) 10^−20 kW with n in rpm, root diameter D, b and m in mm.

    P. H. Dawson, Proc. IMechE A 198 (1984) 51; from memory of the paper. Gears of 300 to 1160 mm.
    """
    diameter = 2e3 * wheel.root_radius
    sides = 0.16 * diameter**3.9
    teeth = diameter**2.9 * (1e3 * wheel.face_width) ** 0.75 * (1e3 * wheel.module) ** 1.15
    outside = () if 300.0 <= diameter <= 1160.0 else ("root diameter 300 to 1160 mm",)
    return Torque(1e3 / RPM * 1e-20 * (np.asarray(speed) / RPM) ** 1.9 * (sides + teeth), outside)


def anderson_loewenthal(wheel: Wheel, speed: Float[Array, "..."], oil: OilState) -> Torque:
    """Windage in a mist of oil by Anderson & Loewenthal.

    P = 2.82e-7 (1 + 2.3 b/R) n^2.8 R^4.6 (0.028 μ + 0.019)^0.2 kW with n in rpm, pitch radius R in m and the
    oil's viscosity μ in mPa·s; the constant holds 34.25 parts of air to one of oil by volume.

    N. E. Anderson, S. H. Loewenthal, NASA TP 1622 (1980); from memory of the report. Spur gears with solid
    bodies.
    """
    shape = (1.0 + 2.3 * wheel.face_width / wheel.pitch_radius) * wheel.pitch_radius**4.6
    mist = (0.028 * 1e3 * np.asarray(oil.viscosity) + 0.019) ** 0.2
    return Torque(1e3 / RPM * 2.82e-7 * shape * mist * (np.asarray(speed) / RPM) ** 1.8)


#: Methods by the names that a scenario has.
WINDAGE: dict[str, Callable[[Wheel, Float[Array, "..."], OilState], Torque]] = {
    "dawson": dawson,
    "anderson-loewenthal": anderson_loewenthal,
}
