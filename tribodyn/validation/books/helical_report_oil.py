"""Micropitting and scuffing in the design report of 2017: ISO/TR 15144-1:2014, ISO/TR 13989:2000."""

import math
from typing import Any

import numpy as np

from tribodyn.gears.rating.margins import flanks_of, strength_of
from tribodyn.gears.rating.standard import Standard
from tribodyn.standards import contact_path, fzg, micropitting, scuffing
from tribodyn.validation.books import helical_report_geometry as shape
from tribodyn.validation.books.helical_report_geometry import both


def films(case: Any, standard: Standard) -> dict[str, Any]:
    """Section 4b, of the contact at A."""
    films, path, sheet = standard.films, standard.path, case.lubricant.sheet
    flanks, radius = flanks_of(case), float(contact_path.equivalent_radius(path, 0.0))
    factor = standard.factors.duty.application * standard.factors.dynamic_factor
    factor *= standard.factors.duty.face * standard.factors.transverse
    strength = strength_of(case.lubricant, case.oil_temperature)
    test = fzg.micropitting_test(10, micropitting.Oil(sheet.viscosity, sheet.pressure_viscosity))
    assert strength.specific_film is not None
    return {
        "mp_mu": films.friction_coefficient,
        "XR": micropitting.roughness_factor(
            case.mean_roughness,
            float(contact_path.equivalent_radius(path, contact_path.point_distances(path)[3])),
        ),
        "theM": films.bulk_temperature - 273.15,
        "XCaA": 1.0,
        "HV": standard.losses,
        "Er": 1e-6 * flanks.reduced_modulus,
        "alf38": 1e6 * sheet.pressure_viscosity(311.15),
        "etatM": 1e3 * sheet.viscosity(films.bulk_temperature),
        "mp_rho": 1e3 * radius,
        "XY": float(contact_path.load_share(path, 0.0)),
        "pH": 1e-6 * float(films.pressure[0]) / math.sqrt(factor),
        "pdyn": 1e-6 * float(films.pressure[0]),
        "lam_A": float(films.specific_film[0]),
        "hY_A": 1e6 * float(films.film_thickness[0]),
        "FbbRef_A": 1e-3 * test.line_load,
        "theMRef": test.bulk_temperature - 273.15,
        "theBRef_A": test.contact_temperature - 273.15,
        "hRef_A": 1e6 * test.film_thickness,
        "lamGFT": test.specific_film,
        "WW": 1.0,
        "lamGFP": strength.specific_film,
        "Slam": float(films.specific_film[0]) / strength.specific_film,
    }


def scuffed(case: Any, standard: Standard, speed: float, flash: tuple[float, float]) -> dict[str, Any]:
    """Section 5: ISO/TR 13989-1 and -2; bulk and contact temperature with X_J 1, K."""
    path, integral, oil = standard.path, standard.integral, case.oil_temperature
    strength, flanks = strength_of(case.lubricant, oil), flanks_of(case)
    assert integral is not None
    assert strength.scuffing is not None
    assert strength.scuffing_integral is not None
    factors, viscosity = standard.factors, float(case.lubricant.sheet.viscosity(oil))
    line_load = factors.line_load * factors.dynamic_factor * factors.duty.face * factors.transverse
    distance = np.linspace(0.0, path.length, 201)
    pitch_point = contact_path.point_distances(path)[3]
    radius = float(contact_path.equivalent_radius(path, pitch_point))
    lubricant = scuffing.lubricant_factor(1.0, viscosity)
    speeds = float(sum(contact_path.rolling_speeds(path, pitch_point, speed)))
    friction = scuffing.flash_friction(line_load, speeds, radius, lubricant, case.mean_roughness)
    tip = [1e3 * float(r) for r in contact_path.curvature_radii(path, path.length)]
    geometry = 0.51 * math.sqrt(path.ratio + 1.0)
    geometry *= (math.sqrt(tip[0]) - math.sqrt(tip[1] / path.ratio)) / (tip[0] * tip[1]) ** 0.25
    effective = scuffing.effective_tip_relief(factors.line_load, (1.0, factors.stiffness.mesh), helical=True)
    return {
        "BM": both(lambda i: 1e-3 * flanks.thermal_contact[i]),
        "Ceff": 1e6 * effective,
        "wBt": 1e-3 * line_load,
        "Xalfbet": scuffing.pressure_angle_factor(path.pressure_angle, shape.ALPHA, shape.HELIX),
        "XL_fla": lubricant,
        "theMi": flash[0] - 273.15,
        "theflm": (flash[0] - oil) / 0.47,
        "theS": strength.scuffing - 273.15,
        "Gamma_max": (path.length - float(pitch_point))
        / (path.base_radius[0] * math.tan(path.pressure_angle)),
        "theB": flash[1] - 273.15,
        "XM": scuffing.thermal_flash_factor(flanks.reduced_modulus, flanks.thermal_contact[0]),
        "XJ": 1.0,
        "XGam": float(contact_path.flash_share(path, distance[-1])),
        "etaM": 1e3 * viscosity,
        "mu_fla": friction,
        "SB": scuffing.flash_safety(strength.scuffing, flash[1], oil),
        "theMC": integral.bulk - 273.15,
        "theflaint": integral.flash_rise,
        "theSint": strength.scuffing_integral - 273.15,
        "XE": 1.0,
        "Xeps": scuffing.contact_ratio_factor(*path.tip_contact_ratios),
        "mu_int": integral.friction_coefficient,
        "XBE": geometry,
        "XQ": scuffing.approach_factor(*path.tip_contact_ratios),
        "XCa": scuffing.tip_relief_factor(path.tip_contact_ratios, 2e-6 / effective),
        "theint": integral.integral - 273.15,
        "SSint": scuffing.integral_safety(strength.scuffing_integral, integral.integral),
        "SSL": scuffing.load_safety(strength.scuffing_integral, integral.integral, oil),
    }
