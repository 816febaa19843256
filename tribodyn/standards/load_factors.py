"""Load factors by ISO 6336-1:2019: K_v by method B (clause 6); K_Hα from calculated loads and by method B."""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Ends of the ranges of the resonance ratio: main resonance, supercritical.
_MAIN, _SUPERCRITICAL = 1.15, 1.5
#: F_t K_A/b below which the main resonance begins earlier, N/m.
_LOW_LOAD = 100e3
#: Grade by ISO 1328-1 from which tip relief is not credited: B_k = 1.
_UNCREDITED = 6.0


class DynamicMesh(NamedTuple):
    """What K_v depends on."""

    pinion_teeth: float
    pinion_speed: float  # rad/s
    reduced_mass: float  # m_red per face width along the line of action, see `reduced_mass`, kg/m
    #: single_stiffness, mesh_stiffness: c' and c_γα per face width, Pa (1 N/(mm µm) is 1 GPa)
    single_stiffness: float
    mesh_stiffness: float
    line_load: float  # F_t K_A/b, N/m
    #: pitch_deviation, profile_deviation: f_pb and f_fα, m, of the gear that has the larger ones; running-in
    #: is taken off here
    pitch_deviation: float
    profile_deviation: float
    total_contact_ratio: float  # ε_γ
    tip_relief: float  # C_a, m; of unmodified gears that of running in, `run_in_relief`
    quality: float  # grade by ISO 1328-1 of the coarser gear
    #: y_p = y_f over the deviation: 0.075 of case-hardened and nitrided gears, at most 3 µm
    run_in: float = 0.075


class DynamicFactor(NamedTuple):
    """K_v and where it is from."""

    factor: float
    resonance_ratio: float  # N, speed over resonance speed
    resonance_speed: float  # n_E1, rad/s of the pinion
    range: str  # "subcritical", "main resonance", "intermediate" or "supercritical"


def reduced_mass(inertias: tuple[float, float], base_radii: tuple[float, float], face_width: float) -> float:
    """m_red = J*_1 J*_2/(J*_1 r_b2² + J*_2 r_b1²) per face width, kg/m: (7), J of the bodies in kg m²."""
    (first, second), (pinion, gear) = inertias, base_radii
    return first * second / (first * gear**2 + second * pinion**2) / face_width


def resonance_speed(pinion_teeth: float, mesh_stiffness: float, mass: float) -> float:
    """Resonance speed of the pinion n_E1, rad/s: √(c_γα/m_red)/z_1, (6)."""
    return math.sqrt(mesh_stiffness / mass) / pinion_teeth


def run_in_relief(allowable_stress: float) -> float:
    """C_ay = (σ_Hlim/97 − 18.45)²/18 + 1.5, µm for N/mm²; given in Pa, returned in m: table 4."""
    return 1e-6 * ((1e-6 * allowable_stress / 97.0 - 18.45) ** 2 / 18.0 + 1.5)


def coefficients(total_contact_ratio: float) -> tuple[float, float, float, float, float, float, float]:
    """C_v1 to C_v7 over ε_γ: table 4."""
    total = total_contact_ratio
    c2, c3, c4, c6 = 0.34, 0.23, 0.90, 0.47
    if total > 2.0:
        c2, c3 = 0.57 / (total - 0.3), 0.096 / (total - 1.56)
        c4, c6 = (0.57 - 0.05 * total) / (total - 1.44), 0.12 / (total - 1.74)
    if total <= 1.5:
        last = 0.75
    else:
        last = 0.125 * math.sin(math.pi * (total - 2.0)) + 0.875 if total <= 2.5 else 1.0
    return 0.32, c2, c3, c4, 0.47, c6, last


def dynamic_factor(mesh: DynamicMesh) -> DynamicFactor:
    """K_v by the range of the resonance ratio N: (9) to (22).

    Subcritical (N ≤ N_S) 1 + N (C_v1 B_p + C_v2 B_f + C_v3 B_k), main resonance (up to 1.15)
    1 + C_v1 B_p + C_v2 B_f + C_v4 B_k, supercritical (from 1.5) C_v5 B_p + C_v6 B_f + C_v7, linear between;
    never below 1. B_p and B_f are c' (f − y)/(F_t K_A/b), B_k = |1 − c' C_a/(F_t K_A/b)|, 1 from grade 6 on.
    """
    speed = resonance_speed(mesh.pinion_teeth, mesh.mesh_stiffness, mesh.reduced_mass)
    ratio = mesh.pinion_speed / speed
    deflection = mesh.line_load / mesh.single_stiffness
    pitch, profile = (
        (deviation - min(mesh.run_in * deviation, 3e-6)) / deflection
        for deviation in (mesh.pitch_deviation, mesh.profile_deviation)
    )
    relief = 1.0 if mesh.quality >= _UNCREDITED else abs(1.0 - mesh.tip_relief / deflection)
    c1, c2, c3, c4, c5, c6, c7 = coefficients(mesh.total_contact_ratio)
    low = min(mesh.line_load / _LOW_LOAD, 1.0)
    lower = 0.85 if low >= 1.0 else 0.5 + 0.35 * math.sqrt(low)
    main = c1 * pitch + c2 * profile + c4 * relief + 1.0
    beyond = c5 * pitch + c6 * profile + c7
    if ratio <= lower:
        found, name = ratio * (c1 * pitch + c2 * profile + c3 * relief) + 1.0, "subcritical"
    elif ratio <= _MAIN:
        found, name = main, "main resonance"
    elif ratio < _SUPERCRITICAL:
        share = (_SUPERCRITICAL - ratio) / (_SUPERCRITICAL - _MAIN)
        found, name = beyond + (main - beyond) * share, "intermediate"
    else:
        found, name = beyond, "supercritical"
    return DynamicFactor(max(found, 1.0), ratio, speed, name)


def transverse_load_factor(load: float, accurate_load: float) -> float:
    """K_Hα: maximum load of a tooth over that of the same gears without deviations, at least 1: clause 8.

    It is 1 where the deviations raise no tooth's load, and for gears without deviations, whose modifications
    stay. Both loads are those of `shared_load`: in the middle of the path of spur gears with ε_α < 2 one pair
    carries everything, with deviations as without, and the ratio of the maxima over the whole path would
    always be 1. It is at most the whole load over `accurate_load`, reached where deviations leave one pair.
    """
    return max(1.0, load / accurate_load)


def shared_load(
    load: Float[Array, "position pair"], roll: Float[Array, "position pair"], limits: tuple[float, float]
) -> float:
    """Maximum load of a pair, N, over the positions at which two pairs or more are on their path of contact.

    The limits are the roll angles (rad) of the path's ends without load. NaN where there is no such position.
    """
    first, last = limits
    room = 1e-9 * (last - first)
    together = np.sum((roll >= first - room) & (roll <= last + room), axis=1) >= 2
    return float(np.max(load[together])) if np.any(together) else float("nan")


def transverse_factor_b(
    contact_ratios: tuple[float, float], mesh_stiffness: float, pitch_deviation: float, line_load: float
) -> float:
    """K_Hα by method B: 1 where the deflection exceeds the deviations by far: (73) to (77).

    0.9 + 0.4 c_γα (f_pb − y_α)/(F_tH/b), times ε_γ/2 up to ε_γ = 2, the second term times √(2 (ε_γ − 1)/ε_γ)
    above; at least 1, at most ε_γ/(ε_α Z_ε²). Of (ε_α, ε_β), c_γα per face width (Pa), f_pb − y_α (m) and
    F_tH/b = F_t K_A K_v K_Hβ/b (N/m).
    """
    transverse, overlap = contact_ratios
    total = transverse + overlap
    excess = 0.4 * mesh_stiffness * pitch_deviation / line_load
    if total <= 2.0:
        factor = total / 2.0 * (0.9 + excess)
    else:
        factor = 0.9 + excess * float(np.sqrt(2.0 * (total - 1.0) / total))
    part = min(overlap, 1.0)
    squared = (4.0 - transverse) / 3.0 * (1.0 - part) + part / transverse
    return float(min(max(factor, 1.0), max(total / (transverse * squared), 1.0)))
