"""Tooth bending strength of involute gears: ISO 6336-3, method B, as functions of numbers.

Formulas are those of the editions of 2006 and 2019, from memory of the standards; listings of two programs
confirm those of 2019 for spur gears, those of 2006 for helical ones (`tribodyn validate`). In 2019 Y_F has a
factor f_ε ≤ 1, and Y_β is over cos³ β. The critical section is that of the tooth as it is cut, by rack or
pinion-type cutter (`geometry.root_section`).
"""

import math
from typing import NamedTuple

from tribodyn.standards.fatigue import StressCurve
from tribodyn.standards.metals import SURFACE_HARDENED, Metal, bending_factors, slip_layer

#: Y_ST: the test gears' stress correction factor.
STRESS_CORRECTION_TEST = 2.0
#: Notch parameter q_sT of the test gears, and the thickness 1/χ_P of the formula, m.
_TEST_NOTCH, _GRADIENT = 2.5, 5e-3


class RootSection(NamedTuple):
    """The critical section of the virtual spur tooth, where 30° (internal: 60°) tangents touch the fillet."""

    arm: float  # h_Fe, bending moment arm of the load at the outer point of single pair contact, m
    thickness: float  # s_Fn, root chord, m
    notch_radius: float  # ρ_F, m
    load_angle: float  # α_Fen, between the load and the perpendicular of the tooth's axis, rad


class BendingGear(NamedTuple):
    """What the root stress of one gear depends on."""

    section: RootSection
    normal_module: float  # m_n, m
    normal_pressure_angle: float  # rad
    helix_angle: float  # β, rad, ≥ 0
    overlap_ratio: float  # ε_β
    virtual_contact_ratio: float  # ε_αn
    face_width: float  # b, m
    tooth_height: float  # h, m
    rim: float  # thickness s_R of the rim under the teeth, m
    internal: bool
    quality: float  # grade by ISO 1328-1
    roughness: float  # Rz of the root, m
    reversed: bool = False  # both flanks carry in every turn: an idler, a planet
    edition: int = 2019  # of ISO 6336-3, or 2006


class Stress(NamedTuple):
    """Nominal root stress and its factors."""

    form: float  # Y_F
    correction: float  # Y_S
    helix: float  # Y_β
    rim: float  # Y_B
    deep: float  # Y_DT
    notch: float  # q_s
    nominal: float  # σ_F0, Pa
    distribution: float = 1.0  # f_ε, within Y_F; 1 in the edition of 2006


class Relative(NamedTuple):
    """Factors of the permissible stress, at the reference number of cycles and (static) below."""

    notch: float  # Y_δrelT
    surface: float  # Y_RrelT
    size: float  # Y_X
    alternating: float  # Y_M, mean stress influence
    static_notch: float  # Y_δrelT for static load

    @property
    def reference(self) -> float:
        """Product at the reference number of cycles."""
        return self.notch * self.surface * self.size * self.alternating


def form_factor(gear: BendingGear) -> float:
    """Y_F = 6 h_Fe/m_n cos α_Fen/((s_Fn/m_n)² cos α_n), in the edition of 2019 times f_ε: (9)."""
    section, module = gear.section, gear.normal_module
    lever = 6.0 * section.arm / module * math.cos(section.load_angle)
    plain = lever / ((section.thickness / module) ** 2 * math.cos(gear.normal_pressure_angle))
    return plain * distribution_factor(gear)


def distribution_factor(gear: BendingGear) -> float:
    """f_ε, how pairs share the load at the outer point of single pair contact: ISO 6336-3:2019, (10) to (14).

    Spur gears 1, from ε_αn = 2 on 0.7; helical ones √(1 − ε_β + ε_β/ε_αn), from ε_αn = 2 on
    √((1 − ε_β)/2 + ε_β/ε_αn), ε_β ≤ 1. The edition of 2006 has 1. From memory; printed for spur gears only.
    """
    if gear.edition < 2019:
        return 1.0
    overlap, deep = min(gear.overlap_ratio, 1.0), gear.virtual_contact_ratio >= 2.0
    if overlap <= 0.0:
        return 0.7 if deep else 1.0
    alone = (1.0 - overlap) / 2.0 if deep else 1.0 - overlap
    return math.sqrt(alone + overlap / gear.virtual_contact_ratio)


def stress_correction(section: RootSection) -> tuple[float, float]:
    """Y_S = (1.2 + 0.13 L) q_s^(1/(1.21 + 2.3/L)) and q_s = s_Fn/(2 ρ_F), L = s_Fn/h_Fe: (34) to (36).

    Valid for 1 ≤ q_s < 8.
    """
    length = section.thickness / section.arm
    notch = section.thickness / (2.0 * section.notch_radius)
    return (1.2 + 0.13 * length) * notch ** (1.0 / (1.21 + 2.3 / length)), notch


def nominal_stress(gear: BendingGear, tangential_load: float) -> Stress:
    """σ_F0 = F_t/(b m_n) Y_F Y_S Y_β Y_B Y_DT, Pa: (3); F_t at the reference circle, N."""
    form = form_factor(gear)
    correction, notch = stress_correction(gear.section)
    helical = helix_factor(gear.helix_angle, gear.overlap_ratio, gear.edition)
    rim, deep = rim_factor(gear), deep_tooth_factor(gear.virtual_contact_ratio, gear.quality)
    load = tangential_load / (gear.face_width * gear.normal_module)
    return Stress(
        form,
        correction,
        helical,
        rim,
        deep,
        notch,
        load * form * correction * helical * rim * deep,
        distribution_factor(gear),
    )


def helix_factor(helix_angle: float, overlap_ratio: float, edition: int = 2019) -> float:
    """Y_β = 1 − ε_β β/120° with ε_β ≤ 1 and β ≤ 30°, in the edition of 2019 over cos³ β: (39)."""
    held = min(helix_angle, math.radians(30.0))
    plain = 1.0 - min(overlap_ratio, 1.0) * math.degrees(held) / 120.0
    return plain / math.cos(held) ** 3 if edition >= 2019 else plain


def rim_factor(gear: BendingGear) -> float:
    """Y_B: 1 of thick rims, 1.6 ln(2.242 h_t/s_R) external, 1.15 ln(8.324 m_n/s_R) internal: (40) to (43).

    Below half a tooth height (1.75 m_n internal) the formula is extrapolated.
    """
    if gear.internal:
        return max(1.15 * math.log(8.324 * gear.normal_module / max(gear.rim, 1e-9)), 1.0)
    return max(1.6 * math.log(2.242 * gear.tooth_height / max(gear.rim, 1e-9)), 1.0)


def beyond(gear: BendingGear, notch: float) -> list[str]:
    """What of a root lies outside the limits of the standard; none: all is inside."""
    exceeded = []
    thinnest = 1.75 * gear.normal_module if gear.internal else 0.5 * gear.tooth_height
    if gear.rim < thinnest:
        exceeded.append(
            f"rim {1e3 * gear.rim:.3g} mm, below {1e3 * thinnest:.3g} mm, for which Y_B is extrapolated"
        )
    if not 1.0 <= notch < 8.0:
        exceeded.append(f"notch parameter q_s {notch:.2g}, outside 1 to 8, for which Y_S holds")
    if math.degrees(gear.helix_angle) > 30.0:
        exceeded.append("helix angle above 30°: Y_β is that of 30°")
    return exceeded


def deep_tooth_factor(virtual_contact_ratio: float, quality: float) -> float:
    """Y_DT: 1 up to ε_αn = 2.05 and from grade 5 on, falling to 0.7 at 2.5: (44) to (46)."""
    if quality > 4.0 or virtual_contact_ratio <= 2.05:
        return 1.0
    return max(2.366 - 0.666 * virtual_contact_ratio, 0.7)


def face_factor(face_load: float, slenderness: float) -> float:
    """K_Fβ = K_Hβ^N, N = (b/h)²/(1 + b/h + (b/h)²) with b/h ≥ 3: ISO 6336-1, (69), (70)."""
    slender = max(slenderness, 3.0)
    return face_load ** (slender**2 / (1.0 + slender + slender**2))


def root_stress(stress: Stress, load_factor: float) -> float:
    """σ_F, Pa: σ_F0 K with K = K_A K_γ K_v K_Fβ K_Fα, K_Fα = K_Hα: (2)."""
    return stress.nominal * load_factor


def relative_factors(gear: BendingGear, stress: Stress, metal: Metal) -> Relative:
    """Y_δrelT (58), Y_RrelT (62) to (70), Y_X (71) to (75) and Y_M (annex B) of a material."""
    layer = slip_layer(metal)
    gear_support, test = (
        1.0 + math.sqrt(layer * (1.0 + 2.0 * notch) / _GRADIENT) for notch in (stress.notch, _TEST_NOTCH)
    )
    return Relative(
        gear_support / test,
        _surface(metal, gear.roughness),
        _size(metal, 1e3 * gear.normal_module),
        _alternating(metal, stress.correction) if gear.reversed else 1.0,
        _static_notch(metal, stress.correction),
    )


#: Rz below which a surface counts as smooth, µm.
_SMOOTH = 1.0


def _surface(metal: Metal, roughness: float) -> float:
    rz = max(1e6 * roughness, _SMOOTH)
    smooth = 1e6 * roughness < _SMOOTH
    if metal.treatment in ("grey-iron", "nitrided", "nitrided-through-hardened", "nitrocarburized"):
        return 1.025 if smooth else 4.299 - 3.259 * (rz + 1.0) ** (1.0 / 200.0)
    if metal.treatment == "normalized":
        return 1.07 if smooth else 5.306 - 4.203 * (rz + 1.0) ** 0.01
    return 1.12 if smooth else 1.674 - 0.529 * (rz + 1.0) ** 0.1


def _size(metal: Metal, module: float) -> float:
    """Y_X over the normal module in mm."""
    if metal.treatment == "grey-iron":
        return 1.075 - 0.015 * min(max(module, 5.0), 25.0)
    if metal.treatment in SURFACE_HARDENED:
        return 1.05 - 0.01 * min(max(module, 5.0), 25.0)
    return 1.03 - 0.006 * min(max(module, 5.0), 30.0)


def _static_notch(metal: Metal, correction: float) -> float:
    if metal.treatment in ("case-hardened", "induction-hardened"):
        return 0.44 * correction + 0.12
    if metal.treatment in SURFACE_HARDENED:
        return 0.20 * correction + 0.60
    if metal.treatment == "grey-iron":
        return 1.0
    softer = 0.82 * (300e6 / metal.yield_strength) ** 0.25
    return (1.0 + softer * (correction - 1.0)) / (1.0 + softer)


#: Stress ratio R of idlers and planets by annex B, load of equal size on both flanks.
_STRESS_RATIO = -1.2


def mean_stress_influence(metal: Metal, correction: float) -> float:
    """M of annex B, by how much less amplitude is endured per mean stress; of roots with so much Y_S."""
    return {
        "case-hardened": 0.8 - 0.15 * correction,
        "induction-hardened": 0.7,
        "nitrided": 0.3,
        "nitrided-through-hardened": 0.3,
        "nitrocarburized": 0.3,
        "through-hardened": 0.3,
        "through-hardened-carbon": 0.4,
        "normalized": 0.4,
        "ductile-iron": 0.4,
        "grey-iron": 0.4,
    }[metal.treatment]


def pulsating_stress(low: float, high: float, influence: float) -> float:
    """Stress that pulsates from 0 (R = 0) with the damage of one between `low` and `high`, Pa.

    Haigh's lines of equal damage: amplitude + M mean stress below R = low/high = 0, where it is
    σ_high − σ_low (1 − M)/(1 + M), with σ_low = R σ_high that is σ_high/Y_M of annex B. In tension throughout
    as in the FKM guideline: a third of M up to R = 0.5, amplitude alone from there on.
    """
    if low <= 0.0:
        return high - low * (1.0 - influence) / (1.0 + influence)
    third = influence / 3.0
    if low < 0.5 * high:
        return (high - low + third * (high + low)) / (1.0 + third)
    return (high - low) * (1.0 + influence) / (1.0 + third)


def _alternating(metal: Metal, correction: float) -> float:
    """Y_M = 1/(1 − R (1 − M)/(1 + M)): how much less a root stands that is bent both ways: annex B."""
    return 1.0 / pulsating_stress(_STRESS_RATIO, 1.0, mean_stress_influence(metal, correction))


def permissible(metal: Metal, factors: Relative) -> StressCurve:
    """σ_FG over load cycles, Pa: σ_Flim Y_ST Y_NT Y_δrelT Y_RrelT Y_X from the reference number of cycles on.

    At and below the static number of cycles Y_δrelT is the static one, Y_RrelT = Y_X = 1; between straight
    lines: (4), (6), (7).
    """
    life = bending_factors(metal.treatment)
    limit = [STRESS_CORRECTION_TEST * metal.bending_limit] * len(life.stress)
    static = factors.static_notch * factors.alternating
    return life.times(limit).times([static, *[factors.reference] * (len(limit) - 1)])
