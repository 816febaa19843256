"""Friction laws that give a whole mesh one mean coefficient, from the conditions at its pitch point.

Evaluated once before a run; the contact then has the coefficient as a Coulomb contact has its own.
"""

import math
from typing import Any, NamedTuple

from tribodyn.numerics.elementary import exp, log


class MeanConditions(NamedTuple):
    """Nominal conditions of a mesh at its pitch point, SI.

    Attributes
    ----------
    line_load : normal load of a single pair over the face width, w = F_t/(b cos α), N/m
    curvature : relative curvature 1/ρ_C at the pitch point, 1/m
    sum_speed : V_ΣC = 2 V sin α, sum of the rolling speeds at the pitch point, m/s
    pitch_line_speed : V, m/s
    load_intensity : K = F_t (u + 1)/(b d_1 u), Pa
    viscosity : η at the temperature of the oil, Pa·s
    density : of the oil, kg/m³
    mean_roughness : Ra, arithmetic mean roughness of the flanks, m
    load_exponent : d of the lubricant factor X_L = (w mm/N)^−d
    """

    line_load: Any
    curvature: Any
    sum_speed: Any
    pitch_line_speed: Any
    load_intensity: Any
    viscosity: Any
    density: Any
    mean_roughness: Any
    load_exponent: Any


def mean_conditions(
    tangential_load: Any,
    pinion_pitch_radius: Any,
    gear_pitch_radius: Any,
    pressure_angle: Any,
    pinion_speed: Any,
    face_width: Any,
    viscosity: Any,
    density: Any,
    mean_roughness: Any,
    load_exponent: Any,
) -> MeanConditions:
    """Conditions at the pitch point of a path of contact, whatever its family, with pressure angle > 0 there.

    Parameters
    ----------
    tangential_load : N
        F_t on the pitch circles.
    pinion_pitch_radius, gear_pitch_radius, pressure_angle : m, m, rad
        At the pitch point.
    pinion_speed : rad/s
    face_width : m
    viscosity, density, mean_roughness, load_exponent
        As in `MeanConditions`.
    """
    per_width = tangential_load / face_width
    curvatures = 1.0 / pinion_pitch_radius + 1.0 / gear_pitch_radius
    speed = pinion_speed * pinion_pitch_radius
    return MeanConditions(
        line_load=per_width / math.cos(pressure_angle),
        curvature=curvatures / math.sin(pressure_angle),
        sum_speed=2.0 * speed * math.sin(pressure_angle),
        pitch_line_speed=speed,
        load_intensity=per_width * curvatures / 2.0,
        viscosity=viscosity,
        density=density,
        mean_roughness=mean_roughness,
        load_exponent=load_exponent,
    )


def niemann(conditions):
    """Mean friction coefficient by Niemann, as ISO/TR 14179-2 and Höhn use it.

    μ_m = 0.048 [w/(V_ΣC ρ_C)]^0.2 η^−0.05 Ra^0.25 X_L, X_L = w^−d, with w in N/mm, V in m/s, ρ in mm, η in
    mPa·s and Ra in µm: Diez-Ibarbia (6), whose print loses the face width in w. Fitted to FZG tests of
    case-hardened gears, V up to about 50 m/s; d = 0.0651 for mineral oil 75W90.
    """
    load = 1e-3 * conditions.line_load
    group = load * 1e-3 * conditions.curvature / conditions.sum_speed
    viscosity = 1e3 * conditions.viscosity
    roughness = 1e6 * conditions.mean_roughness
    return 0.048 * exp(
        0.2 * log(group)
        - 0.05 * log(viscosity)
        + 0.25 * log(roughness)
        - conditions.load_exponent * log(load)
    )


def iso_14179_1(conditions):
    """Mesh coefficient of friction of ISO/TR 14179-1:2001 (AGMA's method).

    f_m = ν^−0.223 K^−0.40/(3.239 V^0.70) with the kinematic viscosity ν in mm²/s, the load intensity K in
    N/mm² and the pitch line speed V in m/s; for 2 < V ≤ 25 m/s and 1.4 < K ≤ 14 N/mm². The coefficient falls
    with the load, against the other laws, and knows nothing of roughness.
    """
    kinematic = 1e6 * conditions.viscosity / conditions.density
    intensity = 1e-6 * conditions.load_intensity
    return (
        exp(-0.223 * log(kinematic) - 0.40 * log(intensity) - 0.70 * log(conditions.pitch_line_speed)) / 3.239
    )
