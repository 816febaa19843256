"""Surface durability (pitting) of involute gears: ISO 6336-2, method B, as functions of numbers.

Formulas are those of the editions of 2006 and 2019, from memory of the standards; listings of two programs
confirm them (`tribodyn validate`). Between the editions Z_B and Z_D differ: helical gears without suitable
profile modification have √f_ZCa in place of 1 in 2019; the speed of Z_v is that at the working pitch circle
in the listing of 2019, at the reference circle in reports of 2006. No other factor is known to differ.
"""

import math
from typing import NamedTuple

from tribodyn.standards.contact_path import ContactPath, transverse_angle
from tribodyn.standards.fatigue import StressCurve
from tribodyn.standards.metals import SURFACE_HARDENED, VICKERS, Metal, contact_factors

#: σ_Hlim between which C_ZL and C_ZR change, N/mm².
_SOFT, _HARD = 850.0, 1200.0
#: Brinell hardness between which softer gears harden at work, and that of the formula's end.
_SOFTEST, _HARDEST = 130.0, 470.0


#: f_ZCa of ISO 6336-2:2019 by the profile modification of the flanks: suitable for the duty by a contact
#: analysis, usual without one, none.
UNMODIFIED_FACTOR = {"suitable": 1.0, "usual": 1.07, "none": 1.2}


class PittingMesh(NamedTuple):
    """What the contact stress and its factors depend on; pairs are (pinion, gear)."""

    path: ContactPath
    #: transverse reference radii r, m, and normal pressure and helix angle at the reference circle, rad
    reference_radius: tuple[float, float]
    normal_pressure_angle: float
    helix_angle: float
    face_width: float  # b, m
    pinion_torque: float  # N m
    pinion_speed: float  # rad/s
    effective_modulus: float  # 2/E_r = Σ(1 − ν²)/E inverted: E_r, Pa
    viscosity_40: float  # ν40 of the oil, m²/s
    #: mean peak-to-valley roughness of the flanks Rz1, Rz2, m
    roughness: tuple[float, float]
    edition: int = 2019  # of ISO 6336-2, or 2006
    modification: str = "none"  # one of `UNMODIFIED_FACTOR`, of the edition of 2019

    @property
    def unmodified_factor(self) -> float:
        """f_ZCa; 1 in the edition of 2006."""
        return UNMODIFIED_FACTOR[self.modification] if self.edition >= 2019 else 1.0


class Geometry(NamedTuple):
    """Factors of the contact stress that do not depend on the load."""

    zone: float  # Z_H
    elasticity: float  # Z_E, √Pa
    contact_ratio: float  # Z_ε
    helix: float  # Z_β
    single_pair: tuple[float, float]  # Z_B, Z_D
    nominal: float  # σ_H0, Pa


class Influences(NamedTuple):
    """Factors of the permissible stress at the reference number of cycles, of pinion and gear."""

    lubricant: tuple[float, float]  # Z_L
    speed: tuple[float, float]  # Z_v
    roughness: tuple[float, float]  # Z_R
    hardening: tuple[float, float]  # Z_W
    size: float = 1.0  # Z_X

    def of(self, gear: int) -> float:
        """Product of the factors of pinion (0) or gear (1)."""
        return (
            self.lubricant[gear] * self.speed[gear] * self.roughness[gear] * self.hardening[gear] * self.size
        )


def tangential_load(mesh: PittingMesh) -> float:
    """F_t at the reference circle, N."""
    return mesh.pinion_torque / abs(mesh.reference_radius[0])


def geometry(mesh: PittingMesh) -> Geometry:
    """Factors and nominal contact stress σ_H0 = Z_H Z_E Z_ε Z_β √(F_t/(d_1 b) (u + 1)/u): (4) to (6).

    Z_H (14), Z_E (24), Z_ε (28) to (30), Z_β = 1/√cos β (31); of an internal gear u < 0.
    """
    path, ratio = mesh.path, mesh.path.ratio
    zone = zone_factor(
        mesh.normal_pressure_angle, mesh.helix_angle, path.pressure_angle, path.base_helix_angle
    )
    elasticity = elasticity_factor(mesh.effective_modulus)
    shared = contact_ratio_factor(path.contact_ratio, path.overlap_ratio)
    helix = helix_factor(mesh.helix_angle)
    pressed = tangential_load(mesh) / (2.0 * mesh.reference_radius[0] * mesh.face_width)
    curved = (ratio + 1.0) / ratio  # of the sign of the diameter, both < 0 of an internal pinion
    nominal = zone * elasticity * shared * helix * math.sqrt(pressed * curved)
    single = single_pair_factors(path, mesh.unmodified_factor)
    return Geometry(zone, elasticity, shared, helix, single, nominal)


def zone_factor(
    normal_pressure_angle: float, helix_angle: float, working_angle: float, base_helix_angle: float
) -> float:
    """Z_H = √(2 cos β_b cos α_wt/(cos² α_t sin α_wt)) of α_n, β, α_wt and β_b, rad: (14)."""
    transverse = transverse_angle(normal_pressure_angle, helix_angle)
    return math.sqrt(2.0 * math.cos(base_helix_angle) / (math.cos(transverse) ** 2 * math.tan(working_angle)))


def elasticity_factor(effective_modulus: float) -> float:
    """Z_E = √(E_r/(2π)), √Pa, of 2/E_r = Σ(1 − ν²)/E: 189.8 √(N/mm²) of steel on steel: (24)."""
    return math.sqrt(effective_modulus / (2.0 * math.pi))


def helix_factor(helix_angle: float) -> float:
    """Z_β = 1/√cos β: (31)."""
    return 1.0 / math.sqrt(math.cos(helix_angle))


def contact_ratio_factor(transverse: float, overlap: float) -> float:
    """Z_ε: √((4 − ε_α)/3) of spur gears, √(1/ε_α) from ε_β = 1 on, between by ε_β: (28) to (30)."""
    part = min(overlap, 1.0)
    return math.sqrt((4.0 - transverse) / 3.0 * (1.0 - part) + part / transverse)


def single_pair_factors(path: ContactPath, unmodified: float = 1.0) -> tuple[float, float]:
    """Z_B and Z_D: stress at the inner points B and D of single pair contact over that at the pitch point.

    Quotients M_1 and M_2 (15), (16) of spur gears, at least 1; with the overlap ratio they go over to √f_ZCa
    (`unmodified`; 1 in 2006), which wide helical gears have. An internal gear has 1.
    """
    tangent = math.tan(path.pressure_angle)
    whole = 2.0 * math.pi
    roots = [
        math.sqrt((tip / base) ** 2 - 1.0)
        for tip, base in zip(path.tip_radius, path.base_radius, strict=True)
    ]
    pitches = [whole / z for z in path.teeth]
    beyond = path.contact_ratio - 1.0
    ratios = []
    for raised, other in ((0, 1), (1, 0)):
        inner = (roots[raised] - pitches[raised]) * (roots[other] - beyond * pitches[other])
        ratios.append(tangent / math.sqrt(inner) if inner > 0.0 else 1.0)
    part = min(path.overlap_ratio, 1.0)
    wide = math.sqrt(unmodified)
    raised = [
        max(m - part * (m - wide), 1.0) if z > 0 else 1.0 for m, z in zip(ratios, path.teeth, strict=True)
    ]
    return raised[0], raised[1]


def contact_stress(geometry: Geometry, load_factor: float) -> tuple[float, float]:
    """σ_H of pinion and gear, Pa: Z_B, Z_D σ_H0 √K with K = K_A K_γ K_v K_Hβ K_Hα: (2), (3)."""
    raised = geometry.nominal * math.sqrt(load_factor)
    return geometry.single_pair[0] * raised, geometry.single_pair[1] * raised


def influences(mesh: PittingMesh, metals: tuple[Metal, Metal]) -> Influences:
    """Z_L (34), Z_v (37), Z_R (39), of both gears by σ_Hlim of the softer, and Z_W (42) to (46)."""
    speed = mesh.pinion_speed * abs(_speed_radius(mesh))
    limit = min(metals, key=lambda metal: metal.hardness).contact_limit
    lubricant, velocity = lubricant_factor(limit, mesh.viscosity_40), speed_factor(limit, speed)
    rough = roughness_factor(limit, sum(mesh.roughness) / 2.0, _reduced_radius(mesh))
    hardened = work_hardening(mesh, metals)
    return Influences((lubricant, lubricant), (velocity, velocity), (rough, rough), hardened)


def lubricant_factor(contact_limit: float, viscosity_40: float) -> float:
    """Z_L = C_ZL + 4 (1 − C_ZL)/(1.2 + 134/ν_40)², ν_40 in mm²/s here: (34)."""
    share = _lubricant_share(contact_limit)
    return share + 4.0 * (1.0 - share) / (1.2 + 134.0 / (1e6 * viscosity_40)) ** 2


def _lubricant_share(contact_limit: float) -> float:
    """C_ZL: 0.83 up to σ_Hlim = 850 N/mm², 0.91 from 1200 on, (35)."""
    return 0.83 + 0.08 * min(max((1e-6 * contact_limit - _SOFT) / (_HARD - _SOFT), 0.0), 1.0)


def speed_factor(contact_limit: float, speed: float) -> float:
    """Z_v = C_Zv + 2 (1 − C_Zv)/√(0.8 + 32/v), C_Zv = C_ZL + 0.02, v in m/s: (37)."""
    share = _lubricant_share(contact_limit) + 0.02
    return share + 2.0 * (1.0 - share) / math.sqrt(0.8 + 32.0 / max(speed, 1e-9))


def roughness_factor(contact_limit: float, roughness: float, reduced_radius: float) -> float:
    """Z_R = (3 µm/Rz10)^C_ZR of the mean Rz and ρ_red at the pitch point, m: (38), (39)."""
    exponent = 0.32 - 0.0002 * min(max(1e-6 * contact_limit, _SOFT), _HARD)
    return (3.0 / (1e6 * roughness * (0.01 / reduced_radius) ** (1.0 / 3.0))) ** exponent


def _speed_radius(mesh: PittingMesh) -> float:
    """Radius, m, at which the speed of Z_v is taken: reference circle, working pitch circle in 2019."""
    return mesh.path.pitch_radius[0] if mesh.edition >= 2019 else mesh.reference_radius[0]


def _reduced_radius(mesh: PittingMesh) -> float:
    """ρ_red at the pitch point, m: ρ = r_b tan α_wt of either gear."""
    first, second = (base * math.tan(mesh.path.pressure_angle) for base in mesh.path.base_radius)
    return first * second / (first + second)


def work_hardening(mesh: PittingMesh, metals: tuple[Metal, Metal]) -> tuple[float, float]:
    """Z_W: the softer gear hardens at work against a surface-hardened or a harder through-hardened mate."""
    harder = 0 if metals[0].hardness >= metals[1].hardness else 1
    softer = 1 - harder
    factors = [1.0, 1.0]
    if metals[softer].treatment not in SURFACE_HARDENED:
        brinell = metals[softer].hardness / VICKERS
        if metals[harder].treatment in SURFACE_HARDENED:
            rough = _hardened_roughness(mesh, harder)
            held = min(max(brinell, _SOFTEST), _HARDEST)
            factors[softer] = (1.2 - (held - _SOFTEST) / 1700.0) * (3.0 / rough) ** 0.15
        elif softer == 1:
            ratio = min(metals[harder].hardness / metals[softer].hardness, 1.7)
            slope = 0.00898 * ratio - 0.00829 if ratio >= 1.2 else 0.0
            factors[softer] = 1.0 + slope * (min(abs(mesh.path.ratio), 20.0) - 1.0)
    return factors[0], factors[1]


def _hardened_roughness(mesh: PittingMesh, harder: int) -> float:
    """Equivalent roughness Rz_H of the harder flank against the softer, µm, held within 3 and 16: (43)."""
    hard, other = mesh.roughness[harder], mesh.roughness[1 - harder]
    speed = mesh.pinion_speed * abs(mesh.reference_radius[0])
    rough = 1e6 * hard * (0.01 / _reduced_radius(mesh)) ** 0.33 * (hard / other) ** 0.66
    return min(max(rough / (1e6 * mesh.viscosity_40 * speed / 1500.0) ** 0.33, 3.0), 16.0)


def permissible(metal: Metal, influence: float) -> StressCurve:
    """σ_HG over load cycles, Pa: σ_Hlim Z_NT Z_L Z_v Z_R Z_W Z_X from the reference number of cycles on.

    At and below the static number of cycles the influences count as 1; between straight lines: (32), (33).
    """
    factors = contact_factors(metal.treatment)
    limit = [metal.contact_limit] * len(factors.stress)
    return factors.times(limit).times([1.0, *[influence] * (len(limit) - 1)])
