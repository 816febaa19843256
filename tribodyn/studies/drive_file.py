"""A gear pair without a scenario: from a drive file, or from any scenario, to what its geometry needs.

A pair of any family is turned into a drive file of the family `spline`, from which a search can set out.
"""

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from pydantic import ValidationError

from tribodyn.errors import InputError, InputErrors, quoted, unknown_name
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import body_masses
from tribodyn.geometry.drive import SIDES, BodyMass, Drive, MaterialData, Side, body_of, internal_side
from tribodyn.geometry.families import family
from tribodyn.geometry.families.spline import FEWEST, MOST, fit_spline, flank_deviation
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.input.messages import Origins, explain
from tribodyn.input.quantity import Table
from tribodyn.input.resolve import OVERRIDES, resolve_table, unresolved_keys
from tribodyn.input.sources import find_drive_or_scenario, read_toml
from tribodyn.input.tables.gears.drive_data import drive_of, masses_of, materials_of, rounded_distance_of
from tribodyn.input.tables.gears.drive_rules import broken_drive_rules
from tribodyn.input.tables.gears.model_files import DriveTable
from tribodyn.input.tables.gears.quality import tolerance_lines
from tribodyn.input.tables.gears.tooth_data import THICKNESS_KEYS, gauge_of
from tribodyn.standards.allowances import centre_distance_allowance
from tribodyn.studies.protocol.load import load


class DriveModel(NamedTuple):
    """A gear pair as it stands in a drive file."""

    #: title, name: title of the drive or scenario, and its name
    title: str
    name: str
    family: str  # name of the family of paths of contact
    drive: Drive
    materials: tuple[MaterialData, MaterialData]
    masses: tuple[BodyMass, BodyMass]  # None where they follow from the outline
    path: Path  # the file that was named
    origins: Origins  # which file each part came from; the drive stands at the key "drive"
    table: Mapping[str, Any]  # the drive as a drive file has it, with everything that it refers to

    def sheet(self, assembly: Assembly) -> dict[str, Any]:
        """The geometry sheet: name to (value, unit), of pinion and gear in tables of their own."""
        specified = [(body.mass, body.inertia) for body in self.masses]
        masses = body_masses(assembly, specified, [material.density for material in self.materials])
        rounded = rounded_distance_of(self.table)
        return sheet_of(self.table, assembly, masses) | (rounded.lines() if rounded else {})


def sheet_of(
    table: Mapping[str, Any], assembly: Assembly, masses: Sequence[tuple[float, float]] | None = None
) -> dict[str, Any]:
    """The geometry sheet with the limits and tolerances that a drive file's data give."""
    drive = DriveTable.model_validate(table)
    distance = abs(float(assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius))
    grade = drive.centre_distance_grade
    apart = 0.0 if grade is None else centre_distance_allowance(grade, distance)
    gauges = gauge_of(drive, drive.pinion), gauge_of(drive, drive.gear)
    sheet = geometry_sheet(assembly, masses, gauges, distance_allowance=apart)
    for side, lines in zip(SIDES, tolerance_lines(drive), strict=True):
        sheet[side] |= lines
    return sheet


class _DriveAlone(Table):
    drive: DriveTable


def load_drive(
    model: str | Mapping[str, Any], overrides: Mapping[str, Any] | None = None, mesh: str | None = None
) -> DriveModel:
    """Read the gear pair of a drive file or of a scenario.

    `model` is the name of a shipped drive or scenario, the path of a file of either sort, or what a drive
    file holds; `overrides` are dotted keys, as in a scenario, to values: ``{"drive.pinion.profile_shift":
    "0.3"}``; of a train `mesh` names the mesh whose gears are meant. Raises InputError if there is no such
    file, or it describes no pair of gears or is wrong.
    """
    if isinstance(model, Mapping):
        _refuse(mesh)
        return _of_table(dict(model), Path("drive"), overrides or {})
    path = find_drive_or_scenario(model)
    written = read_toml(path)
    if "drive" in written or "kind" in written:
        return _of_scenario(path, overrides or {}, mesh)
    _refuse(mesh)
    return _of_table(written, path, overrides or {})


def load_gear(
    model: str | Mapping[str, Any], overrides: Mapping[str, Any] | None = None, gear: str = ""
) -> dict[str, tuple[DriveModel, Side]]:
    """The pairs in which a gear is, and what it is in them: of a train by the name of the mesh.

    Of a pair the gear is its pinion or its gear, and the mesh has no name. Meshes that differ by their planet
    alone are there once. Arguments and errors as of `load_drive`, and where there is no such gear.
    """
    if not isinstance(model, Mapping) and "kind" in read_toml(path := find_drive_or_scenario(model)):
        case, study, *_ = load(path, overrides or {})
        if (whole := study.whole()) is not None:
            return {
                mesh: (_of_table(whole.pair(case, mesh)["drive"], path, {}), side)
                for mesh, side in whole.gear(case, gear).items()
            }
    pair = load_drive(model, overrides)
    if gear not in SIDES:
        raise unknown_name("gear", gear, SIDES, "gear")
    return {"": (pair, gear)}


def _of_table(written: dict[str, Any], path: Path, overrides: Mapping[str, Any]) -> DriveModel:
    for key, value in overrides.items():
        if key.partition(".")[0] != "drive":
            rule, remedy = "is no key of a drive", 'begin with drive, as in "drive.pinion.profile_shift"'
            raise InputError(key, quoted(value), rule, remedy, OVERRIDES)
    data, origins, unresolved = resolve_table({"drive": written}, path, overrides, lambda _: _DriveAlone)
    try:
        table = _DriveAlone.model_validate({"drive": data["drive"]}).drive
    except ValidationError as error:
        if "family" not in written:
            raise _no_pair(path, "not a pair of gears: it names no family of paths of contact") from None
        unresolved_names = unresolved_keys(unresolved)
        mistakes = [mistake for mistake in explain(error, _DriveAlone) if mistake.key not in unresolved_names]
        raise InputErrors([origins.locate(mistake) for mistake in (*unresolved, *mistakes)]) from None
    errors = [*unresolved, *broken_drive_rules(table)]
    if errors:
        raise InputErrors([origins.locate(mistake) for mistake in errors])
    return DriveModel(
        table.title,
        path.stem,
        table.family,
        drive_of(table),
        materials_of(table),
        masses_of(table),
        path,
        origins,
        data["drive"],
    )


def _refuse(mesh: str | None) -> None:
    """Refuse a mesh of what has but one."""
    if mesh is not None:
        raise InputError("mesh", quoted(mesh), "is of trains: a pair of gears has one mesh", "omit it")


def _of_scenario(path: Path, overrides: Mapping[str, Any], mesh: str | None) -> DriveModel:
    case, study, _, origins = load(path, overrides)
    if not study.has_gears:
        if (whole := study.whole()) is None:
            raise _no_pair(path, f"not a pair of gears, but {study.about}")
        return _of_table(whole.pair(case, mesh or "")["drive"], path, {})
    _refuse(mesh)
    # a quasi-static study needs no masses
    pair = case.pair
    masses = getattr(pair, "masses", (BodyMass(), BodyMass()))
    table = tomllib.loads(case.toml)["drive"]
    return DriveModel(
        case.title, case.name, pair.family, pair.drive, pair.materials, masses, path, origins, table
    )


def _no_pair(path: Path, rule: str) -> InputError:
    return InputError("model", quoted(path.stem), rule, "run a scenario of it instead: tribodyn run")


_OF_BODY = ("profile_shift", "addendum", "dedendum", "fillet_radius")
#: Keys whose place those of the body, and the path, take.
_OF_PATH = ("pressure_angle", "shape", "rack", "centre_distance", "centre_distance_grade")
_OF_TEETH = ("tip_radius", "tip_diameter", "tip_rounding", *THICKNESS_KEYS)


class SplineDrive(NamedTuple):
    """What a drive file of the fitted pair holds, and its maximum distance (m) from the original's flanks."""

    table: dict[str, Any]
    deviation: float


def as_spline(model: DriveModel, values: int, key: str = "n") -> SplineDrive:
    """Fit a free-form path of so many angles to that of a pair of any family that passes the checks.

    `key` is what messages call their number. Raises InputError for too few or too many, gears that cannot be
    made, and a fit of which none can be made.
    """
    if (side := internal_side(model.drive)) is not None:
        rule = "an internal gear has no free-form path"
        raise InputError(f"drive.{side}.internal", "true", rule, "fit the path of an external pair")
    if not FEWEST <= values <= MOST:
        raise InputError(key, values, f"a path has {FEWEST} to {MOST} values", "use 9")
    with model.origins.naming():
        assembly = check(family(model.family), model.drive)
    fitted = fit_spline(assembly, values)
    deviation = flank_deviation(assembly, fitted)
    drive, shape = fitted.drive, fitted.drive.shape
    table = {name: value for name, value in model.table.items() if name not in _OF_PATH}
    table |= {
        "title": f"{model.table['title']}, as a free-form path",
        "source": f"{values} values fitted to the path of contact; flanks within {1e6 * deviation:.2g} um. "
        f"Of the original: {model.table['source']}",
        "family": "spline",
        "module": f"{1e3 * drive.module:.12g} mm",
    }
    if drive.helix_angle:
        table["helix_angle"] = f"{np.degrees(abs(drive.helix_angle)):.12g} deg"
    table["shape"] = {
        "angles": [f"{angle:.10g} deg" for angle in np.degrees(shape.angles)],
        "knots": [f"{knot:.10g} mm" for knot in 1e3 * shape.knots],
        "corner": f"{np.degrees(shape.corner):.10g} deg",
    }
    for side in SIDES:
        body = body_of(drive, side)
        kept = {name: value for name, value in table[side].items() if name not in _OF_TEETH}
        table[side] = kept | {name: float(f"{getattr(body, name):.12g}") for name in _OF_BODY}
        if body.thickness_allowance:
            table[side]["thickness_allowance"] = f"{1e6 * body.thickness_allowance:.10g} um"
    check(fitted.family, drive)
    return SplineDrive(table, deviation)
