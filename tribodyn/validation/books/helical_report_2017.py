"""A published design report of a helical stage (KISSsoft 2017): ISO 6336:2006 and its parts, row by row.

Load factors follow from the report's tolerances, stiffness and mass; roots are those of tips in the middle of
their tolerance, as the report has them.
"""

import math
from collections.abc import Mapping
from typing import Any

from tribodyn.compliance import iso6336
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import capacity_of, life_bins
from tribodyn.gears.rating.standard import Standard, rated_duty, standard_of
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.root_section import critical_section
from tribodyn.standards import contact_path, load_factors
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.books import helical_report_geometry as shape
from tribodyn.validation.books import rows_of
from tribodyn.validation.books.helical_report_geometry import both
from tribodyn.validation.books.helical_report_measures import measures, tolerances_1995
from tribodyn.validation.books.helical_report_oil import films, scuffed

BOOK = "helical-report-2017"
SCENARIO = "assessment-helical-24-95"
_SPEED = shape.SPEED * math.pi / 30.0
_TORQUE = 5000e3 / _SPEED
#: As printed; F_t/b K_A in N/m.
_LINE_LOAD = 2.0 * _TORQUE / (shape.REFERENCE[0] * 1e-3) / (shape.WIDTH * 1e-3) * 1.25
_FACE = 1.15
_RATIO = shape.contact_ratio()
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
    roots = _rated(overrides | MIDDLE_TIPS)[2].by_name()
    sections = [
        critical_section(assembled(load_scenario(SCENARIO, overrides | MIDDLE_TIPS)), side) for side in SIDES
    ]
    ends = shape.thickness_ends()
    assemblies = {
        name: assembled(load_scenario(SCENARIO, allowed))
        for name, allowed in (("", GIVEN), *((end, _thinner(ends[end])) for end in "ei"))
    }
    values = shape.geometry(assemblies) | measures(ends) | tolerances_1995(2.884) | _loads() | factors
    values["alfFen"] = both(lambda i: math.degrees(sections[i].load_angle))
    relieved = _rated(overrides | {"assessment.tip_relief": "1 mm"})[1]  # X_J 1, as the report has it
    flash = relieved.flash_bulk, relieved.flash_contact
    values |= _root(roots, factors) | _flank(named) | films(case, standard)
    values |= scuffed(case, standard, _SPEED, flash)
    return values | _masses() | _losses(case, standard)


def _thinner(allowances: tuple[float, float]) -> dict[str, Any]:
    return GIVEN | {
        f"drive.{side}.thickness_allowance": f"{amount} mm"
        for side, amount in zip(SIDES, allowances, strict=True)
    }


def _rated(changes: Mapping[str, Any]) -> tuple[Any, Standard, Any]:
    case = load_scenario(SCENARIO, changes)
    assembly = assembled(case)
    standard = standard_of(case, assembly, rated_duty(case.settings, case.oil_temperature, face=1.0))
    standard = standard._replace(factors=standard.factors._replace(stiffness=_stiffness()))
    bins = life_bins(case, assembly, standard.factors)
    capacity = capacity_of(case, assembly, standard.factors, bins, case.settings)
    assert capacity is not None, "the drive's material has a heat treatment"
    return case, standard, capacity


def _stiffness() -> iso6336.ReferenceStiffness:
    """c′ with the gear blank factor of web 0.25 and rim 5, of the virtual teeth."""
    pair = iso6336.ReferencePair(
        (24.0, 95.0), shape.SHIFTS, (1.25, 1.25), shape.ALPHA, _RATIO, _LINE_LOAD, helix_angle=shape.HELIX
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
        "NL": both(lambda i: 175200.0 * 3600.0 * _SPEED / (2.0 * math.pi) / 1e6 / (1.0, shape.RATIO)[i]),
    }


def _factors() -> dict[str, Any]:
    """Section 2: K factors by method B from printed tolerances; K_Hα takes the larger of f_pb and f_fα."""
    stiffness = _stiffness()
    hard = load_factors.running_in("case-hardened", 1500e6, 20.83)
    inertias = _masses()["J"]
    radii = both(lambda i: shape.BASES[i] / 2e3)
    mass = load_factors.reduced_mass(inertias, radii, shape.WIDTH * 1e-3)
    mesh = load_factors.DynamicMesh(
        24.0,
        _SPEED,
        mass,
        stiffness.single_pair,
        stiffness.mesh,
        _LINE_LOAD,
        _PITCH,
        _PROFILE,
        _RATIO + shape.OVERLAP,
        _RELIEF,
        6.0,
        (hard, hard),
    )
    dynamic = load_factors.dynamic_factor(mesh)
    load = _LINE_LOAD * dynamic.factor * _FACE
    transverse, plain = (
        load_factors.transverse_factor_b((_RATIO, shape.OVERLAP), stiffness.mesh, after, load)
        for after in (_PROFILE - hard.of(_PITCH), _PITCH - hard.of(_PITCH))
    )
    assert plain < transverse
    slender = shape.WIDTH / shape.cut_height()
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
        "Kbg": contact_path.helical_load_factor(_RATIO + shape.OVERLAP),
    }


def _sides(named: Mapping[str, Any], name: str, unit: float = 1.0) -> tuple[float, float]:
    return named[name]["pinion"] / unit, named[name]["gear"] / unit


def _root(named: Mapping[str, Any], factors: Mapping[str, Any]) -> dict[str, Any]:
    """Section 3, stresses with the K_Fβ of the height of the teeth as they are cut."""
    more = factors["KFb"] / named["K_Fbeta"]
    safety = both(lambda i: _sides(named, "S_F")[i] / more)
    product = both(
        lambda i: math.prod(_sides(named, name)[i] for name in ("Y_delta_relT", "Y_R_relT", "Y_X", "Y_NT"))
    )
    values: dict[str, Any] = {
        name: _sides(named, ours, unit)
        for name, ours, unit in (
            ("YF", "Y_F", 1.0),
            ("YS", "Y_S", 1.0),
            ("hF", "h_F", 1e-3),
            ("sFn", "s_Fn", 1e-3),
            ("roF", "rho_F", 1e-3),
            ("YB", "Y_B", 1.0),
            ("sigF0", "sigma_F0", 1e6),
            ("YdrelT", "Y_delta_relT", 1.0),
            ("YRrelT", "Y_R_relT", 1.0),
            ("YX", "Y_X", 1.0),
            ("YM", "Y_M", 1.0),
            ("YNT", "Y_NT", 1.0),
            ("sigFG", "sigma_FG", 1e6),
            ("sigFP", "sigma_FP", 1e6),
        )
    }
    return values | {
        "sigF": both(lambda i: _sides(named, "sigma_F", 1e6)[i] * more),
        "SF": safety,
        "Ybet": _sides(named, "Y_beta")[0],
        "YDT": _sides(named, "Y_DT")[0],
        "Y_product": product,
        "Yst": 2.0,
        "sigFE": both(lambda i: 2e-6 * _sides(named, "sigma_Flim")[i]),
        "kW_root": both(lambda i: 5000.0 * safety[i] / 1.56),
    }


def _flank(named: Mapping[str, Any]) -> dict[str, Any]:
    safety, stress = _sides(named, "S_H"), _sides(named, "sigma_H", 1e6)
    pairs = {
        name: _sides(named, ours, unit)
        for name, ours, unit in (
            ("ZL", "Z_L", 1.0),
            ("ZV", "Z_v", 1.0),
            ("ZR", "Z_R", 1.0),
            ("ZW", "Z_W", 1.0),
            ("ZNT", "Z_NT", 1.0),
            ("sigHP", "sigma_HP", 1e6),
            ("sigHG", "sigma_HG", 1e6),
        )
    }
    return pairs | {
        "ZH": named["Z_H"],
        "ZE": 1e-3 * named["Z_E"],
        "Zeps": named["Z_epsilon"],
        "Zbet": named["Z_beta"],
        "sigH0": 1e-6 * named["sigma_H0"],
        "sigHw": stress[0] / named["Z_B"],
        "ZB_ZD": (named["Z_B"], named["Z_D"]),
        "sigHB_sigHD": stress,
        "Z_product": both(lambda i: math.prod(pairs[name][i] for name in ("ZL", "ZV", "ZR", "ZNT"))),
        "ZX": (named["Z_X"], named["Z_X"]),
        "SHw": safety,
        "SHBD": safety,
        "SH_torque": both(lambda i: safety[i] ** 2),
        "kW_flank": both(lambda i: 5000.0 * (safety[i] / 1.25) ** 2),
    }


def _masses() -> dict[str, Any]:
    """Rings of steel between bore and the middle of the teeth."""
    outer = both(lambda i: (shape.TIPS[i] + shape.ROOTS[i]) / 4e3)
    inner = both(lambda i: shape.BORES[i] / 2e3)
    mass = both(lambda i: 7830.0 * math.pi * (outer[i] ** 2 - inner[i] ** 2) * shape.WIDTH * 1e-3)
    inertia = both(lambda i: mass[i] * (outer[i] ** 2 + inner[i] ** 2) / 2.0)
    return {
        "mass": mass,
        "mass_sum": sum(mass),
        "J": inertia,
        "J_sum": inertia[0] + inertia[1] / shape.RATIO**2,
    }


def _losses(case: Any, standard: Standard) -> dict[str, Any]:
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


rows = rows_of(BOOK, _values)
