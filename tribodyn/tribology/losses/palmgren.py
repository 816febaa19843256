"""Friction of rolling bearings by Palmgren, as Harris gives it: M = M_0 + M_1."""

import math

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.losses.bearings import BALLS, DOUBLE, BearingInOil, BearingTorque
from tribodyn.tribology.losses.loss import RPM, OilState

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
#: f_1 of rollers; of balls c and y of c (P_0/C_0)^y: Harris, the same chapter, means of his ranges.
_ROLLER_FACTORS = {
    "cylindrical-roller": 0.0003,
    "needle-roller": 0.0003,
    "tapered-roller": 0.0004,
    "spherical-roller": 0.0004,
}
BALL_FACTORS = {
    "deep-groove-ball": (0.0005, 0.55),
    "angular-contact-ball": (0.001, 0.33),
    "four-point-contact-ball": (0.001, 0.33),
    "self-aligning-ball": (0.0003, 0.4),
}
#: ν n, mm²/s times rpm, below which the moment without load no longer depends on it.
SLOW = 2000.0


def viscous_moment(
    factor: float, mean_diameter: float, speed: Float[Array, "..."], oil: OilState
) -> Float[Array, "..."]:
    """M_0 of a bearing, N m, with f_0, d_m (m) and speed (rad/s).

    M_0 = 10^−7 f_0 (ν n)^⅔ d_m³ N mm for ν n ≥ 2000, else 160 · 10^−7 f_0 d_m³, with ν in mm²/s, n in rpm and
    d_m in mm. The printed 160 is 0.8 % more than 2000^⅔.
    """
    flow = oil.kinematic * np.asarray(speed, dtype=float) / RPM
    size = 1e-10 * factor * (1e3 * mean_diameter) ** 3
    return size * np.where(flow >= SLOW, np.maximum(flow, SLOW) ** (2.0 / 3.0), 160.0)


def static_share(
    bearing: BearingInOil, radial: Float[Array, "..."], axial: Float[Array, "..."]
) -> Float[Array, "..."]:
    """P_0/C_0; 0 where C_0 is not known."""
    if bearing.static_rating is None:
        return np.zeros(np.broadcast_shapes(np.shape(radial), np.shape(axial)))
    x, y = bearing.static_factors
    return np.maximum(x * radial + y * axial, radial) / bearing.static_rating


def rolling_load(
    bearing: BearingInOil, radial: Float[Array, "..."], axial: Float[Array, "..."]
) -> Float[Array, "..."]:
    """P_1 of balls and of rollers with a contact angle, N; at least the radial force.

    Deep groove 3 F_a − 0.1 F_r, angular contact F_a − 0.1 F_r, of two rows 1.4 F_a − 0.1 F_r, self-aligning
    1.4 Y_2 F_a − 0.1 F_r with Y_2 = 0.65 cot α; tapered rollers 2 Y F_a, Y = 0.4 cot α; spherical rollers
    1.2 Y_2 F_a, Y_2 = 0.67 cot α; other rollers F_r.
    """
    kind, thrust, less = bearing.type, 0.0, 0.0
    if kind in ("tapered-roller", "spherical-roller"):
        thrust = (0.8 if kind == "tapered-roller" else 1.2 * 0.67) / math.tan(bearing.contact_angle)
    elif kind in BALLS:
        less = 0.1
        if kind == "deep-groove-ball":
            thrust = 3.0
        elif kind == "self-aligning-ball":
            thrust = 1.4 * 0.65 / math.tan(bearing.contact_angle)
        else:
            thrust = 1.4 if bearing.both_ways or kind in DOUBLE else 1.0
    return np.maximum(thrust * np.asarray(axial) - less * np.asarray(radial), radial)


def palmgren(
    bearing: BearingInOil,
    speed: Float[Array, "..."],
    oil: OilState,
    radial: Float[Array, "..."],
    axial: Float[Array, "..."],
) -> BearingTorque:
    """M_0 (`viscous_moment`) and M_1 = f_1 P_1 d_m with `rolling_load`, f_1 of balls c (P_0/C_0)^y.

    T. A. Harris, Rolling Bearing Analysis, 4th edition, chapter 14; from memory. Rolling bearings in an oil
    bath; friction of flanges under axial load is not in it.
    """
    factor = DRAG_FACTORS[bearing.type] if bearing.drag_factor is None else bearing.drag_factor
    idle = bearing.rows * viscous_moment(factor, bearing.mean_diameter, speed, oil)
    if bearing.type in BALLS:
        scale, exponent = BALL_FACTORS[bearing.type]
        share = scale * static_share(bearing, radial, axial) ** exponent
    else:
        share = _ROLLER_FACTORS[bearing.type]
    loaded = share * rolling_load(bearing, radial, axial) * bearing.mean_diameter
    return BearingTorque(bearing.count * idle, bearing.count * loaded, without_rating(bearing, radial, axial))


def without_rating(
    bearing: BearingInOil, radial: Float[Array, "..."], axial: Float[Array, "..."]
) -> tuple[str, ...]:
    """What is to be said of balls under load whose C_0 is not known."""
    loaded = bool(np.any(np.asarray(radial) > 0.0) or np.any(np.asarray(axial) > 0.0))
    if bearing.type not in BALLS or bearing.static_rating is not None or not loaded:
        return ()
    return ("without static_rating no loss under load",)
