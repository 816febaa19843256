"""From a case of a search to its record: every evaluation, the best, and what was evaluated about it."""

from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.sources import computing_digest
from tribodyn.record.reader import open_record
from tribodyn.record.schema import partial_path, require_same_code
from tribodyn.record.writer import RecordWriter, check_target
from tribodyn.studies.design.candidates.archive import (
    Archive,
    Candidate,
    Levels,
    Moved,
    SpentError,
    Unfinished,
    resolutions,
)
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, shares_of, start_of
from tribodyn.studies.design.candidates.converged import Converged, converged
from tribodyn.studies.design.candidates.evaluation import Cluster, Evaluators, Figures, Pool, workers_for
from tribodyn.studies.design.candidates.scoring import SLACK, Scoring
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.layout import (
    FACTORS,
    LOWER,
    MOVED,
    START_FIGURES,
    UPPER,
    figure_rows,
    layout_of,
    names_of,
    rows_of,
    scales_of,
    unfinished_in,
)
from tribodyn.studies.design.methods import METHODS, method_of
from tribodyn.studies.design.outcome import check_targets, chosen_best, headline, signed, write_best
from tribodyn.studies.protocol.recording import target, writer
from tribodyn.studies.protocol.study import Progress, RunResult


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

    It fails where no candidate satisfies all constraints. Interrupted, it keeps the evaluations and the best
    so far.
    """
    name, reason = method_of(case)
    path = Path(output) if output is not None else Path(f"{case.name}.h5")
    before = _unfinished(case, path) if resume and not force else None
    best_of = partial(write_best, case, record=path, force=force)
    check_targets(case, path, force)
    force = force or before is not None
    before = before or Unfinished()
    path = target(case, path, force)
    begun = perf_counter()
    with ExitStack() as stack:
        pool, start = stack.enter_context(_started(case, before.start.get(1), client))
        before = before._replace(start={**before.start, 1: start})
        names = names_of(case, start)
        room = sum(map(len, before.known.values())) + len(FACTORS) * case.search.evaluations
        scales = scales_of(case, names)
        how: dict[str, Any] = {"scales": scales, "force": force, "code": computing_digest()}
        record = stack.enter_context(writer(case, path, layout_of(case), room, **how))

        def started(factor: int, of: Figures) -> None:
            record.put(FACTORS.index(factor), {START_FIGURES: figure_rows(names, of)})

        def keep(candidate: Candidate) -> None:
            record.write(record.written, rows_of(case, names, [candidate], record.written))
            if progress:
                progress(min(1.0, record.written / case.search.evaluations))

        levels = Levels(case, pool, before, started, keep)
        archive = searched = levels.at(1)
        for factor in sorted(before.known):
            known = levels.at(factor).recorded
            record.write(record.written, rows_of(case, names, known, record.written))

        def so_far(**more: Any) -> dict[str, Any]:
            where = {"engine": pool.name, "workers": pool.workers}
            figures = {"method": name, "method_reason": reason, **where}
            wall = {"wall_time": perf_counter() - begun}
            return headline(case, archive, searched) | figures | more | wall

        try:
            _search(case, archive, name)
            end = converged(case, levels, name)
            archive = end.archive
            best = chosen_best(case, archive)
            if best is None:
                message = _why_none(case, archive)
                return RunResult(record.fail(message, so_far()), "failed", message, so_far())
            summary = so_far(
                **_resolved(case, searched, end, best),
                **_about(case, archive, pool, best, before.moved, record),
            )
        except KeyboardInterrupt as error:
            archive.close()
            best = chosen_best(case, archive)
            kept = record.fail(str(error) or "interrupted by the user", so_far())
            if best is not None:
                error.add_note(f"the best so far: {best_of({**best.values, **archive.more})[0]}")
            error.add_note(f"the {record.written} evaluations so far: {kept}, --resume goes on")
            raise
        files = best_of({**best.values, **archive.more})
        names = [*(f"toml_{name}" if name else "toml" for name in case.scenarios), "dxf"]
        summary["files"] = dict(zip(names, map(str, files), strict=False))
        return RunResult(record.finish(summary, trim=True), "complete", "", summary)


def figures(case: DesignCase) -> dict[str, Any]:
    """Figures of a search without a record; raises SimulationError where nothing is feasible."""
    name, _ = method_of(case)
    with _started(case) as (pool, start):
        levels = Levels(case, pool, Unfinished(start={1: start}))
        _search(case, levels.at(1), name)
        end = converged(case, levels, name)
        found = headline(case, end.archive, levels.at(1))
        if "objective" not in found:
            raise SimulationError(_why_none(case, end.archive))
        return found


@contextmanager
def _started(
    case: DesignCase, start: Figures | None = None, client: Any = None
) -> Iterator[tuple[Evaluators, Figures]]:
    """Give what evaluates candidates, and the figures of the base scenario's cases as it stands."""
    cases = cases_of(case, {})
    workers = workers_for(case.search.evaluations * len(cases))
    with Cluster(case.scenarios, client) if client else Pool(case.scenarios, workers) as pool:
        yield pool, start or pool.submit(cases).result()


def _search(case: DesignCase, archive: Archive, name: str) -> None:
    start = start_of(case)
    with suppress(SpentError):
        archive.score(start)
        METHODS[name](archive, start)


def _resolved(case: DesignCase, searched: Archive, end: Converged, best: Candidate) -> dict[str, Any]:
    """On which resolution the figures stand, and what the best is on the one that was searched on."""
    if end.stands is None:
        return {}
    before = searched.scoring.score(searched.found_of(best.values).result()).objectives
    return {
        "resolution": resolutions(case, end.archive.factor),
        "resolution_searched": resolutions(case, 1),
        "objective_searched": signed(case, before),
        "figure_stands": end.stands,
        "evaluations_finer": end.evaluations,
    }


def _unfinished(case: DesignCase, path: Path) -> Unfinished | None:
    """What an unfinished search recorded; None where there is no such record."""
    partial = partial_path(path)
    if not partial.exists():
        return None
    check_target(path, force=True)
    other = "move it away, or --force to begin anew"
    with open_record(partial) as record:
        if record.kind != case.kind or record.attrs["scenario_sha256"] != case.sha256:
            raise InputError("--resume", str(partial), "made from another scenario", other)
        require_same_code(record.attrs, partial)
        return unfinished_in(case, record)


def _why_none(case: DesignCase, archive: Archive) -> str:
    """Why there is no best: what the nearest candidate misses, or why none has figures."""
    nearest = archive.nearest()
    if nearest is None:
        reason = archive.evaluations[-1].score.message if archive.evaluations else "none was evaluated"
        return f"no candidate has figures: {reason}"
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
    shares = shares_of(case, best.values)
    waiting: list[tuple[int, str, Future[Figures]]] = []
    for place, free in enumerate(case.free if case.sensitivities else ()):
        for name, step in ((LOWER, -MOVED), (UPPER, MOVED)):
            if (place, name) in moved:
                continue
            changed = shares.copy()
            changed[place] = np.clip(changed[place] + step, 0.0, 1.0)
            values = chosen(case, changed) if free.continuous else best.values
            waiting.append((place, name, archive.found_of(values)))
    for place in range(len(case.tolerances) if case.sensitivities else 0):
        for name, side in ((LOWER, -1.0), (UPPER, 1.0)):
            if (len(case.free) + place, name) not in moved:
                figures = pool.submit(cases_of(case, best.values, archive.more, alone=(place, side)))
                waiting.append((len(case.free) + place, name, figures))
    ends = [{}, best.values] if case.confirm else []
    confirming = [pool.submit(cases_of(case, values, {**archive.more, **case.confirm})) for values in ends]
    for (place, name), value in moved.items():
        record.put(place, {name: value})
    for place, name, figures in waiting:
        record.put(place, {name: _objective(archive.scoring, figures.result())})
    confirmed = [_objective(archive.scoring, figures.result()) for figures in confirming]
    return {"objective_start_confirmed": confirmed[0], "objective_confirmed": confirmed[1]} if ends else {}


def _objective(scoring: Scoring, found: Figures) -> float:
    return scoring.score(found).objectives[0]
