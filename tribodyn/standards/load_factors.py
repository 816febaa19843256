"""Load factors by ISO 6336-1:2019: K_v by method B (clause 6); K_Hα from calculated loads and by method B."""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards.metals import SURFACE_HARDENED, Treatment

#: Ends of the ranges of the resonance ratio: main resonance, supercritical.
_MAIN, _SUPERCRITICAL = 1.15, 1.5
#: F_t K_A/b below which the main resonance begins earlier, N/m.
_LOW_LOAD = 100e3
#: Grade by ISO 1328-1 from which tip relief is not credited: B_k = 1.
_UNCREDITED = 6.0


class FlankRunIn(NamedTuple):
    """How much of a deviation running in takes off one gear's flanks."""

    share: float  # y over the deviation
    most: float = math.inf  # m

    def of(self, deviation: float) -> float:
        """Running-in allowance y of a deviation, m."""
        return min(self.share * deviation, self.most)


#: y_α = 0.075 f_pb ≤ 3 µm of case-hardened, induction-hardened and nitrided gears.
_HARD_FLANK = FlankRunIn(0.075, 3e-6)


def running_in(treatment: Treatment | None, contact_limit: float, speed: float) -> FlankRunIn:
    """y_α of f_pb, and y_f of f_fα, of one gear: ISO 6336-1:2019, (77) to (79), from memory.

    Structural and through-hardened steel and ductile iron (taken as pearlitic) 160 N/mm²/σ_Hlim, grey iron
    0.275, surface-hardened steel 0.075 up to 3 µm. The former two are limited by what f_pb = 80 µm gives
    where the pitch line (m/s) runs above 5 m/s, 40 µm above 10 m/s. None, unknown: as surface-hardened.
    """
    if treatment is None or treatment in SURFACE_HARDENED:
        return _HARD_FLANK
    share = 0.275 if treatment == "grey-iron" else min(160e6 / contact_limit, 1.0)
    widest = math.inf if speed <= 5.0 else 80e-6 if speed <= 10.0 else 40e-6
    return FlankRunIn(share, share * widest)


def helix_running_in(treatment: Treatment | None, contact_limit: float, speed: float) -> FlankRunIn:
    """y_β of F_βx of one gear: ISO 6336-1:2019, (46) to (51): twice y_α and its limits, from memory."""
    profile = running_in(treatment, contact_limit, speed)
    return FlankRunIn(min(2.0 * profile.share, 1.0), 2.0 * profile.most)


def run_in(deviation: float, gears: tuple[FlankRunIn, FlankRunIn]) -> float:
    """Running-in allowance of a pair, m: the mean of both gears'."""
    return (gears[0].of(deviation) + gears[1].of(deviation)) / 2.0


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
    run_in: tuple[FlankRunIn, FlankRunIn] = (_HARD_FLANK, _HARD_FLANK)  # of pinion and gear: y_p and y_f


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
    never below 1. B_p and B_f are c' (f − y)/(F_t K_A/b), B_k abs(1 − c' C_a/(F_t K_A/b)), 1 from grade 6 on.
    """
    speed = resonance_speed(mesh.pinion_teeth, mesh.mesh_stiffness, mesh.reduced_mass)
    ratio = mesh.pinion_speed / speed
    deflection = mesh.line_load / mesh.single_stiffness
    pitch, profile = (
        (deviation - run_in(deviation, mesh.run_in)) / deflection
        for deviation in (mesh.pitch_deviation, mesh.profile_deviation)
    )
    relief = 1.0 if mesh.quality >= _UNCREDITED else abs(1.0 - mesh.tip_relief / deflection)
    c1, c2, c3, c4, c5, c6, c7 = coefficients(mesh.total_contact_ratio)
    low = min(mesh.line_load / _LOW_LOAD, 1.0)
    lower = 0.85 if low >= 1.0 else 0.5 + 0.35 * math.sqrt(low)
    main = c1 * pitch + c2 * profile + c4 * relief + 1.0
    beyond = c5 * pitch + c6 * profile + c7
    if ratio <= lower:
        factor, name = ratio * (c1 * pitch + c2 * profile + c3 * relief) + 1.0, "subcritical"
    elif ratio <= _MAIN:
        factor, name = main, "main resonance"
    elif ratio < _SUPERCRITICAL:
        share = (_SUPERCRITICAL - ratio) / (_SUPERCRITICAL - _MAIN)
        factor, name = beyond + (main - beyond) * share, "intermediate"
    else:
        factor, name = beyond, "supercritical"
    return DynamicFactor(max(factor, 1.0), ratio, speed, name)


def disc_mass(
    base_diameter: float,
    middle_diameter: float,
    ratio: float,
    density: tuple[float, float],
    bores: tuple[float, float] = (0.0, 0.0),
) -> float:
    """m_red of two discs per face width, kg/m: (30) to (32), from diameters d_b, d_m = (d_a + d_f)/2 (m).

    π/8 (d_m1/d_b1)² d_m1²/(1/((1 − q_1⁴) ρ_1) + 1/((1 − q_2⁴) ρ_2 u²)), the bores q over d_m of each gear.
    """
    resistance = sum(
        1.0 / ((1.0 - bore**4) * mass * by)
        for bore, mass, by in zip(bores, density, (1.0, ratio**2), strict=True)
    )
    return math.pi / 8.0 * (middle_diameter / base_diameter) ** 2 * middle_diameter**2 / resistance


def face_load_factor_c(misalignment: float, mesh_stiffness: float, line_load: float) -> float:
    """K_Hβ by method C: 1 + F_βy c_γβ/(2 F_m/b), √(2 F_βy c_γβ/(F_m/b)) from 2 on: (41), (42).

    F_βy after running in (m), c_γβ per face width (Pa), F_m/b = F_t K_A K_γ K_v/b (N/m).
    """
    opened = misalignment * mesh_stiffness / line_load
    return 1.0 + opened / 2.0 if opened < 2.0 else math.sqrt(2.0 * opened)


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
