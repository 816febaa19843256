"""Load cycles in a course of stress: rain-flow counting by four points, as ASTM E1049-85 counts."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float


class LoadCycle(NamedTuple):
    """A closed hysteresis loop, or half of one."""

    low: float
    high: float
    share: float  # 1, of a half cycle 1/2

    @property
    def range(self) -> float:
        """Of the stress."""
        return self.high - self.low


def rainflow(course: Sequence[float] | Float[Array, " sample"]) -> list[LoadCycle]:
    """Cycles of a course that is passed once.

    Of four reversals in a row the inner two are a cycle where their range is not larger than both beside it;
    they are taken out. What is left grows and shrinks, and counts as half cycles: ASTM E1049-85, 5.4.4.
    """
    cycles, rest = list[LoadCycle](), list[float]()
    for point in reversals(course):
        rest.append(point)
        while len(rest) >= 4:
            before, first, second, after = rest[-4:]
            inner = abs(second - first)
            if inner > abs(first - before) or inner > abs(after - second):
                break
            cycles.append(LoadCycle(min(first, second), max(first, second), 1.0))
            del rest[-3:-1]
    return cycles + [LoadCycle(min(a, b), max(a, b), 0.5) for a, b in pairwise(rest)]


def rainflow_repeated(course: Sequence[float] | Float[Array, " sample"]) -> list[LoadCycle]:
    """Cycles of one passage of a course that is repeated without end: it is begun at its maximum, 5.4.5."""
    values = np.asarray(course, dtype=float)
    if not values.size:
        return []
    begun = np.roll(values, -int(np.argmax(values)))
    return rainflow(np.append(begun, begun[0]))


def reversals(course: Sequence[float] | Float[Array, " sample"]) -> list[float]:
    """Ends of a course and the values at which it turns."""
    values = np.asarray(course, dtype=float)
    moving = np.append(True, np.diff(values) != 0.0)[: values.size]
    values = values[moving]
    if values.size < 3:
        return values.tolist()
    turns = np.sign(np.diff(values))
    return values[np.concatenate([[True], turns[1:] != turns[:-1], [True]])].tolist()
