"""Runs the tasks of all studies that take part in an assessment; what is there is not done again."""

import hashlib
import json
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import tomli_w

from tribodyn import __version__
from tribodyn.errors import InputError, SimulationError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.families import family
from tribodyn.numerics.cache import replacing
from tribodyn.numerics.work import announce
from tribodyn.record.reader import open_record
from tribodyn.record.schema import COMPLETE
from tribodyn.record.sweep_schema import DONE
from tribodyn.scenario.resolve import resolve_table
from tribodyn.studies import STUDIES
from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.batch import Chunk
from tribodyn.studies.by_standard import base_pitch_deviation
from tribodyn.studies.load import loaded_from, table_of
from tribodyn.studies.part import Answer, Asked, Done, Role, Task
from tribodyn.studies.study import Progress, Study


class Part(NamedTuple):
    """A study that takes part, its role and its tasks."""

    study: Study
    role: Role
    tasks: tuple[Task, ...]


def asked_of(case: AssessmentCase) -> Asked:
    """What a case asks the studies."""
    data, settings = tomllib.loads(case.toml), case.settings
    first, last = settings.speed_range
    speeds = np.linspace(first, last, settings.speeds) * case.pinion_speed
    names = ("drive", "lubricant", "bearings", "mesh", "losses")
    tables = {name: data[name] for name in names if name in data}
    tables |= {
        "oil_temperature": data["operating"]["oil_temperature"],
        "temperature": data.get("temperature", {"model": "iso", "lubrication": settings.lubrication}),
        "damping_ratio": settings.damping_ratio,
    }
    assembly = Assembly(family(case.family), case.drive)
    _, pitch_deviation = base_pitch_deviation(assembly, case.quality)
    return Asked(
        case.title,
        tables,
        case.pinion_speed,
        case.gear_torque,
        tuple(case.gear_torque * share for share in settings.torque_shares),
        tuple(sorted({*map(float, speeds), case.pinion_speed})),
        settings.friction_laws,
        pitch_deviation,
        settings.samples,
    )


def parts(asked: Asked) -> tuple[Part, ...]:
    """Studies of the registry that take part, in order, with their tasks."""
    found = [(study, role) for _, study in STUDIES.items() if (role := study.role()) is not None]
    return tuple(
        Part(study, role, tuple(role.tasks(asked)))
        for study, role in sorted(found, key=lambda one: one[1].order)
    )


def case_of(task: Task, overrides: Mapping[str, Any] = MappingProxyType({})) -> Any:
    """The case of a task.

    Raises
    ------
    InputError
        If it cannot be run.
    """
    path = Path(f"{task.name}.toml")
    data = json.loads(json.dumps(task.scenario))
    return loaded_from(resolve_table(data, path, overrides, table_of), path).case


def folder_of(record: Path) -> Path:
    """Where the parts of a record lie."""
    return record.with_name(f"{record.stem}-parts")


def results(all_parts: tuple[Part, ...], folder: Path, progress: Progress | None = None) -> dict[str, Done]:
    """Run every task, or take up what an earlier call left; results by name of the task.

    Raises
    ------
    InputError, SimulationError
        If a task that is needed cannot be run.
    """
    every = [(part.study, task) for part in all_parts for task in part.tasks]
    for _, task in every:  # whatever is wrong is said before any work
        if task.needed:
            case_of(task, {task.key: task.values[0]} if task.values else {})
    folder.mkdir(parents=True, exist_ok=True)
    report = progress or (lambda _share: None)
    done: dict[str, Done] = {}
    for number, (study, task) in enumerate(every):
        announce(f"{number + 1}/{len(every)}, {task.about}")
        report(number / len(every))
        try:
            done[task.name] = _varied(study, task, folder) if task.values else _run(study, task, folder)
        except (InputError, SimulationError) as error:
            if task.needed:
                raise
            done[task.name] = Done(folder / task.name, failures=(f"{task.about}: {error}",))
    report(1.0)
    return done


def kept(all_parts: tuple[Part, ...], folder: Path) -> dict[str, Done] | None:
    """Results that an earlier call left, as `results` gives them; None where a needed one is missing."""
    done: dict[str, Done] = {}
    for part in all_parts:
        for task in part.tasks:
            found = _kept_rows(task, folder) if task.values else _kept_run(task, folder)
            if found is None and task.needed:
                return None
            done[task.name] = found or Done(folder / task.name, failures=(task.about,))
    return done


def answers(
    all_parts: tuple[Part, ...], asked: Asked, done: Mapping[str, Done]
) -> Iterator[tuple[Part, Answer]]:
    """What every study says of its results."""
    for part in all_parts:
        yield part, part.role.answer(asked, {task.name: done[task.name] for task in part.tasks})


def _run(study: Study, task: Task, folder: Path) -> Done:
    found = _kept_run(task, folder)
    if found is not None:
        return found
    path = folder / f"{task.name}.h5"
    result = study.run(case_of(task), path, force=True, allow_large=True)  # the whole was asked for
    if result.status != COMPLETE:
        raise SimulationError(f"{task.about}: {result.message}")
    with open_record(path) as record:
        return Done(path, record.summary)


def _kept_run(task: Task, folder: Path) -> Done | None:
    """A complete record of the same scenario by this version; None: there is none."""
    path = folder / f"{task.name}.h5"
    if not path.exists():
        return None
    try:
        with open_record(path) as record:
            made = record.attrs["scenario_sha256"], record.attrs["tribodyn_version"]
            same = made == (case_of(task).sha256, __version__) and record.status == COMPLETE
            return Done(path, record.summary) if same else None
    except InputError:  # damaged: it is written anew
        return None


def _kept_rows(task: Task, folder: Path) -> Done | None:
    """Rows of the same cases by this version; None: there are none."""
    path = folder / f"{task.name}.json"
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        if data["sha256"] != _digest(task):
            return None
        rows = {name: np.array(row, dtype=float) for name, row in data["figures"].items()}
        return Done(path, rows=rows, failures=tuple(data["failures"]))
    except (OSError, ValueError, LookupError, TypeError, AttributeError):
        return None


def _digest(task: Task) -> str:
    asked = [dict(task.scenario), task.key, list(task.values), __version__]
    return hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()


def _varied(study: Study, task: Task, folder: Path) -> Done:
    """Figures of every case: together, where the study evaluates cases so."""
    found = _kept_rows(task, folder)
    if found is not None:
        return found
    cases = [case_of(task, {task.key: value}) for value in task.values]
    rows, failures = _figures(study, cases)
    data = {
        "scenario": tomli_w.dumps(dict(task.scenario)),
        "varied": task.key,
        "values": list(task.values),
        "figures": {name: [one if np.isfinite(one) else None for one in row] for name, row in rows.items()},
        "failures": failures,
        "sha256": _digest(task),
    }
    path = folder / f"{task.name}.json"
    with replacing(path) as scratch:
        scratch.write_text(json.dumps(data, indent=1), encoding="utf-8")
    return Done(path, rows={name: np.array(row) for name, row in rows.items()}, failures=tuple(failures))


def _figures(study: Study, cases: list[Any]) -> tuple[dict[str, list[float]], list[str]]:
    """Figures over the cases, NaN where one fails, and why those failed."""
    names, failures = list(study.swept()), []
    batch = study.batch()
    rows: dict[str, list[float]] = {name: [float("nan")] * len(cases) for name in names}
    if batch is not None:
        settings = batch.settings([cases[0], cases[-1]], None, "native")
        block = batch.evaluate(Chunk(np.arange(len(cases)), tuple(cases)), settings, None)
        for i in range(len(cases)):
            if block["status"][i] != DONE:
                failures.append(str(block["message"][i]))
                continue
            for name in names:
                rows[name][i] = float(block[name][i])
        return rows, failures
    for i, case in enumerate(cases):
        try:
            figures = study.figures(case)
        except (InputError, SimulationError) as error:
            failures.append(str(error))
            continue
        for name in names:
            if figures.get(name) is not None:
                rows[name][i] = float(figures[name])
    return rows, failures
