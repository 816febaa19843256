"""The meshes of an assessed train as pairs of gears, and what the studies are asked of their teeth."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any, NamedTuple

import tomli_w

from tribodyn.cases.assessment_part import TEETH, MeshAtDuty
from tribodyn.errors import InputError
from tribodyn.gears.case import OiledCase
from tribodyn.input.resolve import resolve_table
from tribodyn.studies.assessment.pair import parts
from tribodyn.studies.assessment.pair import scenario as of_pair
from tribodyn.studies.assessment.pair.case import AssessmentCase, AssessmentTable
from tribodyn.studies.assessment.pair.parts import Part
from tribodyn.studies.assessment.train.case import TrainAssessmentCase
from tribodyn.studies.assessment.unknowns import Draw


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
        "samples": 0,  # they are drawn of the train
    }
    return AssessmentTable.model_construct(**own)


def parts_of(pairs: Mapping[str, MeshPair], draws: Sequence[Draw]) -> dict[str, tuple[Part, ...]]:
    """What the studies of the teeth alone are asked of every group of meshes that are alike, by its name.

    Names of tasks begin with that of the group. None is needed: without it a mesh has its motion alone.
    """
    found: dict[str, tuple[Part, ...]] = {}
    for pair in pairs.values():
        if pair.group not in found:
            samples = tuple(draw.of_teeth(pair.mesh.distance) for draw in draws)
            request = parts.request_of(pair.pressed)._replace(samples=samples)
            own = parts.parts(request, (TEETH,))
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
