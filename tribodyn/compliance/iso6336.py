"""Reference stiffness after ISO 6336-1, method B: the values that ours are compared with.

External gears, and internal ones in place of which a rack counts. Theory after Weber & Banaschek for solid
discs of steel with the standard basic rack, corrected by measurements and by factors for what differs.
Formulas and limits are those of ISO 6336-1:2019, 9.3, from memory of the standard, not transcribed from it.
Example 1 of ISO/TR 6336-30 confirms q', C_M, C_B for the dedendum, c_γα and c_γβ (test_iso6336); C_R, C_B for
the pressure angle, the reduction at low loads and internal gears have no such check.
"""

import math
from typing import NamedTuple

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.helix import base_helix_angle, normal_section

_PER_MM_UM = 1e9  # N/(mm µm) in Pa
#: C_M, by which measured stiffness falls short of the theory.
MEASURED_CORRECTION = 0.8
#: E of the steel that the theory is worked out for, Pa.
STEEL_MODULUS = 206e9
# Line load below which the stiffness falls with the load, and up to which the series is within +5 … −8 % of
# the theory, N/m.
_LOW_LOAD, _HIGH_LOAD = 100e3, 1600e3
_SHIFT_SUM = (-0.5, 2.0)
# Pressure angles for which parts 2 and 3 were confirmed, and transverse contact ratios of part 1.
_PRESSURE_ANGLE = (math.radians(15.0), math.radians(25.0))
_CONTACT_RATIO = (1.2, 2.5)
# Addendum of the standard rack, and by how much another one goes unmentioned, such as a shortened tip.
_ADDENDUM, _ADDENDUM_MARGIN = 1.0, 0.1
# Rims thinner than this many tooth heights are no solid discs (the limit of Y_B, part 3).
_RIM_HEIGHTS = 1.2


class ReferencePair(NamedTuple):
    """What the reference stiffness depends on; pairs are (gear with fewer teeth, gear with more)."""

    #: teeth, profile_shift, dedendum: numbers of teeth; shifts and dedenda of the rack, in (normal) modules
    teeth: tuple[float, float]
    profile_shift: tuple[float, float]
    dedendum: tuple[float, float]
    pressure_angle: float  # of the rack, in the normal section, rad
    contact_ratio: float  # ε_α, transverse
    line_load: float  # F_t K_A/b on the reference circle, N/m
    youngs_modulus: tuple[float, float] = (STEEL_MODULUS, STEEL_MODULUS)  # Pa
    helix_angle: float = 0.0  # β at the reference circle, rad
    blank: float = 1.0  # C_R, see `blank_factor`; 1 for solid discs


class ReferenceStiffness(NamedTuple):
    """Stiffness per face width, in Pa = N/(m m), and its factors; 1 N/(mm µm) is 1 GPa."""

    theoretical: float  # c'_th, maximum stiffness of a single pair of steel, from theory
    #: correction, blank, rack, material, load: C_M, C_R, C_B, E/E_St, and the reduction at low loads
    correction: float
    blank: float
    rack: float
    material: float
    load: float
    single_pair: float  # c' = c'_th cos β times the factors
    #: mesh, mesh_face: c_γα, mean over the mesh cycle, and c_γβ for the face load factor
    mesh: float
    mesh_face: float


def theoretical_stiffness(
    teeth: tuple[float, float],
    profile_shift: tuple[float, float] = (0.0, 0.0),
    pressure_angle: float = math.radians(20.0),
    helix_angle: float = 0.0,
) -> float:
    """Maximum stiffness c'_th of one pair of steel teeth, solid discs, standard rack, per face width, Pa.

    Of z and x of the gear with fewer teeth and of its mate; valid for x1 ≥ x2, −0.5 ≤ x1 + x2 ≤ 2 and line
    loads from 100 to 1600 N/mm. Of helical gears the virtual numbers of teeth z/(cos² β_b cos β) count. An
    internal mate, z2 < 0, has z_n2 = ∞ and its own x2, positive where it makes the tooth thicker.
    ISO 6336-1:2019, 9.3.2: c'_th = 1/q', q' the series (82).
    """
    base = math.asin(math.sin(helix_angle) * math.cos(pressure_angle))
    z1, z2 = (z / (math.cos(base) ** 2 * math.cos(helix_angle)) for z in teeth)
    x1, x2 = profile_shift
    z2 = z2 if z2 > 0.0 else math.inf
    flexibility = (
        0.04723
        + 0.15551 / z1
        + 0.25791 / z2
        - 0.00635 * x1
        - 0.11654 * x1 / z1
        - 0.00193 * x2
        - 0.24188 * x2 / z2
        + 0.00529 * x1**2
        + 0.00182 * x2**2
    )
    return _PER_MM_UM / flexibility


def rack_factor(dedendum: tuple[float, float], pressure_angle: float) -> float:
    """C_B = mean of 1 + 0.5 (1.2 − h_fP/m_n), times 1 − 0.02 (20° − α_n): another rack than the standard one.

    ISO 6336-1, 9.3.2.5; from memory of the standard.
    """
    deep = sum(1.0 + 0.5 * (1.2 - depth) for depth in dedendum) / 2.0
    return deep * (1.0 - 0.02 * (20.0 - math.degrees(pressure_angle)))


def blank_factor(web: float, rim: float) -> float:
    """C_R = 1 + ln(b_s/b)/(5 exp(s_R/(5 m_n))) of a gear with rim and web; a solid disc has 1.

    A mean for mating gears of similar or stiffer bodies: the softer body counts. The web b_s/b, its thickness
    over the face width, counts as 0.2 … 1.2, the rim s_R/m_n, its thickness under the teeth in modules, as at
    least 1. ISO 6336-1, 9.3.2.4; from memory of the standard.
    """
    return 1.0 + math.log(min(max(web, 0.2), 1.2)) / (5.0 * math.exp(max(rim, 1.0) / 5.0))


def reference_stiffness(pair: ReferencePair) -> ReferenceStiffness:
    """Stiffness of one pair of teeth and of the mesh, within the limits that `outside` goes through.

    c' = c'_th C_M C_R C_B cos β E/E_St, below 100 N/mm times (F_t K_A/b/(100 N/mm))^0.25; E is the harmonic
    mean. c_γα = c' (0.75 ε_α + 0.25), c_γβ = 0.85 c_γα. ISO 6336-1:2019, 9.3.2 and 9.3.3.
    """
    theoretical = theoretical_stiffness(pair.teeth, pair.profile_shift, pair.pressure_angle, pair.helix_angle)
    rack = rack_factor(pair.dedendum, pair.pressure_angle)
    material = 2.0 / sum(STEEL_MODULUS / modulus for modulus in pair.youngs_modulus)
    load = min(pair.line_load / _LOW_LOAD, 1.0) ** 0.25
    single = theoretical * MEASURED_CORRECTION * pair.blank * rack * material * load
    single *= math.cos(pair.helix_angle)
    mesh = single * (0.75 * pair.contact_ratio + 0.25)
    return ReferenceStiffness(
        theoretical, MEASURED_CORRECTION, pair.blank, rack, material, load, single, mesh, 0.85 * mesh
    )


def outside(pair: ReferencePair) -> list[str]:
    """Say what of a pair lies outside the limits of the standard; none: all is inside."""
    (x1, x2), ratio = pair.profile_shift, pair.contact_ratio
    beyond = []
    if x1 < x2:
        beyond.append(f"profile shift {x1:.3g} of the gear with fewer teeth, less than its mate's {x2:.3g}")
    if not _SHIFT_SUM[0] <= x1 + x2 <= _SHIFT_SUM[1]:
        beyond.append(f"sum of profile shifts {x1 + x2:.3g}, limits {_SHIFT_SUM[0]:g} and {_SHIFT_SUM[1]:g}")
    low, high = _PRESSURE_ANGLE
    if not low - 1e-9 <= pair.pressure_angle <= high + 1e-9:
        limits = f"limits {math.degrees(low):.0f} and {math.degrees(high):.0f} deg"
        beyond.append(f"pressure angle {math.degrees(pair.pressure_angle):.4g} deg, {limits}")
    if ratio < _CONTACT_RATIO[0]:
        beyond.append(f"contact ratio {ratio:.3g}, below {_CONTACT_RATIO[0]:g} (c_gamma up to 10 % less)")
    if ratio > _CONTACT_RATIO[1]:
        beyond.append(f"contact ratio {ratio:.3g}, above {_CONTACT_RATIO[1]:g}")
    if pair.line_load > _HIGH_LOAD:
        beyond.append(f"line load {pair.line_load * 1e-3:.0f} N/mm, above {_HIGH_LOAD * 1e-3:.0f} N/mm")
    return beyond


def pair_of(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], normal_load: float
) -> ReferencePair:
    """Pair of an involute drive, solid discs and K_A = 1, under the load (N) of all pairs along the normal.

    The order is by numbers of teeth, whichever gear drives.
    """
    drive, path = normal_section(assembly.drive), assembly.path
    # of equal numbers of teeth the larger profile shift comes first
    ranks = [(1.0 / body.teeth, body.profile_shift) for body in (drive.pinion, drive.gear)]
    order = SIDES if ranks[0] >= ranks[1] else SIDES[::-1]
    bodies = [body_of(drive, side) for side in order]
    transverse = normal_load * math.cos(float(base_helix_angle(assembly.drive)))
    # of the sign of the gear's radii, as the reference radius below
    torque = transverse * float(path.gear_pitch_radius) * math.cos(float(path.pressure_angle(0.0)))
    modulus = dict(zip(SIDES, (material.youngs_modulus for material in materials), strict=True))
    return ReferencePair(
        teeth=(float(bodies[0].teeth), float(bodies[1].teeth)),
        profile_shift=(float(bodies[0].profile_shift), float(bodies[1].profile_shift)),
        dedendum=(float(bodies[0].dedendum), float(bodies[1].dedendum)),
        pressure_angle=float(drive.pressure_angle),
        contact_ratio=float(assembly.contact_ratio),
        line_load=torque / float(reference_radius(assembly.drive, "gear")) / float(assembly.common_width),
        youngs_modulus=(modulus[order[0]], modulus[order[1]]),
        helix_angle=abs(float(drive.helix_angle)),
    )


def bodies_outside(assembly: Assembly) -> list[str]:
    """Say where bodies and tips differ from those that the standard's series is for."""
    drive, beyond = normal_section(assembly.drive), []
    module = float(drive.module)
    for side in SIDES:
        body = body_of(drive, side)
        tip, root = float(tip_circle_radius(assembly.drive, side)), float(assembly.tooth(side).root_radius)
        addendum = (tip - float(reference_radius(assembly.drive, side))) / module - float(body.profile_shift)
        if abs(addendum - _ADDENDUM) > _ADDENDUM_MARGIN:
            beyond.append(f"addendum of the {side} {addendum:.3g} modules, the series is for {_ADDENDUM:g}")
        heights = (root - float(body.bore_radius)) / (tip - root)
        if heights < _RIM_HEIGHTS:
            beyond.append(
                f"rim of the {side} {heights:.2g} tooth heights, no solid disc below {_RIM_HEIGHTS:g}"
            )
    return beyond
