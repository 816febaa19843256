"""Every mesh of an assessed train as a pair of gears, by the standards and simulated, and the worst."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.assessment_part import MeshAtDuty, TaskResult
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import as_life, required, shorter_life
from tribodyn.gears.rating.limits import SAFETIES, least, worst
from tribodyn.gears.rating.margins import strength_of
from tribodyn.gears.rating.rating_text import numbered
from tribodyn.gears.rating.spectrum import spectrum_part
from tribodyn.gears.rating.standard import factors_by_name, margins_by_standard
from tribodyn.geometry.drive import SIDES
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.pair import parts
from tribodyn.studies.assessment.pair.case import AssessmentCase
from tribodyn.studies.assessment.pair.conclusion import ByStandard, by_standard, concluded
from tribodyn.studies.assessment.pair.parts import Part
from tribodyn.studies.assessment.scatter import (
    Conclusion,
    SampleValues,
    drawn_values,
    numbers_of,
    samples_of,
    with_ranges,
)
from tribodyn.studies.assessment.train.case import TrainAssessmentCase
from tribodyn.studies.assessment.train.pairs import MeshPair
from tribodyn.studies.assessment.unknowns import Draw

STAGES = "stages"
#: Of the run at the duty, of each mesh.
_OF_MESH = (
    *("dynamic_factor", "power_in_mean", "power_friction_mean", "efficiency", "friction_coefficient_mean"),
    *("hertz_pressure_max", "film_min", "film_parameter_min", "contact_temperature_max", "bulk_temperature"),
    *("contact_loss_fraction", "S_B", "S_lambda"),
)
#: Of the load contact, of each mesh.
_OF_CONTACT = (
    *("loaded_transmission_error_peak_to_peak", "pinion_root_tension_max", "gear_root_tension_max"),
    *("shaft_misalignment", "given_misalignment"),
)


#: Of the run, of each mesh, what is concluded from as from the studies of a pair.
_FOR_PAIR = ("dynamic_factor", "power_friction_mean", "friction_coefficient_mean", "bulk_temperature")


def mesh_load_factor(case: TrainAssessmentCase, mesh: MeshAtDuty, own: Mapping[str, Any]) -> float:
    """K_γ of a mesh: given, or of its planetary stage in the simulation; 1 of others."""
    given = case.settings.mesh_load_factor
    if given is not None and mesh.stage:
        return given
    return float(own.get(STAGES, {}).get(mesh.stage, {}).get("mesh_load_factor", 1.0))


class TeethFindings(NamedTuple):
    """What was found of the teeth of a group of meshes."""

    along: Mapping[str, Any]  # arrays along the path of contact; empty: nothing is known
    quantities: Mapping[str, Any]
    spread: Mapping[str, np.ndarray]  # of samples


def contact_of(group: str, every: Sequence[Part], done: Mapping[str, TaskResult]) -> TeethFindings:
    """What the studies of the teeth say of a group of meshes; of one that failed there is nothing."""
    along, quantities, spread = dict[str, Any](), dict[str, Any](), dict[str, np.ndarray]()
    for part in every:
        results = {task.name.removeprefix(f"{group}-"): done[task.name] for task in part.tasks}
        first = results[next(iter(results))]
        if first.summary:
            found = part.role.answer(part.request, results)
            along |= found.along
            quantities |= found.quantities
            spread |= found.spread
    return TeethFindings(along, {"face_load_factor": 1.0} | quantities, spread)


class Scatter(NamedTuple):
    """What was found of the train's motion over samples of what is not known."""

    draws: Sequence[Draw]
    rows: Mapping[str, np.ndarray]  # values (sample,), and of meshes (sample, mesh), by name; empty: none


class _Rating(NamedTuple):
    """A mesh by the standards."""

    rated: AssessmentCase
    pressed: AssessmentCase
    by: ByStandard

    def seen(self) -> ByStandard:
        """As the gears are pressed."""
        if self.pressed is self.rated or self.by.capacity is None:
            return self.by
        capacity = self.by.capacity
        return self.by._replace(capacity=capacity._replace(gears=capacity.gears[::-1]))


def _rating(pair: MeshPair, share: float, quantities: Mapping[str, Any], draw: Draw | None = None) -> _Rating:
    """The rating with a K_γ and K_Hβ of the contact, of a sample where one is given."""
    settings = pair.rated.settings.model_copy(update={"mesh_load_factor": share})
    rated, pressed = (replace(one, settings=settings) for one in (pair.rated, pair.pressed))
    if draw is not None:
        rated, pressed = (draw.of(one, pair.mesh.distance) for one in (rated, pressed))
    pressed = pressed if pair.turned else rated
    face, faces = float(quantities["face_load_factor"]), parts.faces_of(pressed, quantities)
    return _Rating(rated, pressed, by_standard(rated, assembled(rated), face, faces, pair.mesh.meshing))


def assessed_mesh(
    case: TrainAssessmentCase,
    mesh: MeshAtDuty,
    pair: MeshPair | None,
    own: Mapping[str, Any],
    contact: TeethFindings,
    record: Record,
    scatter: Scatter,
) -> tuple[dict[str, Any], SampleValues | None]:
    """A mesh by the standards, where it has involutes of a tolerance class, beside its motion; its samples.

    `own` is the summary of the run at the duty, `record` its record; `contact` is of its teeth.
    """
    of_run, share = own[MESHES][mesh.name], mesh_load_factor(case, mesh, own)
    found: dict[str, Any] = {
        "driver": of_run["driver"],
        "driven": of_run["driven"],
        **({"alike": mesh.alike} if mesh.alike else {}),
        "simulated": {name: of_run[name] for name in _OF_MESH if of_run.get(name) is not None},
        "load_factors": {"K_A": case.settings.application_factor, "K_gamma": share},
    }
    if pair is None:
        return found, None
    rating = _rating(pair, share, contact.quantities)
    given = pair.rated.settings.face_load_factor
    found["load_factors"]["K_Hbeta"] = given or float(contact.quantities["face_load_factor"])
    if rating.by.standard is not None:
        found |= _by_name(case, rating.rated, rating.by)
        found["load_factors"] |= factors_by_name(rating.by.standard.factors)
    loads = case.whole.loads(record, case.subject.case, mesh.name) if contact.along else None
    if loads is None:
        return found, None
    quantities = dict(contact.quantities) | {
        name: of_run[name] for name in _FOR_PAIR if of_run.get(name) is not None
    }
    names = found["driver"], found["driven"]
    outcome, beside = _beside(rating, contact.along, quantities, loads, names, planetary=bool(mesh.stage))
    found["simulated"] |= beside.pop("simulated")
    found |= beside
    rows = contact.spread and scatter.rows
    if not rows:
        return found, None
    number = record.meshes.index(mesh.name)
    of_mesh = {
        "dynamic_factor": rows["dynamic_factor_of_mesh"][:, number],
        "mesh_load_factor": np.full(len(scatter.draws), share),
    }
    if case.settings.mesh_load_factor is None and mesh.stage:
        of_mesh["mesh_load_factor"] *= rows["mesh_load_factor"] / own["mesh_load_factor"]

    def like(draw: Draw, path: Mapping[str, Any], sample: Mapping[str, Any]) -> Conclusion:
        one = _rating(pair, sample["mesh_load_factor"], sample, draw)
        return concluded(one.pressed, path, sample, accurate=outcome, rated=one.seen())

    accurate = contact.along, quantities | {"mesh_load_factor": share}
    samples = samples_of(scatter.draws, {**contact.spread, **of_mesh}, accurate, like)
    return with_ranges(found, samples), samples


def _by_name(case: TrainAssessmentCase, rated: AssessmentCase, by: ByStandard) -> dict[str, Any]:
    """What a summary has of a rating."""
    assert by.standard is not None
    oil = rated.oil_temperature
    strength = strength_of(rated.lubricant, oil, case.settings.structure_factor, rated.materials)
    iso, capacity = by.iso | margins_by_standard(by.standard, strength, oil), by.capacity
    if capacity is None:
        return {"iso": iso}
    iso |= as_life(capacity.life, capacity.shortest.unlimited)
    iso |= spectrum_part(capacity, required(case.settings))
    return {"iso": iso} | ({"outside": numbered(capacity.remarks)} if capacity.remarks else {})


def _beside(
    rating: _Rating,
    along: Mapping[str, Any],
    quantities: Mapping[str, Any],
    loads: Any,
    names: Sequence[str],
    *,
    planetary: bool,
) -> tuple[Conclusion, dict[str, Any]]:
    """The simulation of a mesh beside its rating: from the contact of its teeth and their loads in motion.

    Those of a planet are brought to the mean load that K_γ multiplies.
    """
    rated, pressed = rating.rated, rating.pressed
    turned = pressed is not rated
    if turned:
        loads = loads.seen_from_driven(float(rated.drive.pinion.teeth / rated.drive.gear.teeth))
    places = along["roll_angle"]
    positions = round(float(assembled(pressed).pitch_angle) / float(places[1] - places[0]))
    mean = float(np.sum(along["normal_load"])) / positions
    loads = loads.of_load(mean if planetary else loads.mean_load, quantities["dynamic_factor"])
    outcome = concluded(pressed, along, quantities, loads._asdict(), rated=rating.seen())
    simulated = outcome.judged["margins"]["simulated"] | outcome.simulated
    simulated |= {name: quantities[name] for name in _OF_CONTACT if name in quantities}
    found: dict[str, Any] = {"simulated": _other_sides(simulated) if turned else simulated}
    if outcome.parted:
        found["reasons"] = numbered(
            [_named(text, names[::-1] if turned else names) for text in outcome.parted]
        )
    return outcome, found


def _named(text: str, gears: Sequence[str]) -> str:
    """A sentence on pinion and gear with the names of both."""
    for side, name in zip(SIDES, gears, strict=True):
        text = text.replace(f" of the {side}:", f" of {name}:")
    return text


def _other_sides(values: Mapping[str, Any]) -> dict[str, Any]:
    """Quantities of pinion and gear with both exchanged."""
    pinion, gear = SIDES
    other = {pinion: gear, gear: pinion}
    found = {}
    for name, value in values.items():
        if isinstance(value, Mapping) and set(value) == set(SIDES):
            value = {side: value[other[side]] for side in SIDES}
        for side in SIDES:
            if name.startswith(f"{side}_"):
                name = name.replace(side, other[side], 1)
                break
        found[name] = value
    return found


def _margin(mesh: Mapping[str, Any], name: str) -> float:
    """A safety of a mesh: the worse of the standard's and the simulation's; NaN: neither is known."""
    return worst(*(least(mesh.get(part, {}).get(name)) for part in ("iso", "simulated")))


def worst_margins(meshes: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Smallest safeties of all meshes, and which mesh has them."""
    worst: dict[str, Any] = {}
    for name in (*SAFETIES.values(), "life"):
        margins = {mesh: _margin(each, name) for mesh, each in meshes.items()}
        margins = {mesh: value for mesh, value in margins.items() if math.isfinite(value)}
        if margins:
            place = min(margins, key=lambda mesh: margins[mesh])
            worst[name] = margins[place]
            worst.setdefault("worst_of", {})[name] = place
    return worst | shorter_life(
        *(mesh.get(part, {}) for mesh in meshes.values() for part in ("iso", "simulated"))
    )


#: What of samples is compared with limits as it stands: limit -> quantity of the motion.
_OF_MOTION = {"dynamic_factor": "dynamic_factor", "mesh_load_factor": "mesh_load_factor"}


def samples_of_train(
    scatter: Scatter, meshes: Mapping[str, Mapping[str, Any]], samples: Mapping[str, SampleValues]
) -> SampleValues:
    """Samples of a train: of each the worst mesh; a mesh without samples counts as it is."""
    count, worst_of = len(scatter.draws), dict[str, np.ndarray]()
    for name in (*SAFETIES.values(), "life"):
        every = [
            _least_of(samples[mesh], name, count) if mesh in samples else np.full(count, _margin(each, name))
            for mesh, each in meshes.items()
        ]
        known = [values for values in every if np.any(np.isfinite(values))]
        if known:
            worst_of[name] = np.min(known, axis=0)
    kept = numbers_of(scatter.rows)
    of_margins = SAFETIES | {"life": "life"}
    limits = {limit: worst_of[name] for limit, name in of_margins.items() if name in worst_of}
    limits |= {limit: kept[name] for limit, name in _OF_MOTION.items() if name in kept}
    return SampleValues(drawn_values(scatter.draws), kept | worst_of, {}, {}, limits)


def _least_of(samples: SampleValues, name: str, count: int) -> np.ndarray:
    """A safety of every sample of a mesh, the worse of the standard's and the simulation's."""
    parts_of = [part[name] for part in (samples.simulated, samples.iso) if name in part]
    return np.min(parts_of, axis=0) if parts_of else np.full(count, math.nan)
