"""Margins by the standards and by the simulation, and which limits of the scenario hold."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.quantities.quantity import Quantity
from tribodyn.standards import scuffing
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.local import LocalValues
from tribodyn.studies.assessment.standard import ZERO_CELSIUS, Standard, Strength


class StandardLimit(NamedTuple):
    """A limit of the scenario; `least`: the quantity must be at least the limit, else at most."""

    label: str
    quantity: Quantity
    least: bool = False


#: Name of a limit -> what it is.
LIMITS: dict[str, StandardLimit] = {
    "scuffing_flash": StandardLimit("Scuffing S_B, flash temperature", QUANTITIES["S_B"], least=True),
    "scuffing_integral": StandardLimit("Scuffing S_intS, integral temp.", QUANTITIES["S_intS"], least=True),
    "micropitting": StandardLimit("Micropitting S_λ", QUANTITIES["S_lambda"], least=True),
    "dynamic_factor": StandardLimit("Dynamic factor K_v", QUANTITIES["dynamic_factor"]),
    "hertz_pressure": StandardLimit("Hertz pressure with K_v", QUANTITIES["hertz_pressure_max"]),
    "root_tension": StandardLimit("Root tension", QUANTITIES["pinion_root_tension_max"]),
    "loaded_error": StandardLimit(
        "Loaded error, peak to peak", QUANTITIES["loaded_transmission_error_peak_to_peak"]
    ),
}
#: StandardLimit -> the figure that it bounds, of those that scatter.
_SCATTERED = {"dynamic_factor": "dynamic_factor", "loaded_error": "loaded_transmission_error_peak_to_peak"}


def margins_and_limits(
    case: AssessmentCase,
    found: Standard | None,
    strength: Strength,
    local: LocalValues,
    figures: Mapping[str, Any],
    spread: Mapping[str, Mapping[str, float]],
) -> dict[str, Any]:
    """Return ``margins`` by ``iso`` and ``simulated``, ``load_factors`` and ``limits``; temperatures in °C.

    The worse of both safeties is compared with a limit. One whose load stage the oil lacks is
    left out. Where a figure scatters over samples of deviations (`spread`, by the names of the figures),
    its 95 % is compared too, as ``p95`` and ``kept_p95``.
    """
    by_standard = _by_standard(case, found, strength) if found else {}
    own = _by_simulation(case, strength, local)
    values = {
        "scuffing_flash": _worse(by_standard.get("S_B"), own.get("S_B")),
        "scuffing_integral": by_standard.get("S_intS", math.nan),
        "micropitting": _worse(by_standard.get("S_lambda"), own.get("S_lambda")),
        "dynamic_factor": figures["dynamic_factor"],
        "hertz_pressure": float(np.nanmax(local.films.pressure)),
        "root_tension": max(figures["pinion_root_tension_max"], figures["gear_root_tension_max"]),
        "loaded_error": figures["loaded_transmission_error_peak_to_peak"],
    }
    limits = {}
    for name, limit in case.limits.items():
        if limit is None or not math.isfinite(values[name]):
            continue
        kept = values[name] >= limit if LIMITS[name].least else values[name] <= limit
        limits[name] = {"value": float(values[name]), "limit": float(limit), "kept": bool(kept)}
        upper = spread.get(_SCATTERED.get(name, ""), {}).get("p95", math.nan)
        if math.isfinite(upper):
            limits[name] |= {"p95": upper, "kept_p95": bool(upper <= limit)}
    factors = {"K_A": case.settings.application_factor, "K_Hbeta": figures["face_load_factor"]}
    if found:
        factors |= {
            "K_v": found.dynamic.factor,
            "K_Halpha": found.transverse,
            "N": found.dynamic.resonance_ratio,
            "resonance_speed": found.dynamic.resonance_speed,
            "range": found.dynamic.range,
            "c_gamma_beta": found.mesh_stiffness_face,
        }
    margins = {"simulated": own} | ({"iso": by_standard} if by_standard else {})
    return {"margins": margins, "load_factors": factors, "limits": limits}


def _by_standard(case: AssessmentCase, found: Standard, strength: Strength) -> dict[str, float]:
    margins = {
        "theta_M_flash": found.flash_bulk - ZERO_CELSIUS,
        "theta_B": found.flash_contact - ZERO_CELSIUS,
        "theta_int": found.integral - ZERO_CELSIUS,
    }
    if strength.scuffing is not None and strength.scuffing_integral is not None:
        margins |= {
            "theta_S": strength.scuffing - ZERO_CELSIUS,
            "theta_intS": strength.scuffing_integral - ZERO_CELSIUS,
            "S_B": scuffing.flash_safety(strength.scuffing, found.flash_contact, case.oil_temperature),
            "S_intS": scuffing.integral_safety(strength.scuffing_integral, found.integral),
        }
    if strength.specific_film is not None:
        worst = float(np.min(found.films.specific_film))
        margins |= {"lambda_GFP": strength.specific_film, "S_lambda": worst / strength.specific_film}
    return margins


def _by_simulation(case: AssessmentCase, strength: Strength, local: LocalValues) -> dict[str, float]:
    films = local.films
    contact = films.bulk_temperature + float(np.nanmax(films.flash_rise))
    margins = {"theta_B": contact - ZERO_CELSIUS}
    if strength.scuffing is not None:
        margins["S_B"] = scuffing.flash_safety(strength.scuffing, contact, case.oil_temperature)
    if strength.specific_film is not None:
        margins["S_lambda"] = float(np.nanmin(films.specific_film)) / strength.specific_film
    return margins


def _worse(one: float | None, other: float | None) -> float:
    known = [value for value in (one, other) if value is not None and math.isfinite(value)]
    return min(known, default=math.nan)
