"""Losses of the rows of a drive cycle over the temperature: evaluated at some, interpolated between.

A mesh's losses are those at its own bulk temperature, all others those at the temperature of the oil.
"""

from collections.abc import Callable, Sequence

import numpy as np

from tribodyn.cases.loss_part import LossesOver, LossSource, OperatingPoints
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.drive_cycle.case import DutyRows
from tribodyn.tribology.oil import TEMPERATURE_RANGE

#: Distance of the temperatures at which losses are evaluated, K: what falls by e in 30 K is interpolated
#: within 1e-4 by the cubic through four of them.
KNOT = 10.0
_LOWEST = TEMPERATURE_RANGE[0]
_LAST = round((TEMPERATURE_RANGE[1] - _LOWEST) / KNOT)


class WarmLosses:
    """Losses of the rows; temperatures are added when they are asked for."""

    def __init__(
        self,
        losses_at: Callable[[OperatingPoints], LossesOver],
        rows: DutyRows,
        meshes: Sequence[str],
        start: float,
    ) -> None:
        self._losses_at, self._meshes = losses_at, meshes
        duties = np.stack([rows.speed, rows.load], axis=1)
        self._duties, number = np.unique(duties, axis=0, return_inverse=True)
        self._number = number.ravel()  # of the duty of each row
        self._low = min(max(int((start - _LOWEST) // KNOT) - 1, 0), _LAST - 3)
        self.sources: tuple[LossSource, ...] = ()
        self._values = self._evaluate(range(self._low, self._low + 4))
        #: of each row and source: the loss that was found over the interpolated one
        self.correction = np.ones((len(rows.time), len(self.sources)))
        columns = {name: column for column, name in enumerate(meshes)}
        #: of each source the number of the temperature that it goes by: of a mesh, or behind those the oil's
        self.goes_by = np.array(
            [columns[source.element] if source.term == "P_VZP" else len(meshes) for source in self.sources]
        )

    def _evaluate(self, knots: range) -> Float[Array, "knot duty source"]:
        count, at = len(self._duties), _LOWEST + KNOT * np.array(knots, dtype=float)
        speed, load = np.tile(self._duties, (len(at), 1)).T
        oil = np.repeat(at, count)
        bulk = np.repeat(oil[:, None], len(self._meshes), axis=1)
        losses = self._losses_at(OperatingPoints(load, speed, oil, bulk))
        self.sources = losses.sources
        return losses.power(speed).reshape(len(at), count, -1)

    def power(
        self, row: int, share: float, temperatures: Float[Array, "point source"]
    ) -> Float[Array, "point source"]:
        """Losses, W, of a share of the way from a row to the next one, each source at its temperature, K."""
        place = np.clip((temperatures - _LOWEST) / KNOT, 0.0, _LAST)
        self._reach(float(place.min()), float(place.max()))
        values = self._of_row(row) * (1.0 - share)
        if share:
            values = values + self._of_row(min(row + 1, len(self._number) - 1)) * share
        begin = np.clip(np.floor(place).astype(int) - 1 - self._low, 0, len(values) - 4)
        along = place - self._low - begin
        columns = np.arange(values.shape[1])
        terms = [_weight(number, along) * values[begin + number, columns] for number in range(4)]
        return np.sum(terms, axis=0)

    def _of_row(self, row: int) -> Float[Array, "knot source"]:
        return self._values[:, self._number[row]] * self.correction[row]

    def _reach(self, low: float, high: float) -> None:
        """Evaluate further temperatures, where places between them lie beyond."""
        last = self._low + len(self._values) - 1
        first = max(int(np.floor(low)) - 1, 0)
        if first < self._low:
            self._values = np.concatenate([self._evaluate(range(first, self._low)), self._values])
            self._low = first
        end = min(int(np.floor(high)) + 2, _LAST)
        if end > last:
            self._values = np.concatenate([self._values, self._evaluate(range(last + 1, end + 1))])


def _weight(number: int, along: Float[Array, "..."]) -> Float[Array, "..."]:
    """Weight of one of four equidistant values in the cubic through them."""
    others = [other for other in range(4) if other != number]
    weight = np.ones_like(along)
    for other in others:
        weight = weight * (along - other) / (number - other)
    return weight
