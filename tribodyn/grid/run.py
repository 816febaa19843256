"""A sweep from its grid to its record."""

import math
import tomllib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
import tomli_w

from tribodyn.cases.cost import say_beforehand
from tribodyn.errors import InputError
from tribodyn.grid.data_set import DataSet, listed_of
from tribodyn.grid.engines import Block, Engine
from tribodyn.grid.grid import Grid
from tribodyn.grid.plan import chained_steps, estimate_of, refuse_large, single_steps
from tribodyn.grid.refinement import Refinement, begun_anew, grid_of
from tribodyn.input.vary import Axis
from tribodyn.record.sweep_schema import DIRECTIONS, FAILED, WAITING, VariedKey
from tribodyn.record.sweep_writer import SweepHead, SweepWriter, values_left
from tribodyn.record.writer import check_target
from tribodyn.studies.protocol.batch import Chunk

Follow = Callable[[int, int], None]
"""Called with the cases done and to do."""


class SweepResult(NamedTuple):
    """How a sweep ended: the record's path, "complete" or "failed", how many cases failed, its summary."""

    path: Path
    status: str
    cases: int
    failed: int
    summary: dict[str, Any]


def settings_of(grid: Grid, transient: int | None = None, engine: str = "native") -> Any:
    """How the cases of a sweep are evaluated; see `protocol.batch.Batch.settings`."""
    return grid.batch.settings(grid.structures(), transient, engine)


def cases_at_most(grid: Grid, refinement: Refinement | None, directions: int) -> int:
    """How many cases a sweep has, with all further values that it may get."""
    further = refinement.most if refinement else 0
    return (grid.shape[0] + further) * math.prod(grid.shape[1:]) * max(1, directions)


def run(
    grid: Grid,
    settings: Any,
    engine: Engine,
    output: str | Path,
    *,
    directions: Sequence[str] = (),
    unstable: bool = False,
    refinement: Refinement | None = None,
    force: bool = False,
    resume: bool = False,
    follow: Follow | None = None,
    allow_large: bool = False,
    scenario_file: str = "",
    data_set: DataSet | None = None,
) -> SweepResult:
    """Evaluate every case of a grid and write the record; InputError before anything is computed.

    The `settings` are from `settings_of`, the `refinement` from `refinement_of`. `directions` are senses to
    follow the first parameter in, none: every case begins by itself; `unstable` continues branches beyond the
    ends of their stable parts. `force` replaces a record, `resume` goes on with what an unfinished sweep
    left; `allow_large`: see `grid.plan`; `scenario_file`: see `record.target.Origin`; of a
    `data_set` the grid is `grid.hearing`.
    """
    if data_set and (directions or unstable or refinement):
        option = "--refine" if refinement else "--direction"
        raise InputError(option, None, "contradicts --signals", "omit one")
    if directions or unstable:
        _can_be_followed(grid, directions, unstable)
        settings = grid.batch.following(settings, unstable)
    most = refinement.most if refinement else 0
    estimate = estimate_of(grid, settings, len(directions), engine.width, most)
    refuse_large(estimate, allow_large)
    first = grid
    if refinement and resume and not force:
        grid = grid_of(grid, refinement, values_left(output, grid.axes[0].name))

    def head_of(grid: Grid) -> SweepHead:
        head = _head(grid, first, settings, directions, refinement, data_set)
        return head._replace(scenario_file=scenario_file)

    head = head_of(grid)
    if refinement:
        refinement.require_recorded(head.layout)
    if not resume:
        check_target(Path(output), force, head.origin)
    _sound_somewhere(grid, settings)
    say_beforehand(estimate)
    begun, done = perf_counter(), 0
    with SweepWriter(output, head, force=force, resume=resume) as record:
        done_before = int(np.sum(record.status != WAITING))
        expected = cases_at_most(first, refinement, len(directions)) - done_before
        while True:
            for chunk, block in _blocks(grid, settings, engine, directions, record):
                record.write(chunk.numbers, block)
                done += len(chunk.numbers)
                if follow:
                    follow(min(done, expected), expected)
            further = refinement.further(grid, first, record) if refinement else ()
            if not further:
                break
            finer = grid.with_values(_merged(grid.axes[0].values, further))
            rows, again = begun_anew(grid, finer, directions)
            record.extend(head_of(finer), rows, again)
            grid = finer
        failed = int(np.sum(record.status == FAILED))
        summary = {
            "cases": record.status.size,
            "failed": failed,
            "cases_done_by_this_call": done,
            "wall_time": perf_counter() - begun,
        }
        path = record.finish(summary)
    status = "failed" if failed == summary["cases"] else "complete"
    return SweepResult(path, status, summary["cases"], failed, summary)


def _blocks(
    grid: Grid, settings: Any, engine: Engine, directions: Sequence[str], record: SweepWriter
) -> Iterator[tuple[Chunk, Block]]:
    """Evaluate all cases that wait, step after step."""
    waiting = record.status == WAITING
    size = grid.batch.size_of_chunk(settings, int(waiting.sum()), engine.width)

    def recorded(numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return record.status[numbers], record.read("state", numbers), record.read("period", numbers)

    if directions:
        steps = chained_steps(grid, waiting, size, directions, recorded)
    else:
        every = single_steps(grid, waiting, size)
        steps = iter([(chunk for chunks in every for chunk in chunks)])
    for chunks in steps:
        yield from engine(grid.study.kind, chunks, settings)


def _merged(values: Sequence[Any], further: Sequence[float]) -> list[float]:
    """Values and further ones between them, in the order of the values."""
    return sorted([*values, *further], reverse=values[0] > values[-1])


def _can_be_followed(grid: Grid, directions: Sequence[str], unstable: bool) -> None:
    """Raise InputError where cases have no order or no motion to go on from, or steps are too expensive."""
    axis = grid.axes[0]
    option = "--unstable" if unstable else "--direction"
    if not grid.batch.states:
        rule = f"{grid.study.about}: its cases do not go on from each other"
        raise InputError(option, None, rule, "omit it")
    if not directions:
        rule = "continues the branches that --direction follows"
        raise InputError(option, None, rule, "add --direction: up, down or both")
    if not axis.numeric:
        raise InputError("--direction", axis.key, "has no order to go up or down", "vary a number first")
    if unstable and grid.changes_what_is_shared(0):
        rule = f"each value of {axis.key} needs a table of the mesh of its own"
        raise InputError(option, None, rule, "vary another key first, or omit it")


def _head(
    grid: Grid,
    first: Grid,
    settings: Any,
    directions: Sequence[str],
    refinement: Refinement | None,
    data_set: DataSet | None,
) -> SweepHead:
    """What is known of the sweep over a grid, the first one or one with further values."""
    scales = tuple(VariedKey(axis.name, axis.key, axis.units, axis.values) for axis in grid.axes)
    settings_data = {
        "vary": {axis.key: list(axis.written) for axis in first.axes},
        "weights": {axis.name: _weights(grid, axis) for axis in grid.axes if axis.weighed},
        "drawn": [axis.name for axis in grid.axes if axis.drawn],
        "directions": [direction for direction in DIRECTIONS if direction in directions],
        "chosen": {key: ", ".join(names) for key, names in grid.chosen.items()},
        "laws": grid.base.laws(),
        **({"refine": refinement._asdict()} if refinement else {}),
        **({"test": data_set.test} if data_set else {}),
        **settings._asdict(),
    }
    head = SweepHead(
        scenario=grid.base.toml,
        sha256=grid.base.sha256,
        parameters=scales,
        settings=tomli_w.dumps(settings_data),
        directions=tuple(directions),
        layout=grid.batch.layout(settings),
    )
    if data_set is None:
        return head
    layout = head.layout  # of a data set, whose cases are in a list
    told = {"title": str(tomllib.loads(head.scenario).get("title", "")), "license": data_set.licence}
    listed = listed_of(grid, data_set, layout)
    return head._replace(listed=listed, layout=layout._replace(attributes={**told, **layout.attributes}))


def _weights(grid: Grid, axis: Axis) -> list[float]:
    """Weights of the tables that an axis numbers, as the scenario has them."""
    if axis.weighed is None:
        return []
    tables = tomllib.loads(grid.base.toml)[axis.weighed.tables]
    return [float(tables[int(number) - 1][axis.weighed.weight]) for number in axis.values]


def _sound_somewhere(grid: Grid, settings: Any) -> None:
    """A mistake that all cases share is reported at once: a case at each end of the grid is checked."""
    refusals = []
    for case in grid.ends():
        try:
            grid.batch.check(case, settings)
            return
        except InputError as error:
            refusals.append(error)
    raise refusals[0]
