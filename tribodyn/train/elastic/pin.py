"""Planet pins as beams of round section, with shear: how stiff the middle of a planet is on one."""

from math import pi
from typing import Literal, NamedTuple

Mounting = Literal["cantilever", "straddle"]


class Pin(NamedTuple):
    """A pin whose ends are clamped in the carrier, one of a cantilever, both of a straddle-mounted one."""

    mounting: Mounting
    diameter: float  # m
    length: float  # free: from the carrier to the planet's middle, or between both plates of the carrier, m
    bore: float  # diameter, m; 0: solid
    youngs_modulus: float  # Pa
    poisson_ratio: float


def pin_stiffness(pin: Pin) -> float:
    """Force over displacement at the planet's middle, N/m, in every direction across the pin.

    Cantilever: 1/k = L³/(3 E I) + L/(κ G A); straddle, in the middle: L³/(192 E I) + L/(4 κ G A). κ of a
    circle is 6 (1 + ν)/(7 + 6 ν), of a ring Cowper's (J. Appl. Mech. 33 (1966) 335).
    """
    ratio, nu = (pin.bore / pin.diameter) ** 2, pin.poisson_ratio
    area = pi / 4.0 * pin.diameter**2 * (1.0 - ratio)
    moment = pi / 64.0 * pin.diameter**4 * (1.0 - ratio**2)
    both = (2.0 * pin.bore * pin.diameter / (pin.bore**2 + pin.diameter**2)) ** 2
    # m of Cowper is inner over outer radius: (1 + m²)² / … by both = 4 m²/(1 + m²)²
    factor = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu + (5.0 + 3.0 * nu) * both)
    sheared = factor * pin.youngs_modulus / (2.0 * (1.0 + nu)) * area
    bending, shear = (3.0, 1.0) if pin.mounting == "cantilever" else (192.0, 4.0)
    return 1.0 / (pin.length**3 / (bending * pin.youngs_modulus * moment) + pin.length / (shear * sheared))
