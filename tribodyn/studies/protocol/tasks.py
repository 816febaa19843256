"""Runs the tasks of the studies that take part in an assessment; what is there is not done again.

Beside every part lies a file that says what it is of: the digest of its scenario and of the code that
computed it, and that of the part itself. A part of another scenario or of other code is computed again; one
that is not what was written is refused.
"""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import tomli_w

from tribodyn.cases.assessment_part import Task, TaskResult
from tribodyn.cases.results import target, writer
from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.files.output_files import write_output
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.numerics.processes.work import announce
from tribodyn.record.reader import Record
from tribodyn.record.schema import COMPLETE, Layout
from tribodyn.studies.protocol.evaluated import evaluated
from tribodyn.studies.protocol.load import load_data, put_chosen
from tribodyn.studies.protocol.study import CaseHead, Progress, RunResult, Study


def case_of(task: Task, overrides: Mapping[str, Any] = MappingProxyType({})) -> Any:
    """The case of a task; raises InputError if it cannot be run."""
    return load_data(task.scenario, task.name, overrides).case


def require_cases(every: Sequence[tuple[Study, Task]]) -> None:
    """Raise InputError where a task that is needed cannot be run: said before any work."""
    for _, task in every:
        if task.needed:
            _first(task)


def folder_of(record: Path) -> Path:
    """Where the parts of a record lie."""
    return record.with_name(f"{record.stem}-parts")


def results(
    every: Sequence[tuple[Study, Task]],
    folder: Path,
    progress: Progress | None = None,
    *,
    force: bool = False,
) -> dict[str, TaskResult]:
    """Run every task, or take up what an earlier call left; results by name of the task.

    Raises InputError or SimulationError if a task that is needed cannot be run; before any work where a part
    was changed since it was written, unless `force` is given: then it is computed again.
    """
    require_cases(every)
    for _, task in every:
        sound = _sealed(task, folder) is not None and not _changed(task, folder)
        if force and not sound and _file(task, folder).is_file():
            _file(task, folder).unlink()
        _require_unchanged(task, folder)
    folder.mkdir(parents=True, exist_ok=True)
    done: dict[str, TaskResult] = {}
    for number, (study, task) in enumerate(every):
        announce(f"{number + 1}/{len(every)}, {task.about}")
        if progress:
            progress(number / len(every))
        try:
            done[task.name] = _kept(task, folder) or _computed(study, task, folder)
        except (InputError, SimulationError) as error:
            if task.needed:
                raise
            done[task.name] = TaskResult(folder / task.name, failures=(f"{task.about}: {error}",))
    if progress:
        progress(1.0)
    return done


class Concluded(NamedTuple):
    """What tasks come to."""

    along: Mapping[str, Any]  # the datasets along the axis of the record's layout
    summary: dict[str, Any]
    rows: Sequence[Mapping[str, Any]] = ()  # of the datasets along other axes


def recorded(
    case: CaseHead,
    output: str | Path | None,
    layout: Layout,
    concluded: Callable[[Path, Progress | None, bool], Concluded],
    *,
    force: bool = False,
    progress: Progress | None = None,
    **more: Any,
) -> RunResult:
    """Write the record of a case that is concluded from tasks; see `study.Study.run`.

    `concluded` runs them into a folder, as `results` does; `more` is for the `writer`. Tasks that were done
    before a call was stopped are kept.
    """
    path = target(case, output, force)
    folder = folder_of(path)
    try:
        along, summary, rows = concluded(folder, progress, force)
    except SimulationError as error:
        with writer(case, path, layout, 0, force=force) as record:
            return RunResult(record.fail(str(error), {}), "failed", str(error), {})
    except KeyboardInterrupt as error:
        # what is left of the part in work is done again
        error.__notes__ = [f"the parts done so far: {folder}, the same call goes on"]
        raise
    with writer(case, path, layout, len(along[layout.axis_name]), force=force, **more) as record:
        record.write(0, along)
        for number, row in enumerate(rows):
            record.put(number, row)
        return RunResult(record.finish(summary), "complete", "", summary)


def kept(every: Sequence[tuple[Study, Task]], folder: Path) -> dict[str, TaskResult] | None:
    """Results that an earlier call left, as `results` gives them; None where a needed one is missing.

    Raises InputError if a part was changed since it was written.
    """
    done: dict[str, TaskResult] = {}
    for _, task in every:
        _require_unchanged(task, folder)
        result = _kept(task, folder)
        if result is None and task.needed:
            return None
        done[task.name] = result or TaskResult(folder / task.name, failures=(task.about,))
    return done


def _kept(task: Task, folder: Path) -> TaskResult | None:
    """What the same code made of the same scenario; None: there is nothing."""
    sealed, path = _sealed(task, folder), _file(task, folder)
    if sealed is None or not path.exists() or sealed[0] != _origin(task):
        return None
    return _read(task, path)


def _read(task: Task, path: Path) -> TaskResult:
    if not task.cases:
        with Record(path) as record:
            return TaskResult(path, record.summary)
    data = json.loads(path.read_text(encoding="utf-8"))
    rows = {name: np.array(row, dtype=float) for name, row in data["quantities"].items()}
    return TaskResult(path, rows=rows, failures=tuple(data["failures"]), cases=tuple(data["cases"]))


def _computed(study: Study, task: Task, folder: Path) -> TaskResult:
    """Run a task, or the cases over which it varies, and seal what it gives; until then nothing is kept."""
    path = _file(task, folder)
    _seal(task, folder).unlink(missing_ok=True)
    if task.cases:
        write_output(path, json.dumps(_varied(study, task), indent=1), force=True)
    else:
        result = study.run(case_of(task), path, force=True, allow_large=True)  # the whole was asked for
        if result.status != COMPLETE:
            raise SimulationError(f"{task.about}: {result.message}")
    write_output(_seal(task, folder), f"{_origin(task)} {_digest(path)}\n", force=True)
    return _read(task, path)


def _varied(study: Study, task: Task) -> dict[str, Any]:
    """Quantities over the cases of a task, None where one fails, and why those failed."""
    keys, cases = _cases(task)
    batched = task.arrays if study.batch() else ()  # others have their arrays among their quantities
    results = evaluated(study, cases, marched=task.marched, arrays=batched)
    rows = [{} if isinstance(result, str) else result for result in results]
    return {
        "scenario": tomli_w.dumps(dict(task.scenario)),
        "cases": keys,
        "quantities": {name: [_known(row.get(name)) for row in rows] for name in study.swept()}
        | {name: _alike([row.get(name) for row in rows]) for name in task.arrays},
        "failures": list(dict.fromkeys(result for result in results if isinstance(result, str))),
    }


def _cases(task: Task) -> tuple[list[dict[str, Any]], list[Any]]:
    """Values by which the cases of a task differ, and the cases; a text where one cannot be made: why."""
    chosen, keys, cases = case_of(task).chosen(), list[dict[str, Any]](), list[Any]()

    def add(overrides: Mapping[str, Any]) -> Any:
        keys.append(dict(overrides))
        scenario = dict(task.scenario)
        put_chosen(scenario, chosen, overrides)
        try:
            cases.append(load_data(scenario, task.name, overrides).case)
        except InputError as error:
            cases.append(str(error))
        return cases[-1]

    for overrides in task.cases:
        case = add(overrides)
        if task.further is not None and not isinstance(case, str):
            with suppress(InputError, SimulationError):  # the case itself says why
                for more in task.further(case):
                    add({**overrides, **more})
    return keys, cases


def _known(value: Any) -> float | None:
    return float(value) if value is not None and np.isfinite(value) else None


def _alike(rows: Sequence[Any]) -> list[list[float | None]]:
    """Rows of one length: those that are missing have nothing known in them."""
    known = [[] if row is None else list(map(_known, row)) for row in rows]
    length = max(map(len, known), default=0)
    return [[*row, *[None] * (length - len(row))] for row in known]


def _first(task: Task) -> Any:
    """The case of a task, or the first of its cases."""
    return case_of(task, task.cases[0] if task.cases else {})


def _file(task: Task, folder: Path) -> Path:
    return folder / f"{task.name}.{'json' if task.cases else 'h5'}"


def _seal(task: Task, folder: Path) -> Path:
    return folder / f"{task.name}.origin"


def _origin(task: Task) -> str:
    """Digest of everything that the part of a task depends on."""
    varied = [dict(case) for case in task.cases], list(task.arrays), task.marched
    parts = [_first(task).sha256, *varied, computing_digest()]
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()


def _sealed(task: Task, folder: Path) -> tuple[str, str] | None:
    """Origin and digest of a part as it was written; None where nothing was, or the seal is damaged."""
    with suppress(OSError, ValueError):
        origin, written = _seal(task, folder).read_text(encoding="ascii").split()
        return origin, written
    return None


def _changed(task: Task, folder: Path) -> bool:
    """Whether a part is not what was written."""
    sealed, path = _sealed(task, folder), _file(task, folder)
    if sealed is None or not path.exists():
        return False
    return not path.is_file() or _digest(path) != sealed[1]


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _require_unchanged(task: Task, folder: Path) -> None:
    if _changed(task, folder):
        raise InputError(
            "part",
            str(_file(task, folder)),
            "was changed since the assessment wrote it",
            "remove it, or assess with --force, which computes it again",
        )
