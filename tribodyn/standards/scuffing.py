"""Scuffing by the flash and by the integral temperature: ISO/TS 6336-20 and -21:2017.

Numbers of equations are those of ISO/TR 13989:2000, its part 1 for the flash temperature and part 2 for the
integral temperature.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.standards.contact_path import (
    ContactPath,
    curvature_radii,
    helical_load_factor,
    transverse_angle,
)
from tribodyn.standards.micropitting import mean_friction, roughness_factor


def lubricant_factor(kind_factor: float, viscosity: float) -> float:
    """X_L of an oil at its viscosity η, Pa·s, from that of its type, X_L η^0.05 with η in mPa·s: (27).

    The types have the factors of `micropitting.Oil`.
    """
    return kind_factor * (1e3 * viscosity) ** -0.05


def flash_friction(
    line_load: float, speed_sum: float, pitch_radius: float, lubricant: float, roughness: float
) -> float:
    """Mean friction coefficient μ_m: (25) to (28).

    0.060 (w_Bt/(v_ΣC ρ_relC))^0.2 X_L Ra^0.25 in N/mm, m/s, mm, µm, with X_L of `lubricant_factor`, of
    w_Bt = K_A K_v K_Hβ K_Hα F_t/b (N/m), v_ΣC = 2 v_t sin α_wt (m/s), the radius of relative curvature at the
    pitch point (m) and Ra = (Ra_1 + Ra_2)/2 (m).
    """
    load = 1e-3 * line_load / (speed_sum * 1e3 * pitch_radius)
    return 0.060 * load**0.2 * lubricant * (1e6 * roughness) ** 0.25


def flash_rise(
    friction: Any,
    line_load: Any,
    half_width: Any,
    speeds: tuple[Any, Any],
    thermal_contact: tuple[float, float],
) -> Any:
    """Flash temperature rise after Blok, K: (3).

    1.11 μ_m w abs(v_g1 − v_g2)/(√(2 b_H)(B_M1 √v_g1 + B_M2 √v_g2)), w the normal load per length of the
    contact line (N/m), b_H the half width of the Hertz contact (m), B_M in W s^½/(m² K). X_J is not in it,
    see `flash_approach`.
    """
    first, second = speeds
    share = thermal_contact[0] * np.sqrt(first) + thermal_contact[1] * np.sqrt(second)
    heat = 1.11 * friction * line_load * np.abs(first - second)
    return heat / (np.sqrt(2.0 * half_width) * share)


def flash_approach(before: Any, length: float, missing_relief: float) -> Any:
    """X_J = 1 + (C_eff − C_a)/50 µm · ((Γ_C − Γ_Y)/(Γ_E − Γ_A))³ before the pitch point, after it 1.

    `before` is the distance from a place to the pitch point, m, negative after it, of a path of a `length`
    (at most that: of rings C may lie beyond the path); `missing_relief` is C_eff − C_a, m, ≥ 0. Without
    relief a driven tooth comes into contact too early and is struck. ISO/TS 6336-20:2017, from memory; a
    listing of STplus has 4.4 % more at A, as this does (`tribodyn validate stplus-fzg-c`).
    """
    return 1.0 + missing_relief / 50e-6 * (np.clip(before, 0.0, length) / length) ** 3


def bulk_temperature(oil_temperature: float, mean_flash: float, lubrication: float = 1.0) -> float:
    """Bulk temperature θ_M = θ_oil + 0.47 X_S X_mp θ_fl,m, K, of a gear with one mate: (22) to (24).

    `mean_flash` is the mean of the flash temperature along the path, `lubrication` X_S.
    """
    return oil_temperature + 0.47 * lubrication * mean_flash


def flash_safety(scuffing_temperature: float, contact_temperature: float, oil_temperature: float) -> float:
    """S_B = (θ_S − θ_oil)/(θ_Bmax − θ_oil): (100)."""
    return (scuffing_temperature - oil_temperature) / (contact_temperature - oil_temperature)


#: Line load, N/m, and speeds at the pitch circle, m/s, within which the friction coefficient is fitted (5.1).
_LINE_LOAD, _FASTEST = 150e3, 50.0
#: Shares of the mean flash temperature in bulk and integral temperature: C_1 and C_2.
_BULK, _FLASH = 0.7, 1.5


def tip_relief_factor(tip_contact_ratios: tuple[float, float], share: float) -> float:
    """X_Ca over C_a/C_eff, which counts up to 1: ISO/TR 13989-2:2000, (32).

    1 + (0.06 + 0.18 C_a/C_eff) ε_max + (0.02 + 0.69 C_a/C_eff) ε_max²: above 1 without relief too.
    """
    longest, relief = max(tip_contact_ratios), min(max(share, 0.0), 1.0)
    return 1.0 + (0.06 + 0.18 * relief) * longest + (0.02 + 0.69 * relief) * longest**2


def effective_tip_relief(line_load: float, stiffness: tuple[float, float], *, helical: bool) -> float:
    """C_eff = K_A F_t/(b c′) of spur, K_A F_t/(b c_γ) of helical gears, m: ISO/TR 13989-2:2000.

    Of K_A F_t/b at the reference circle (N/m) and (c′, c_γα) per face width (Pa).
    """
    return line_load / stiffness[1 if helical else 0]


def load_safety(scuffing: float, integral: float, oil_temperature: float) -> float:
    """S_SL = (θ_intS − θ_oil)/(θ_int − θ_oil), K: about the factor by which the load may grow."""
    return (scuffing - oil_temperature) / (integral - oil_temperature)


class IntegralTemperature(NamedTuple):
    """Friction coefficient μ_mC, then temperatures in K."""

    friction_coefficient: float  # μ_mC at the pitch point
    at_tip: float  # θ_flaE of the pinion's tip under the whole load
    flash_rise: float  # θ_flaint, mean over the path
    bulk: float  # θ_M-C
    integral: float  # θ_int


class ScuffingMesh(NamedTuple):
    """What the integral temperature depends on besides the path."""

    line_load: float  # w_Bt = K_A K_v K_Bβ K_Bα F_t/b, F_t at the reference circle, N/m
    pitch_speed: float  # v at the reference circle, m/s
    viscosity: float  # η at the oil's temperature, Pa·s
    oil_temperature: float  # K
    roughness: float  # (Ra_1 + Ra_2)/2, m
    reduced_modulus: float  # E_r = 2/Σ(1 − ν²)/E, Pa
    thermal_contact: float  # mean B_M, W s^½/(m² K)
    #: pressure_angle, helix_angle: α_n and β, rad
    pressure_angle: float
    helix_angle: float = 0.0
    #: lubricant, lubrication, tip_relief: X_L (without viscosity), X_S, X_Ca
    lubricant: float = 1.0
    lubrication: float = 1.0
    tip_relief: float = 1.0
    run_in: float = 1.0  # φ_E: 1 after running in, 0 of new flanks


def contact_ratio_factor(first: float, second: float) -> float:
    """X_ε from the tip contact ratios ε_1 and ε_2, up to ε_α = 3: (39) to (44).

    Mean over the path of the flash temperature that the pinion's tip would have under the whole load.
    """
    total = first + second
    if total < 1.0:
        sharing = first**2 + second**2
    elif total < 2.0 and max(first, second) < 1.0:
        sharing = 0.70 * (first**2 + second**2) - 0.22 * total + 0.52 - 0.60 * first * second
    elif total < 2.0 and first >= 1.0:
        sharing = 0.18 * first**2 + 0.70 * second**2 + 0.82 * first - 0.52 * second - 0.30 * first * second
    elif total < 2.0:
        sharing = 0.70 * first**2 + 0.18 * second**2 - 0.52 * first + 0.82 * second - 0.30 * first * second
    else:
        long, short = max(first, second), min(first, second)
        sharing = 0.44 * long**2 + 0.59 * short**2 + 0.30 * (long - short) - 0.15 * long * short
    return sharing / (2.0 * total * first)


def approach_factor(first: float, second: float) -> float:
    """X_Q of a driving pinion: 1 up to ε_2/ε_1 = 1.5, 0.6 from 3 on, linear between: (25) to (29)."""
    return min(max(1.40 - 4.0 / 15.0 * second / first, 0.6), 1.0)


def pressure_angle_factor(working: float, pressure_angle: float, helix_angle: float) -> float:
    """X_αβ = 1.22 (sin α_wt cos α_n cos β)^¼/√(cos α_wt cos α_t), α_wt and α_n in rad: (13)."""
    transverse = transverse_angle(pressure_angle, helix_angle)
    product = math.sin(working) * math.cos(pressure_angle) * math.cos(helix_angle)
    return 1.22 * product**0.25 / math.sqrt(math.cos(working) * math.cos(transverse))


def thermal_flash_factor(reduced_modulus: float, thermal_contact: float) -> float:
    """X_M = E_r^¼/B_M, of steel 50 K N^−¾ s^½ m^−½ mm; from Pa and W s^½/(m² K): (11), (12)."""
    return 1e3 * (1e-6 * reduced_modulus) ** 0.25 / (thermal_contact / math.sqrt(1e3))


def geometry_factor(path: ContactPath) -> float:
    """X_BE = 0.51 √(u + 1) (√ρ_E1 − √(ρ_E2/u))/(ρ_E1 ρ_E2)^¼, from the radii of curvature at E: (10)."""
    first, second = (1e3 * abs(float(radius)) for radius in curvature_radii(path, path.length))
    geometry = 0.51 * math.sqrt(path.ratio + 1.0) * (math.sqrt(first) - math.sqrt(second / path.ratio))
    return geometry / (first * second) ** 0.25


def integral_temperature(path: ContactPath, mesh: ScuffingMesh) -> IntegralTemperature:
    """Integral temperature of a driving pinion and its gear: (1) to (31).

    θ_int = θ_M + 1.5 θ_flaint, θ_M = θ_oil + 0.7 X_S θ_flaint, θ_flaint = θ_flaE X_ε; θ_flaE of the pinion's
    tip under the whole load, μ_mC X_M X_BE X_αβ (K_Bγ w_Bt)^¾ √v/a^¼ X_E/(X_Q X_Ca) in N/mm, m/s, mm.
    """
    ratio, first, second = path.ratio, *path.tip_contact_ratios
    helical = helical_load_factor(path.total_contact_ratio)
    working, base_helix = path.pressure_angle, path.base_helix_angle
    transverse = transverse_angle(mesh.pressure_angle, mesh.helix_angle)
    pitch_radius = (
        ratio / (1.0 + ratio) ** 2 * path.centre_distance * math.sin(working) / math.cos(base_helix)
    )
    speed_sum = 2.0 * min(mesh.pitch_speed, _FASTEST) * math.tan(working) * math.cos(transverse)
    friction = mean_friction(
        max(mesh.line_load, _LINE_LOAD) * helical,
        speed_sum,
        pitch_radius,
        mesh.viscosity,
        roughness_factor(mesh.roughness, pitch_radius),
        mesh.lubricant,
    )
    geometry = geometry_factor(path)
    angles = pressure_angle_factor(working, mesh.pressure_angle, mesh.helix_angle)
    flash = thermal_flash_factor(mesh.reduced_modulus, mesh.thermal_contact)
    load = (1e-3 * mesh.line_load * helical) ** 0.75
    running_in = 1.0 + (1.0 - mesh.run_in) * 30.0 * 1e3 * mesh.roughness / pitch_radius
    at_tip = friction * flash * geometry * angles * load * math.sqrt(mesh.pitch_speed)
    at_tip *= running_in / ((1e3 * path.centre_distance) ** 0.25 * approach_factor(first, second))
    mean = at_tip / mesh.tip_relief * contact_ratio_factor(first, second)
    bulk = mesh.oil_temperature + _BULK * mesh.lubrication * mean
    return IntegralTemperature(friction, at_tip / mesh.tip_relief, mean, bulk, bulk + _FLASH * mean)


def integral_safety(scuffing: float, integral: float) -> float:
    """S_intS = θ_intS/θ_int of temperatures in °C (given in K): (14)."""
    return (scuffing - 273.15) / (integral - 273.15)
