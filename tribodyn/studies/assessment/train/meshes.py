"""Every mesh of an assessed train by the standards, beside its motion, and the worst of all."""

import math
from collections.abc import Mapping
from typing import Any

from tribodyn.cases.assessment_part import MeshAtDuty
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import as_life, capacity_of, life_bins, required, shorter_life
from tribodyn.gears.rating.limits import SAFETIES, least, worst
from tribodyn.gears.rating.margins import strength_of
from tribodyn.gears.rating.rating_text import numbered
from tribodyn.gears.rating.spectrum import spectrum_part
from tribodyn.gears.rating.standard import (
    factors_by_name,
    iso_part,
    margins_by_standard,
    rated_duty,
    standard_of,
)
from tribodyn.record.reader import MESHES
from tribodyn.studies.assessment.train.case import TrainAssessmentCase

STAGES = "stages"
#: Of the run at the duty, of each mesh.
_OF_MESH = (
    *("dynamic_factor", "power_in_mean", "power_friction_mean", "efficiency", "friction_coefficient_mean"),
    *("hertz_pressure_max", "film_min", "film_parameter_min", "contact_temperature_max", "bulk_temperature"),
    *("contact_loss_fraction", "S_B", "S_lambda"),
)


def spectra_of(case: TrainAssessmentCase) -> dict[str, list[tuple[float, float, float]]]:
    """Of every mesh the duties of the load spectrum: share, driver's speed rad/s, torque N m; empty: none."""
    whole, found = case.whole, dict[str, list[tuple[float, float, float]]]()
    for share, at_duty in whole.duties(case.subject.case):
        for mesh in whole.meshes(at_duty):
            duty = mesh.pair.operating
            found.setdefault(mesh.name, []).append((share, duty.pinion_speed, duty.gear_torque))
    return found


def rated_mesh(
    case: TrainAssessmentCase,
    mesh: MeshAtDuty,
    own: Mapping[str, Any],
    spectra: Mapping[str, list[tuple[float, float, float]]],
) -> dict[str, Any]:
    """A mesh by the standards, where it has involutes of a tolerance class, beside its motion."""
    settings, of_run = case.settings, own[MESHES][mesh.name]
    share = settings.mesh_load_factor
    if share is None or not mesh.stage:
        share = float(own.get(STAGES, {}).get(mesh.stage, {}).get("mesh_load_factor", 1.0))
    found: dict[str, Any] = {
        "driver": of_run["driver"],
        "driven": of_run["driven"],
        **({"alike": mesh.alike} if mesh.alike else {}),
        "simulated": {name: of_run[name] for name in _OF_MESH if of_run.get(name) is not None},
        "load_factors": {
            "K_A": settings.application_factor,
            "K_gamma": share,
            "K_Hbeta": settings.face_of(mesh.name),
        },
    }
    pair, assembly = mesh.pair, assembled(mesh.pair)
    if pair.quality is None or not assembly.family.involute or not pair.operating.gear_torque > 0.0:
        return found
    oil = float(pair.lubricant.temperature)
    duty = rated_duty(settings, oil, face=1.0, mesh=share)
    duty = duty._replace(mesh=share, face=settings.face_of(mesh.name))
    standard = standard_of(pair, assembly, duty)
    strength = strength_of(pair.lubricant, oil, settings.structure_factor, pair.materials)
    found["load_factors"] |= factors_by_name(standard.factors)
    bins = life_bins(pair, assembly, standard.factors, spectra.get(mesh.name, ()))
    capacity = capacity_of(pair, assembly, standard.factors, bins, settings, mesh.meshing)
    by_standard = iso_part(pair, standard) | margins_by_standard(standard, strength, oil)
    if capacity is not None:
        by_standard |= as_life(capacity.life, capacity.shortest.unlimited) | capacity.by_name()
        by_standard |= spectrum_part(capacity, required(settings))
    beyond = list(capacity.remarks) if capacity else []
    return found | {"iso": by_standard} | ({"outside": numbered(beyond)} if beyond else {})


def _margin(mesh: Mapping[str, Any], name: str) -> float:
    """A safety of a mesh: the worse of the standard's and the simulation's; NaN: neither is known."""
    return worst(*(least(mesh.get(part, {}).get(name)) for part in ("iso", "simulated")))


def worst_margins(meshes: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Smallest safeties of all meshes, and which mesh has them."""
    found: dict[str, Any] = {}
    for name in (*SAFETIES.values(), "life"):
        known = {mesh: _margin(each, name) for mesh, each in meshes.items()}
        known = {mesh: value for mesh, value in known.items() if math.isfinite(value)}
        if known:
            place = min(known, key=lambda mesh: known[mesh])
            found[name] = known[place]
            found.setdefault("worst_of", {})[name] = place
    return found | shorter_life(*(mesh.get("iso", {}) for mesh in meshes.values()))
