"""Scuffing by the flash temperature: ISO/TS 6336-20:2017, before it ISO/TR 13989-1:2000.

Numbers of equations are those of ISO/TR 13989-1.
"""

from typing import Any

import numpy as np


def lubricant_factor(kind_factor: float, viscosity: float) -> float:
    """X_L of an oil at its viscosity η, Pa·s, from that of its type, X_L η^0.05 with η in mPa·s: (27).

    The types have the factors of `micropitting.Oil`.
    """
    return kind_factor * (1e3 * viscosity) ** -0.05


def mean_friction(
    line_load: float, speed_sum: float, pitch_radius: float, lubricant: float, roughness: float
) -> float:
    """Mean friction coefficient μ_m: (25) to (28).

    0.060 (w_Bt/(v_ΣC ρ_relC))^0.2 X_L Ra^0.25 in N/mm, m/s, mm, µm, with X_L of `lubricant_factor`.

    Parameters
    ----------
    line_load : w_Bt = K_A K_v K_Hβ K_Hα F_t/b, N/m
    speed_sum : v_ΣC = 2 v_t sin α_wt, m/s
    pitch_radius : radius of relative curvature at the pitch point, m
    roughness : (Ra_1 + Ra_2)/2, m
    """
    load = 1e-3 * line_load / (speed_sum * 1e3 * pitch_radius)
    return 0.060 * load**0.2 * lubricant * (1e6 * roughness) ** 0.25


def flash_rise(
    friction: Any,
    line_load: Any,
    half_width: Any,
    speeds: tuple[Any, Any],
    thermal_contact: tuple[float, float],
    approach: Any = 1.0,
) -> Any:
    """Flash temperature rise after Blok, K: (3).

    1.11 μ_m X_J w |v_g1 − v_g2|/(√(2 b_H)(B_M1 √v_g1 + B_M2 √v_g2)).

    Parameters
    ----------
    friction : μ_m
    line_load : normal load per length of the contact line, N/m
    half_width : b_H of the Hertz contact, m
    speeds : v_g1, v_g2, m/s
    thermal_contact : B_M of pinion and gear, W s^½/(m² K)
    """
    first, second = speeds
    share = thermal_contact[0] * np.sqrt(first) + thermal_contact[1] * np.sqrt(second)
    return (
        1.11 * friction * approach * line_load * np.abs(first - second) / (np.sqrt(2.0 * half_width) * share)
    )


def bulk_temperature(oil_temperature: float, mean_flash: float, lubrication: float = 1.0) -> float:
    """Bulk temperature θ_M = θ_oil + 0.47 X_S X_mp θ_fl,m, K, of a gear with one mate: (22) to (24).

    `mean_flash` is the mean of the flash temperature along the path, `lubrication` X_S.
    """
    return oil_temperature + 0.47 * lubrication * mean_flash


def safety(scuffing_temperature: float, contact_temperature: float, oil_temperature: float) -> float:
    """S_B = (θ_S − θ_oil)/(θ_Bmax − θ_oil): (100)."""
    return (scuffing_temperature - oil_temperature) / (contact_temperature - oil_temperature)
