"""From a case of a search to its record: every evaluation, the best, and what was evaluated about it."""

from collections.abc import Mapping
from contextlib import ExitStack, suppress
from functools import cache
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.cases.results import left_over, record_path, target, writer
from tribodyn.errors import SimulationError
from tribodyn.numerics.files.sources import computing_digest
from tribodyn.numerics.processes.work import usable_cores
from tribodyn.record.reader import Record
from tribodyn.record.writer import RecordWriter
from tribodyn.studies.design.candidates.archive import (
    FACTORS,
    Archive,
    Candidate,
    Moved,
    SpentError,
    Unfinished,
    resolutions,
)
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, samples_of, shares_of, start_of
from tribodyn.studies.design.candidates.converged import Converged, converged, counts
from tribodyn.studies.design.candidates.evaluation import (
    Answer,
    Cluster,
    Evaluators,
    Pool,
    Results,
)
from tribodyn.studies.design.candidates.scoring import SLACK
from tribodyn.studies.design.candidates.sources import standing
from tribodyn.studies.design.case import DesignCase, Free
from tribodyn.studies.design.methods import METHODS, method_of
from tribodyn.studies.design.outcome import (
    LOWER,
    MOVED,
    START_QUANTITIES,
    UPPER,
    check_targets,
    chosen_best,
    headline,
    layout_of,
    names_of,
    numbers_of_cases,
    row_of,
    scales_of,
    signed,
    unfinished_in,
    write_best,
)
from tribodyn.studies.protocol.study import CheckResult, Progress, RunResult, TextTable

#: Evaluations that a process of its own is worth.
WORTH = 24


def check(case: DesignCase) -> CheckResult:
    """Check a case and say what is searched."""
    name, reason = method_of(case)
    starts = [standing(case.scenarios, free.keys[0]) for free in case.free]
    rows = [
        (", ".join(free.keys), "–" if start is None else str(start), _bounds(free))
        for free, start in zip(case.free, starts, strict=True)
    ]
    cases = len(case.duties) * len(samples_of(case))
    wanted = [objective.name.removeprefix("-") for objective in case.objectives]
    more = case.objectives[0].name.startswith("-")
    by_factor = counts(case, name)
    further = sum(by_factor.values()) - case.search.evaluations
    last = max(by_factor)
    finer = f"about {further}, on up to {last} times the resolution" if last > 1 else f"about {further}"
    data = {
        "free": {key: _bounds(free) for free in case.free for key in free.keys},
        "objective": wanted,
        "subject_to": [constraint.text for constraint in case.constraints],
        "method": name,
        "cases_per_evaluation": cases,
        "evaluations_by_resolution": {str(factor): count for factor, count in by_factor.items()},
    }
    tables = (
        TextTable("Free keys", ("key", "start", "range"), rows),
        TextTable(
            "Search",
            ("", ""),
            (
                ("maximise" if more else "minimise", " and ".join(wanted)),
                *(("part", f"{name}: {part.get('title', '')}") for name, part in case.parts.items()),
                *(("subject to", constraint.text) for constraint in case.constraints),
                ("method", f"{name}: {reason}"),
                ("evaluations", f"{case.search.evaluations} at most, {cases} cases each"),
                ("besides, at the end", finer),
            ),
        ),
    )
    return CheckResult(data, tables)


def _bounds(free: Free) -> str:
    """The range of a free key in words."""
    if free.choices:
        return ", ".join(map(str, free.choices))
    return f"{free.low:g} … {free.high:g} {free.unit}".rstrip()


def run(
    case: DesignCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
    resume: bool = False,
    client: Any = None,
) -> RunResult:
    """Run a search and write its record; see `study.Study.run`.

    It fails where no candidate satisfies all constraints. Interrupted, it keeps what it has found so far.
    """
    name, reason = method_of(case)
    path = record_path(case, output)
    before = _unfinished(case, path) if resume and not force else None
    check_targets(case, path, force)
    replace = force or before is not None
    target(case, path, force, resumed=before is not None)
    before = before or Unfinished()
    begun = perf_counter()
    with ExitStack() as stack:
        pool = stack.enter_context(_pool(case, client))
        start = before.start.get(1) or pool.submit(cases_of(case, {})).result()
        before = before._replace(start={**before.start, 1: start})
        names = names_of(case, start)
        room = sum(map(len, before.known.values())) + len(FACTORS) * case.search.evaluations
        how: dict[str, Any] = {"scales": scales_of(case, names), "force": replace, "code": computing_digest()}
        expected = counts(case, name)
        stages = dict.fromkeys(expected, 0)  # evaluations by resolution
        record = stack.enter_context(writer(case, path, layout_of(case), room, **how))

        def keep(candidate: Candidate) -> None:
            record.write(record.written, row_of(case, names, candidate, record.written))
            stages[candidate.factor] = stages.get(candidate.factor, 0) + 1
            if progress:
                progress(_share(stages, expected))

        @cache
        def at(factor: int) -> Archive:
            archive = Archive(case, pool, keep, factor, before)
            at_start = numbers_of_cases(names, archive.scoring.start)
            record.put(FACTORS.index(factor), {START_QUANTITIES: at_start})
            return archive

        def so_far(**more: Any) -> dict[str, Any]:
            where = {"method": name, "method_reason": reason, "engine": pool.name, "workers": pool.workers}
            quantities = headline(case, archive, at(1)) if archive else {}
            return quantities | where | more | {"wall_time": perf_counter() - begun}

        archive = None
        try:
            archive = at(1)
            for factor in sorted(before.known):
                for candidate in at(factor).recorded.values():
                    keep(candidate)
            _search(case, at(1), name)
            end = converged(case, at, name)
            archive = end.archive
            best = chosen_best(case, archive)
            if best is None:
                message = _why_none(case, archive)
                return RunResult(record.fail(message, so_far()), "failed", message, so_far())
            about = _about(case, archive, pool, best, before.moved, record)
            summary = so_far(**_resolved(case, at(1), end, best), **about)
            summary["evaluations_finer"] = end.evaluations
            every = ("evaluations", "evaluations_finer", "evaluations_about")
            summary["evaluations_total"] = sum(summary[each] for each in every) + at.cache_info().currsize
        except KeyboardInterrupt as error:
            best = chosen_best(case, archive) if archive else None
            kept = record.fail(str(error) or "interrupted by the user", so_far())
            if archive and best:
                files = write_best(case, {**best.values, **archive.more}, path, force)
                error.add_note(f"the best so far: {files[0]}")
            error.add_note(f"the {record.written} evaluations so far: {kept}, --resume goes on")
            raise
        if progress:
            progress(1.0)
        files = write_best(case, {**best.values, **archive.more}, path, force)
        kinds = [*(f"toml_{name}" if name else "toml" for name in case.scenarios), "dxf"]
        summary["files"] = dict(zip(kinds, map(str, files), strict=False))
        return RunResult(record.finish(summary, trim=True), "complete", "", summary)


def _share(done: Mapping[int, int], expected: Mapping[int, int]) -> float:
    """Share of a search that is done: a resolution that ended before its expected evaluations is whole."""
    last = max(factor for factor, count in done.items() if count)
    behind = sum(count for factor, count in expected.items() if factor < last)
    here = min(done[last], expected.get(last, 0))
    return min(1.0, (behind + here) / sum(expected.values()))


def quantities_of(case: DesignCase) -> dict[str, Any]:
    """Quantities of a search without a record; raises SimulationError where nothing is feasible."""
    name, _ = method_of(case)
    with _pool(case) as pool:
        at = cache(lambda factor: Archive(case, pool, factor=factor))
        _search(case, at(1), name)
        end = converged(case, at, name)
        quantities = headline(case, end.archive, at(1))
        if "objective" not in quantities:
            raise SimulationError(_why_none(case, end.archive))
        return quantities


def _pool(case: DesignCase, client: Any = None) -> Evaluators:
    """What evaluates candidates; a context manager."""
    if client:
        return Cluster(case.scenarios, client)
    worth = case.search.evaluations * len(cases_of(case, {})) // WORTH
    return Pool(case.scenarios, max(1, min(usable_cores(), worth)))


def _search(case: DesignCase, archive: Archive, name: str) -> None:
    start = start_of(case)
    with suppress(SpentError):
        archive.score(start)
        METHODS[name](archive, start)


def _resolved(case: DesignCase, searched: Archive, end: Converged, best: Candidate) -> dict[str, Any]:
    """On which resolution the quantities stand, and what the best is on the one that was searched on."""
    if end.stands is None:
        return {}
    before = searched.scoring.score(searched.found_of(best.values).result()).objectives
    return {
        "resolution": resolutions(case, end.archive.factor),
        "resolution_searched": resolutions(case, 1),
        "objective_searched": signed(case, before),
        "quantity_stands": end.stands,
    }


def _unfinished(case: DesignCase, path: Path) -> Unfinished | None:
    """What an unfinished search recorded; None where there is no such record."""

    def same(record: Record) -> bool:
        return record.attrs["scenario_sha256"] == case.sha256

    with left_over(case, path, same) as record:
        return record and unfinished_in(case, record)


def _why_none(case: DesignCase, archive: Archive) -> str:
    """Why there is no best: what the nearest candidate misses, or why none has quantities."""
    nearest = archive.nearest()
    if nearest is None:
        reason = archive.evaluations[-1].score.message if archive.evaluations else "none was evaluated"
        return f"no candidate has quantities: {reason}"
    missed = [
        f"{constraint.text} by {-100 * margin:.3g} %"
        for constraint, margin in zip(case.constraints, nearest.score.margins, strict=True)
        if margin < -SLACK
    ]
    values = ", ".join(f"{key} = {value}" for key, value in nearest.values.items())
    return f"no candidate satisfies all constraints; the nearest, {values}, misses {' and '.join(missed)}"


def _about(
    case: DesignCase, archive: Archive, pool: Evaluators, best: Candidate, moved: Moved, record: RecordWriter
) -> dict[str, Any]:
    """Evaluate about the best: each key and each tolerance moved alone; and once more as `confirm` says.

    What stands in `moved`, of the search that this one goes on from, is not evaluated again.
    """
    shares, keys = shares_of(case, best.values), len(case.free)

    def found(place: int, side: float) -> Answer:
        if place >= keys:
            return pool.submit(cases_of(case, best.values, archive.more, alone=(place - keys, side)))
        if not case.free[place].continuous:
            return archive.found_of(best.values)
        changed = shares.copy()
        changed[place] = np.clip(changed[place] + side * MOVED, 0.0, 1.0)
        return archive.found_of(chosen(case, changed))

    def objective(results: Results) -> float:
        return archive.scoring.score(results).objectives[0]

    places = range(keys + len(case.tolerances)) if case.sensitivities else ()
    waiting = {
        (place, name): found(place, side)
        for place in places
        for name, side in ((LOWER, -1.0), (UPPER, 1.0))
        if (place, name) not in moved
    }
    ends = [{}, best.values] if case.confirm else []
    confirming = [pool.submit(cases_of(case, values, {**archive.more, **case.confirm})) for values in ends]
    for (place, name), value in moved.items():
        record.put(place, {name: value})
    for (place, name), answer in waiting.items():
        record.put(place, {name: objective(answer.result())})
    confirmed = [objective(answer.result()) for answer in confirming]
    summary: dict[str, Any] = {"evaluations_about": 2 * len(places) + len(ends)}
    if ends:
        summary |= {"objective_start_confirmed": confirmed[0], "objective_confirmed": confirmed[1]}
    return summary
