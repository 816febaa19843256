"""In which order the cases of a sweep are done, and from which state each begins."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.record.sweep_schema import DONE
from tribodyn.studies.sweeping.batch import Chunk, NeighbourWay
from tribodyn.sweep.grid import Grid

#: Gives what was recorded of cases: (numbers) -> statuses (n,), states (n, …), periods of the motion (n,).
Recorded = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


def single_steps(grid: Grid, waiting: np.ndarray, size: int) -> Iterator[list[Chunk]]:
    """All cases on their own, in one step; those that share costly work one after the other.

    Parameters
    ----------
    waiting : (cases,) bool, which are still to be done
    size : cases in a chunk
    """
    numbers = _by_table(grid)
    numbers = numbers[waiting[numbers]]
    for part in range(0, len(numbers), size):
        chosen = np.sort(numbers[part : part + size])
        yield [Chunk(chosen, tuple(case_or_reason(grid, number) for number in chosen))]


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
            cases = tuple(case_or_reason(grid, grid.flat(places[i])) for i in chosen)
            ways = tuple(_way(grid, behind[i], places[i]) for i in chosen)
            chunks.append(Chunk(numbers[chosen], cases, states[chosen], ways))
        yield chunks
        status, final, period = recorded(numbers)
        good = status == DONE
        states[good] = final[good]
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


def case_or_reason(grid: Grid, number: int) -> Any:
    """The case of a number of the grid, or why there is none."""
    try:
        return grid.case(np.unravel_index(number, grid.shape))  # pyright: ignore[reportArgumentType]
    except InputError as error:
        return str(error)


def _by_table(grid: Grid) -> np.ndarray:
    """Numbers of all cases, ordered so that axes which change what cases share run slowest."""
    axes = range(len(grid.shape))
    order = sorted(axes, key=lambda axis: not (grid.shape[axis] > 1 and grid.changes_what_is_shared(axis)))
    return np.arange(np.prod(grid.shape)).reshape(grid.shape).transpose(order).ravel()
