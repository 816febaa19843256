"""A published design report of a helical stage (KISSsoft 2017): ISO 6336:2006 and its parts, row by row.

Load factors follow from the report's tolerances, stiffness and mass; roots are those of tips in the middle of
their tolerance, as the report has them.
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.compliance import iso6336
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import capacity_of, life_bins
from tribodyn.gears.rating.margins import flanks_of, strength_of
from tribodyn.gears.rating.standard import Standard, rated_duty, standard_of
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.root_section import critical_section
from tribodyn.standards import contact_path, fzg, load_factors, micropitting, scuffing
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.books import helical_report_geometry as shape
from tribodyn.validation.books import rows_of, sides
from tribodyn.validation.books.scuffing import scuffing_numbers

BOOK = "helical-report-2017"
SCENARIO = "assessment-helical-24-95"
_SPEED = shape.SPEED * math.pi / 30.0
_TORQUE = 5000e3 / _SPEED
#: As printed; F_t/b K_A in N/m.
_LINE_LOAD = 2.0 * _TORQUE / (shape.REFERENCE[0] * 1e-3) / (shape.WIDTH * 1e-3) * 1.25
_FACE = 1.15
#: f_pb, f_fα and C_a as printed, m.
_PITCH, _PROFILE, _RELIEF = 15.9e-6, 22e-6, 2e-6
GIVEN = {
    "assessment.edition": 2006,
    "assessment.application_factor": 1.25,
    "assessment.face_load_factor": _FACE,
    "assessment.required_life": "175200 h",
    "assessment.required_safety_pitting": 1.25,
    "assessment.required_safety_bending": 1.56,
    "assessment.peak_roughness": "4.8 um",
    "assessment.root_roughness": "20 um",
    "assessment.tip_relief": "2 um",
    "lubricant.fzg_scuffing_stage": 14,
    "operating.pinion_speed": f"{shape.SPEED} rpm",
    "drive.pressure_angle": f"{shape.ALPHA} rad",
    "drive.helix_angle": f"{shape.HELIX} rad",
    "drive.material.thermal_conductivity": "50 W/(m*K)",
    "drive.material.density": "7830 kg/m**3",
    "drive.material.specific_heat": "485 J/(kg*K)",  # B_M 13.78
    **{f"drive.{side}.profile_shift": x for side, x in zip(SIDES, shape.SHIFTS, strict=True)},
    **{f"drive.{side}.tip_diameter": f"{d} mm" for side, d in zip(SIDES, shape.TIPS, strict=True)},
}
#: Tip diameters at the middle of their tolerance.
MIDDLE_TIPS = {
    f"drive.{side}.tip_diameter": f"{d - shape.TIP_TOLERANCE / 2.0} mm"
    for side, d in zip(SIDES, shape.TIPS, strict=True)
}


def _values() -> dict[str, Any]:
    factors = _factors()
    overrides = GIVEN | {
        "assessment.dynamic_factor": factors["KV"],
        "assessment.transverse_load_factor": factors["KHa"],
    }
    case, standard, capacity = _rated(overrides)
    named = capacity.by_name()
    middle, _, roots = _rated(overrides | MIDDLE_TIPS)
    sections = [critical_section(assembled(middle), side) for side in SIDES]
    assemblies = {"": assembled(load_scenario(SCENARIO, GIVEN).pair)}
    for end, allowances in shape.THICKNESS.items():
        thinner = zip(SIDES, allowances, strict=True)
        changes = {f"drive.{side}.thickness_allowance": f"{amount} mm" for side, amount in thinner}
        assemblies[end] = assembled(load_scenario(SCENARIO, GIVEN | changes).pair)
    values = shape.geometry(assemblies) | shape.measures() | shape.tolerances_1995(2.884)
    values |= _loads() | factors | {"alfFen": [math.degrees(section.load_angle) for section in sections]}
    relieved = _rated(overrides | {"assessment.tip_relief": "1 mm"})[1]
    values |= _root(roots.by_name(), factors) | _flank(named) | _films(case, standard)
    return values | _scuffed(case, standard, relieved) | _masses() | _losses(standard)


def _rated(changes: Mapping[str, Any]) -> tuple[Any, Standard, Any]:
    case = load_scenario(SCENARIO, changes).pair
    assembly = assembled(case)
    standard = standard_of(case, assembly, rated_duty(case.settings, case.oil_temperature, face=1.0))
    standard = standard._replace(factors=standard.factors._replace(stiffness=_stiffness()))
    bins = life_bins(case, assembly, standard.factors)
    capacity = capacity_of(case, assembly, standard.factors, bins, case.settings)
    assert capacity is not None, "the drive's material has a heat treatment"
    return case, standard, capacity


def _stiffness() -> iso6336.ReferenceStiffness:
    """c′ with the gear blank factor of web 0.25 and rim 5, of the virtual teeth."""
    teeth, dedenda, shifts = (24.0, 95.0), (1.25, 1.25), (shape.SHIFTS[0], shape.SHIFTS[1])
    pair = iso6336.ReferencePair(
        teeth, shifts, dedenda, shape.ALPHA, shape.CONTACT_RATIO, _LINE_LOAD, helix_angle=shape.HELIX
    )
    return iso6336.reference_stiffness(pair._replace(blank=iso6336.blank_factor(0.25, 5.0)))


def _loads() -> dict[str, Any]:
    tangential = 2.0 * _TORQUE / (shape.REFERENCE[0] * 1e-3)
    diameter = shape.BASES[0] / math.cos(shape.working_angle())
    working = 2e3 * _TORQUE / diameter
    axial = tangential * math.tan(shape.HELIX)
    return {
        "Ft": tangential,
        "Fa": axial,
        "Fr": tangential * math.tan(shape.TRANSVERSE),
        "Fnorm": tangential / math.cos(shape.TRANSVERSE) / math.cos(shape.BASE_HELIX),
        "w": tangential / shape.WIDTH,
        "Ftw": working,
        "Faw": axial,
        "Frw": working * math.tan(shape.working_angle()),
        "v": _SPEED * shape.REFERENCE[0] / 2e3,
        "v_w": _SPEED * diameter / 2e3,
        "NL": 175200.0 * 3600.0 * _SPEED / (2.0 * math.pi) / 1e6 / np.array([1.0, shape.RATIO]),
    }


def _factors() -> dict[str, Any]:
    """Section 2: K factors by method B from printed tolerances; K_Hα takes the larger of f_pb and f_fα."""
    stiffness = _stiffness()
    hard = load_factors.running_in("case-hardened", 1500e6, 20.83)
    radii = shape.BASES[0] / 2e3, shape.BASES[1] / 2e3
    mass = load_factors.reduced_mass(_masses()["J"], radii, shape.WIDTH * 1e-3)
    mesh = load_factors.DynamicMesh(
        24.0,
        _SPEED,
        mass,
        stiffness.single_pair,
        stiffness.mesh,
        _LINE_LOAD,
        _PITCH,
        _PROFILE,
        shape.CONTACT_RATIO + shape.OVERLAP,
        _RELIEF,
        6.0,
        (hard, hard),
    )
    dynamic = load_factors.dynamic_factor(mesh)
    load = _LINE_LOAD * dynamic.factor * _FACE
    transverse, plain = (
        load_factors.transverse_factor_b((shape.CONTACT_RATIO, shape.OVERLAP), stiffness.mesh, after, load)
        for after in (_PROFILE - hard.of(_PITCH), _PITCH - hard.of(_PITCH))
    )
    assert plain < transverse
    slender = shape.WIDTH / shape.CUT_HEIGHT
    return {
        "yp": 1e6 * hard.of(_PITCH),
        "yf": 1e6 * hard.of(_PROFILE),
        "ya": 1e6 * hard.of(_PITCH),
        "CM": stiffness.correction,
        "CR": stiffness.blank,
        "CBS": stiffness.rack,
        "EEst": stiffness.material,
        "c_prime": 1e-9 * stiffness.single_pair,
        "cgalf": 1e-9 * stiffness.mesh,
        "cgbet": 1e-9 * stiffness.mesh_face,
        "mRed": 1e-3 * mass,
        "nE1": dynamic.resonance_speed * 30.0 / math.pi,
        "N": dynamic.resonance_ratio,
        "KV": dynamic.factor,
        "KHb": _FACE,
        "KBb": _FACE,
        "KFb": _FACE ** (slender**2 / (1.0 + slender + slender**2)),
        "KHa": transverse,
        "KFa": transverse,
        "KBa": transverse,
        "Kbg": contact_path.helical_load_factor(shape.CONTACT_RATIO + shape.OVERLAP),
    }


def _root(named: Mapping[str, Any], factors: Mapping[str, Any]) -> dict[str, Any]:
    """Section 3, stresses with the K_Fβ of the height of the teeth as they are cut."""
    more = factors["KFb"] / named["K_Fbeta"]
    safety = sides(named, "S_F") / more
    strength = ("Y_delta_relT", "Y_R_relT", "Y_X", "Y_NT")
    same = {"YF": "Y_F", "YS": "Y_S", "YB": "Y_B", "YM": "Y_M"}
    same |= dict(zip(("YdrelT", "YRrelT", "YX", "YNT"), strength, strict=True))
    stresses = {"sigF0": "sigma_F0", "sigFG": "sigma_FG", "sigFP": "sigma_FP"}
    lengths = {"hF": "h_F", "sFn": "s_Fn", "roF": "rho_F"}
    values: dict[str, Any] = {
        name: sides(named, ours, unit)
        for table, unit in ((same, 1.0), (stresses, 1e6), (lengths, 1e-3))
        for name, ours in table.items()
    }
    return values | {
        "sigF": sides(named, "sigma_F", 1e6) * more,
        "SF": safety,
        "Ybet": sides(named, "Y_beta")[0],
        "YDT": sides(named, "Y_DT")[0],
        "Y_product": math.prod(sides(named, name) for name in strength),
        "Yst": 2.0,
        "sigFE": 2e-6 * sides(named, "sigma_Flim"),
        "kW_root": 5000.0 * safety / 1.56,
    }


def _flank(named: Mapping[str, Any]) -> dict[str, Any]:
    safety, stress = sides(named, "S_H"), sides(named, "sigma_H", 1e6)
    factors = {"ZL": "Z_L", "ZV": "Z_v", "ZR": "Z_R", "ZNT": "Z_NT"}
    pairs = {name: sides(named, ours) for name, ours in factors.items()}
    return pairs | {
        "ZW": sides(named, "Z_W"),
        "sigHP": sides(named, "sigma_HP", 1e6),
        "sigHG": sides(named, "sigma_HG", 1e6),
        "ZH": named["Z_H"],
        "ZE": 1e-3 * named["Z_E"],
        "Zeps": named["Z_epsilon"],
        "Zbet": named["Z_beta"],
        "sigH0": 1e-6 * named["sigma_H0"],
        "sigHw": stress[0] / named["Z_B"],
        "ZB_ZD": (named["Z_B"], named["Z_D"]),
        "sigHB_sigHD": stress,
        "Z_product": math.prod(pairs.values()),
        "ZX": (named["Z_X"], named["Z_X"]),
        "SHw": safety,
        "SHBD": safety,
        "SH_torque": safety**2,
        "kW_flank": 5000.0 * (safety / 1.25) ** 2,
    }


def _masses() -> dict[str, Any]:
    """Rings of steel between bore and the middle of the teeth."""
    outer, inner = (shape.TIPS + shape.ROOTS) / 4e3, shape.BORES / 2e3
    mass = 7830.0 * math.pi * (outer**2 - inner**2) * shape.WIDTH * 1e-3
    inertia = mass * (outer**2 + inner**2) / 2.0
    return {
        "mass": mass,
        "mass_sum": sum(mass),
        "J": inertia,
        "J_sum": inertia[0] + inertia[1] / shape.RATIO**2,
    }


def _losses(standard: Standard) -> dict[str, Any]:
    """Section 8: mean friction and loss."""
    friction = standard.films.friction_coefficient
    loss = 5000.0 * friction * standard.losses
    stiffness = standard.factors.stiffness.mesh * shape.WIDTH * 1e-3 * (shape.BASES[0] / 2e3) ** 2
    return {
        "mum_niemann": friction,
        "PVZ": loss,
        "etaz": 100.0 * (1.0 - loss / 5000.0),
        "cr": 1e-6 * stiffness,
        "delcr": math.degrees(_TORQUE / stiffness),
    }


def _films(case: Any, standard: Standard) -> dict[str, Any]:
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


def _scuffed(case: Any, standard: Standard, relieved: Standard) -> dict[str, Any]:
    """Section 5: ISO/TR 13989-1 and -2; the flash temperature with X_J 1, as the report has it."""
    path, factors = standard.path, standard.factors
    line_load = factors.line_load * factors.dynamic_factor * factors.duty.face * factors.transverse
    effective = scuffing.effective_tip_relief(factors.line_load, (1.0, factors.stiffness.mesh), helical=True)
    flash = relieved.flash_bulk, relieved.flash_contact
    normal, relief = (shape.ALPHA, shape.HELIX), 2e-6 / effective
    numbers = scuffing_numbers(case, standard, normal, line_load, flash, relief)
    pitch_point = float(contact_path.point_distances(path)[3])
    return {name: numbers[ours] for name, ours in _SCUFFING.items()} | {
        "BM": 1e-3 * numbers["B_M"],
        "Ceff": 1e6 * effective,
        "theflm": (flash[0] - case.oil_temperature) / 0.47,
        "Gamma_max": (path.length - pitch_point) / (path.base_radius[0] * math.tan(path.pressure_angle)),
        "XJ": 1.0,
        "XGam": float(contact_path.flash_share(path, path.length)),
        "XE": 1.0,
    }


rows = rows_of(BOOK, _values)
