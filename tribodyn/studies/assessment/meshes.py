"""The meshes of the gearbox of a scenario as pairs of gears."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import tomli_w

from tribodyn.cases.assessment_part import MeshAtDuty
from tribodyn.errors import InputError
from tribodyn.gears.case import OiledCase
from tribodyn.geometry.modification import Misalignment
from tribodyn.input.resolve import resolve_table
from tribodyn.studies.assessment.case import AssessmentCase, RatedMesh
from tribodyn.studies.assessment.pair_file import KIND, AssessmentMesh, AssessmentScenario, rated_pair
from tribodyn.studies.assessment.settings import AssessmentTable


def meshes_of(case: AssessmentCase) -> dict[str, RatedMesh]:
    """Every mesh with teeth whose driver drives, by name."""
    whole, subject = case.whole, case.gearbox.case
    spectra, found = spectra_of(case), dict[str, RatedMesh]()
    for mesh in whole.meshes(subject):
        if mesh.pair.operating.gear_torque > 0.0:
            try:
                tables = whole.pair(subject, mesh.name)
            except InputError:  # of a bare model
                continue
            found[mesh.name] = _pair_of(case, mesh, tables, spectra.get(mesh.name, ()))
    return found


def _pair_of(
    case: AssessmentCase,
    mesh: MeshAtDuty,
    tables: Mapping[str, Any],
    spectrum: Sequence[tuple[float, float, float]],
) -> RatedMesh:
    pair = mesh.pair
    drive, duty = tables["drive"], pair.operating
    teeth = float(pair.drive.pinion.teeth), float(pair.drive.gear.teeth)
    speed, torque, ratio = duty.pinion_speed, duty.gear_torque, 1.0
    if teeth[0] < 0.0:
        ratio = abs(teeth[0] / teeth[1])
    title = f"{case.title}: {mesh.name}"
    data = {
        "title": title,
        "kind": KIND,
        "drive": drive,
        "lubricant": tables["lubricant"],
        "operating": {
            **tables["operating"],
            "pinion_speed": f"{speed * ratio!r} rad/s",
            "gear_torque": f"{torque * ratio!r} N*m",
        },
        "mesh": _face(mesh, tables["mesh"], ratio != 1.0),
    }
    data, *_ = resolve_table(data, Path(f"{mesh.name}.toml"), {}, lambda _: AssessmentScenario)
    toml = tomli_w.dumps(data)
    digest = hashlib.sha256(toml.encode()).hexdigest()
    pressed = rated_pair(AssessmentScenario.model_validate(data), toml, digest)
    settings = _settings(case, mesh)
    stretched = tuple((share, fast * ratio, load * ratio) for share, fast, load in spectrum)
    pressed = replace(pressed, settings=settings, limits=case.limits, spectrum=stretched)
    if ratio == 1.0:
        return RatedMesh(mesh, pressed, pressed)
    own = {field.name: getattr(pair, field.name) for field in fields(OiledCase)}
    kept = {name: getattr(pressed, name) for name in ("title", "name", "kind", "toml", "sha256")}
    return RatedMesh(mesh, replace(pressed, **{**own, **kept}, spectrum=tuple(spectrum)), pressed)


def _face(mesh: MeshAtDuty, table: Mapping[str, Any], mirrored: bool) -> dict[str, Any]:
    """Slices of the face, and how the axes stand, drawn shafts, matrices and planets on pins included.

    Of spur pairs with a ring nothing. A mesh whose ring drives is rated as if the planet did on the same
    flanks, `mirrored`: seen from the other end of the face.
    """
    drive, stand = mesh.pair.drive, mesh.pair.supports.misalignment
    if min(float(drive.pinion.teeth), float(drive.gear.teeth)) < 0.0 and not drive.helix_angle:
        return {}
    if mirrored:
        stand = Misalignment(-stand.in_plane, -stand.out_of_plane)
    found = {name: table[name] for name in ("slices", "misalignment") if name in table}
    if any(stand):
        given = AssessmentMesh.model_validate(found).misalignment
        angles = {name: getattr(given, name) + getattr(stand, name) for name in stand._fields}
        found["misalignment"] = {
            **found.get("misalignment", {}),
            **{name: f"{angle!r} rad" for name, angle in angles.items()},
        }
    return found


def _settings(case: AssessmentCase, mesh: MeshAtDuty) -> AssessmentTable:
    """What is asked of a mesh: what is asked of all, with its own factors."""
    names = set(AssessmentTable.model_fields) & set(type(case.settings).model_fields)
    own = {name: getattr(case.settings, name) for name in names}
    own |= {
        "face_load_factor": case.settings.face_of(mesh.name),
        "mesh_load_factor": case.settings.mesh_load_factor if mesh.stage else None,
        "friction_laws": (str(mesh.pair.friction.law),),
        "samples": 0,  # they are drawn of the train
    }
    return AssessmentTable.model_construct(**own)


def spectra_of(case: AssessmentCase) -> dict[str, list[tuple[float, float, float]]]:
    """Of every mesh the duties of the load spectrum: share, driver's speed rad/s, torque N m; empty: none."""
    whole, spectra = case.whole, dict[str, list[tuple[float, float, float]]]()
    for share, at_duty in whole.duties(case.gearbox.case):
        for mesh in whole.meshes(at_duty):
            duty = mesh.pair.operating
            spectra.setdefault(mesh.name, []).append((share, duty.pinion_speed, duty.gear_torque))
    return spectra
