"""Rating life of rolling bearings by ISO 281 and ISO/TS 16281.

Formulas of the modified and of the reference life are written from knowledge, without the standards at hand.

Bearings are named by type, as in `EXPONENTS`; loads and ratings are those of the whole bearing or pair.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

BALLS = ("deep-groove-ball", "angular-contact-ball", "four-point-contact-ball", "self-aligning-ball")
ROLLERS = (
    *("cylindrical-roller", "needle-roller", "tapered-roller"),
    *("spherical-roller", "toroidal-roller"),
)
#: ISO 281: exponent of the life, of point and of line contact.
EXPONENTS = dict.fromkeys(BALLS, 3.0) | dict.fromkeys(ROLLERS, 10.0 / 3.0)
#: Those that carry radial load alone.
_RADIAL = ("cylindrical-roller", "needle-roller", "toroidal-roller")
#: Those whose two rows share a radial load.
_TWO_ROWS = ("self-aligning-ball", "spherical-roller", "four-point-contact-ball")
#: ISO 281, table 3, deep groove ball bearings: f_0 F_a/C_0, e and Y; X is 0.56 beyond e.
_RELATIVE_LOAD = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
_E = (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
_Y = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
#: f_0 of deep groove ball bearings of usual sizes: ISO 76 has 12 to 16.
STATIC_FACTOR = 14.0
#: ISO 281, table 3, angular contact ball bearings, one row: contact angle, degrees, X and Y; Y of 10° and 15°
#: by i f_0 F_a/C_0 times cos α, at the relative loads above.
_ANGLES = (10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0)
_ANGULAR_X = (0.46, 0.44, 0.43, 0.41, 0.39, 0.37, 0.35, 0.33)
_ANGULAR_Y = (
    (1.88, 1.71, 1.52, 1.41, 1.34, 1.23, 1.10, 1.01, 1.00),
    (1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00),
    *((y,) * 9 for y in (1.00, 0.87, 0.76, 0.66, 0.57, 0.50)),
)
#: ISO 76, the same: Y_0 of one row, whose X_0 is 0.5.
_STATIC_Y = (0.50, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22)


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
    rows: int = 1,
) -> Equivalent:
    """P = X F_r + Y F_a, ISO 281:2007, tables 3 and 7; loads ≥ 0, N; α in rad.

    Deep groove ball bearings go by f_0 F_a/C_0, linear between the values of the table and constant beyond
    them; without C_0 they are taken at its lower end, where Y is largest: P is not too small then. So do
    angular contact ones below 20°; linear between the angles of the table. Tapered ones have e = 1.5 tan α,
    X = 0.4 and Y = 0.4 cot α. Two rows that take thrust both ways (`rows` = 2: O or X; spherical,
    self-aligning and four-point contact ones always) have 2^0.7 times X and Y of one ball row, and
    Y_1 = Y_2 − (1 − X_2)/e up to e: the table within its rounding; rollers X = 0.67, Y = 0.67 cot α and
    Y_1 = 0.45 cot α, self-aligning balls 0.65 and 0.42. What carries F_r alone has P = F_r.
    """
    if kind in _RADIAL:
        return Equivalent(radial, 1.0, 0.0, math.inf)
    rows = 2 if kind in _TWO_ROWS else rows
    relative = 0.0 if static_rating is None else static_factor * axial / static_rating
    up_to = 0.0
    if kind == "deep-groove-ball":
        limit = float(np.interp(relative, _RELATIVE_LOAD, _E))
        factors = (0.56, float(np.interp(relative, _RELATIVE_LOAD, _Y)))
    elif kind in ("angular-contact-ball", "four-point-contact-ball"):
        at = rows * relative * math.cos(contact_angle), math.degrees(contact_angle)
        x = float(np.interp(at[1], _ANGLES, _ANGULAR_X))
        y = float(np.interp(at[1], _ANGLES, [np.interp(at[0], _RELATIVE_LOAD, each) for each in _ANGULAR_Y]))
        limit = (1.0 - x) / y
        factors = (x, y) if rows == 1 else (2.0**0.7 * x, 2.0**0.7 * y)
        up_to = 0.0 if rows == 1 else factors[1] - (1.0 - factors[0]) / limit
    else:
        slope = math.tan(contact_angle)
        limit = 1.5 * slope
        share, up_to = (0.65, 0.42 / slope) if kind == "self-aligning-ball" else (0.67, 0.45 / slope)
        if rows == 1:
            share, up_to = 0.4, 0.0
        factors = (share, share / slope)
    if axial <= limit * radial:
        factors = (1.0, up_to)
    return Equivalent(factors[0] * radial + factors[1] * axial, *factors, limit)


def static_factors(kind: str, *, contact_angle: float = 0.0, rows: int = 1) -> tuple[float, float]:
    """X_0 and Y_0 of P_0 = max(X_0 F_r + Y_0 F_a, F_r), ISO 76:2006, tables 2 and 3; α in rad.

    Deep groove balls 0.6 and 0.5; angular contact 0.5 and Y_0 by α, other types with a contact angle 0.5 and
    0.22 cot α; both doubled of two rows that take thrust both ways; what carries F_r alone 1 and 0.
    """
    if kind in _RADIAL:
        return 1.0, 0.0
    rows = 2 if kind in _TWO_ROWS else rows
    if kind == "deep-groove-ball":
        return 0.6, 0.5
    if kind in ("angular-contact-ball", "four-point-contact-ball"):
        return 0.5 * rows, rows * float(np.interp(math.degrees(contact_angle), _ANGLES, _STATIC_Y))
    return 0.5 * rows, rows * 0.22 / math.tan(contact_angle)


def static_load(
    kind: str, radial: float, axial: float, *, contact_angle: float = 0.0, rows: int = 1
) -> float:
    """P_0 by `static_factors`, N; loads ≥ 0, N."""
    x, y = static_factors(kind, contact_angle=contact_angle, rows=rows)
    return max(x * radial + y * axial, radial)


def basic_life(kind: str, dynamic_rating: float, load: float) -> float:
    """L_10 = (C/P)^p 10⁶, revolutions that 90 % of bearings reach; infinite without load."""
    return 1e6 * (dynamic_rating / load) ** EXPONENTS[kind] if load > 0.0 else math.inf


def running_time(revolutions: float, speed: float) -> float:
    """Time that so many revolutions take at a speed (rad/s, > 0), s: L_10h of L_10."""
    return revolutions * 2.0 * math.pi / speed


#: ISO 281:2007, annex A: filtered circulating oil by the code of ISO 4406 (beside it β of its filter): a, b
#: of e_C = min(a κ^0.68 D_pw^0.55, 1) (1 − b/D_pw^⅓), D_pw in mm.
CLEANLINESS = {
    "-/13/10": (0.0864, 0.5663),  # β_6(c) = 200
    "-/15/12": (0.0432, 0.9987),  # β_12(c) = 200
    "-/17/14": (0.0288, 1.6329),  # β_25(c) = 75
    "-/19/16": (0.0216, 2.3362),  # β_40(c) = 75
}


def reference_viscosity(pitch_diameter: float, speed: float) -> float:
    """ν_1, m²/s, that a bearing of pitch diameter D_pw (m) needs at a speed (rad/s): ISO 281:2007, 9.3.3.2.

    45 000 n^−0.83 D_pw^−0.5 mm²/s below 1000 rpm, 4500 n^−0.5 D_pw^−0.5 from there on; n in rpm, D_pw in mm.
    """
    turns, size = 30.0 * speed / math.pi, 1e3 * pitch_diameter
    by_speed = 45000.0 * turns**-0.83 if turns < 1000.0 else 4500.0 * turns**-0.5
    return 1e-6 * by_speed / math.sqrt(size)


def contamination_factor(viscosity_ratio: float, pitch_diameter: float, cleanliness: str) -> float:
    """e_C, 0 to 1, of circulating oil filtered in line, by its code of ISO 4406: ISO 281:2007, annex A."""
    factor, loss = CLEANLINESS[cleanliness]
    size = 1e3 * pitch_diameter
    filled = min(factor * viscosity_ratio**0.68 * size**0.55, 1.0)
    return max(filled * (1.0 - loss / size ** (1.0 / 3.0)), 0.0)


def fatigue_load_limit(kind: str, static_rating: float, pitch_diameter: float) -> float:
    """C_u, N, from C_0: ISO 281:2007, B.3.3 (simplified); catalogues have it of each bearing.

    C_0/22 of balls, C_0/8.2 of rollers; beyond D_pw = 100 mm times (100/D_pw)^0.5 and ^0.3.
    """
    share, exponent = (22.0, 0.5) if kind in BALLS else (8.2, 0.3)
    return static_rating / share * min(0.1 / pitch_diameter, 1.0) ** exponent


def life_factor(kind: str, viscosity_ratio: float, relative_limit: float) -> float:
    """a_ISO of a radial bearing, from κ = ν/ν_1 and e_C C_u/P: ISO 281:2007, equations (31) to (36).

    Balls 0.1 [1 − (2.5671 − c/κ^e)^0.83 (e_C C_u/P)^⅓]^−9.3, rollers 0.1 [1 − (1.5859 − c/κ^e)
    (e_C C_u/P)^0.4]^−9.185, at most 50. κ counts up to 4; below 0.1 the standard has none: 0.1 is taken.
    """
    ratio = min(max(viscosity_ratio, 0.1), 4.0)
    place = 0 if ratio < 0.4 else 1 if ratio < 1.0 else 2
    power = ratio ** (0.054381, 0.19087, 0.071739)[place]
    if kind in BALLS:
        film = max(2.5671 - (2.2649, 1.9987, 1.9987)[place] / power, 0.0) ** 0.83
        rest, exponent = 1.0 - film * relative_limit ** (1.0 / 3.0), -9.3
    else:
        film = max(1.5859 - (1.3993, 1.2348, 1.2348)[place] / power, 0.0)
        rest, exponent = 1.0 - film * relative_limit**0.4, -9.185
    return min(0.1 * rest**exponent, 50.0) if rest > 0.0 else 50.0


def reference_life_of_balls(
    loads: Sequence[float],
    dynamic_rating: float,
    ball_diameter: float,
    pitch_diameter: float,
    contact_angle: float = 0.0,
    conformity: float = 0.52,
    outer_conformity: float | None = None,
) -> float:
    """L_10r, revolutions, from the loads of all balls of a row (N): ISO/TS 16281:2008, 4.3; infinite of none.

    [(Q_ci/Q_ei)^(−10/3) + (Q_ce/Q_ee)^(−10/3)]^(−9/10) 10⁶ with Q_ei = (Σ Q³/Z)^⅓ and
    Q_ee = (Σ Q^(10/3)/Z)^0.3 of an inner ring that turns under a standing load, and the ratings of the
    raceways by C. Conformity is the groove's radius over the ball's diameter; absent, the outer groove's is
    that of the inner one.
    """
    load = np.asarray(loads, dtype=float)
    if not np.any(load):
        return math.inf
    gamma = ball_diameter * math.cos(contact_angle) / pitch_diameter
    inner_groove, outer_groove = conformity, outer_conformity or conformity
    grooves = inner_groove / outer_groove * (2.0 * outer_groove - 1.0) / (2.0 * inner_groove - 1.0)
    raceways = 1.044 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * grooves**0.41
    each = dynamic_rating / (len(load) * math.cos(contact_angle) ** 0.7)
    inner = each / 0.407 * (1.0 + raceways ** (10.0 / 3.0)) ** 0.3
    outer = each / 0.389 * (1.0 + raceways ** (-10.0 / 3.0)) ** 0.3
    on_inner = float(np.mean(load**3)) ** (1.0 / 3.0)
    on_outer = float(np.mean(load ** (10.0 / 3.0))) ** 0.3
    return 1e6 * ((on_inner / inner) ** (10.0 / 3.0) + (on_outer / outer) ** (10.0 / 3.0)) ** -0.9


def reference_life_of_rollers(
    loads: Sequence[Sequence[float]],
    dynamic_rating: float,
    roller_diameter: float,
    pitch_diameter: float,
    contact_angle: float = 0.0,
) -> float:
    """L_10r, revolutions, from the loads (N) of the slices of all rollers of a row: ISO/TS 16281:2008, 5.3.

    {Σ_k [(q_kci/q_kei)^(−9/2) + (q_kce/q_kee)^(−9/2)]}^(−8/9) 10⁶ over the slices, with the mean loads of
    exponents 4 and 4.5 and the ratings of the raceways by C, λ ν = 0.83; slices near the ends count more,
    1 − 0.01/ln(1.985 |k − middle|/count) as of a profiled roller. Infinite without load.
    """
    load = np.asarray([np.asarray(each, dtype=float) for each in loads])
    if not np.any(load):
        return math.inf
    elements, slices = load.shape
    gamma = roller_diameter * math.cos(contact_angle) / pitch_diameter
    raceways = 1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    each = dynamic_rating / (0.83 * elements * math.cos(contact_angle)) * (1.0 / slices) ** (7.0 / 9.0)
    inner = each / 0.378 * (1.0 + raceways**4.5) ** (2.0 / 9.0)
    outer = each / 0.364 * (1.0 + raceways**-4.5) ** (2.0 / 9.0)
    away = np.abs(np.arange(slices) - (slices - 1) / 2.0) / slices
    concentrated = load * (1.0 - 0.01 / np.log(1.985 * np.where(away > 0.0, away, 0.5 / slices)))
    on_inner = np.mean(concentrated**4, axis=0) ** 0.25
    on_outer = np.mean(concentrated**4.5, axis=0) ** (2.0 / 9.0)
    return 1e6 * float(np.sum((on_inner / inner) ** 4.5 + (on_outer / outer) ** 4.5)) ** (-8.0 / 9.0)


def row_rating(kind: str, dynamic_rating: float, rows: int) -> float:
    """C of one of so many rows from that of all: ISO 281, C ~ i^0.7 of balls, i^(7/9) of rollers."""
    return dynamic_rating / rows ** (0.7 if kind in BALLS else 7.0 / 9.0)


def life_of_rows(kind: str, lives: Sequence[float]) -> float:
    """Life of rows that turn together: L^−e = Σ L_row^−e, e = 10/9 of balls, 9/8 of rollers."""
    slope = 10.0 / 9.0 if kind in BALLS else 9.0 / 8.0
    failing = sum(life**-slope for life in lives if life < math.inf)
    return float(failing ** (-1.0 / slope)) if failing > 0.0 else math.inf
