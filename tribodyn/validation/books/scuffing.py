"""Scuffing of a book's gears by symbol: ISO/TS 6336-20 and -21:2017, ISO/TR 13989-1 and -2:2000."""

from typing import Any

import numpy as np

from tribodyn.gears.rating.margins import flanks_of, strength_of
from tribodyn.gears.rating.standard import Standard
from tribodyn.standards import contact_path, scuffing


def raised(standard: Standard, oil: float, friction: float, flash: float) -> Standard:
    """The same with another friction coefficient and flash temperature of the integral method, as factors.

    `oil` is the temperature of the oil, K.
    """
    integral = standard.integral
    assert integral is not None
    rise, bulk = flash * integral.flash_rise, oil + flash * (integral.bulk - oil)
    return standard._replace(
        integral=integral._replace(
            friction_coefficient=friction * integral.friction_coefficient,
            at_tip=flash * integral.at_tip,
            flash_rise=rise,
            bulk=bulk,
            integral=bulk + 1.5 * rise,
        )
    )


def scuffing_numbers(
    case: Any,
    standard: Standard,
    normal: tuple[float, float],
    line_load: float,
    flash: tuple[float, float],
    relief: float = 0.0,
) -> dict[str, Any]:
    """Factors, and temperatures in °C.

    Of α_n and β (rad), w_Bt with all load factors (N/m), bulk and contact temperature of the flash method (K)
    and C_a/C_eff.
    """
    path, integral, oil = standard.path, standard.integral, case.oil_temperature
    strength, flanks = strength_of(case.lubricant, oil), flanks_of(case)
    limit, integral_limit = strength.scuffing, strength.scuffing_integral
    assert integral is not None
    assert limit is not None
    assert integral_limit is not None
    tips = path.tip_contact_ratios
    pitch_point = contact_path.point_distances(path)[3]
    radius = float(contact_path.equivalent_radius(path, pitch_point))
    speeds = float(sum(contact_path.rolling_speeds(path, pitch_point, case.operating.pinion_speed)))
    viscosity = float(case.lubricant.sheet.viscosity(oil))
    lubricant = scuffing.lubricant_factor(1.0, viscosity)
    return {
        "eta_oil": 1e3 * viscosity,
        "B_M": np.array(flanks.thermal_contact),
        "w_Bt": 1e-3 * line_load,
        "X_alphabeta": scuffing.pressure_angle_factor(path.pressure_angle, *normal),
        "X_L_fla": lubricant,
        "X_M": scuffing.thermal_flash_factor(flanks.reduced_modulus, flanks.thermal_contact[0]),
        "mu_fla": scuffing.flash_friction(line_load, speeds, radius, lubricant, case.mean_roughness),
        "theta_M_fla": flash[0] - 273.15,
        "theta_B": flash[1] - 273.15,
        "theta_S": limit - 273.15,
        "S_B": scuffing.flash_safety(limit, flash[1], oil),
        "X_BE": scuffing.geometry_factor(path),
        "X_Q": scuffing.approach_factor(*tips),
        "X_eps": scuffing.contact_ratio_factor(*tips),
        "X_Ca": scuffing.tip_relief_factor(tips, relief),
        "mu_mC": integral.friction_coefficient,
        "theta_flaint": integral.flash_rise,
        "theta_M_int": integral.bulk - 273.15,
        "theta_int": integral.integral - 273.15,
        "theta_intS": integral_limit - 273.15,
        "S_intS": scuffing.integral_safety(integral_limit, integral.integral),
        "S_SL": scuffing.load_safety(integral_limit, integral.integral, oil),
    }
