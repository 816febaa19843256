"""A sweep from its grid to its record."""

from collections.abc import Callable, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
import tomli_w

from tribodyn.dynamics.modes import mode_count
from tribodyn.errors import InputError
from tribodyn.record.sweep_schema import DIRECTIONS, FAILED, FIGURES, WAITING
from tribodyn.record.sweep_writer import ParameterScale, SweepHead, SweepWriter
from tribodyn.record.writer import check_target
from tribodyn.solve.periodic import refuse_time_dependent
from tribodyn.studies.gear_pair.batch.evaluate import Settings, tabulated
from tribodyn.studies.gear_pair.prepare import prepare
from tribodyn.sweep.engines import Engine
from tribodyn.sweep.grid import Grid
from tribodyn.sweep.plan import chained_steps, chunk_size, single_steps

#: Mesh cycles that the search for a steady state may take, that its window has (whole periods, up to 4), and
#: points of the section of a motion that has no period.
MOST_CYCLES, STEADY_WINDOW, STEADY_POINTS = 2000, 4, 256
#: The same of a transient: a quarter of its cycles, at most this many; points of its section, half of them.
TRANSIENT_WINDOW, TRANSIENT_POINTS = 16, 256
#: Above these a sweep is refused: surely mistyped, or too large for one file.
MOST_CASES, MOST_BYTES = 1_000_000, 64 * 2**30
#: Seconds that a case takes on one core, for what is said of a sweep too large.
SECONDS_A_CASE = 0.02

Follow = Callable[[int, int], None]
"""Called with the cases done and to do."""


class SweepResult(NamedTuple):
    """How a sweep ended: the record's path, "complete" or "failed", how many cases failed, its figures."""

    path: Path
    status: str
    cases: int
    failed: int
    summary: dict[str, Any]


def settings_of(grid: Grid, transient: int | None, method: str = "") -> Settings:
    """How the cases of a sweep are brought to their windows.

    Parameters
    ----------
    grid : Grid
    transient : int or None
        Mesh cycles to march; None where steady states are sought.
    method : str
        Integration method instead of the scenario's.
    """
    samples = grid.base.output.samples_per_cycle
    modes = _modes(grid)
    if transient is None:
        return Settings(True, MOST_CYCLES, STEADY_WINDOW, STEADY_POINTS, samples, modes, method)
    window = max(1, min(TRANSIENT_WINDOW, transient // 4))
    points = max(window, min(TRANSIENT_POINTS, transient // 2))
    return Settings(False, transient, window, points, samples, modes, method)


def _modes(grid: Grid) -> int:
    """Most modes that a case can have, of the ends of all axes."""
    places = [(0,) * len(grid.shape), tuple(size - 1 for size in grid.shape)]
    shaft = any(grid.case(place).operating.shaft_stiffness is not None for place in places)
    return 6 if shaft else 5


def run(
    grid: Grid,
    settings: Settings,
    engine: Engine,
    output: str | Path,
    *,
    directions: Sequence[str] = (),
    force: bool = False,
    resume: bool = False,
    follow: Follow | None = None,
) -> SweepResult:
    """Evaluate every case of a grid and write the record.

    Parameters
    ----------
    grid : Grid
    settings : Settings
    engine : Engine
    output : path
    directions : sequence of "up", "down"
        Senses in which to follow the first parameter; none: every case begins by itself.
    force, resume : bool
        Replace a record, or go on with what an unfinished sweep left.
    follow : callable, optional

    Raises
    ------
    InputError
        Before anything is computed.
    """
    _not_absurd(grid, settings, directions)
    if directions and not grid.axes[0].numeric:
        axis = grid.axes[0].key
        raise InputError("--direction", axis, "has no order to go up or down", "vary a number first")
    head = _head(grid, settings, directions)
    if not resume:
        check_target(Path(output), force)
    _sound_somewhere(grid, settings)
    begun = perf_counter()
    with SweepWriter(output, head, force=force, resume=resume) as record:
        waiting = record.status == WAITING
        total, done = int(waiting.sum()), 0
        size = chunk_size(settings.window, settings.samples, total, engine.width)

        def recorded(numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            return record.status[numbers], record.read("state", numbers)

        if directions:
            steps = chained_steps(grid, waiting, size, directions, recorded)
        else:
            every = single_steps(grid, waiting, size)
            steps = iter([(chunk for chunks in every for chunk in chunks)])
        for chunks in steps:
            for chunk, block in engine(chunks, settings):
                record.write(chunk.numbers, block)
                done += len(chunk.numbers)
                if follow:
                    follow(done, total)
        failed = int(np.sum(record.status == FAILED))
        summary = {
            "cases": record.status.size,
            "failed": failed,
            "cases_done_by_this_call": total,
            "wall_time": perf_counter() - begun,
        }
        path = record.finish(summary)
    status = "failed" if failed == record.status.size else "complete"
    return SweepResult(path, status, record.status.size, failed, summary)


def _head(grid: Grid, settings: Settings, directions: Sequence[str]) -> SweepHead:
    scales = tuple(ParameterScale(axis.name, axis.key, axis.units, axis.values) for axis in grid.axes)
    told = {
        "vary": {axis.key: list(axis.written) for axis in grid.axes},
        "directions": [one for one in DIRECTIONS if one in directions],
        **settings._asdict(),
    }
    return SweepHead(
        scenario=grid.base.toml,
        sha256=grid.base.sha256,
        parameters=scales,
        settings=tomli_w.dumps(told),
        directions=tuple(directions),
        window=settings.window,
        samples_per_cycle=settings.samples,
        cycles=settings.points,
        modes=settings.modes,
    )


def _sound_somewhere(grid: Grid, settings: Settings) -> None:
    """A mistake that all cases share is told at once: a case at each end of the grid is prepared."""
    refused = None
    for place in ((0,) * len(grid.shape), tuple(size - 1 for size in grid.shape)):
        try:
            case = grid.case(place)
            model = prepare(case, tabulated(case)).model
            mode_count(model)
            if settings.steady:
                refuse_time_dependent(model)
            return
        except InputError as error:
            refused = refused or error
    if refused:
        raise refused


def _not_absurd(grid: Grid, settings: Settings, directions: Sequence[str]) -> None:
    cases = int(np.prod(grid.shape, dtype=float)) * max(1, len(directions))
    inner = settings.window * settings.samples + 2 * settings.points + len(FIGURES) + 60
    size = cases * 8 * inner
    if cases > MOST_CASES or size > MOST_BYTES:
        hours = cases * SECONDS_A_CASE / 3600
        raise InputError(
            "--vary",
            " × ".join(map(str, grid.shape)),
            f"{cases:.3g} cases, about {hours:.3g} core hours and {size / 2**30:.3g} GiB",
            f"choose larger steps, or fewer output.samples_per_cycle; at most {MOST_CASES} cases",
        )
