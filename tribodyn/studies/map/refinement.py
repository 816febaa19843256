"""Nodes of a grid between which linear interpolation holds a share of the loss."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.loss_map import GridValues

#: A drag below this share of the largest over the torque, at its speed and temperature, counts as that.
FLOOR = 0.02
#: Share of the accuracy that each axis may use: the misses of three add up in the middle of a cell.
EACH = 0.5
#: How often an interval that was asked for is halved at most: what jumps stays, and is reported.
HALVINGS = 10
#: Places along the other axes at which the middle of an interval is tried.
LINES = 8
#: Points in between that are checked, twice: a share of the nodes, at least and at most.
CHECKED, FEWEST, MOST = 0.03, 60, 400
_ROUNDS = 40

Drag = Callable[[Float[Array, "point axis"]], Float[Array, " point"]]
Axes = tuple[Float[Array, " node"], ...]
Interval = tuple[int, float, float]
"""Axis, and its ends."""


class RefinedGrid(NamedTuple):
    """Axes of a grid, and by how much interpolation misses the drag at points that it does not rest on."""

    axes: Axes
    error_max: float  # share of the drag, see `FLOOR`
    error_mean: float  # over points that lie evenly between the ends of all axes
    checked: int  # points


def nodes_of(axes: Sequence[Float[Array, " node"]]) -> Float[Array, "point axis"]:
    """All nodes, the last axis changing fastest."""
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))


def refined(axes: Sequence[Float[Array, " node"]], drag: Drag, accuracy: float, most: int) -> RefinedGrid:
    """Halve intervals of the axes until interpolation holds the accuracy, or the grid has its most nodes.

    With an accuracy of 0 the axes stay. The first axis is that of the torque. What is drawn at random comes
    from a seed: the same call gives the same grid.
    """
    return _Refinement(axes, drag, accuracy, most).run()


class _Refinement:
    def __init__(self, axes: Sequence[Float[Array, " node"]], drag: Drag, accuracy: float, most: int) -> None:
        self.axes: Axes = tuple(np.asarray(axis, float) for axis in axes)
        self.drag, self.accuracy, self.most = drag, accuracy, most
        self.narrowest = [{(a, b): (b - a) * 0.5**HALVINGS for a, b in pairwise(axis)} for axis in self.axes]
        self.missed: dict[Interval, float] = {}
        self.random = np.random.default_rng(1)

    def run(self) -> RefinedGrid:
        misses = np.empty(0)
        for _ in range(_ROUNDS):
            values = self._values()
            if self.accuracy:
                self._try(values)
                wide = {gap: miss for gap, miss in self.missed.items() if self._present(gap)}
                if self._halve({gap: miss for gap, miss in wide.items() if miss > EACH * self.accuracy}):
                    continue
            points, misses = self._check(values)
            bad = misses > self.accuracy
            if (
                not self.accuracy
                or not np.any(bad)
                or not self._halve(self._behind(values, points[bad], misses[bad]))
            ):
                break
        evenly = misses[len(misses) // 2 :]
        largest, mean = (float(np.max(misses)), float(np.mean(evenly))) if len(misses) else (0.0, 0.0)
        return RefinedGrid(self.axes, largest, mean, len(misses))

    def _values(self) -> Float[Array, "..."]:
        return self.drag(nodes_of(self.axes)).reshape([len(axis) for axis in self.axes])

    def _misses(
        self, values: Float[Array, "..."], points: Float[Array, "point axis"]
    ) -> Float[Array, " point"]:
        """Shares of the drag by which interpolation misses it at points."""
        exact = self.drag(points)
        between = GridValues(self.axes, values)(*points.T)
        largest = GridValues(self.axes[1:], np.max(np.abs(values), axis=0))(*points[:, 1:].T)
        size = np.maximum(np.abs(exact), FLOOR * largest)
        return np.abs(between - exact) / np.where(size > 0.0, size, 1.0)

    def _try(self, values: Float[Array, "..."]) -> None:
        """Try the middle of every interval that has not been tried."""
        places, gaps = [], []
        for k, axis in enumerate(self.axes):
            others = [np.arange(len(other)) for other in self.axes]
            for a, b in pairwise(axis):
                if (k, a, b) in self.missed:
                    continue
                others[k] = np.zeros(1, dtype=int)
                lines = nodes_of(others).astype(int)
                if len(lines) > LINES:  # both ends of all axes, and others at random
                    chosen = self.random.choice(len(lines), LINES - 2, replace=False)
                    lines = lines[np.unique([0, len(lines) - 1, *chosen])]
                points = np.stack([other[at] for other, at in zip(self.axes, lines.T, strict=True)], axis=1)
                points[:, k] = 0.5 * (a + b)
                places.append(points)
                gaps += [(k, a, b)] * len(points)
        if not gaps:
            return
        for gap, miss in zip(gaps, self._misses(values, np.concatenate(places)), strict=True):
            self.missed[gap] = max(self.missed.get(gap, 0.0), float(miss))

    def _check(
        self, values: Float[Array, "..."]
    ) -> tuple[Float[Array, "point axis"], Float[Array, " point"]]:
        """Points drawn at random, and by how much interpolation misses there.

        Within cells that are drawn first, small ones as often as large ones; then as many evenly over all.
        """
        cells = [max(len(axis) - 1, 1) for axis in self.axes]
        count = int(np.clip(CHECKED * values.size, FEWEST, MOST))
        if values.size == 1:
            return np.empty((0, len(cells))), np.empty(0)
        points = np.empty((2 * count, len(cells)))
        for k, (axis, number) in enumerate(zip(self.axes, cells, strict=True)):
            low = self.random.integers(number, size=count)
            share = self.random.uniform(0.25, 0.75, size=count)
            inside = axis[low] + share * (axis[low + 1] - axis[low]) if len(axis) > 1 else axis[low]
            points[:, k] = np.concatenate([inside, self.random.uniform(axis[0], axis[-1], size=count)])
        return points, self._misses(values, points)

    def _behind(
        self,
        values: Float[Array, "..."],
        points: Float[Array, "point axis"],
        misses: Float[Array, " point"],
    ) -> dict[Interval, float]:
        """Of cells that miss at points the interval that misses most by itself, the others at a node."""
        along = []
        for k, axis in enumerate(self.axes):
            moved = np.stack(
                [
                    other[np.argmin(np.abs(points[:, [n]] - other), axis=1)]
                    for n, other in enumerate(self.axes)
                ],
                axis=1,
            )
            moved[:, k] = points[:, k]
            along.append(self._misses(values, moved) if len(axis) > 1 else np.zeros(len(points)))
        found: dict[Interval, float] = {}
        for point, miss, k in zip(points, misses, np.argmax(along, axis=0), strict=True):
            axis = self.axes[k]
            left = int(np.clip(np.searchsorted(axis, point[k], side="right") - 1, 0, len(axis) - 2))
            gap = int(k), float(axis[left]), float(axis[left + 1])
            found[gap] = max(found.get(gap, 0.0), float(miss))
        return found

    def _present(self, gap: Interval) -> bool:
        axis = self.axes[gap[0]]
        left = int(np.searchsorted(axis, gap[1]))
        return axis[left] == gap[1] and left + 1 < len(axis) and axis[left + 1] == gap[2]

    def _may_be_halved(self, gap: Interval) -> bool:
        k, a, b = gap
        return any(
            lo <= a and b <= hi and b - a > 1.5 * least for (lo, hi), least in self.narrowest[k].items()
        )

    def _halve(self, gaps: dict[Interval, float]) -> bool:
        """Halve intervals, the worst first, as far as the nodes go; whether any was."""
        sizes, further = [len(axis) for axis in self.axes], [[] for _ in self.axes]
        for gap in sorted(gaps, key=lambda gap: -gaps[gap]):
            k, a, b = gap
            nodes = np.prod(sizes) / sizes[k] * (sizes[k] + 1)
            if nodes <= self.most and self._may_be_halved(gap):
                further[k].append(0.5 * (a + b))
                sizes[k] += 1
        self.axes = tuple(
            np.sort(np.concatenate([axis, more])) for axis, more in zip(self.axes, further, strict=True)
        )
        return any(further)
