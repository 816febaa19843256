"""Motions without period, marched along values of a parameter that do not depend on those asked for."""

from collections.abc import Generator

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.branch.continued_family import Answer, Carry, Request
from tribodyn.solve.orbit.result import FAILED

#: Values in a factor of two of the parameter, and periods at each of them.
VALUES, CARRIED = 256, 96


def carried(
    state: Float[Array, " state"], start: float, target: float
) -> Generator[Request, Answer, Float[Array, " state"]]:
    """The state of a motion without period, marched along the values between two."""
    for value in between(start, target):
        orbit, *_ = yield Carry(value, state, CARRIED)
        if orbit.kind == FAILED:
            break
        state = orbit.last
    return state


def between(start: float, target: float) -> list[float]:
    """Values between two, the same whatever these are: `VALUES` in every factor of two, in order of going."""
    if start == target or start * target <= 0.0:
        return []
    size = min(abs(start), abs(target))
    values: list[float] = []
    low, high = sorted((start, target))
    exponent = int(np.floor(np.log2(size)))
    while 2.0**exponent <= max(abs(start), abs(target)):
        part = np.sign(start) * 2.0**exponent * (1.0 + np.arange(VALUES) / VALUES)
        values += [float(one) for one in part if low < one < high]
        exponent += 1
    return sorted(values, reverse=bool(target < start))
