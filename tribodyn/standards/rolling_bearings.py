"""Rating life of rolling bearings by ISO 281 and ISO/TS 16281, and Palmgren's friction moment of the load.

Formulas of the modified and of the reference life are written from knowledge, without the standards at hand.

Bearings are named "deep-groove-ball", "cylindrical-roller" and "tapered-roller".
"""

import math
from collections.abc import Sequence
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
    share, exponent = (22.0, 0.5) if kind == "deep-groove-ball" else (8.2, 0.3)
    return static_rating / share * min(0.1 / pitch_diameter, 1.0) ** exponent


def life_factor(kind: str, viscosity_ratio: float, relative_limit: float) -> float:
    """a_ISO of a radial bearing, from κ = ν/ν_1 and e_C C_u/P: ISO 281:2007, equations (31) to (36).

    Balls 0.1 [1 − (2.5671 − c/κ^e)^0.83 (e_C C_u/P)^⅓]^−9.3, rollers 0.1 [1 − (1.5859 − c/κ^e)
    (e_C C_u/P)^0.4]^−9.185, at most 50. κ counts up to 4; below 0.1 the standard has none: 0.1 is taken.
    """
    ratio = min(max(viscosity_ratio, 0.1), 4.0)
    place = 0 if ratio < 0.4 else 1 if ratio < 1.0 else 2
    power = ratio ** (0.054381, 0.19087, 0.071739)[place]
    if kind == "deep-groove-ball":
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
) -> float:
    """L_10r, revolutions, from the loads of all balls (N): ISO/TS 16281:2008, 4.3; infinite without load.

    [(Q_ci/Q_ei)^(−10/3) + (Q_ce/Q_ee)^(−10/3)]^(−9/10) 10⁶ with Q_ei = (Σ Q³/Z)^⅓ and
    Q_ee = (Σ Q^(10/3)/Z)^0.3 of an inner ring that turns under a standing load, and the ratings of the
    raceways by C; both grooves of one conformity (radius over ball diameter).
    """
    load = np.asarray(loads, dtype=float)
    if not np.any(load):
        return math.inf
    gamma = ball_diameter * math.cos(contact_angle) / pitch_diameter
    raceways = 1.044 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72  # equal grooves: times 1^0.41
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
    """L_10r, revolutions, from the loads (N) of the slices of all rollers: ISO/TS 16281:2008, 5.3.

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
