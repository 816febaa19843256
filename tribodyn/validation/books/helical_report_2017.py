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
from tribodyn.gears.rating.standard import Standard, rated_duty, standard_of
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.root_section import critical_section
from tribodyn.standards import contact_path, load_factors, pitting
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.validation.books import helical_report_geometry as shape
from tribodyn.validation.books import helical_report_oil as oil
from tribodyn.validation.books import printed, printed_sides, rows_of, sides

BOOK = oil.BOOK
SCENARIO = "assessment-helical-24-95"
_SPEED = shape.SPEED * math.pi / 30.0
_TORQUE = 5000e3 / _SPEED
#: As printed; F_t/b K_A in N/m.
_LINE_LOAD = 2.0 * _TORQUE / (shape.REFERENCE[0] * 1e-3) / (shape.WIDTH * 1e-3) * 1.25
_FACE = 1.15
#: 1/min: a speed of the gear in the program's file, which is not that of this stage.
_LEFT_OVER = 145.0
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
    path = standard.path
    pitch_radius = float(contact_path.equivalent_radius(path, contact_path.point_distances(path)[3]))
    relieved = _rated(overrides | {"assessment.tip_relief": "1 mm"})[1]
    values |= _root(roots.by_name(), factors) | _flank(named, pitch_radius) | oil.films(case, standard)
    values |= oil.fracture(assemblies[""], standard)
    return values | oil.scuffed(case, standard, relieved) | _masses() | _losses(standard)


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
        "sigF": sides(named, "sigma_F", 1e6) * more * printed_sides(printed(BOOK), "sigF0") / values["sigF0"],
        "SF": safety,
        "Ybet": sides(named, "Y_beta")[0],
        "YDT": sides(named, "Y_DT")[0],
        "Y_product": math.prod(sides(named, name) for name in strength),
        "Yst": 2.0,
        "sigFE": 2e-6 * sides(named, "sigma_Flim"),
        "kW_root": 5000.0 * safety / 1.56,
    }


def _flank(named: Mapping[str, Any], radius: float) -> dict[str, Any]:
    """Section 4, as the report does: C_ZL by its formula at 1200 N/mm² too, 0.3333 for 1/3 in Rz10."""
    soft, speed = 850e6 + (1200.0 / 4375.0 + 0.6357 - 0.83) / 0.08 * 350e6, _SPEED * shape.REFERENCE[0] / 2e3
    more = (0.01 / radius) ** (-0.08 * (0.3333 - 1.0 / 3.0))
    for limit, power in ((soft, 1.0), (1500e6, -1.0)):
        more *= (pitting.lubricant_factor(limit, 220e-6) * pitting.speed_factor(limit, speed)) ** power
    safety, stress = sides(named, "S_H") * more, sides(named, "sigma_H", 1e6)
    factors = {"ZL": "Z_L", "ZV": "Z_v", "ZR": "Z_R", "ZNT": "Z_NT"}
    pairs = {name: sides(named, ours) for name, ours in factors.items()}
    return pairs | {
        "ZW": sides(named, "Z_W"),
        "sigHP": sides(named, "sigma_HP", 1e6) * more,
        "sigHG": sides(named, "sigma_HG", 1e6) * more,
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
    """Rings of steel between bore and the middle of the teeth; J_2 referred by the speed left in the file."""
    outer, inner = (shape.TIPS + shape.ROOTS) / 4e3, shape.BORES / 2e3
    mass = 7830.0 * math.pi * (outer**2 - inner**2) * shape.WIDTH * 1e-3
    inertia = mass * (outer**2 + inner**2) / 2.0
    return {
        "mass": mass,
        "mass_sum": sum(mass),
        "J": inertia,
        "J_sum": inertia[0] + inertia[1] * (_LEFT_OVER / shape.SPEED) ** 2,
    }


def _losses(standard: Standard) -> dict[str, Any]:
    """Section 8, as the report does.

    Mean friction of F_t cos β_b in place of F_bt, stiffness at the input of c_γβ, times d/d_w.
    """
    at_base = math.cos(shape.BASE_HELIX) * math.cos(shape.TRANSVERSE)
    friction = standard.films.friction_coefficient * at_base**0.2
    loss = 5000.0 * friction * standard.losses
    stiffness = standard.factors.stiffness.mesh_face * shape.WIDTH * 1e-3 * (shape.BASES[0] / 2e3) ** 2
    stiffness *= math.cos(shape.working_angle()) / math.cos(shape.TRANSVERSE)
    return {
        "mum_niemann": friction,
        "PVZ": loss,
        "etaz": 100.0 * (1.0 - loss / 5000.0),
        "cr": 1e-6 * stiffness,
        "delcr": math.degrees(_TORQUE / stiffness),
    }


rows = rows_of(BOOK, _values)
