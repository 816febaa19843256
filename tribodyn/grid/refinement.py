"""Further values of a sweep's first key, where the response bends.

After the first grid, rounds of further values halve intervals at whose ends a watched quantity departs from
the straight line between its neighbours. A round follows from what is recorded alone, so that a sweep which
was stopped goes on with the same values.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.grid.grid import Grid
from tribodyn.input.vary import MOST_VALUES, is_whole
from tribodyn.record.sweep_schema import DONE, SweepLayout
from tribodyn.record.sweep_writer import SweepWriter

REFINE, REFINE_BY = "--refine", "--refine-by"
#: A departure from the straight line by this share of the curve's range is a bend: what is drawn between the
#: values is then off by less, because half of an interval bends a quarter as much.
BEND = 0.01
#: An interval of the first grid is divided into this many parts at most, 2^6: jumps end there.
PARTS = 64
#: A round takes the intervals that bend at least this share of the worst: what it finds decides the next.
OF_THE_WORST = 0.25
#: The fewest values that show a bend.
FEWEST = 3


class Refinement(NamedTuple):
    """Up to `most` further values of the first key, where one of the quantities `by` bends."""

    most: int
    by: tuple[str, ...]

    def require_recorded(self, layout: SweepLayout) -> None:
        """Raise InputError where the cases of a sweep have none of a quantity that is watched."""
        for name in self.by:
            if name not in layout.variables:
                rule = "is not recorded: no case of this sweep has it"
                raise InputError(REFINE_BY, quoted(name), rule, "watch another quantity")

    def further(self, grid: Grid, first: Grid, record: SweepWriter) -> list[float]:
        """Values of the next round, SI, from what is recorded of the grid so far; none: it is fine enough."""
        values = np.array(grid.axes[0].values, dtype=float)
        begun = np.array(first.axes[0].values, dtype=float)
        numbers = np.arange(record.status.size)
        done = record.status == DONE
        score = np.zeros(len(values) - 1)
        for name in self.by:
            curves = np.where(done, record.read(name, numbers), np.nan).reshape(len(values), -1)
            for curve in curves.T:
                score = np.maximum(score, interval_bends(values, curve))
        score[np.abs(np.diff(values)) < 1.5 * _finest(values, begun)] = 0.0
        score[score < max(BEND, OF_THE_WORST * float(np.max(score)))] = 0.0
        # the worst first; of equal ones the first
        chosen = np.argsort(-score, kind="stable")[: np.count_nonzero(score)]
        left = self.most - (len(values) - len(begun))
        chosen = np.sort(chosen[: max(0, left)])
        return ((values[chosen] + values[chosen + 1]) / 2.0).tolist()


def interval_bends(values: np.ndarray, curve: np.ndarray) -> np.ndarray:
    """How much a curve bends at the ends of every interval, (n − 1,), as a share of its range.

    At a value it is the distance from the straight line between the two neighbours. Values that failed (NaN)
    are left out: their neighbours lie beside each other.
    """
    finite = np.flatnonzero(np.isfinite(curve))
    bends = np.zeros(len(values) - 1)
    x, y = values[finite], curve[finite]
    extent = float(np.ptp(y)) if len(y) else 0.0
    if len(x) < FEWEST or extent == 0.0:
        return bends
    line = y[:-2] + (y[2:] - y[:-2]) * (x[1:-1] - x[:-2]) / (x[2:] - x[:-2])
    for left, right, bend in zip(finite[:-2], finite[2:], np.abs(y[1:-1] - line) / extent, strict=True):
        bends[left:right] = np.maximum(bends[left:right], bend)
    return bends


def _finest(values: np.ndarray, first: np.ndarray) -> np.ndarray:
    """The narrowest interval allowed at each interval: a part of that of the first grid around it."""
    order = np.sign(first[-1] - first[0])
    around = np.searchsorted(order * first, order * (values[1:] + values[:-1]) / 2.0) - 1
    return np.abs(np.diff(first))[around] / PARTS


def refinement_of(grid: Grid, most: int | None, by: Sequence[str]) -> Refinement | None:
    """The refinement asked for, or none; InputError where the first key has no values between two others.

    By default the first quantity that such a sweep prints is watched.
    """
    if most is None:
        if by:
            raise InputError(REFINE_BY, by[0], f"says what {REFINE} watches", f"add {REFINE} 40")
        return None
    if most < 1:
        raise InputError(REFINE, most, "expected a number of values", "at least 1")
    axis = grid.axes[0]
    values = np.array(axis.values) if axis.numeric else np.empty(0)
    if not axis.numeric or is_whole(grid.study.table(), axis.key):
        raise InputError(REFINE, axis.key, "nothing lies between its values", "vary a quantity first")
    if len(values) < FEWEST or not (np.all(np.diff(values) > 0) or np.all(np.diff(values) < 0)):
        rule = f"bends show in at least {FEWEST} values in order"
        raise InputError(REFINE, f"{len(values)} values of {axis.key}", rule, "give a range of them")
    if len(values) + most > MOST_VALUES:
        raise InputError(REFINE, most, "too many values", f"at most {MOST_VALUES} with the first grid's")
    kept = grid.study.swept()
    for name in by:
        if name not in kept:
            raise unknown_name(REFINE_BY, name, kept, "quantity of such a sweep")
    return Refinement(most, tuple(dict.fromkeys(by)) or (next(iter(grid.study.sweep_table())).name,))


def grid_of(grid: Grid, refinement: Refinement | None, left: Sequence[float]) -> Grid:
    """The grid to go on with, where an unfinished sweep `left` these values of the first key."""
    first = grid.axes[0].values
    order = np.sign(np.diff(left)) if refinement else ()
    ours = len(first) <= len(left) <= len(first) + (refinement.most if refinement else 0)
    ends = ours and (left[0], left[-1]) == (first[0], first[-1])
    if ends and set(first) <= set(left) and len(set(order)) == 1:
        return grid.with_values(left)
    return grid


def begun_anew(grid: Grid, finer: Grid, directions: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """New places of the first key's old values, and which cases of the finer grid, (cases,), wait again.

    Of a sweep that is followed these are the ones next behind the further values: each goes on from the case
    that is now its neighbour, so that an end of a branch is recorded once, where it is.
    """
    values = np.array(finer.axes[0].values)
    old = np.isin(values, grid.axes[0].values)
    again = np.zeros((len(values), *finer.shape[1:], max(1, len(directions))), dtype=bool)
    for d, direction in enumerate(directions):
        after = np.roll(~old, 1 if direction == "up" else -1)  # neither end is a further value
        again[after & old, ..., d] = True
    return np.flatnonzero(old), again.ravel()
