"""Limits that a scenario sets, and whether what was found keeps them."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

import numpy as np

from tribodyn.input import units
from tribodyn.input.quantity import InUnit, Positive, Table
from tribodyn.quantities.catalogue import QUANTITIES, scatter
from tribodyn.quantities.quantity import Quantity

Pressure = Annotated[float, InUnit(units.positive(units.PRESSURE), "1.5 GPa")]


class OilLimits(Table):
    """What must hold: red on the first page where it does not. One that is not given is not judged."""

    scuffing_flash: Positive | None = 1.5
    scuffing_integral: Positive | None = 1.5
    micropitting: Positive | None = 1.0
    flank_fracture: Positive | None = None
    dynamic_factor: Positive | None = None
    hertz_pressure: Pressure | None = None


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
    "pitting": StandardLimit("Pitting S_H", QUANTITIES["S_H"], least=True),
    "bending": StandardLimit("Tooth bending S_F", QUANTITIES["S_F"], least=True),
    "flank_fracture": StandardLimit("Tooth flank fracture S_FF", QUANTITIES["S_FF"], least=True),
    "life": StandardLimit("Life", QUANTITIES["life"], least=True),
    "dynamic_factor": StandardLimit("Dynamic factor K_v", QUANTITIES["dynamic_factor"]),
    "mesh_load_factor": StandardLimit("Mesh load factor K_γ", QUANTITIES["mesh_load_factor"]),
    "hertz_pressure": StandardLimit("Hertz pressure with K_A and K_v", QUANTITIES["hertz_pressure_max"]),
    "root_tension": StandardLimit("Root tension", QUANTITIES["pinion_root_tension_max"]),
    "loaded_error": StandardLimit(
        "Loaded error, peak to peak", QUANTITIES["loaded_transmission_error_peak_to_peak"]
    ),
}


#: Limit of a safety -> its name.
SAFETIES = {
    **{"pitting": "S_H", "bending": "S_F"},
    **{"scuffing_flash": "S_B", "scuffing_integral": "S_intS", "micropitting": "S_lambda"},
    "flank_fracture": "S_FF",
}


def worst(*safeties: float | None) -> float:
    """The smallest of those that are known; NaN where none is."""
    finite = [value for value in safeties if value is not None and math.isfinite(value)]
    return min(finite, default=math.nan)


def least(value: Any) -> float | None:
    """A number, or the smallest of those that a table has of one quantity."""
    return min(value.values()) if isinstance(value, Mapping) else value


def judged(limits: Mapping[str, float | None], values: Mapping[str, float]) -> dict[str, dict[str, Any]]:
    """Values beside the limits that are given, and whether they are kept.

    What has no value, as a safety for which the oil lacks the load stage, is left out.
    """
    judgements: dict[str, dict[str, Any]] = {}
    for name, limit in limits.items():
        value = float(values.get(name, math.nan))
        if limit is None or not math.isfinite(value):
            continue
        kept = value >= limit if LIMITS[name].least else value <= limit
        judgements[name] = {"value": value, "limit": float(limit), "kept": bool(kept)}
    return judgements


def with_unlimited(limits: dict[str, dict[str, Any]], life: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Judged limits, the life marked as a lower bound where it is one, see `capacity.as_life`."""
    if "life" in limits and life.get("life_unlimited"):
        limits["life"]["unlimited"] = True
    return limits


def written_limit(name: str, limit: Mapping[str, Any]) -> str:
    """The value of a judged limit as it is written."""
    quantity = LIMITS[name].quantity
    return quantity.written_of(
        {quantity.name: float(limit["value"]), f"{quantity.name}_unlimited": limit.get("unlimited")}
    )


def not_judged(limits: Mapping[str, float | None], stages: Any) -> str:
    """Which required safeties are not known, since the oil lacks the load stage; "" where none is."""
    needs = {"scuffing_flash": "scuffing", "scuffing_integral": "scuffing", "micropitting": "micropitting"}
    missing = [
        name
        for name, stage in needs.items()
        if limits.get(name) is not None and getattr(stages, stage) is None
    ]
    names = "; ".join(LIMITS[name].label for name in missing)
    of = " and ".join(dict.fromkeys(needs[name] for name in missing))
    return f"Not rated: {names}, as the oil has no FZG load stage of {of}." if missing else ""


def over_samples(limits: Mapping[str, Mapping[str, Any]], samples: Mapping[str, Any]) -> dict[str, Any]:
    """Judged limits with their scatter over samples: ``p5``, ``p95``, ``samples`` and how many ``exceed``.

    `samples` has values (n,) by the names of limits, NaN where a sample has none.
    """
    scattered: dict[str, Any] = {}
    for name, limit in limits.items():
        values = np.asarray(samples.get(name, ()), dtype=float)
        scattered[name] = dict(limit)
        if np.any(np.isfinite(values)):
            finite = values[np.isfinite(values)]
            exceeding = finite < limit["limit"] if LIMITS[name].least else finite > limit["limit"]
            ends = {end: float(value) for end, value in scatter(values).items() if end != "median"}
            scattered[name] |= ends | {"samples": len(finite), "exceed": int(np.sum(exceeding))}
    return scattered


def on_limits(summary: Mapping[str, Any]) -> list[tuple[bool, str]]:
    """Whether the limits hold: good or bad, and the sentence; a second one over samples, where there are."""
    limits, samples = summary.get("limits", {}), summary.get("sample_counts", {})
    exceeded = [LIMITS[name].label for name, sentences in limits.items() if not sentences["kept"]]
    accurate = " with accurate teeth" if samples else ""
    every = f"All {len(limits)} limits hold" if len(limits) != 1 else "The one limit holds"
    sentences = []
    if exceeded:
        sentences.append((False, f"Limits not kept{accurate}: {'; '.join(exceeded)}."))
    elif limits:
        sentences.append((True, f"{every}{accurate}."))
    return [*sentences, *_on_samples(limits, samples)]


def _on_samples(limits: Mapping[str, Any], samples: Mapping[str, Any]) -> list[tuple[bool, str]]:
    """How many samples do not keep which limit, and how many lose contact."""
    if not samples:
        return []
    count, parts = int(samples["samples"]), []
    if lost := int(samples["contact_lost"]):
        begins = QUANTITIES["contact_loss_speed_from"].written(samples["contact_loss_speed_from"])
        lose = "loses" if lost == 1 else "lose"
        parts.append(f"{lost} of {count} samples {lose} contact, from {begins} rpm")
    exceeded = [
        f"{LIMITS[name].label} ({limit['exceed']} of {limit['samples']})"
        for name, limit in limits.items()
        if limit.get("exceed")
    ]
    parts += [f"limits not kept: {', '.join(exceeded)}"] if exceeded else []
    if parts:
        return [(False, f"With what is not known varied: {'; '.join(parts)}.")]
    judged_too = any("exceed" in limit for limit in limits.values())
    both = "keep the limits and contact" if judged_too else "keep contact"
    return [(True, f"With what is not known varied: all {count} samples {both}.")]
