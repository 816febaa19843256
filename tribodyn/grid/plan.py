"""What a sweep takes, in which order its cases are done, and from which state each begins."""

from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from typing import Any

import numpy as np

from tribodyn.cases import cost
from tribodyn.cases.cost import CostKey, Estimate, described
from tribodyn.errors import InputError
from tribodyn.grid.grid import Grid
from tribodyn.input.vary import VARY
from tribodyn.record.sweep_schema import DONE
from tribodyn.studies.protocol.batch import Chunk, NeighbourWay

#: Above this a sweep is refused unless it is asked for: surely a step was mistyped.
MOST_CASES = 1_000_000
#: Cases that are usual, for what to reduce; bytes that a case takes in memory whatever it is.
USUAL_CASES, A_CASE = 1000, 24.0


def estimate_of(grid: Grid, settings: Any, directions: int, width: int = 1, further: int = 0) -> Estimate:
    """What a sweep takes, from its cases at both ends of the grid.

    `settings` are from `grid.run.settings_of`, `directions` is the number of senses in which the first
    parameter is followed, 0 where cases begin by themselves; `width`: see `engines.Engine`; `further` is the
    most values that the first parameter may get besides.
    """
    first, *others = grid.shape
    cases = float(np.prod(others, dtype=float)) * (first + further) * max(1, directions)
    together = int(min(cases, 10.0**9))
    ends = [grid.batch.estimate(case, settings, together, width) for case in grid.ends()]
    seconds, shared = max(end.seconds for end in ends), max(end.shared for end in ends)
    every = CostKey(VARY, cases, USUAL_CASES, f"choose larger steps than for {cases:.4g} cases")
    return Estimate(
        max(end.memory for end in ends) + A_CASE * cases,
        cost.HEAD + cases * max(end.record for end in ends),
        cases * seconds,
        (every, *chain.from_iterable(end.drivers for end in ends)),
        _tables(grid, further) * shared if shared else 0.0,
    )


def _tables(grid: Grid, further: int) -> float:
    """How many tables the cases have among them, with so many further values of the first parameter."""
    sizes = (grid.shape[0] + further, *grid.shape[1:])
    differ = [size > 1 and grid.changes_what_is_shared(axis) for axis, size in enumerate(grid.shape)]
    return float(np.prod([n for n, other in zip(sizes, differ, strict=True) if other], dtype=float))


def refuse_large(estimate: Estimate, allow_large: bool) -> None:
    """Refuse a sweep that takes more than a run may, or has more than `MOST_CASES`, unless it is allowed."""
    cost.refuse_large(estimate, allow_large)
    cases = estimate.drivers[0].value
    if cases > MOST_CASES and not allow_large:
        raise InputError(
            VARY,
            f"{cases:.10g} cases",
            f"takes about {described(estimate)}",
            f"choose larger steps: {MOST_CASES} cases at most, or add --allow-large",
        )


#: Gives what was recorded of cases: (numbers) -> statuses (n,), states (n, …), periods of the motion (n,).
Recorded = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


def single_steps(grid: Grid, waiting: np.ndarray, size: int) -> Iterator[list[Chunk]]:
    """All cases that wait, (cases,) bool, on their own; those that share costly work one after the other."""
    numbers = _by_table(grid)
    numbers = numbers[waiting[numbers]]
    for part in range(0, len(numbers), size):
        chosen = np.sort(numbers[part : part + size])
        places = zip(*np.unravel_index(chosen, grid.shape), strict=True)
        yield [Chunk(chosen, tuple(case_or_reason(grid, place) for place in places))]


def chained_steps(
    grid: Grid, waiting: np.ndarray, size: int, directions: Sequence[str], recorded: Recorded
) -> Iterator[list[Chunk]]:
    """Step after step along the first parameter, each case from the final state of its neighbour.

    Numbers of cases run over the grid and, fastest, over the directions. A step waits until the one before it
    is recorded. After a case that failed the chain goes on from the last state available.
    """
    shape = (*grid.shape, len(directions))
    lanes = [(place, d) for place in np.ndindex(*grid.shape[1:]) for d in range(len(directions))]
    states = np.full((len(lanes), grid.batch.states), np.nan)
    behind: list[tuple[tuple[int, ...], int] | None] = [None] * len(lanes)  # last place done, and its period
    count = grid.shape[0]
    for step in range(count):
        places = [(step if directions[d] == "up" else count - 1 - step, *place) for place, d in lanes]
        numbers = np.array(
            [np.ravel_multi_index((*place, d), shape) for place, (_, d) in zip(places, lanes, strict=True)]
        )
        open_lanes = np.flatnonzero(waiting[numbers])
        chunks = []
        for part in range(0, len(open_lanes), size):
            chosen = open_lanes[part : part + size]
            chosen = chosen[np.argsort(numbers[chosen])]
            cases = tuple(case_or_reason(grid, places[i]) for i in chosen)
            ways = tuple(_way(grid, behind[i], places[i]) for i in chosen)
            chunks.append(Chunk(numbers[chosen], cases, states[chosen], ways))
        yield chunks
        status, final, period = recorded(numbers)
        good = status == DONE
        room = max(0, final.shape[1] - states.shape[1])  # a record has the states of its own structures
        states = np.pad(states, ((0, 0), (0, room)), constant_values=np.nan)
        states[good, : final.shape[1]] = final[good]
        for lane in np.flatnonzero(good):
            behind[lane] = places[lane], int(period[lane])


def _way(
    grid: Grid, behind: tuple[tuple[int, ...], int] | None, place: tuple[int, ...]
) -> NeighbourWay | None:
    """The way along the first parameter from the last place that was done."""
    if behind is None:
        return None
    last, period = behind
    values = [float(value) for value in grid.axes[0].values]
    return NeighbourWay(
        grid.case(last), values[last[0]], values[place[0]], period, (min(values), max(values))
    )


def case_or_reason(grid: Grid, place: Sequence[int]) -> Any:
    """The case at a place of the grid, or why there is none."""
    try:
        return grid.case(place)
    except InputError as error:
        return str(error)


def _by_table(grid: Grid) -> np.ndarray:
    """Numbers of all cases, ordered so that axes which change what cases share run slowest."""
    axes = range(len(grid.shape))
    order = sorted(axes, key=lambda axis: not (grid.shape[axis] > 1 and grid.changes_what_is_shared(axis)))
    return np.arange(np.prod(grid.shape)).reshape(grid.shape).transpose(order).ravel()
