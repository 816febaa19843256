"""Every mesh of an assessed train as a pair of gears, by the standards and simulated, and the worst."""

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import tomli_w

from tribodyn.cases.assessment_part import MeshAtDuty, TaskResult
from tribodyn.errors import InputError
from tribodyn.gears.case import OiledCase
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.capacity import as_life, required, shorter_life
from tribodyn.gears.rating.limits import SAFETIES, least, worst
from tribodyn.gears.rating.margins import strength_of
from tribodyn.gears.rating.rating_text import numbered
from tribodyn.gears.rating.spectrum import spectrum_part
from tribodyn.gears.rating.standard import factors_by_name, margins_by_standard
from tribodyn.geometry.drive import SIDES
from tribodyn.input.resolve import resolve_table
from tribodyn.record.reader import MESHES, Record
from tribodyn.studies.assessment.pair import parts
from tribodyn.studies.assessment.pair import scenario as of_pair
from tribodyn.studies.assessment.pair.case import AssessmentCase, AssessmentTable
from tribodyn.studies.assessment.pair.conclusion import ByStandard, by_standard, concluded
from tribodyn.studies.assessment.pair.parts import Part
from tribodyn.studies.assessment.train.case import TrainAssessmentCase

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


class MeshPair(NamedTuple):
    """A mesh of a train as its pair of gears is assessed."""

    mesh: MeshAtDuty
    rated: AssessmentCase  # the driver its pinion
    #: the same as it is pressed: of a ring that drives the planet is the pinion, in the opposite sense
    pressed: AssessmentCase

    @property
    def turned(self) -> bool:
        """Whether both differ."""
        return self.pressed is not self.rated

    @property
    def group(self) -> str:
        """Name that it shares with the meshes of a set's other planets."""
        return self.mesh.alike or self.mesh.name


def pairs_of(case: TrainAssessmentCase) -> dict[str, MeshPair]:
    """Every mesh with teeth whose driver drives, by name."""
    whole, subject = case.whole, case.subject.case
    spectra, found = spectra_of(case), dict[str, MeshPair]()
    for mesh in whole.meshes(subject):
        if mesh.pair.operating.gear_torque > 0.0:
            try:
                tables = whole.pair(subject, mesh.name)
            except InputError:  # of a bare model
                continue
            found[mesh.name] = _pair_of(case, mesh, tables, spectra.get(mesh.name, ()))
    return found


def _pair_of(
    case: TrainAssessmentCase,
    mesh: MeshAtDuty,
    tables: Mapping[str, Any],
    spectrum: Sequence[tuple[float, float, float]],
) -> MeshPair:
    pair = mesh.pair
    drive, duty = tables["drive"], pair.operating
    teeth = float(pair.drive.pinion.teeth), float(pair.drive.gear.teeth)
    speed, torque, ratio = duty.pinion_speed, duty.gear_torque, 1.0
    if teeth[0] < 0.0:
        ratio = abs(teeth[0] / teeth[1])
    title = f"{case.title}: {mesh.name}"
    data = {
        "title": title,
        "kind": of_pair.KIND,
        "drive": drive,
        "lubricant": tables["lubricant"],
        "operating": {
            **tables["operating"],
            "pinion_speed": f"{speed * ratio!r} rad/s",
            "gear_torque": f"{torque * ratio!r} N*m",
        },
        "mesh": {} if min(teeth) < 0.0 else _face(mesh, tables["mesh"]),
    }
    data, *_ = resolve_table(data, Path(f"{mesh.name}.toml"), {}, lambda _: of_pair.Scenario)
    toml = tomli_w.dumps(data)
    digest = hashlib.sha256(toml.encode()).hexdigest()
    pressed = of_pair.case_of(of_pair.Scenario.model_validate(data), toml, digest)
    settings = _settings(case, mesh)
    stretched = tuple((share, fast * ratio, load * ratio) for share, fast, load in spectrum)
    pressed = replace(pressed, settings=settings, spectrum=stretched)
    if ratio == 1.0:
        return MeshPair(mesh, pressed, pressed)
    own = {field.name: getattr(pair, field.name) for field in fields(OiledCase)}
    kept = {name: getattr(pressed, name) for name in ("title", "name", "kind", "toml", "sha256")}
    return MeshPair(mesh, replace(pressed, **{**own, **kept}, spectrum=tuple(spectrum)), pressed)


def _face(mesh: MeshAtDuty, table: Mapping[str, Any]) -> dict[str, Any]:
    """Slices of the face, and how the axes stand, drawn shafts and matrices included."""
    stand = mesh.pair.supports.misalignment
    found = {name: table[name] for name in ("slices", "misalignment") if name in table}
    if any(stand):
        given = of_pair.AssessmentMesh.model_validate(found).misalignment
        angles = {name: getattr(given, name) + getattr(stand, name) for name in stand._fields}
        found["misalignment"] = {
            **found.get("misalignment", {}),
            **{name: f"{angle!r} rad" for name, angle in angles.items()},
        }
    return found


def _settings(case: TrainAssessmentCase, mesh: MeshAtDuty) -> AssessmentTable:
    """What is asked of a mesh: what is asked of all, with its own factors."""
    names = set(AssessmentTable.model_fields) & set(type(case.settings).model_fields)
    own = {name: getattr(case.settings, name) for name in names}
    own |= {
        "face_load_factor": case.settings.face_of(mesh.name),
        "friction_laws": (str(mesh.pair.friction.law),),
        "samples": 0,
    }
    return AssessmentTable.model_construct(**own)


def parts_of(pairs: Mapping[str, MeshPair]) -> dict[str, tuple[Part, ...]]:
    """What the studies of the teeth alone are asked of every group of meshes that are alike, by its name.

    Names of tasks begin with that of the group. None is needed: without it a mesh has its motion alone.
    """
    found: dict[str, tuple[Part, ...]] = {}
    for pair in pairs.values():
        if pair.group not in found:
            own = parts.parts(parts.request_of(pair.pressed), of_teeth=True)
            found[pair.group] = tuple(
                part._replace(
                    tasks=tuple(
                        task._replace(
                            name=f"{pair.group}-{task.name}",
                            about=f"mesh {pair.group}, {task.about}",
                            needed=False,
                        )
                        for task in part.tasks
                    )
                )
                for part in own
            )
    return found


def spectra_of(case: TrainAssessmentCase) -> dict[str, list[tuple[float, float, float]]]:
    """Of every mesh the duties of the load spectrum: share, driver's speed rad/s, torque N m; empty: none."""
    whole, spectra = case.whole, dict[str, list[tuple[float, float, float]]]()
    for share, at_duty in whole.duties(case.subject.case):
        for mesh in whole.meshes(at_duty):
            duty = mesh.pair.operating
            spectra.setdefault(mesh.name, []).append((share, duty.pinion_speed, duty.gear_torque))
    return spectra


def mesh_load_factor(case: TrainAssessmentCase, mesh: MeshAtDuty, own: Mapping[str, Any]) -> float:
    """K_γ of a mesh: given, or of its planetary stage in the simulation; 1 of others."""
    given = case.settings.mesh_load_factor
    if given is not None and mesh.stage:
        return given
    return float(own.get(STAGES, {}).get(mesh.stage, {}).get("mesh_load_factor", 1.0))


def assessed_mesh(
    case: TrainAssessmentCase,
    mesh: MeshAtDuty,
    pair: MeshPair | None,
    own: Mapping[str, Any],
    contact: tuple[tuple[Part, ...], Mapping[str, TaskResult]],
    record: Record,
) -> dict[str, Any]:
    """A mesh by the standards, where it has involutes of a tolerance class, beside its motion.

    `own` is the summary of the run at the duty, `record` its record; `contact` are the parts that were asked
    of the mesh, and what was done.
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
        return found
    shared = pair.rated.settings.model_copy(update={"mesh_load_factor": share})
    rated, pressed = (replace(one, settings=shared) for one in (pair.rated, pair.pressed))
    pressed = pressed if pair.turned else rated
    parts_done, done = contact
    along, quantities = _contact(pair.group, parts_done, done)
    quantities.setdefault("face_load_factor", 1.0)
    faces = parts.faces_of(pressed, quantities)
    face = float(quantities["face_load_factor"])
    standard = by_standard(rated, assembled(rated), face, faces, mesh.meshing)
    found["load_factors"]["K_Hbeta"] = shared.face_load_factor or face
    if standard.standard is not None:
        found |= _by_name(case, rated, standard)
        found["load_factors"] |= factors_by_name(standard.standard.factors)
    loads = case.whole.loads(record, case.subject.case, mesh.name) if along else None
    if loads is not None:
        of_both = quantities | {name: of_run[name] for name in _FOR_PAIR if of_run.get(name) is not None}
        names = found["driver"], found["driven"]
        beside = _beside(rated, pressed, standard, along, of_both, loads, names)
        found["simulated"] |= beside.pop("simulated")
        found |= beside
    return found


def _contact(
    group: str, every: Sequence[Part], done: Mapping[str, TaskResult]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Arrays along the path and quantities by the studies of a mesh; of one that failed there are none."""
    along, quantities = dict[str, Any](), dict[str, Any]()
    for part in every:
        results = {task.name.removeprefix(f"{group}-"): done[task.name] for task in part.tasks}
        first = results[next(iter(results))]
        if first.summary:
            found = part.role.answer(part.request, results)
            along |= found.along
            quantities |= found.quantities
    return along, quantities


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
    rated: AssessmentCase,
    pressed: AssessmentCase,
    by: ByStandard,
    along: Mapping[str, Any],
    quantities: Mapping[str, Any],
    loads: Any,
    names: Sequence[str],
) -> dict[str, Any]:
    """The simulation of a mesh beside its rating: from the contact of its teeth and their loads in motion."""
    turned = pressed is not rated
    if turned:
        loads = loads.seen_from_driven(float(rated.drive.pinion.teeth / rated.drive.gear.teeth))
        if by.capacity is not None:
            by = by._replace(capacity=by.capacity._replace(gears=by.capacity.gears[::-1]))
    places = along["roll_angle"]
    positions = round(float(assembled(pressed).pitch_angle) / float(places[1] - places[0]))
    mean = float(np.sum(along["normal_load"])) / positions
    loads = loads.of_load(mean, quantities["dynamic_factor"])
    outcome = concluded(pressed, along, quantities, loads._asdict(), rated=by)
    simulated = outcome.judged["margins"]["simulated"] | outcome.simulated
    simulated |= {name: quantities[name] for name in _OF_CONTACT if name in quantities}
    found = {"simulated": _other_sides(simulated) if turned else simulated}
    if outcome.parted:
        found["reasons"] = numbered(
            [_named(text, names[::-1] if turned else names) for text in outcome.parted]
        )
    return found


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
