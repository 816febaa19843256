"""Geometry, dynamic and life factors, stresses and safeties by AGMA 2101-D04 (2001-D04) and AGMA 908-B89.

Written from knowledge, without the standards at hand, for external gears. Printed numbers of two examples of
a textbook (Shigley, 14-4 and 14-5) and its curves of J, from memory too, agree. SI units;
safeties are of stresses.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.standards.contact_path import transverse_angle

#: Table of reliability factors, Y_Z: one failure in two, 10, 100, 1000, 10 000.
RELIABILITY = {0.5: 0.70, 0.9: 0.85, 0.99: 1.00, 0.999: 1.25, 0.9999: 1.50}


class AgmaPair(NamedTuple):
    """A pair of external gears and the rack that cuts them; lengths m, angles rad."""

    teeth: tuple[float, float]
    normal_module: float
    normal_pressure_angle: float
    helix_angle: float
    centre_distance: float
    tip_radii: tuple[float, float]
    face_width: float
    profile_shifts: tuple[float, float] = (0.0, 0.0)
    #: of the rack's tooth, times the module: addendum h_a0, radius of its tip
    tool_addendum: float = 1.25
    tool_radius: float = 0.25


class _Path(NamedTuple):
    """Distances along the line of action of the pinion, m, as AGMA 908 numbers them."""

    base: tuple[float, float]
    working: float  # φ_r
    pitch: float  # p_b
    c1: float
    c2: float
    c4: float
    c5: float
    c6: float


def _path(pair: AgmaPair) -> _Path:
    transverse = transverse_angle(pair.normal_pressure_angle, pair.helix_angle)
    radii = [pair.normal_module * z / 2.0 / math.cos(pair.helix_angle) for z in pair.teeth]
    base = radii[0] * math.cos(transverse), radii[1] * math.cos(transverse)
    working = math.acos(sum(base) / pair.centre_distance)
    c6 = pair.centre_distance * math.sin(working)
    reach = [math.sqrt(tip**2 - b**2) for tip, b in zip(pair.tip_radii, base, strict=True)]
    pitch = 2.0 * math.pi * base[0] / pair.teeth[0]
    c1 = c6 - reach[1]
    return _Path(base, working, pitch, c1, reach[0] - pitch, c1 + pitch, reach[0], c6)


def load_sharing_ratio(pair: AgmaPair) -> float:
    """m_N = F/L_min: 1 of spur gears, of helical ones by the shortest lines of contact, AGMA 908-B89."""
    if not pair.helix_angle:
        return 1.0
    path = _path(pair)
    contact = (path.c5 - path.c1) / path.pitch
    axial = math.pi * pair.normal_module / math.sin(pair.helix_angle)
    across, along = contact % 1.0, pair.face_width / axial % 1.0
    least = across * along if along <= 1.0 - across else (1.0 - across) * (1.0 - along)
    base_helix = math.asin(math.sin(pair.helix_angle) * math.cos(pair.normal_pressure_angle))
    shortest = (contact * pair.face_width - least * axial) / math.cos(base_helix)
    return pair.face_width / shortest


def pitting_geometry_factor(pair: AgmaPair) -> float:
    """I (Z_I) = cos φ_r/((1/ρ_1 + 1/ρ_2) d m_N), AGMA 908-B89.

    Radii of curvature at the pinion's lowest point of single tooth contact of spur gears, at its mean radius
    of helical ones, which are taken to overlap by a pitch or more; d = 2 C/(m_G + 1).
    """
    path = _path(pair)
    ratio = pair.teeth[1] / pair.teeth[0]
    first = path.c2
    if pair.helix_angle:
        mean = (pair.tip_radii[0] + pair.centre_distance - pair.tip_radii[1]) / 2.0
        first = math.sqrt(mean**2 - path.base[0] ** 2)
    curvature = 1.0 / first + 1.0 / (path.c6 - first)
    diameter = 2.0 * pair.centre_distance / (ratio + 1.0)
    return math.cos(path.working) / (curvature * diameter * load_sharing_ratio(pair))


def bending_geometry_factor(pair: AgmaPair, gear: int) -> float:
    """J (Y_J) = Y/(K_f m_N) of the pinion (0) or gear (1), AGMA 908-B89.

    Y by Lewis's parabola in the tooth of the virtual spur gear, z/cos³ ψ, under the load at the highest point
    of single tooth contact of spur gears and at the tip of helical ones; K_f of Dolan and Broghamer.
    """
    path, angle, helix = _path(pair), pair.normal_pressure_angle, pair.helix_angle
    teeth, shift = pair.teeth[gear] / math.cos(helix) ** 3, pair.profile_shifts[gear]
    base = teeth / 2.0 * math.cos(angle)
    if helix:
        reference = pair.normal_module * pair.teeth[gear] / 2.0 / math.cos(helix)
        tip = teeth / 2.0 + (pair.tip_radii[gear] - reference) / pair.normal_module
        tangent = math.sqrt((tip / base) ** 2 - 1.0)
    else:
        tangent = (path.c4 if gear == 0 else path.c6 - path.c2) / path.base[gear]
    half = (math.pi / 2.0 + 2.0 * shift * math.tan(angle)) / teeth + math.tan(angle) - angle
    load_angle = tangent - half
    reached = base / math.cos(load_angle)  # where the load meets the middle of the tooth
    x, y = _fillet(teeth, shift, angle, pair.tool_addendum, pair.tool_radius)
    below = y < reached
    weakest = int(np.argmin(np.where(below, x**2 / np.where(below, reached - y, 1.0), np.inf)))
    chord, height = 2.0 * float(x[weakest]), reached - float(y[weakest])
    depth = pair.tool_addendum - shift - pair.tool_radius
    notch = pair.tool_radius + depth**2 / (teeth / 2.0 + depth)
    raised = (
        0.331
        - 0.436 * angle
        + (chord / notch) ** (0.324 - 0.492 * angle) * (chord / height) ** (0.261 + 0.545 * angle)
    )
    inclined = math.degrees(math.atan(math.tan(helix) * math.sin(angle))) / 100.0
    spread = 1.0 / (1.0 - math.sqrt(inclined * (1.0 - inclined)))  # C_h
    cosine = math.cos(load_angle) / math.cos(angle)
    of_lever = 6.0 * height / (chord**2 * spread) - math.tan(load_angle) / chord
    form = math.cos(helix) ** 2 / (cosine * of_lever)
    return form / (raised * load_sharing_ratio(pair))


def _fillet(teeth: float, shift: float, angle: float, addendum: float, radius: float) -> tuple[Any, Any]:
    """Fillet that a rack cuts, from its bottom to the flank: across and along the tooth's middle, modules."""
    depth = addendum - shift - radius  # of the centre of the rack's tip radius below the rolling line
    aside = math.pi / 4.0 - addendum * math.tan(angle) - radius * (1.0 - math.sin(angle)) / math.cos(angle)
    moved = np.linspace(0.0, depth / math.tan(angle), 2001)
    stretch = 1.0 + radius / np.hypot(moved, depth)
    across, along = moved * stretch, teeth / 2.0 - depth * stretch
    turned = math.pi / teeth - (np.arctan2(across, along) - (moved - aside) * 2.0 / teeth)
    distance = np.hypot(across, along)
    return distance * np.sin(turned), distance * np.cos(turned)


def dynamic_factor(accuracy: float, pitch_speed: float) -> float:
    """K_v = ((C + √v)/C)^B, B = 0.25 (A_v − 5)^0.667, C = 3.5637 + 3.9914 (1 − B): AGMA 2101-D04, v in m/s.

    The accuracy A_v is a whole number from 6 (accurate) to 12; 17 less the older Q_v.
    """
    exponent = 0.25 * (accuracy - 5.0) ** 0.667
    level = 3.5637 + 3.9914 * (1.0 - exponent)
    return ((level + math.sqrt(pitch_speed)) / level) ** exponent


def contact_stress(
    tangential_load: float,
    elastic_coefficient: float,
    geometry: float,
    pinion_diameter: float,
    face_width: float,
    factors: float = 1.0,
) -> float:
    """σ_H = Z_E √(F_t K_o K_v K_s K_H Z_R/(d_w1 b Z_I)), Pa; `factors` is the product of the K and Z_R.

    `elastic_coefficient` Z_E in √Pa: 190 √(N/mm²) of steel is 1.9e5.
    """
    return elastic_coefficient * math.sqrt(
        tangential_load * factors / (pinion_diameter * face_width * geometry)
    )


def bending_stress(
    tangential_load: float, geometry: float, transverse_module: float, face_width: float, factors: float = 1.0
) -> float:
    """σ_F = F_t K_o K_v K_s K_H K_B/(b m_t Y_J), Pa; `factors` is the product of the K."""
    return tangential_load * factors / (face_width * transverse_module * geometry)


def pitting_life_factor(cycles: float) -> float:
    """Z_N of steels: 2.466 N^−0.056 below 10⁷ cycles, 1.4488 N^−0.023 from there on."""
    return 2.466 * cycles**-0.056 if cycles < 1e7 else 1.4488 * cycles**-0.023


def bending_life_factor(cycles: float) -> float:
    """Y_N beyond 3·10⁶ cycles, 1.3558 N^−0.0178; below, of steel of 160 HB, 2.3194 N^−0.0538 at most 1.6."""
    return 1.3558 * cycles**-0.0178 if cycles >= 3e6 else min(2.3194 * cycles**-0.0538, 1.6)


def allowable_stresses(brinell: float, grade: int = 1) -> tuple[float, float]:
    """σ_FP and σ_HP, Pa, of through-hardened steel of grade 1 or 2 by its hardness HB: AGMA 2101-D04.

    Bending 0.533 HB + 88.3 and 0.703 HB + 113, contact 2.22 HB + 200 and 2.41 HB + 237 N/mm².
    """
    bending, contact = {1: ((0.533, 88.3), (2.22, 200.0)), 2: ((0.703, 113.0), (2.41, 237.0))}[grade]
    return 1e6 * (bending[0] * brinell + bending[1]), 1e6 * (contact[0] * brinell + contact[1])


#: σ_FP and σ_HP, N/mm², of case-hardened steel by grade; bending of grade 2 without its further demands.
_CASE_HARDENED = {1: (380.0, 1240.0), 2: (450.0, 1550.0), 3: (515.0, 1895.0)}


def case_hardened_stresses(grade: int = 2) -> tuple[float, float]:
    """σ_FP and σ_HP, Pa, of case-hardened (carburized) steel of grade 1, 2 or 3: AGMA 2101-D04, from memory.

    55, 65, 75 ksi in bending, 180, 225, 275 ksi in contact.
    """
    bending, contact = _CASE_HARDENED[grade]
    return 1e6 * bending, 1e6 * contact


def safety(
    allowable: float,
    stress: float,
    life_factor: float,
    reliability: float = 0.99,
    hardness_ratio: float = 1.0,
) -> float:
    """S_F or S_H: allowable stress times life factor, and Z_W, over stress and the factor of reliability.

    Temperature factor 1 (up to 120 °C). Of the `RELIABILITY` that the standard's table has.
    """
    return allowable * life_factor * hardness_ratio / (stress * RELIABILITY[reliability])
