"""Example 1 of ISO/TR 6336-30: a helical pair, in the editions of 2017 (ISO 6336:2006) and 2022 (geometry).

Printed are its results; the duty is 9000 N m at 360 rpm, ν_40 320 mm²/s, Ra 1 µm, K_Hβ 1.16, C_a 70 µm.
Lengths in mm, angles in degrees.
"""

import math
from collections.abc import Callable
from typing import Any

from tribodyn.compliance import iso6336
from tribodyn.geometry.gauges import Involute, span
from tribodyn.standards import load_factors, pitting
from tribodyn.standards.contact_path import ContactPath, transverse_angle
from tribodyn.standards.flank_tolerances import flank_tolerances, rounded
from tribodyn.standards.metals import Metal, contact_factors
from tribodyn.validation.books import rows_of

BOOK = "iso-tr-6336-30"
_MODULE, _ALPHA, _HELIX, _TEETH, _WIDTH, _CENTRES = (
    8.0,
    math.radians(20.0),
    math.radians(15.8),
    (17, 103),
    100.0,
    500.0,
)
_TIPS, _DEPTH, _ROUNDING = (159.66, 872.35), 11.2, 3.12
_TORQUE, _SPEED, _HOURS, _FACE = 9000.0, 360.0 * math.pi / 30.0, 50000.0, 1.16
_STEEL = Metal("case-hardened", 1500e6, 500e6, 6.9e9, 900e6)
_TRANSVERSE = transverse_angle(_ALPHA, _HELIX)
_REFERENCE = (_MODULE / math.cos(_HELIX) * 17, _MODULE / math.cos(_HELIX) * 103)
_BASES = (_REFERENCE[0] * math.cos(_TRANSVERSE), _REFERENCE[1] * math.cos(_TRANSVERSE))
_WORKING = math.acos(sum(_BASES) / 2.0 / _CENTRES)
_BASE_HELIX = math.asin(math.sin(_HELIX) * math.cos(_ALPHA))
_SHIFTS = (0.14522, 0.0)
_SPANS, _SPAN_TEETH = (38.196, 307.943), (2, 13)


def _both(of: Callable[[int], float]) -> tuple[float, float]:
    return of(0), of(1)


def _tangent(gear: int) -> float:
    return math.sqrt(_TIPS[gear] ** 2 - _BASES[gear] ** 2) / 2.0


def _geometry() -> dict[str, Any]:
    """The tables of 2022."""
    gears = [Involute(_MODULE, _ALPHA, float(z), x, _HELIX) for z, x in zip(_TEETH, _SHIFTS, strict=True)]
    cut = _both(
        lambda i: (
            _SHIFTS[i] + (_SPANS[i] - span(gears[i], _SPAN_TEETH[i])) / (2.0 * _MODULE * math.sin(_ALPHA))
        )
    )
    whole, pitch = _CENTRES * math.sin(_WORKING), math.pi * _BASES[0] / 17.0
    starts = _both(lambda i: whole - _tangent(1 - i))
    length = sum(_tangent(i) for i in (0, 1)) - whole
    overlap = _WIDTH * math.sin(_HELIX) / (math.pi * _MODULE)
    working = _both(lambda i: _BASES[i] / math.cos(_WORKING))

    def form(i: int) -> float:
        """Where the rounded rack leaves the involute."""
        straight = _DEPTH / _MODULE - _ROUNDING / _MODULE * (1.0 - math.sin(_ALPHA)) - cut[i]
        along = _REFERENCE[i] * math.sin(_TRANSVERSE) - 2.0 * straight * _MODULE / math.sin(_TRANSVERSE)
        return math.hypot(_BASES[i], along)

    pitches = _both(
        lambda i: 1e6 * rounded(flank_tolerances(5, 8e-3, _REFERENCE[i] * 1e-3, 0.1).single_pitch)
    )
    return {
        "g_u": 103.0 / 17.0,
        "g_m_t": _MODULE / math.cos(_HELIX),
        "g_d": _REFERENCE,
        "g_inv_alpha_n": math.tan(_ALPHA) - _ALPHA,
        "g_alpha_t": math.degrees(_TRANSVERSE),
        "g_inv_alpha_t": math.tan(_TRANSVERSE) - _TRANSVERSE,
        "g_alpha_wt": math.degrees(_WORKING),
        "g_x_E": cut,
        "g_d_f": _both(lambda i: _REFERENCE[i] - 2.0 * (_DEPTH - cut[i] * _MODULE)),
        "g_d_Ff": _both(form),
        "g_d_b": _BASES,
        "g_beta_b": math.degrees(_BASE_HELIX),
        "g_d_w": working,
        "g_p_n": math.pi * _MODULE,
        "g_p_t": math.pi * _MODULE / math.cos(_HELIX),
        "g_p_bt": pitch,
        "g_g_alpha": length,
        "g_d_Nf": _both(lambda i: math.hypot(_BASES[i], 2.0 * starts[i])),
        "g_eps_alpha": length / pitch,
        "g_eps_beta": overlap,
        "g_eps_gamma": length / pitch + overlap,
        "g_f_pT": pitches,
        "g_f_pb": _both(lambda i: pitches[i] * math.cos(_TRANSVERSE)),
        "g_v_w": _SPEED * working[0] / 2e3,
        "g_v": _SPEED * _REFERENCE[0] / 2e3,
    }


def _capacity() -> dict[str, Any]:
    """The reference column of 2017: ISO 6336:2006, method B."""
    bases = _both(lambda i: _BASES[i] / 2e3)
    overlap = _WIDTH * math.sin(_HELIX) / (math.pi * _MODULE)
    path = ContactPath((17.0, 103.0), bases, _both(lambda i: _TIPS[i] / 2e3), _WORKING, _BASE_HELIX, overlap)
    radii = _both(lambda i: _REFERENCE[i] / 2e3)
    modulus = 2.0 / (2.0 * (1.0 - 0.09) / 206e9)
    mesh = pitting.PittingMesh(
        path, radii, _ALPHA, _HELIX, 0.1, _TORQUE, _SPEED, modulus, 320e-6, (6e-6, 6e-6), 2006
    )
    tangential = pitting.tangential_load(mesh)
    pair = iso6336.ReferencePair(
        (17.0, 103.0),
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
    across = load_factors.transverse_factor_b((path.contact_ratio, overlap), stiffness.mesh, after, load)
    stress = pitting.contact_stress(geometry, dynamic * _FACE * across)
    cycles = _both(lambda i: _HOURS * 3600.0 * _SPEED / (2.0 * math.pi) / (1.0, path.ratio)[i])
    life = _both(lambda i: contact_factors(_STEEL.treatment).at(cycles[i]))
    permitted = _both(lambda i: 1500.0 * influence.of(i) * life[i])
    height = (_TIPS[0] - 120.825) / 2.0
    slender = _WIDTH / height
    return {
        "S_H": _both(lambda i: 1e6 * permitted[i] / stress[i]),
        "sigma_HP": permitted,
        "sigma_H0": 1e-6 * geometry.nominal,
        "sigma_H": _both(lambda i: 1e-6 * stress[i]),
        "F_t": tangential,
        "v": _SPEED * radii[0],
        "K_v": dynamic,
        "K_Halpha": across,
        "K_Falpha": across,
        "K_Fbeta": _FACE ** (slender**2 / (1.0 + slender + slender**2)),
        "z_n": _both(lambda i: _TEETH[i] / (math.cos(_BASE_HELIX) ** 2 * math.cos(_HELIX))),
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
