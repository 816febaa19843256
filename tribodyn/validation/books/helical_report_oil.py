"""Sections 4b, 4d and 5 of the design report of 2017: micropitting, tooth flank fracture and scuffing."""

import math
from typing import Any

import numpy as np

from tribodyn.gears.rating.fracture import middle_thickness
from tribodyn.gears.rating.margins import flanks_of, strength_of
from tribodyn.gears.rating.standard import Standard
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.standards import contact_path, fzg, micropitting, scuffing
from tribodyn.standards.case_hardening import flank_fracture
from tribodyn.standards.case_hardening.flank_fracture import HardenedCase
from tribodyn.standards.metals import VICKERS
from tribodyn.validation.books import helical_report_geometry as shape
from tribodyn.validation.books import printed
from tribodyn.validation.books.scuffing import raised, scuffing_numbers

BOOK = "helical-report-2017"


def films(case: Any, standard: Standard) -> dict[str, Any]:
    """Section 4b, of the contact at A."""
    found = printed(BOOK)
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
        # 8.3 m/s at the reference in place of the working circle: (P μ_m)^0.72
        "theMRef": 90.0 + (test.bulk_temperature - 363.15) * (73.2 / 72.0) ** (0.8 * 0.72),
        "theBRef_A": test.contact_temperature - 273.15,
        "hRef_A": 1e6 * test.film_thickness,
        "lamGFT": found["hRef_A"] / 0.5,
        "WW": 1.0,
        "lamGFP": micropitting.permissible_film(found["lamGFT"]),
        "Slam": float(films.specific_film[0]) / strength.specific_film,
    }


def fracture(assembly: Assembly, standard: Standard) -> dict[str, Any]:
    """Section 4d, of the contact at A: at the printed depth of 1.1 mm, with depths in steps of 0.1 mm."""
    pressure = float(standard.films.pressure[0])
    width = 4.0 * float(contact_path.equivalent_radius(standard.path, 0.0)) * pressure / 226374e6
    hard = HardenedCase(720.0 * VICKERS, 342.0 * VICKERS, 0.5e-3)
    depths, depth = np.arange(1, 60) * 1e-4, np.array([1.1e-3])
    factors = [flank_fracture.material_factor(middle_thickness(assembly, standard, side)) for side in SIDES]
    there, worst = (
        [flank_fracture.greatest_exposure(hard, pressure, width, factor, each) for factor in factors]
        for each in (depth, depths)
    )
    return {
        "AFFmax": [each.exposure for each in there],
        "y_max": [-1e3 * each.depth for each in worst],
        "Kmaterial": factors,
        "tauper": [1e-6 * each.strength for each in there],
        "taueff": [1e-6 * each.stress for each in there],
        "SFF": [flank_fracture.fracture_safety(hard, pressure, width, factor, depths) for factor in factors],
    }


#: Our names of scuffing by the report's.
_SCUFFING = {
    "etaM": "eta_oil",
    "wBt": "w_Bt",
    "Xalfbet": "X_alphabeta",
    "XL_fla": "X_L_fla",
    "XM": "X_M",
    "mu_fla": "mu_fla",
    "theMi": "theta_M_fla",
    "theB": "theta_B",
    "theS": "theta_S",
    "SB": "S_B",
    "XBE": "X_BE",
    "XQ": "X_Q",
    "Xeps": "X_eps",
    "XCa": "X_Ca",
    "mu_int": "mu_mC",
    "theflaint": "theta_flaint",
    "theMC": "theta_M_int",
    "theint": "theta_int",
    "theSint": "theta_intS",
    "SSint": "S_intS",
    "SSL": "S_SL",
}


def scuffed(case: Any, standard: Standard, relieved: Standard) -> dict[str, Any]:
    """Section 5: ISO/TR 13989-1 and -2; as the report has them, X_J 1, and μ_mC of F_t/cos β."""
    path, factors = standard.path, standard.factors
    line_load = factors.line_load * factors.dynamic_factor * factors.duty.face * factors.transverse
    effective = scuffing.effective_tip_relief(factors.line_load, (1.0, factors.stiffness.mesh), helical=True)
    flash = relieved.flash_bulk, relieved.flash_contact
    normal, relief = (shape.ALPHA, shape.HELIX), 2e-6 / effective
    inclined = math.cos(shape.HELIX) ** -0.2
    standard = raised(standard, case.oil_temperature, inclined, inclined)
    numbers = scuffing_numbers(case, standard, normal, line_load, flash, relief)
    pitch_point = float(contact_path.point_distances(path)[3])
    found, oil = printed(BOOK), case.oil_temperature - 273.15
    return {name: numbers[ours] for name, ours in _SCUFFING.items()} | {
        "BM": 1e-3 * numbers["B_M"],
        "Ceff": 1e6 * effective,
        "theflm": (flash[0] - case.oil_temperature) / 0.47,
        "theMi": oil + 0.47 * found["theflm"],
        "SB": scuffing.flash_safety(numbers["theta_S"], found["theB"], oil),
        "Gamma_max": (path.length - pitch_point) / (path.base_radius[0] * math.tan(path.pressure_angle)),
        "XJ": 1.0,
        "XGam": float(contact_path.flash_share(path, path.length)),
        "XE": 1.0,
    }
