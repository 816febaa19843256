"""Rating life of rolling bearings by ISO 281, and the friction moment of their load by Palmgren.

Bearings are named "deep-groove-ball", "cylindrical-roller" and "tapered-roller".
"""

import math
from typing import NamedTuple

import numpy as np

#: ISO 281: exponent of the life, of point and of line contact.
EXPONENTS = {"deep-groove-ball": 3.0, "cylindrical-roller": 10.0 / 3.0, "tapered-roller": 10.0 / 3.0}
#: ISO 281, table 3, deep groove ball bearings: f_0 F_a/C_0, e and Y; X is 0.56 beyond e.
_RELATIVE_LOAD = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
_E = (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
_Y = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
#: f_0 of deep groove ball bearings of usual sizes: ISO 76 has 12 to 16.
STATIC_FACTOR = 14.0


class Equivalent(NamedTuple):
    """Equivalent dynamic load of a bearing, N, with X, Y and e of it."""

    load: float
    radial_factor: float
    axial_factor: float
    limit: float  # e: ratio F_a/F_r up to which axial load does not count


def equivalent_load(
    kind: str,
    radial: float,
    axial: float,
    *,
    static_rating: float | None = None,
    static_factor: float = STATIC_FACTOR,
    contact_angle: float = 0.0,
) -> Equivalent:
    """P = X F_r + Y F_a of a single-row bearing, ISO 281:2007, tables 3 and 7; loads ≥ 0, N.

    Deep groove ball bearings go by f_0 F_a/C_0, linear between the values of the table and constant beyond
    them; without C_0 they are taken at its lower end, where Y is largest: P is not too small then. Tapered
    ones have e = 1.5 tan α, X = 0.4 and Y = 0.4 cot α. Cylindrical ones carry F_r alone.
    """
    if kind == "cylindrical-roller":
        return Equivalent(radial, 1.0, 0.0, math.inf)
    if kind == "tapered-roller":
        limit = 1.5 * math.tan(contact_angle)
        factors = (0.4, 0.4 / math.tan(contact_angle))
    else:
        relative = 0.0 if static_rating is None else static_factor * axial / static_rating
        limit = float(np.interp(relative, _RELATIVE_LOAD, _E))
        factors = (0.56, float(np.interp(relative, _RELATIVE_LOAD, _Y)))
    if axial <= limit * radial:
        factors = (1.0, 0.0)
    return Equivalent(factors[0] * radial + factors[1] * axial, *factors, limit)


def basic_life(kind: str, dynamic_rating: float, load: float) -> float:
    """L_10 = (C/P)^p 10⁶, revolutions that 90 % of bearings reach; infinite without load."""
    return 1e6 * (dynamic_rating / load) ** EXPONENTS[kind] if load > 0.0 else math.inf


def running_time(revolutions: float, speed: float) -> float:
    """Time that so many revolutions take at a speed (rad/s, > 0), s: L_10h of L_10."""
    return revolutions * 2.0 * math.pi / speed


def load_moment(
    kind: str,
    radial: float,
    axial: float,
    mean_diameter: float,
    *,
    static_rating: float | None = None,
    contact_angle: float = 0.0,
) -> float | None:
    """M_1 = f_1 P_1 d_m, N m, by Palmgren, f_1 and P_1 as Harris gives them (chapter 14; from memory).

    Deep groove ball bearings: f_1 = 0.0005 (P_0/C_0)^0.55 with P_0 = max(0.6 F_r + 0.5 F_a, F_r) of ISO 76,
    and P_1 = max(3 F_a − 0.1 F_r, F_r); None without C_0. Cylindrical rollers with cage: f_1 = 0.0003,
    P_1 = F_r. Tapered rollers: f_1 = 0.0004, P_1 = max(2 Y F_a, F_r), Y = 0.4 cot α. Flange friction of
    cylindrical rollers under axial load is not in it.
    """
    if kind == "cylindrical-roller":
        return 0.0003 * radial * mean_diameter
    if kind == "tapered-roller":
        return 0.0004 * max(0.8 / math.tan(contact_angle) * axial, radial) * mean_diameter
    if static_rating is None:
        return None
    static = max(0.6 * radial + 0.5 * axial, radial)
    return 0.0005 * (static / static_rating) ** 0.55 * max(3.0 * axial - 0.1 * radial, radial) * mean_diameter
