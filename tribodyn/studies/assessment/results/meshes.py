"""Every mesh of a gearbox by the standards and simulated, and the worst of them."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.gears.rating.capacity import safeties, shorter_life
from tribodyn.gears.rating.limits import LIMITS, SAFETIES, judged, with_unlimited, worst
from tribodyn.gears.rating.rating_text import numbered
from tribodyn.gears.rating.standard import factors_by_name, margins_by_standard
from tribodyn.geometry.drive import SIDES
from tribodyn.standards.contact_path import POINTS
from tribodyn.studies.assessment.case import RatedPair
from tribodyn.studies.assessment.findings import MeshFindings
from tribodyn.studies.assessment.results.conclusion import ByStandard, concluded, rating_of
from tribodyn.studies.assessment.results.margins import strength_of_case
from tribodyn.studies.assessment.results.scatter import (
    Conclusion,
    SampleValues,
    drawn_values,
    numbers_of,
    samples_of,
    with_ranges,
)
from tribodyn.studies.assessment.unknowns import Draw

#: What a gearbox has of its worst mesh besides safeties.
_LARGEST = (
    *("loaded_transmission_error_peak_to_peak", "pinion_root_tension_max", "gear_root_tension_max"),
    "contact_temperature_max",
)
_SMALLEST = ("specific_film_min",)


class ConcludedMesh(NamedTuple):
    """A mesh of an assessed gearbox."""

    summary: dict[str, Any]
    outcome: Conclusion | None = None  # None: its teeth were not pressed together
    samples: SampleValues | None = None
    pressed: RatedPair | None = None  # with K_γ


def concluded_mesh(found: MeshFindings, limits: Mapping[str, Any], draws: Sequence[Draw]) -> ConcludedMesh:
    """A mesh by the standards, where it has involutes of a tolerance class, beside its simulation."""
    pair = found.at_duty.pair
    summary: dict[str, Any] = {
        **({"driver": found.names[0], "driven": found.names[1]} if found.names[0] else {}),
        **({"alike": found.at_duty.alike} if found.at_duty.alike else {}),
        "duty": {
            "pinion_speed": pair.operating.pinion_speed,
            "gear_torque": pair.operating.gear_torque,
            "oil_temperature": float(pair.lubricant.temperature),
        },
        **found.quantities,
    }
    mesh = found.rated
    if mesh is None:
        return ConcludedMesh(summary | _of_margins({"simulated": found.margins}))
    rating = rating_of(mesh, found.share, found.quantities)
    rated, by = rating.rated, rating.by
    if by.standard is not None:
        summary["transverse_load_factor_method_b"] = by.standard.factors.transverse_b
    summary |= by.summary(rated)
    if by.capacity is not None and by.capacity.remarks:
        summary["outside"] = numbered(by.capacity.remarks)
    if not found.along:
        return ConcludedMesh(summary | _without_contact(found, limits, by))
    outcome = concluded(rating, found.along, found.quantities, found.loads)
    margins = outcome.judged["margins"]
    films, names = outcome.local.films, found.names[:: -1 if mesh.turned else 1]
    of_teeth = {
        "contact_temperature_max": float(films.bulk_temperature + np.nanmax(films.flash_rise)),
        "specific_film_min": outcome.simulated["lambda_GF"]["worst"],
        "simulated": outcome.simulated,
        "rests_on": outcome.rests,
        "reasons": numbered([_named(text, names) for text in outcome.parted]),
        "point_angles": dict(zip(POINTS, map(float, outcome.local.points), strict=True)),
    }
    summary |= _of_margins(margins) | outcome.judged | of_teeth
    if mesh.mesh.stage:
        summary["load_factors"]["K_gamma"] = found.share
    samples = None
    if found.rows:

        def like(draw: Draw, path: Mapping[str, Any], sample: Mapping[str, Any]) -> Conclusion:
            share = sample.get("mesh_load_factor", found.share)
            return concluded(rating_of(mesh, share, sample, draw), path, sample, accurate=outcome)

        samples = samples_of(draws, found.rows, (found.along, found.quantities), like)
        summary = with_ranges(summary, samples)
    if mesh.turned:
        summary = _other_sides(summary)
    return ConcludedMesh(summary, outcome, samples, rating.pressed)


def _without_contact(found: MeshFindings, limits: Mapping[str, Any], by: ByStandard) -> dict[str, Any]:
    """Margins, load factors and limits of a mesh whose teeth were not pressed together."""
    assert found.rated is not None
    rated, simulated = found.rated.rated, dict(found.margins)
    margins: dict[str, Any] = {"simulated": simulated} if simulated else {}
    factors = {"K_A": rated.settings.application_factor, "K_gamma": found.share}
    if by.standard is not None:
        strength = strength_of_case(rated)
        margins["iso"] = margins_by_standard(by.standard, strength, rated.oil_temperature)
        margins["iso"] |= safeties(by.capacity)
        factors |= factors_by_name(by.standard.factors)
    least = least_of(margins)
    values = {limit: least.get(name, math.nan) for limit, name in (SAFETIES | {"life": "life"}).items()}
    values["dynamic_factor"] = found.quantities.get("dynamic_factor", math.nan)
    return _of_margins(margins) | {
        "load_factors": factors,
        "limits": with_unlimited(judged(limits, values), least),
    }


def _of_margins(margins: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    return {**least_of(margins), "margins": margins}


def least_of(margins: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """The smaller safeties and the shorter life of the standard and the simulation."""
    both = [margins.get(part, {}) for part in ("iso", "simulated")]
    found = {name: worst(*(one.get(name) for one in both)) for name in SAFETIES.values()}
    return {name: value for name, value in found.items() if math.isfinite(value)} | shorter_life(*both)


def _named(text: str, gears: Sequence[str]) -> str:
    """A sentence on pinion and gear with the names of both, where they have names."""
    for side, name in zip(SIDES, gears, strict=True):
        text = text.replace(f" of the {side}:", f" of {name}:") if name else text
    return text


def _other_sides(values: Mapping[str, Any]) -> dict[str, Any]:
    """Quantities of pinion and gear with both exchanged, but for those by the standard."""
    pinion, gear = SIDES
    other, found = {pinion: gear, gear: pinion}, dict[str, Any]()
    for name, value in values.items():
        if isinstance(value, Mapping) and set(value) == set(SIDES):
            value = {side: value[other[side]] for side in SIDES}
        elif name == "simulated":
            value = _other_sides(value)
        side = next((side for side in SIDES if name.startswith(f"{side}_")), "")
        found[name.replace(side, other[side], 1) if side else name] = value
    return found


def worst_of(meshes: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """What a gearbox has of its worst mesh, and which that is."""
    found: dict[str, Any] = {}
    for names, extreme in ((_LARGEST, max), ((*SAFETIES.values(), *_SMALLEST, "life"), min)):
        for name in names:
            values = {mesh: each[name] for mesh, each in meshes.items() if each.get(name) is not None}
            if values:
                place = extreme(values, key=lambda mesh: values[mesh])
                found[name] = values[place]
                found.setdefault("worst_of", {})[name] = place
    return found | shorter_life(*meshes.values())


def worst_limits(every: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Judged limits of the worst mesh each, of those that meshes have."""
    found: dict[str, Any] = {}
    for limits in every:
        for name, cell in limits.items():
            other, sign = found.get(name, cell), 1.0 if LIMITS[name].least else -1.0
            found[name] = min(other, cell, key=lambda one: sign * one["value"])
    return found


def worst_samples(
    draws: Sequence[Draw], rows: Mapping[str, np.ndarray], meshes: Sequence[ConcludedMesh]
) -> SampleValues:
    """Samples of a gearbox: of each the worst mesh; a mesh without samples counts as it is."""
    count, quantities, limits = len(draws), numbers_of(rows), dict[str, np.ndarray]()
    of_least = dict.fromkeys((*SAFETIES.values(), *_SMALLEST, "life"), True) | dict.fromkeys(_LARGEST, False)
    for name, least in of_least.items():
        _add_worst(quantities, name, [_values(mesh, name, count) for mesh in meshes], least=least)
    for name, limit in LIMITS.items():
        every = [
            mesh.samples.limits.get(name)
            if mesh.samples
            else np.full(count, mesh.summary.get("limits", {}).get(name, {}).get("value", math.nan))
            for mesh in meshes
        ]
        _add_worst(limits, name, every, least=limit.least)
    return SampleValues(drawn_values(draws), quantities, {}, {}, limits)


def _values(mesh: ConcludedMesh, name: str, count: int) -> np.ndarray:
    """A quantity of every sample of a mesh, of a safety the worse of the standard's and the simulation's."""
    if mesh.samples is None:
        return np.full(count, mesh.summary.get(name, math.nan))
    samples = mesh.samples
    parts = [part[name] for part in (samples.simulated, samples.iso) if name in part]
    parts = [samples.quantities[name]] if name in samples.quantities else parts
    return np.min(parts, axis=0) if parts else np.full(count, math.nan)


def _add_worst(
    found: dict[str, np.ndarray], name: str, every: Sequence[np.ndarray | None], *, least: bool
) -> None:
    known = [values for values in every if values is not None and np.any(np.isfinite(values))]
    if known:
        found[name] = (np.min if least else np.max)(known, axis=0)
