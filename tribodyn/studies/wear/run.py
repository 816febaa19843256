"""From a case of the wear study to its record and worn profiles; a run goes on from what another left."""

import hashlib
import tomllib
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from time import perf_counter
from types import FunctionType
from typing import Any

import numpy as np

from tribodyn.cases.results import left_over, record_path, target, writer
from tribodyn.compliance.sharing.flank_gap import check_modifications
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import check_contact
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.check import check_on_elements, oil_data
from tribodyn.gears.plausibility import checks_gears
from tribodyn.gears.prepare import assembled
from tribodyn.geometry.body import geometry_arrays
from tribodyn.kernels.native.arguments import function_layout
from tribodyn.mesh.record_arrays import untabulated
from tribodyn.mesh.tabulate_loaded import flanks_of
from tribodyn.mesh.teeth.fields import LEADING, TRAILING
from tribodyn.mesh.teeth.table import flank_places
from tribodyn.numerics.files.output_files import WRITTEN, check_output, write_output
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.numerics.registry import FROM_PYTHON
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.reader import Record
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult
from tribodyn.studies.wear.case import BODIES, WearCase, layout_of, recorded_at
from tribodyn.studies.wear.outcome import row_of, state_of, summary_of
from tribodyn.studies.wear.passage import Depths, Wearing, WearPassage, march, passage, unworn
from tribodyn.studies.wear.pressed_positions import places_of
from tribodyn.tribology.closure import laws_of
from tribodyn.tribology.wear import wear_law_of


def profile_path(record: Path, body: str) -> Path:
    """Name of the file with the worn profile of a gear, beside its record."""
    return record.with_name(f"{record.stem}-{body}.csv")


def write_profiles(study: Wearing, row: dict[str, Any], record: Path, force: bool = False) -> list[Path]:
    """Write what is worn off both gears, the mean over teeth and face, with the profile error that they had.

    Tables of depth (m) over roll angle (rad) with a comment before them. Raises as `write_output`.
    """
    roll, files = study.places.node, []
    for body, depth in zip(BODIES, row["worn_depth"], strict=True):
        profile_error = getattr(study.case.mesh.modifications, body).profile_error
        total = np.mean(depth, axis=-1)
        if profile_error is not None:
            total = total + np.interp(roll, *profile_error)
        about = f"profile error of the {body} after {float(row['revolutions']):g} revolutions of the pinion"
        columns = np.degrees(roll).tolist(), (1e6 * total).tolist()
        lines = [f"{angle!r},{worn!r}" for angle, worn in zip(*columns, strict=True)]
        head = f"{WRITTEN['.csv'].decode()}: {about}", "roll_angle [deg],error [um]"
        files.append(write_output(profile_path(record, body), "\n".join([*head, *lines, ""]), force=force))
    return files


#: Keys in which the scenario of a run that goes on may differ from that of the record.
_MAY_DIFFER = (("wear", "revolutions"), ("output", "every"))


def prepare(case: WearCase) -> Wearing:
    """Check geometry, modifications and load, and lay out positions and nodes; raises InputError."""
    assembly = assembled(case)
    check_modifications(assembly, case.mesh.modifications)
    flanks = flanks_of(assembly, case.materials, case.mesh)
    check_contact(flanks, case.operating.gear_torque)
    law = wear_law_of(case.wear)
    places = places_of(flanks, case.operating.gear_torque, case.positions_per_cycle, case.mesh.early)
    gaps = own_gaps(flanks, places.node, case) if any(case.teeth) else None
    return Wearing(case, places, law, law.made(None, dict(case.wear.values)), gaps)


def own_gaps(flanks: LoadedFlanks, node: Float[Array, " node"], case: WearCase) -> Depths:
    """What is missing at the nodes of every tooth from the beginning, m, pitch errors apart."""
    of_gears = []
    faces = flank_places(flanks.flexible.assembly, node, np.asarray(flanks.face()))
    for deviations, flank, at, count in zip(case.teeth, (LEADING, TRAILING), faces, case.counts, strict=True):
        gaps = np.zeros((count, len(node), flanks.slices))
        for tooth in range(count):
            for each in deviations:
                if (more := each.fields(tooth, flank, at)) is not None:
                    gaps[tooth] += more.gap.T
        of_gears.append(gaps)
    return of_gears[0], of_gears[1]


@checks_gears
def check(case: WearCase) -> CheckResult:
    """Check a case, and say what gears it describes, how stiff they are, and by which law they wear."""
    study = prepare(case)
    checked = check_on_elements(case, study.places.held.flanks.flexible)
    wear = {"law": study.law.name, **study.parameters._asdict()}
    return checked._replace(data={**checked.data, "wear": wear})


def run(
    case: WearCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
    resume: bool = False,
    client: Any = None,
) -> RunResult:
    """Run a case and write its record, and the worn profiles beside it; see `study.Study.run`.

    With `resume` it goes on from the record of a run of the same scenario with fewer revolutions, which it
    then replaces, or from what an interrupted run left.
    """
    path = record_path(case, output)
    before = _recorded(case, path) if resume and not force else {}
    for body in BODIES:
        check_output(profile_path(path, body), force)
    target(case, path, force, resumed=bool(before))
    begun, at = perf_counter(), None
    study = prepare(case)
    done = len(before.get("revolutions", ()))
    ends = (0, -1) if done else ()  # a run may have been stopped before its first row
    first, row = [{name: values[end] for name, values in before.items()} for end in ends] or ({}, {})
    rows = recorded_at(case, float(row["revolutions"])) if done else recorded_at(case)
    start = state_of(study, row) if done else unworn(study)
    how: dict[str, Any] = {"force": force or bool(before), "code": _code_of(case), **_beside(study)}
    with writer(case, path, layout_of(case), done + len(rows), **how) as record:
        if done:
            record.write(0, before)
        try:
            # of what is recorded already, where no row is left
            at = passage(study, start.depths, start.revolutions) if done else None
            for state, at in march(study, start, rows):
                block = row_of(study, state, at)
                record.write(record.written, block)
                row = {name: values[0] for name, values in block.items()}
                first = first or row
                if progress:
                    progress(state.revolutions / case.revolutions)
        except SimulationError as error:
            summary = _summary(study, first, row, at, begun)
            return RunResult(record.fail(error.reason, summary), "failed", error.reason, summary)
        summary = _summary(study, first, row, at, begun)
        summary["files"] = dict(zip(BODIES, map(str, write_profiles(study, row, path, force)), strict=True))
        return RunResult(record.finish(summary), "complete", "", summary)


def quantities_of(case: WearCase) -> dict[str, Any]:
    """Quantities of a case without a record; raises InputError or SimulationError."""
    study, begun = prepare(case), perf_counter()
    every = list(march(study, unworn(study), recorded_at(case)))
    ends = [{name: values[0] for name, values in row_of(study, *every[i]).items()} for i in (0, -1)]
    return _summary(study, ends[0], ends[1], every[-1][1], begun)


def _summary(
    study: Wearing, first: Mapping[str, Any], last: Mapping[str, Any], at: WearPassage | None, begun: float
) -> dict[str, Any]:
    if at is None:
        return {"wall_time": perf_counter() - begun}
    summary = summary_of(study, dict(first), dict(last), at)
    oil = {} if study.case.lubricated is None else {"lubricant": oil_data(study.case.lubricated.lubricant)}
    return summary | oil | {"wall_time": perf_counter() - begun}


def _beside(study: Wearing) -> dict[str, Any]:
    """Scales and groups of a record."""
    case, places, flexible = study.case, study.places, study.places.held.flanks.flexible
    pinion, gear = case.counts
    scales = {
        "body": np.array(BODIES),
        "roll": places.node,
        "slice": np.asarray(places.held.flanks.face()),
        "cycle": np.arange(case.cycles),
        "phase": places.phase,
    }
    if case.each_tooth:
        scales |= {"pinion_tooth": np.arange(pinion), "gear_tooth": np.arange(gear)}
    numbers = untabulated(flexible.assembly, flexible.width)
    groups = {"mesh_cycle": numbers, "geometry": geometry_arrays(flexible.assembly)}
    return {"groups": groups, "scales": scales}


def _recorded(case: WearCase, path: Path) -> dict[str, np.ndarray]:
    """Rows of the run that this one goes on from, all its datasets; none where there is no such run.

    Raises InputError if there is one of another scenario or of other code, or one that is longer.
    """

    def same(record: Record) -> bool:
        if _kept(record.attrs["scenario"]) != _kept(case.toml):
            return False
        if not all(map(_is_recognised, _functions_of(case))):
            rule = "a law depends on data of which nobody knows whether they are still the same"
            remedy = "move it away, or --force to begin anew"
            raise InputError("--resume", str(record.path), rule, remedy)
        return True

    with left_over(case, path, same, _code_of(case), complete=True) as record:
        if record is None:
            return {}
        rows, whole = {name: record[name] for name in record}, record.path == path
    done = float(rows["revolutions"][-1]) if len(rows["revolutions"]) else 0.0
    if whole and done >= case.revolutions:
        rule = f"the record reaches {done:g} revolutions already"
        raise InputError("wear.revolutions", f"{case.revolutions:g}", rule, "write a larger number")
    return {name: values[rows["revolutions"] <= case.revolutions] for name, values in rows.items()}


def _functions_of(case: WearCase) -> list[Callable[..., Any]]:
    """The functions of laws from outside this package: from Python, or from installed packages."""
    oiled, ours = case.lubricated, __name__.partition(".")[0] + "."
    laws = (wear_law_of(case.wear), *(() if oiled is None else laws_of(oiled)))
    outside = [
        law
        for law in laws
        if law.name.startswith(FROM_PYTHON) or not law.function.__module__.startswith(ours)
    ]
    return [part for law in outside for part in (*law.functions, law.parameters) if part is not None]


def _is_recognised(function: Callable[..., Any]) -> bool:
    """Whether a digest tells a function with all that it refers to from any other."""
    return isinstance(function, FunctionType) and function_layout(function).kept


def _code_of(case: WearCase) -> str:
    """Digest of the code that computes a case, laws from outside and what they refer to included."""
    layouts = [function_layout(part).identity for part in _functions_of(case) if _is_recognised(part)]
    return hashlib.sha256(repr((computing_digest(), layouts)).encode()).hexdigest()


def _kept(toml: str) -> dict[str, Any]:
    """A scenario without the keys that a run which goes on may change, and without its names."""
    data = tomllib.loads(toml)
    for table, key in _MAY_DIFFER:
        with suppress(KeyError):
            del data[table][key]
    return {key: value for key, value in data.items() if key not in ("title", "name")}
