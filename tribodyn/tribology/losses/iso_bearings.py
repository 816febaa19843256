"""Friction of rolling bearings by ISO/TR 14179, parts 1 and 2."""

import math

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.bearings import BearingInOil, BearingTorque
from tribodyn.tribology.losses.loss import OilState
from tribodyn.tribology.losses.palmgren import (
    BALL_FACTORS,
    rolling_load,
    static_share,
    viscous_moment,
    without_rating,
)

#: ISO/TR 14179-2: f_0 in an oil bath, by type and series; the first one where none is given.
BATH_FACTORS: dict[str, dict[str, float]] = {
    "deep-groove-ball": {"": 2.0},
    "angular-contact-ball": {"": 3.3},
    "four-point-contact-ball": {"": 6.0},
    "self-aligning-ball": {"": 1.75},
    "cylindrical-roller": {"2": 2.2, "10": 2.2, "3": 2.2, "4": 2.2, "22": 3.0, "23": 4.0},
    "needle-roller": {"": 12.0},
    "tapered-roller": {"": 6.0},
    "spherical-roller": {
        **{"222": 4.0, "213": 3.5, "223": 4.5, "230": 4.5, "231": 5.5},
        **{"232": 6.0, "239": 4.5, "240": 6.5, "241": 7.0},
    },
}
#: f_1 of rollers by series; f_1, a and b of spherical rollers.
_ROLLER_FACTORS = {
    "cylindrical-roller": {
        **{"2": 0.0003, "10": 0.0002, "3": 0.00035},
        **{"4": 0.0004, "22": 0.0004, "23": 0.0004},
    },
    "needle-roller": {"": 0.002},
    "tapered-roller": {"": 0.0004},
}
_SPHERICAL = {
    "213": (0.00022, 1.35, 0.2),
    "222": (0.00015, 1.35, 0.3),
    "223": (0.00065, 1.35, 0.1),
    "230": (0.001, 1.5, -0.3),
    "231": (0.00035, 1.5, -0.1),
    "232": (0.00045, 1.5, -0.1),
    "239": (0.00025, 1.5, -0.1),
    "240": (0.0008, 1.5, -0.2),
    "241": (0.001, 1.5, -0.2),
}
#: f_1 of balls: c and y of c (P_0/C_0)^y.
_BALL_FACTORS = BALL_FACTORS | {"deep-groove-ball": (0.00075, 0.55)}
#: f_2 of the flanges of cylindrical rollers of usual design with cage, in oil.
FLANGE_FACTOR = 0.002


def iso_14179_2(
    bearing: BearingInOil,
    speed: Float[Array, "..."],
    oil: OilState,
    radial: Float[Array, "..."],
    axial: Float[Array, "..."],
) -> BearingTorque:
    """M_0 + M_1 + M_2 by ISO/TR 14179-2:2001, with the factors of SKF's general catalogue of 1989.

    M_0 as `viscous_moment` has it; M_1 = f_1 P_1^a d_m^b N mm with N and mm, a = b = 1 but for spherical
    rollers; M_2 = f_2 F_a d_m of cylindrical rollers. P_1 as `rolling_load` has it, but 1.5 F_a + 3.6 F_r of
    four points, and of spherical rollers 1.35 Y_2 F_a where Y_2 F_a > F_r, Y_2 = 0.67 cot α, else
    F_r [1 + 0.35 (Y_2 F_a/F_r)³]. Written from memory. Deep groove balls have f_1 0.0006 to 0.0009
    (P_0/C_0)^0.55 there: the mean is taken.
    """
    kind, size = bearing.type, bearing.mean_diameter
    radial, axial = np.asarray(radial, dtype=float), np.asarray(axial, dtype=float)
    series = bearing.series or next(iter(BATH_FACTORS[kind]))
    factor = BATH_FACTORS[kind].get(series, next(iter(BATH_FACTORS[kind].values())))
    idle = viscous_moment(factor if bearing.drag_factor is None else bearing.drag_factor, size, speed, oil)
    load = _rolling_load(bearing, radial, axial)
    if kind == "spherical-roller":
        scale, a, b = _SPHERICAL[series]
        loaded = 1e-3 * scale * load**a * (1e3 * size) ** b
    elif kind in _BALL_FACTORS:
        scale, exponent = _BALL_FACTORS[kind]
        loaded = scale * static_share(bearing, radial, axial) ** exponent * load * size
    else:
        factors = _ROLLER_FACTORS[kind]
        loaded = factors.get(series, next(iter(factors.values()))) * load * size
    if kind == "cylindrical-roller":
        loaded = loaded + FLANGE_FACTOR * axial * size
    exceeded = list(without_rating(bearing, radial, axial))
    if kind == "cylindrical-roller" and np.any(axial > 0.5 * radial):
        exceeded.append("F_a ≤ 0.5 F_r of cylindrical rollers")
    return BearingTorque(bearing.count * bearing.rows * idle, bearing.count * loaded, tuple(exceeded))


def _rolling_load(
    bearing: BearingInOil, radial: Float[Array, "..."], axial: Float[Array, "..."]
) -> Float[Array, "..."]:
    """P_1, N."""
    if bearing.type == "four-point-contact-ball":
        return np.maximum(1.5 * axial + 3.6 * radial, radial)
    if bearing.type != "spherical-roller":
        return rolling_load(bearing, radial, axial)
    thrust = 0.67 / math.tan(bearing.contact_angle) * axial
    ratio = thrust / np.maximum(radial, 1e-300)
    return np.where(ratio > 1.0, 1.35 * thrust, radial * (1.0 + 0.35 * np.minimum(ratio, 1.0) ** 3))


#: ISO/TR 14179-1: coefficients of friction f_b by type.
FRICTION_COEFFICIENTS = {
    "deep-groove-ball": 0.0015,
    "angular-contact-ball": 0.0013,
    "four-point-contact-ball": 0.0013,  # as angular contact
    "self-aligning-ball": 0.0010,
    "cylindrical-roller": 0.0011,
    "needle-roller": 0.0025,  # with cage; 0.0045 without
    "tapered-roller": 0.0018,
    "spherical-roller": 0.0018,
}


def iso_14179_1(
    bearing: BearingInOil,
    speed: Float[Array, "..."],
    oil: OilState,
    radial: Float[Array, "..."],
    axial: Float[Array, "..."],
) -> BearingTorque:
    """T_b = f_b W d_b/2 and M_0 by ISO/TR 14179-1:2001 (AGMA's method); from memory.

    W is the force on the bearing, √(F_r² + F_a²), d_b its bore. M_0 is `viscous_moment` with f_0 of part 2
    (the part's own table is not at hand).
    """
    bore = bearing.bore if bearing.bore is not None else 0.0
    force = np.hypot(radial, axial)
    loaded = 0.5 * FRICTION_COEFFICIENTS[bearing.type] * force * bore
    idle = iso_14179_2(bearing, speed, oil, 0.0 * force, 0.0 * force).idle
    return BearingTorque(idle, bearing.count * loaded)
