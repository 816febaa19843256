"""Example 1 of ISO/TR 6336-30: a helical pair, in the editions of 2017 (ISO 6336:2006) and 2022 (geometry).

Printed are its results; the duty is 9000 N m at 360 rpm, ν_40 320 mm²/s, Ra 1 µm, K_Hβ 1.16, C_a 70 µm.
Lengths in mm, angles in degrees.
"""

import math
from typing import Any

import numpy as np

from tribodyn.compliance import iso6336
from tribodyn.geometry.families.involute import involute_function
from tribodyn.geometry.gauges import Involute, span
from tribodyn.standards import load_factors, pitting
from tribodyn.standards.contact_path import ContactPath, transverse_angle
from tribodyn.standards.flank_tolerances import flank_tolerances, rounded
from tribodyn.standards.metals import Metal, contact_factors
from tribodyn.validation.books import printed, printed_sides, rows_of

BOOK = "iso-tr-6336-30"
_MODULE, _ALPHA, _HELIX = 8.0, math.radians(20.0), math.radians(15.8)
_TEETH, _WIDTH, _CENTRES = (17.0, 103.0), 100.0, 500.0
_TIPS, _DEPTH, _ROUNDING = np.array([159.66, 872.35]), 11.2, 3.12
_TORQUE, _SPEED, _HOURS, _FACE = 9000.0, 360.0 * math.pi / 30.0, 50000.0, 1.16
_STEEL = Metal("case-hardened", 1500e6, 500e6, 6.9e9, 900e6)
_TRANSVERSE = transverse_angle(_ALPHA, _HELIX)
_REFERENCE = _MODULE / math.cos(_HELIX) * np.array(_TEETH)
_BASES = _REFERENCE * math.cos(_TRANSVERSE)
_WORKING = math.acos(sum(_BASES) / 2.0 / _CENTRES)
_BASE_HELIX = math.asin(math.sin(_HELIX) * math.cos(_ALPHA))
_OVERLAP = _WIDTH * math.sin(_HELIX) / (math.pi * _MODULE)
_SHIFTS = (0.14522, 0.0)
_SPANS, _SPAN_TEETH = (38.196, 307.943), (2, 13)


def _geometry() -> dict[str, Any]:
    """The tables of 2022."""
    gears = [Involute(_MODULE, _ALPHA, z, x, _HELIX) for z, x in zip(_TEETH, _SHIFTS, strict=True)]
    longer = np.array(_SPANS) - list(map(span, gears, _SPAN_TEETH))
    cut = _SHIFTS + longer / (2.0 * _MODULE * math.sin(_ALPHA))
    whole, pitch = _CENTRES * math.sin(_WORKING), math.pi * _BASES[0] / 17.0
    tangents = np.sqrt(_TIPS**2 - _BASES**2) / 2.0
    length = sum(tangents) - whole
    working = _BASES / math.cos(_WORKING)
    # where the rounded rack leaves the involute
    straight = _DEPTH / _MODULE - _ROUNDING / _MODULE * (1.0 - math.sin(_ALPHA)) - cut
    along = _REFERENCE * math.sin(_TRANSVERSE) - 2.0 * straight * _MODULE / math.sin(_TRANSVERSE)
    pitches = np.array(
        [1e6 * rounded(flank_tolerances(5, 8e-3, d * 1e-3, 0.1).single_pitch) for d in _REFERENCE]
    )
    return {
        "g_u": 103.0 / 17.0,
        "g_m_t": _MODULE / math.cos(_HELIX),
        "g_d": _REFERENCE,
        "g_inv_alpha_n": float(involute_function(_ALPHA)),
        "g_alpha_t": math.degrees(_TRANSVERSE),
        "g_inv_alpha_t": float(involute_function(_TRANSVERSE)),
        "g_alpha_wt": math.degrees(_WORKING),
        "g_x_E": cut,
        "g_d_f": _REFERENCE - 2.0 * (_DEPTH - cut * _MODULE),
        "g_d_Ff": np.hypot(_BASES, along),
        "g_d_b": _BASES,
        "g_beta_b": math.degrees(_BASE_HELIX),
        "g_d_w": working,
        "g_p_n": math.pi * _MODULE,
        "g_p_t": math.pi * _MODULE / math.cos(_HELIX),
        "g_p_bt": pitch,
        "g_g_alpha": length,
        "g_d_Nf": np.hypot(_BASES, 2.0 * (whole - tangents[::-1])),
        "g_eps_alpha": length / pitch,
        "g_eps_beta": _OVERLAP,
        "g_eps_gamma": length / pitch + _OVERLAP,
        "g_f_pT": pitches,
        "g_f_pb": pitches * math.cos(_TRANSVERSE),
        "g_v_w": _SPEED * working[0] / 2e3,
        "g_v": _SPEED * _REFERENCE[0] / 2e3,
    }


def _capacity() -> dict[str, Any]:
    """The reference column of 2017: ISO 6336:2006, method B."""
    bases, tips, radii = (tuple(diameters / 2e3) for diameters in (_BASES, _TIPS, _REFERENCE))
    path = ContactPath(_TEETH, bases, tips, _WORKING, _BASE_HELIX, _OVERLAP)
    modulus = 2.0 / (2.0 * (1.0 - 0.09) / 206e9)
    mesh = pitting.PittingMesh(
        path, radii, _ALPHA, _HELIX, 0.1, _TORQUE, _SPEED, modulus, 320e-6, (6e-6, 6e-6), 2006
    )
    tangential = pitting.tangential_load(mesh)
    pair = iso6336.ReferencePair(
        _TEETH,
        (0.145, 0.0),
        (1.4, 1.4),
        _ALPHA,
        path.contact_ratio,
        tangential / 0.1,
        helix_angle=_HELIX,
    )
    stiffness = iso6336.reference_stiffness(pair)
    dynamic = _dynamic(path, stiffness, tangential / 0.1)
    geometry, influence = pitting.geometry(mesh), pitting.influences(mesh, (_STEEL, _STEEL))
    after = 8.4179e-6 - load_factors.running_in("case-hardened", 1500e6, 2.664).of(8.4179e-6)
    load = tangential / 0.1 * dynamic * _FACE
    across = load_factors.transverse_factor_b((path.contact_ratio, _OVERLAP), stiffness.mesh, after, load)
    stress = np.array(pitting.contact_stress(geometry, dynamic * _FACE * across))
    cycles = _HOURS * 3600.0 * _SPEED / (2.0 * math.pi) / np.array([1.0, path.ratio])
    life = np.array([contact_factors(_STEEL.treatment).at(number) for number in cycles])
    permitted = 1500.0 * np.array([influence.of(0), influence.of(1)]) * life
    height = (_TIPS[0] - 120.825) / 2.0
    slender = _WIDTH / height
    return {
        "S_H": permitted / printed_sides(printed(BOOK), "sigma_H"),
        "sigma_HP": permitted,
        "sigma_H0": 1e-6 * geometry.nominal,
        "sigma_H": 1e-6 * stress,
        "F_t": tangential,
        "v": _SPEED * radii[0],
        "K_v": dynamic,
        "K_Halpha": across,
        "K_Falpha": across,
        "K_Fbeta": _FACE ** (slender**2 / (1.0 + slender + slender**2)),
        "z_n": np.array(_TEETH) / (math.cos(_BASE_HELIX) ** 2 * math.cos(_HELIX)),
        "N_L": cycles,
        "Z_NT": life,
        "Z_X": influence.size,
        "Z_W": influence.hardening[1],
        "Z_R": influence.roughness[0],
        "Z_v": influence.speed[0],
        "Z_L": influence.lubricant[0],
        "Z_beta": geometry.helix,
        "Z_eps": geometry.contact_ratio,
        "Z_E": 1e-3 * geometry.elasticity,
        "Z_B": geometry.single_pair,
        "Z_H": geometry.zone,
        "c_prime": 1e-9 * stiffness.single_pair,
        "c_th": 1e-9 * stiffness.theoretical,
        "c_gamma_alpha": 1e-9 * stiffness.mesh,
        "c_gamma_beta": 1e-9 * stiffness.mesh_face,
    }


def _dynamic(path: ContactPath, stiffness: iso6336.ReferenceStiffness, line_load: float) -> float:
    """K_v of discs without a bore, tolerances of class 5 (2013)."""
    mass = load_factors.disc_mass(_BASES[0] * 1e-3, (_TIPS[0] + 120.825) / 2e3, path.ratio, (7830.0, 7830.0))
    hard = load_factors.running_in("case-hardened", 1500e6, 2.664)
    form = flank_tolerances(5, 8e-3, _REFERENCE[1] * 1e-3, 0.1).profile_form
    mesh = load_factors.DynamicMesh(
        17.0,
        _SPEED,
        mass,
        stiffness.single_pair,
        stiffness.mesh,
        line_load,
        8.4179e-6,
        form,
        path.total_contact_ratio,
        70e-6,
        5.0,
        (hard, hard),
    )
    return load_factors.dynamic_factor(mesh).factor


rows = rows_of(BOOK, lambda: _geometry() | _capacity())
