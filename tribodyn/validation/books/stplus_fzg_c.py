"""The FZG gears of type C in the listing of FVA STplus 11.1F: ISO 6336:2019 and its parts, factor by factor.

K_Hβ is what the printed pressures imply: f_sh is printed with one digit, the shaft behind it not at all.
Strength is that of endurance, as there: N_L is printed, and life factors are 1. Lengths in mm here.
"""

import math
from typing import Any

import numpy as np

from tribodyn.compliance import iso6336
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import capacity_of, life_bins
from tribodyn.gears.rating.margins import flanks_of
from tribodyn.gears.rating.standard import rated_duty, standard_of
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.root_section import critical_section
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.geometry.tooth import thickness_half_angle
from tribodyn.standards import contact_path, fzg, load_factors, micropitting, scuffing
from tribodyn.standards.flank_tolerances import flank_tolerances_1995
from tribodyn.standards.mesh_loss.friction import schlenk
from tribodyn.studies.protocol.load import load_data
from tribodyn.tribology.oil import kinematic_viscosity
from tribodyn.validation.books import printed, rows_of, sides
from tribodyn.validation.books import stplus_geometry as shape
from tribodyn.validation.books.scuffing import raised, scuffing_numbers
from tribodyn.validation.books.stplus_fracture import fracture

BOOK = "stplus-fzg-c"
_M, _ALPHA, _WIDTH, _TEETH, _SHIFTS = shape.MODULE, shape.ALPHA, shape.WIDTH, shape.TEETH, shape.SHIFTS
_TIPS, _TORQUE, _SPEED, _LIMIT = (82.45, 118.35), 130.0, 1500.0, 1510.0
_LINE_LOAD = 3611.1e3 / 14.0  # F_t/b, N/m
#: K_v K_Hβ from the pressure at B (1374.113 N/mm² on 7.253 mm), over our K_v.
_K = 1.358343
#: η at the oil's temperature as printed, Pa·s: by other constants of the oil than ν_40 and ν_100.
_VISCOSITY = 30.93e-3
_BASE: dict[str, Any] = {
    "dedendum": 1.39,
    "fillet_radius": 0.25,
    "face_width": "14 mm",
    "bore_radius": "1 um",
}
SCENARIO = {
    "title": "FZG type C",
    "kind": "assessment",
    "drive": {
        "family": "involute",
        "module": "4.5 mm",
        "pressure_angle": "20 deg",
        "centre_distance": "91.5 mm",
        "mean_roughness": "0.3 um",
        "quality": 5,
        "material": {
            "like": "18CrNiMo7-6",
            "contact_stress_limit": "1510 MPa",
            "bending_stress_limit": "475 MPa",
            "youngs_modulus": "210 GPa",
            "poisson_ratio": 0.3,
            "density": "7850 kg/m**3",
            "specific_heat": "482.1019 J/(kg*K)",  # with 50 W/(m K) the printed B_M of 435
            "thermal_conductivity": "50 W/(m*K)",
        },
        **{
            side: _BASE
            | {"teeth": z, "profile_shift": x, "tip_diameter": f"{tip} mm", "thickness_allowance": "-85 um"}
            for side, z, x, tip in zip(SIDES, _TEETH, _SHIFTS, _TIPS, strict=True)
        },
    },
    "lubricant": {
        "type": "mineral",
        "viscosity_40": "90.02 mm**2/s",
        "viscosity_100": "10.41 mm**2/s",
        "density_15": "884.1 kg/m**3",
        "fzg_scuffing_stage": 6,
    },
    "operating": {
        "pinion_torque": "130 N*m",
        "pinion_speed": "1500 rpm",
        "oil_temperature": "60 degC",
    },
    "assessment": {"peak_roughness": "1.8 um", "root_roughness": "20 um", "run_in": False},
}


def _values() -> dict[str, Any]:
    stiffness = _stiffness()
    dynamic = _dynamic(stiffness)
    factor = float(dynamic["K_v"])
    case = load_data(SCENARIO, BOOK, {"assessment.face_load_factor": _K / factor}).case.pair
    assembly = assembled(case)
    duty = rated_duty(case.settings, case.oil_temperature, face=1.0)._replace(dynamic=factor)
    standard = standard_of(case, assembly, duty)
    factors = standard.factors._replace(stiffness=stiffness)
    capacity = capacity_of(case, assembly, factors, life_bins(case, assembly, factors), case.settings)
    assert capacity is not None, "the material has a heat treatment"
    sheet, named = geometry_sheet(assembly), capacity.by_name()
    values = shape.geometry(sheet) | shape.measures() | _loads(standard) | _roots(assembly) | dynamic
    return values | _strength(named, standard, assembly) | _scuffed(case, standard, stiffness, factor)


def _loads(standard: Any) -> dict[str, Any]:
    """Loads and losses."""
    tangential, working = 2e3 * _TORQUE / 72.0, 2e3 * _TORQUE / 73.2
    at_base, speed = tangential / math.cos(_ALPHA), math.pi * _SPEED / 60.0 * 73.2e-3
    power = _TORQUE * _SPEED * math.pi / 30.0
    radius = contact_path.equivalent_radius(standard.path, contact_path.point_distances(standard.path)[3])
    sliding = 2.0 * speed * math.sin(standard.path.pressure_angle)
    # FVA 166, after Schlenk
    friction = schlenk(1e3 * at_base / _WIDTH, sliding, float(radius), _VISCOSITY, 0.3e-6, 1.0)
    loss = power * friction * standard.losses
    return {
        "P": 1e-3 * power,
        "T": (_TORQUE, 1.5 * _TORQUE),
        "F_t": tangential,
        "F_tw": working,
        "F_tb": at_base,
        "n": (_SPEED, _SPEED / 1.5),
        "v_w": speed,
        "mu_mz": friction,
        "H_v": standard.losses,
        "P_VzP": loss,
        "eta_zP": 1.0 - loss / power,
        "K_star": tangential / (_WIDTH * 72.0) * 2.5 / 1.5,
        "U": tangential / (_WIDTH * _M),
        "T_1T": fzg.scuffing_torque(6),
    }


def _roots(assembly: Assembly) -> dict[str, Any]:
    """The critical section, under a load at the outer point of single pair contact and at the tip."""
    sections = [critical_section(assembly, side) for side in SIDES]
    angles, arms, thickness = (
        np.array([getattr(section, name) for section in sections])
        for name in ("load_angle", "arm", "thickness")
    )
    bases, tips = np.array(_TEETH) * _M / 2.0 * math.cos(_ALPHA), np.array(_TIPS) / 2.0
    places = bases / np.cos(angles) - 1e3 * arms
    half_angles = [
        float(thickness_half_angle(assembly.tooth(side), tip * 1e-3))
        for side, tip in zip(SIDES, tips, strict=True)
    ]
    at_tip = np.arccos(bases / tips) - half_angles
    return {
        "alpha_Fan": np.degrees(at_tip),
        "alpha_Fen": np.degrees(angles),
        "h_Fa": (bases / np.cos(at_tip) - places) / _M,
        "d_sF": 2.0 * np.hypot(places, 500.0 * thickness),
    }


def _stiffness() -> iso6336.ReferenceStiffness:
    """c′ of the teeth as cut: the dedendum is that below the reference line of the nominal shift."""
    deeper = 0.085 / (2.0 * math.tan(_ALPHA) * _M)
    pair = iso6336.ReferencePair(
        (16.0, 24.0),
        _SHIFTS,
        (1.39 + deeper, 1.39 + deeper),
        _ALPHA,
        1.43615,
        _LINE_LOAD,
        (210e9, 210e9),
    )
    return iso6336.reference_stiffness(pair)


def _dynamic(stiffness: iso6336.ReferenceStiffness) -> dict[str, Any]:
    """Load factors from discs without a bore and from exact tolerances of 1995."""
    gear = flank_tolerances_1995(5, _M * 1e-3, 108e-3, _WIDTH * 1e-3, ranges=False)
    hard = load_factors.running_in("case-hardened", 1510e6, 5.749)
    base_pitch = gear.single_pitch  # not times cos α there
    mass = load_factors.disc_mass(67.658e-3, (82.45e-3 + 60.893e-3) / 2.0, 1.5, (7850.0, 7850.0))
    relief = load_factors.run_in_relief(_LIMIT * 1e6)
    mesh = load_factors.DynamicMesh(
        16.0,
        _SPEED * math.pi / 30.0,
        mass,
        stiffness.single_pair,
        stiffness.mesh,
        _LINE_LOAD,
        base_pitch,
        gear.profile_form,
        1.43615,
        relief,
        5.0,
        (hard, hard),
    )
    dynamic = load_factors.dynamic_factor(mesh)
    crooked = 1.33 * 6e-6 + gear.total_helix
    straightened = load_factors.helix_running_in("case-hardened", 1510e6, 5.749).of(crooked)
    raised = _LINE_LOAD * dynamic.factor
    face = load_factors.face_load_factor_c(crooked - straightened, stiffness.mesh_face, raised)
    after = base_pitch - hard.of(base_pitch)
    across = load_factors.transverse_factor_b((1.43615, 0.0), stiffness.mesh, after, raised * 1.32)
    return {
        "K_v": dynamic.factor,
        "N": dynamic.resonance_ratio,
        "m_red": 1e-3 * mass,
        "c_gamma_alpha": 1e-9 * stiffness.mesh,
        "c_gamma_beta": 1e-9 * stiffness.mesh_face,
        "c_prime": 1e-9 * stiffness.single_pair,
        "C_B": stiffness.rack,
        "C_M": stiffness.correction,
        "C_R": stiffness.blank,
        "f_pb": 1e6 * base_pitch,
        "f_pe": 4.0 + 0.315 * (_M + 0.25 * math.sqrt(108.0)),  # DIN 3961, quality 5
        "y_p": 1e6 * hard.of(base_pitch),
        "y_alpha": 1e6 * hard.of(base_pitch),
        "f_falpha": 1e6 * gear.profile_form,
        "y_f": 1e6 * hard.of(gear.profile_form),
        "C_ay": 1e6 * relief,
        "f_ma": 1e6 * gear.total_helix,
        "y_beta": 1e6 * straightened,
        "K_Hbeta": face,
        "K_Halpha": across,
        "K_Falpha": across,
    }


def _strength(named: dict[str, Any], standard: Any, assembly: Assembly) -> dict[str, Any]:
    """ISO 6336-2 and -3 for endurance, and ISO/TS 6336-4."""
    contact, root = sides(named, "sigma_H", 1e6), sides(named, "sigma_F", 1e6)
    influence = {name: sides(named, name)[0] for name in ("Z_L", "Z_v", "Z_R")}
    product = math.prod(influence.values())
    permitted = _LIMIT * product * named["Z_X"]
    relative, smooth, size = (sides(named, name) for name in ("Y_delta_relT", "Y_R_relT", "Y_X"))
    root_permitted = 950.0 * relative * smooth * size
    lengths = {
        name: sides(named, ours) for name, ours in (("s_Fn", "s_Fn"), ("h_Fe", "h_F"), ("rho_F", "rho_F"))
    }
    values: dict[str, Any] = {name: named[name] for name in ("K_Fbeta", "f_ZCa", "Z_H", "Z_beta")}
    values |= {name: sides(named, name) for name in ("f_epsilon", "Y_F", "Y_B", "Y_S")}
    values |= {name: sides(named, name)[0] for name in ("Z_W", "Y_beta", "Y_DT")}
    values |= influence | {name: 1e3 * length / _M for name, length in lengths.items()}
    values |= {
        "N_L": sides(named, "N_L", 1e6),
        "sigma_H": contact,
        "sigma_H0": 1e-6 * named["sigma_H0"],
        "Z_B": (named["Z_B"], named["Z_D"]),
        "Z_E": 1e-3 * named["Z_E"],
        "Z_eps": named["Z_epsilon"],
        "R_z10": 1.8 * (10.0 / 8.38205) ** (1.0 / 3.0),
        "Z_LRv": product,
        "Z_X": (named["Z_X"], named["Z_X"]),
        "Z_N": (1.0, 1.0),
        "sigma_HP": (permitted, permitted),
        "S_H": permitted / contact,
        "S_HMo": (permitted / contact) ** 2,
        "sigma_F": root,
        "sigma_F0": sides(named, "sigma_F0", 1e6),
        "q_s": lengths["s_Fn"] / (2.0 * lengths["rho_F"]),
        "Y_X": size,
        "Y_delrelT": relative,
        "Y_RrelT": smooth,
        "Y_N": (1.0, 1.0),
        "sigma_FP": root_permitted,
        "S_F": root_permitted / root,
        "rho_slip": (0.003, 0.003),
    }
    load = _K * _TORQUE / standard.path.base_radius[0] / (_WIDTH * 1e-3)
    return values | fracture(assembly, standard, load)


def _scuffed(
    case: Any, standard: Any, stiffness: iso6336.ReferenceStiffness, factor: float
) -> dict[str, Any]:
    """ISO/TS 6336-20 and -21, as the listing has them.

    The integral temperature with the working circle's speed and the printed viscosity at 60 °C, flash
    temperatures of loads without K_v.
    """
    viscous, faster = (
        (_VISCOSITY / float(case.lubricant.sheet.viscosity(case.oil_temperature))) ** -0.05,
        73.2 / 72.0,
    )
    standard = raised(standard, case.oil_temperature, viscous * faster**-0.2, viscous * faster**0.3)
    path, integral, oil = standard.path, standard.integral, case.lubricant.sheet
    static = factor**-0.75
    bulk = case.oil_temperature + static * (standard.flash_bulk - case.oil_temperature)
    rise = static * (standard.flash_contact - standard.flash_bulk)
    flash = bulk, 273.15 + printed(BOOK)["theta_M_fla"] + rise
    values = scuffing_numbers(case, standard, (_ALPHA, 0.0), _LINE_LOAD * _K, flash)
    places = contact_path.point_distances(path)
    radius, roughness = float(contact_path.equivalent_radius(path, places[3])), case.mean_roughness
    pitch = path.base_radius[0] * math.tan(path.pressure_angle)
    gammas = contact_path.curvature_radii(path, places[[0, 2, 3, 4, 6]])[0] / pitch - 1.0
    stiffnesses = stiffness.single_pair, stiffness.mesh
    test_torque = fzg.scuffing_torque(6)
    effective = _LINE_LOAD / math.cos(_ALPHA) / stiffness.mesh
    values |= {
        "eta_40": 1e3 * float(oil.viscosity(313.15)),
        "eta_100": 10.41 * (884.1 - 0.65 * (373.15 - 288.15)) * 1e-3,  # as the listing lets density fall
        "VT": (math.log10(math.log10(90.82)) - math.log10(math.log10(11.21))) / math.log10(373.0 / 313.0),
        "nu_50": 1e6 * float(kinematic_viscosity(90.02e-6, 10.41e-6, 323.15)),
        "nu_60": 1e6 * float(kinematic_viscosity(90.02e-6, 10.41e-6, 333.15)),
        "B_M": values["B_M"] / math.sqrt(1e3),
        "K_Bbeta": standard.factors.duty.face,
        "K_Bgamma": contact_path.helical_load_factor(path.total_contact_ratio),
        "X_E": 1.0 + 30.0 * 1e3 * roughness / radius,
        "X_R": micropitting.roughness_factor(roughness, radius),
        "C_eff_int": 1e6 * scuffing.effective_tip_relief(_LINE_LOAD, stiffnesses, helical=False),
        "C_eff_fla": 1e6 * effective,
        "theta_flaE": integral.at_tip,
        "theta_MT": 80.0 + 0.23 * test_torque,
        "theta_flaintT": 0.2 * test_torque * (100.0 / 90.02) ** 0.02,
        "theta_flamax": rise,
    }
    values |= {f"Gamma_{name}": float(gamma) for name, gamma in zip("ABCDE", gammas, strict=True)}
    return values | _flashes(case, path, values["mu_fla"] * static, effective)


def _flashes(
    case: Any, path: contact_path.ContactPath, friction: float, effective: float
) -> dict[str, float]:
    """Flash temperature at A, B, D, E."""
    flanks, points = flanks_of(case), contact_path.point_distances(path)
    places = points[[0, 2, 4, 6]]
    load = _K * _TORQUE / path.base_radius[0] / (_WIDTH * 1e-3) * contact_path.flash_share(path, places, 5.0)
    radii = contact_path.equivalent_radius(path, places)
    width = np.sqrt(8.0 * load * radii / (np.pi * flanks.reduced_modulus))
    speeds = contact_path.rolling_speeds(path, places, case.operating.pinion_speed)
    rises = scuffing.flash_rise(friction, load, width, speeds, flanks.thermal_contact)
    rises *= scuffing.flash_approach(points[3] - places, path.length, effective)
    return {f"theta_fl_{name}": float(rise) for name, rise in zip("ABDE", rises, strict=True)}


rows = rows_of(BOOK, _values)
