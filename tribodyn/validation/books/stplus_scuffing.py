"""Scuffing of the FZG gears of type C in the listing of STplus: ISO/TS 6336-20 and -21:2017."""

import math
from typing import Any

import numpy as np

from tribodyn.compliance.iso6336 import ReferenceStiffness
from tribodyn.gears.rating.margins import flanks_of, strength_of
from tribodyn.standards import contact_path, fzg, micropitting, scuffing
from tribodyn.tribology.oil import kinematic_viscosity
from tribodyn.validation.books.stplus_geometry import ALPHA, WIDTH, pair

TORQUE = 130.0  # N m


def scuffed(case: Any, standard: Any, stiffness: ReferenceStiffness, factor: float) -> dict[str, Any]:
    """ISO/TS 6336-20 and -21."""
    path, integral, duty = standard.path, standard.integral, standard.factors.duty
    oil = case.lubricant.sheet
    strength = strength_of(case.lubricant, case.oil_temperature)
    assert strength.scuffing is not None
    assert strength.scuffing_integral is not None
    viscosity = float(oil.viscosity(333.15))
    from_pitch = contact_path.point_distances(path)[[0, 2, 3, 4, 6]]
    pitch = path.base_radius[0] * math.tan(path.pressure_angle)
    gammas = contact_path.curvature_radii(path, from_pitch)[0] / pitch - 1.0
    flanks, radius = (
        flanks_of(case),
        float(contact_path.equivalent_radius(path, contact_path.point_distances(path)[3])),
    )
    line_load = 3611.1e3 / 14.0
    test_torque = fzg.scuffing_torque(6)
    bulk_test = 80.0 + 0.23 * test_torque
    flash_test = 0.2 * test_torque * (100.0 / 90.02) ** 0.02
    tip = [1e3 * float(r) for r in contact_path.curvature_radii(path, path.length)]
    geometry = (
        0.51 * math.sqrt(2.5) * (math.sqrt(tip[0]) - math.sqrt(tip[1] / 1.5)) / (tip[0] * tip[1]) ** 0.25
    )
    lubricant = scuffing.lubricant_factor(1.0, viscosity)
    speeds = contact_path.rolling_speeds(
        path, contact_path.point_distances(path)[3], case.operating.pinion_speed
    )
    friction = scuffing.flash_friction(
        line_load * factor, float(sum(speeds)), radius, lubricant, case.mean_roughness
    )
    values = {
        "eta_40": 1e3 * float(oil.viscosity(313.15)),
        "eta_100": 1e3 * float(oil.viscosity(373.15)),
        "eta_oil": 1e3 * viscosity,
        "VT": (math.log10(math.log10(90.82)) - math.log10(math.log10(11.21))) / math.log10(373.0 / 313.0),
        "nu_50": 1e6 * float(kinematic_viscosity(90.02e-6, 10.41e-6, 323.15)),
        "nu_60": 1e6 * float(kinematic_viscosity(90.02e-6, 10.41e-6, 333.15)),
        "B_M": pair(lambda i: flanks.thermal_contact[i] / math.sqrt(1e3)),
        "X_alphabeta": scuffing.pressure_angle_factor(path.pressure_angle, ALPHA, 0.0),
        "K_Bbeta": duty.face,
        "K_Bgamma": contact_path.helical_load_factor(path.total_contact_ratio),
        "X_E": 1.0 + 30.0 * 1e3 * case.mean_roughness / radius,
        "X_R": micropitting.roughness_factor(case.mean_roughness, radius),
        "X_Q": scuffing.approach_factor(*path.tip_contact_ratios),
        "X_BE": geometry,
        "X_M": scuffing.thermal_flash_factor(flanks.reduced_modulus, flanks.thermal_contact[0]),
        "X_eps": scuffing.contact_ratio_factor(*path.tip_contact_ratios),
        "X_Ca": scuffing.tip_relief_factor(path.tip_contact_ratios, 0.0),
        "C_eff_int": 1e6
        * scuffing.effective_tip_relief(line_load, (stiffness.single_pair, stiffness.mesh), helical=False),
        "C_eff_fla": 1e6 * line_load / math.cos(ALPHA) / stiffness.mesh,
        "mu_mC": integral.friction_coefficient,
        "theta_int": integral.integral - 273.15,
        "theta_flaE": integral.at_tip,
        "theta_flaint": integral.flash_rise,
        "theta_M_int": integral.bulk - 273.15,
        "theta_intS": strength.scuffing_integral - 273.15,
        "theta_MT": bulk_test,
        "theta_flaintT": flash_test,
        "S_intS": scuffing.integral_safety(strength.scuffing_integral, integral.integral),
        "w_Bt": 1e-3 * line_load * factor,
        "S_SL": scuffing.load_safety(strength.scuffing_integral, integral.integral, case.oil_temperature),
        "X_L_fla": lubricant,
        "theta_flamax": standard.flash_contact - standard.flash_bulk,
        "theta_M_fla": standard.flash_bulk - 273.15,
        "mu_fla": friction,
        "theta_B": standard.flash_contact - 273.15,
        "theta_S": strength.scuffing - 273.15,
        "S_B": scuffing.flash_safety(strength.scuffing, standard.flash_contact, case.oil_temperature),
    }
    values |= {f"Gamma_{name}": float(gamma) for name, gamma in zip("ABCDE", gammas, strict=True)}
    return values | _flashes(case, standard, friction, flanks, factor, 1e-6 * values["C_eff_fla"])


def _flashes(
    case: Any, standard: Any, friction: float, flanks: Any, factor: float, effective: float
) -> dict[str, float]:
    """Flash temperature at A, B, D, E."""
    path = standard.path
    places = contact_path.point_distances(path)[[0, 2, 4, 6]]
    load = (
        factor * TORQUE / path.base_radius[0] / (WIDTH * 1e-3) * contact_path.flash_share(path, places, 5.0)
    )
    radii = contact_path.equivalent_radius(path, places)
    width = np.sqrt(8.0 * load * radii / (np.pi * flanks.reduced_modulus))
    speeds = contact_path.rolling_speeds(path, places, case.operating.pinion_speed)
    rises = scuffing.flash_rise(friction, load, width, speeds, flanks.thermal_contact)
    before = contact_path.point_distances(path)[3] - places
    rises *= scuffing.flash_approach(before, path.length, effective)
    return {f"theta_fl_{name}": float(rise) for name, rise in zip("ABDE", rises, strict=True)}
