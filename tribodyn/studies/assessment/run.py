"""From a case of an assessment to its record: what the other studies find, and the standards beside it."""

import tomllib
from collections.abc import Collection, Mapping
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.cases.assessment_part import Meshing, TaskResult
from tribodyn.cases.results import TextTable
from tribodyn.gears.check import sheet_tables, with_oil
from tribodyn.gears.plausibility import checks_gears
from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.bearings import bearing_part
from tribodyn.gears.rating.limits import judged, not_judged
from tribodyn.gears.rating.rating_text import COLUMNS, numbered, rating_rows
from tribodyn.gears.rating.spectrum import spectrum_tables
from tribodyn.gears.rating.strength import metal_remarks
from tribodyn.geometry.body import geometry_arrays
from tribodyn.post.verdict import outside
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.reader import MESHES
from tribodyn.record.trust import EXTRAPOLATED, INSIDE, OUTSIDE, REASONS, TRUST
from tribodyn.studies.assessment.case import AssessmentCase, RatedPair, layout_of
from tribodyn.studies.assessment.findings import GearboxFindings, MeshFindings, findings_of
from tribodyn.studies.assessment.parts import DUTY, AssessmentParts, assessment_parts, speeds_of
from tribodyn.studies.assessment.results.conclusion import by_standard
from tribodyn.studies.assessment.results.margins import LocalValues
from tribodyn.studies.assessment.results.meshes import (
    ConcludedMesh,
    concluded_mesh,
    worst_limits,
    worst_of,
    worst_samples,
)
from tribodyn.studies.assessment.results.over_speed import safeties_over_speed
from tribodyn.studies.assessment.results.scatter import put_in
from tribodyn.studies.assessment.text import assumed, extrapolated
from tribodyn.studies.drive_file import sheet_of
from tribodyn.studies.protocol import tasks
from tribodyn.studies.protocol.evaluated import scratch
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult

#: What is no number, or has the unit of what is compared; what ends the name of a scatter.
WITHOUT_UNIT, SPREAD_OF = ("limits", "limit_values", "samples"), "_spread"
#: Keys of a table that has values of one quantity.
_PARTS = {"worst", "median", "pinion"}


def check(case: AssessmentCase) -> CheckResult:
    """Check a case and what it asks of the other studies; say what gears and oil it describes."""
    requested = assessment_parts(case)
    tasks.require_cases(requested.tasks)
    names = [task.name for _, task in requested.tasks]
    if case.own is not None:
        checked = _check_pair(case.own)
        return checked._replace(data={**checked.data, "tasks": names})
    checked = case.gearbox.study.check(case.gearbox.case, allow_large=True)
    rated = {name: _rated(mesh.rated, mesh.mesh.meshing) for name, mesh in case.meshes.items()}
    shown = dict(zip((mesh.group for mesh in case.meshes.values()), rated.values(), strict=True))
    tables = [
        table._replace(title=f"{table.title}, {group}")
        for group, one in shown.items()
        for table in one.tables
    ]
    remarks = [remark for one in rated.values() for remark in one.remarks]
    return checked._replace(
        data={**checked.data, "tasks": names, "rating": {name: one.data for name, one in rated.items()}},
        remarks=(*checked.remarks, *dict.fromkeys(remarks)),
        details=(*checked.details, *tables),
    )


@checks_gears
def _check_pair(case: RatedPair) -> CheckResult:
    """Check a pair of gears, and rate it by the standards."""
    sheet = sheet_of(tomllib.loads(case.toml)["drive"], assembled(case))
    result = with_oil(CheckResult({"geometry": sheet}, sheet_tables(sheet)), case.lubricant)
    rated = _rated(case)
    return result._replace(
        data={**result.data, **rated.data},
        tables=(*result.tables, *rated.tables),
        remarks=(*result.remarks, *rated.remarks),
    )


def _rated(case: RatedPair, meshing: tuple[Meshing, Meshing] = (Meshing(), Meshing())) -> CheckResult:
    """What the standards say of a pair of gears before its contact is analysed; nothing of other teeth."""
    by = by_standard(case, assembled(case), 1.0, meshing=meshing)
    if not by.iso:
        return CheckResult({}, ())
    data = by.summary(case)
    face = "given" if case.settings.face_load_factor else "1, until the contact is analysed"
    titles = {"iso": "ISO 6336, K_Hβ", "agma": "AGMA 2101, K_H"}
    tables = [
        TextTable(f"{title} {face}", COLUMNS, rating_rows(data[part]))
        for part, title in titles.items()
        if part in data
    ]
    outside_of = by.capacity.remarks if by.capacity else ()
    spectrum = spectrum_tables(data.get("spectrum", {}))
    return CheckResult(data, (*tables, *spectrum), (*metal_remarks(case), *outside_of))


def run(
    case: AssessmentCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `study.Study.run`.

    The parts lie in a folder beside the record and are run again only if their scenarios or the code changed.
    """
    more: dict[str, Any] = {}
    if case.own is not None:
        more["groups"] = {"geometry": geometry_arrays(assembled(case.own))}
        more["scales"] = {"input_speed": np.array(speeds_of(case.settings, case.speed))}

    def concluded(folder: Path, progress: Progress | None, force: bool) -> tasks.Concluded:
        local, over_speed, summary = assessed(case, folder, progress, force)
        if local is None:
            return tasks.Concluded(over_speed, summary)
        names = [name for name in over_speed if name != "input_speed"]
        rows = [{name: over_speed[name][row] for name in names} for row in range(len(over_speed[names[0]]))]
        return tasks.Concluded(_along_path(local), summary, rows)

    layout = layout_of(case)
    return tasks.recorded(case, output, layout, concluded, force=force, progress=progress, **more)


def quantities_of(case: AssessmentCase) -> dict[str, Any]:
    """Quantities of a case without a record; see `scratch` for its parts."""
    with scratch() as folder:
        return assessed(case, folder)[2]


def assessed(
    case: AssessmentCase, folder: Path, progress: Progress | None = None, force: bool = False
) -> tuple[LocalValues | None, dict[str, np.ndarray], dict[str, Any]]:
    """Run the parts into a folder and put them together: along the path, over the speed, and the summary.

    Values along the path are of a pair of gears alone. Raises InputError or SimulationError if a part that is
    needed cannot be run; see also `tasks.results`.
    """
    begun = perf_counter()
    requested = assessment_parts(case)
    done = tasks.results(requested.tasks, folder, progress, force=force)
    found = findings_of(case, requested, done)
    meshes = {name: concluded_mesh(mesh, case.limits, requested.draws) for name, mesh in found.meshes.items()}
    summaries = {name: mesh.summary for name, mesh in meshes.items()}
    gearbox = dict(summaries[""]) if case.own else _gearbox(case, found, summaries)
    summary = {
        **found.quantities,
        **gearbox,
        **_losses(case, found.run, done),
        **bearing_part(case.shafts, case.oil),
        "not_judged": not_judged(case.limits, case.oil.fzg),
        "in_doubt": numbered([*_in_doubt(found.run), *_engaged(found.run), *_too_short(found.meshes)]),
    }
    scattered = [mesh for mesh in meshes.values() if mesh.samples is not None]
    if scattered:
        own = scattered[0].samples if case.own else None
        samples = own or worst_samples(requested.draws, found.rows, [*meshes.values()])
        summary = put_in(summary, samples)
    varied = requested.varied if scattered else ""
    summary |= {
        "assumed": numbered([*assumed(case, summaries, varied)]),
        "extrapolated": numbered([*extrapolated(requested.tasks, done), *_outside(summaries)]),
        **_trust(done, requested),
        "wall_time": perf_counter() - begun,
    }
    summary = _told(summary)
    local = meshes[""].outcome.local if case.own and meshes[""].outcome else None
    return local, _over_speed(found, meshes, case.speed), summary | {"units": units_of(summary)}


def _told(summary: Mapping[str, Any]) -> dict[str, Any]:
    """A summary without what says nothing."""
    kept = {name: value for name, value in summary.items() if value not in ({}, [], "")}
    if MESHES in kept:
        kept[MESHES] = {name: _told(mesh) for name, mesh in kept[MESHES].items()}
    return kept


def _gearbox(
    case: AssessmentCase, found: GearboxFindings, meshes: Mapping[str, Mapping[str, Any]]
) -> dict[str, Any]:
    """What a gearbox has of its meshes."""
    limits = worst_limits([mesh.get("limits", {}) for mesh in meshes.values()])
    at_duty = {"mesh_load_factor": found.quantities.get("mesh_load_factor", np.nan)}
    limits |= judged({name: case.limits.get(name) for name in at_duty}, at_duty)
    known = found.over_speed["mesh_load_factor"]
    highest = {"mesh_load_factor_max": float(np.nanmax(known))} if np.any(np.isfinite(known)) else {}
    return {**highest, **worst_of(meshes), MESHES: dict(meshes), "limits": limits}


def _over_speed(
    found: GearboxFindings, meshes: Mapping[str, ConcludedMesh], speed: float
) -> dict[str, np.ndarray]:
    """What is recorded over the speed, with the smallest safeties of the simulation."""
    curves = dict(found.over_speed)
    for name, mesh in found.meshes.items():
        pressed, speeds = meshes[name].pressed, curves["input_speed"]
        if pressed is None:
            continue
        of_mesh = safeties_over_speed(pressed, mesh.along, mesh.quantities, mesh.over_speed, speeds, speed)
        for safety, values in of_mesh.items():
            curves[safety] = np.fmin(curves[safety], values)
    return curves


def _losses(case: AssessmentCase, run: Mapping[str, Any], done: Mapping[str, TaskResult]) -> dict[str, Any]:
    """Losses of a gearbox by its own friction law and by the others that were asked for."""
    if not run:
        return {}
    first = str(next(iter(run[MESHES].values())).get("friction_law", "own"))
    runs = {first: run} | {law: done[f"friction-{law}"].summary for law in case.settings.friction_laws}
    runs = {law: summary for law, summary in runs.items() if summary}
    if len(runs) < 2:
        return {}
    efficiencies = [float(summary["efficiency"]) for summary in runs.values()]
    return {
        "loss_by_law": {law: float(summary["power_friction_mean"]) for law, summary in runs.items()},
        "efficiency_lowest": min(efficiencies),
        "efficiency_highest": max(efficiencies),
    }


def _in_doubt(run: Mapping[str, Any]) -> list[str]:
    """Which meshes have film or friction that the solved contact puts in doubt, as the run says."""
    meshes_by_line: dict[str, list[str]] = {}
    for name, mesh in run.get(MESHES, {}).items():
        for line in outside(mesh):
            if "in doubt" in line:
                meshes_by_line.setdefault(line, []).append(name)
    return [f"Mesh {', '.join(names)}: {line[0].lower()}{line[1:]}" for line, names in meshes_by_line.items()]


def _engaged(run: Mapping[str, Any]) -> list[str]:
    """That K_v is, or may be, how pairs engage by the energy method, as the run says."""
    return [f"Simulated K_v and safeties: {run[name]}" for name in ("engagement_remark",) if run.get(name)]


def _too_short(meshes: Mapping[str, MeshFindings]) -> list[str]:
    """Which meshes have no simulated strength, as the run at the duty holds no whole cycle of theirs."""
    short = [name for name, mesh in meshes.items() if mesh.rated and mesh.along and not mesh.loads]
    what = "no whole cycle of it was run, so no S_H and S_F are simulated; raise solver.cycles"
    return [f"Mesh {', '.join(short)}: {what}."] if any(short) else []


def _outside(meshes: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """What of the meshes lies outside the limits of the standards."""
    return [
        f"Mesh {name}: {text}" if name else text
        for name, mesh in meshes.items()
        for text in mesh.get("outside", {}).values()
    ]


def units_of(summary: Mapping[str, Any]) -> dict[str, str]:
    """SI unit of every number of a summary by its name, for programs that read them.

    A value by points, a scatter and a table of values have the unit of the name that they stand under.
    """
    units: dict[str, str] = {}
    for name, value in summary.items():
        quantity = QUANTITIES.get(name.removesuffix(SPREAD_OF).rpartition(".")[2])
        if name in WITHOUT_UNIT:
            continue
        if quantity is None and isinstance(value, Mapping):
            units |= units_of(value) if not _PARTS & set(value) else {name: "1"}
        elif not isinstance(value, str | bool):
            units[name] = quantity.si if quantity else "1"
    return dict(sorted(units.items()))


def _along_path(local: LocalValues) -> dict[str, Any]:
    films = local.films
    return {
        "roll_angle": local.roll_angle,
        "normal_load": local.normal_load,
        "hertz_pressure": films.pressure,
        "equivalent_radius": local.radius,
        "sliding_speed": local.sliding,
        "flash_temperature_rise": films.flash_rise,
        "contact_temperature": films.bulk_temperature + films.flash_rise,
        "film_thickness": films.film_thickness,
        "specific_film": films.specific_film,
    }


def _trust(done: Mapping[str, TaskResult], requested: AssessmentParts) -> dict[str, Any]:
    """Outside the model where any part is; laws extrapolated where those of a needed one are.

    Of a gearbox as its run at the duty.
    """
    if requested.runs:
        return {name: done[DUTY].summary[name] for name in (TRUST, REASONS) if done[DUTY].summary.get(name)}
    needed: Collection[str] = {task.name for _, task in requested.tasks if task.needed}
    parts = {name: result.summary for name, result in done.items() if TRUST in result.summary}
    for verdict, parts_of in ((OUTSIDE, parts), (EXTRAPOLATED, needed)):
        reasons: dict[str, Any] = {}
        judged_so = [part for name, part in parts.items() if part[TRUST] == verdict and name in parts_of]
        for part in judged_so:
            reasons |= part[REASONS]
        if judged_so:
            return {TRUST: verdict, REASONS: reasons}
    return {TRUST: INSIDE} if parts else {}
