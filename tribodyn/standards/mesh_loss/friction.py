"""Mean friction coefficient of a mesh by published regressions, one a function; all take arrays.

Of the load per width at the base circle F_bt/b, the sum of rolling speeds v_ΣC = 2 v_t sin α_wt and the
normal radius of relative curvature ρ_C, both at the pitch point, the oil's viscosity at its own temperature
and Ra = (Ra_1 + Ra_2)/2 of new flanks. Each is a mean over the path of contact, of the mesh as a whole.
"""

from typing import Any

import numpy as np


def schlenk(
    line_load: Any, speed_sum: Any, pitch_radius: Any, viscosity: Any, roughness: Any, lubricant: Any
) -> Any:
    """μ_mZ = 0.048 (F_bt/b/(v_ΣC ρ_C))^0.2 η^−0.05 Ra^0.25 X_L in N/mm, m/s, mm, mPa s, µm.

    Schlenk (TU München 1995), which ISO/TR 14179-2 and Niemann/Winter have too; they differ in the table of
    the lubricant's factor X_L. Fitted to FZG gears of case-hardened steel at pitch line speeds of 1 to 50 m/s
    and from about 150 N/mm on.
    """
    load = 1e-3 * line_load / (speed_sum * 1e3 * pitch_radius)
    return 0.048 * load**0.2 * (1e3 * viscosity) ** -0.05 * (1e6 * roughness) ** 0.25 * lubricant


def iso_14179_1(kinematic_viscosity: Any, load_intensity: Any, pitch_speed: Any) -> Any:
    """f_m = ν^−0.223 K^−0.40/(3.239 V^0.70) in mm²/s, N/mm², m/s: ISO/TR 14179-1:2001 (AGMA).

    For 2 < V ≤ 25 m/s and a load intensity of 1.4 < K ≤ 14 N/mm², see `load_intensity`. It falls with the
    load, against the others, and knows no roughness.
    """
    return (
        (1e6 * kinematic_viscosity) ** -0.223 * (1e-6 * load_intensity) ** -0.40 / (3.239 * pitch_speed**0.70)
    )


def load_intensity(pinion_torque: Any, face_width: Any, pitch_radius: Any, ratio: Any) -> Any:
    """K = T_1 (u + 1)/(2 b r_w1² u), Pa, with the pinion's working pitch radius: ISO/TR 14179-1:2001."""
    return pinion_torque * (ratio + 1.0) / (2.0 * face_width * pitch_radius**2 * ratio)


def fernandes(
    normal_force: Any,
    contact_length: Any,
    speed_sum: Any,
    pitch_radius: Any,
    viscosity: Any,
    pressure_viscosity: Any,
    roughness: Any,
    lubricant: Any,
) -> Any:
    """μ_mZ = 0.014 S_p^−¼ S_g^¼ X_L, S_p = v_ΣC η √(α/F_bn), S_g = Ra/√(l ρ_C), in SI units.

    C. M. C. G. Fernandes, R. C. Martins, J. H. O. Seabra, Tribol. Int. 70 (2014) 83, as the open program
    GEARpie of the first author has it; X_L as in Schlenk's with that program's table: 0.846 of mineral oil,
    0.65 of PAO and esters, 0.585 of PAG. `contact_length` l is the least sum of the lines of contact over the
    mesh cycle, F_bn the whole normal force. Fitted to wind turbine gear oils on FZG gears.
    """
    speed = speed_sum * viscosity * np.sqrt(pressure_viscosity / normal_force)
    return 0.014 * (roughness / np.sqrt(contact_length * pitch_radius) / speed) ** 0.25 * lubricant
