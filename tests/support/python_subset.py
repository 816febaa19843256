"""Functions in the Python that kernels are written in, one for each of its meanings that C has otherwise."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import (
    absolute,
    exp,
    expm1,
    last_at_or_below,
    log,
    log1p,
    maximum,
    minimum,
    sqrt,
    truncate,
    where,
)

WEIGHTS = (0.5, -1.25, 2.0)
TABLE = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
_FACTOR = 3.5


class Point(NamedTuple):
    """A point and what it is multiplied with."""

    x: Any
    y: Any
    scale: Any = 2.0


class Held(NamedTuple):
    """A record in a record, and a function."""

    point: Any
    function: Any
    rows: Any


def whole_numbers(a, b, c):
    """Division and remainder of whole numbers are rounded down, and / gives a float."""
    halves = -a // b, -a % b, a // b, a % b
    return (*halves, (a + c) / b, a - b - c, a - (b - c), a * (b + c), min(a, b, c), abs(a))


def floats(x, y):
    """Remainders, powers, signs."""
    return x % y, x // y, absolute(x) ** 1.5, absolute(x) ** 2, -(0.0 - x), x - (y - x), x / (y / x), 2**3 * x


def elementary_functions(x):
    """The elementary functions, of small and of large numbers."""
    small = 1e-9 * x
    return (
        exp(x), log(absolute(x) + 1.0), log1p(small), expm1(small), sqrt(absolute(x)), truncate(absolute(x)),
        minimum(x, 1.0), maximum(x, 1), minimum(x, float("nan")), where(x > 0.0, x, -1.0),
    )  # fmt: skip


def truths(x, y):
    """Chained comparisons, and what stands to the right is left out where the left decides."""
    inside = 0.0 <= x < y <= 2.0
    either = x > 1.0 or (y > 1.0 and not inside)
    both = (x > 0.0) & (y > 0.0) | inside
    return (
        1.0 if inside else 0.0,
        1.0 if either else 0.0,
        1.0 if both else 0.0,
        x if x > y else y if y > 0 else 0,
    )


def branches(x, n):
    """Variables get their first value in a branch; an early return."""
    if x > 2.0:
        return x, -1.0
    if n > 2:
        found, other = x, 1
    elif n > 1:
        found, other = 2.0 * x, 2.5
    else:
        found, other = 0.0, n
    return found, other * 1.0


def loops(n, y):
    """Ranges with a step, break, continue, while, a loop's variable that is changed and read behind it."""
    total = 0
    for i in range(n - 1, -1, -2):
        total = total * 10 + i
    last = 0
    for i in range(n):
        if i == 3:
            continue
        if i > 5:
            break
        last = last * 10 + i
        i = 100 * i
        total += i
    reached = i
    count = 0.0
    while count < n:
        count += 1.5
    for k in range(n):
        for j in range(k):
            y[j] += k
    for i in range(len(WEIGHTS)):
        y[i] += WEIGHTS[i] * _FACTOR
    return total, last, reached, count


def endless(x):
    """A loop that only a return leaves, and one of a single turn."""
    for i in range(1):
        x = x + i
    while True:
        x = 2.0 * x
        if x > 100.0:
            return x


def one_name_for_several(n, y):
    """A name that is a float first, then a whole number, then a record."""
    for i in range(n):
        x = 0.5 * i
        y[i] += x
    for i in range(n):
        x = i // 2
        y[x] += 1.0
    x = Point(y[0], y[1])
    return x.x * x.scale, x.y


def exchanged(a, b, y):
    """Variables and elements change places."""
    a, b = b, a
    y[0], y[1] = y[1], y[0]
    a, b = a + b, a - b
    return a, b


def _mean(point, extra=1.0, *, factor=1.0):
    return factor * (point.x + point.y) / 2.0 + extra


def _with(scale):
    def scaled(point):
        return scale * point.x - point.y

    return scaled


SCALED = _with(7.0)


def records(x, y):
    """Named tuples made, changed and handed on; defaults, keywords, functions in records."""
    point = Point(x, y)
    moved = point._replace(y=3.0)
    held = Held(moved, _mean, TABLE)
    first, second, scale = moved
    rows = held.rows[1]
    total = held.function(held.point, factor=2.0) + _mean(point) + SCALED(point) + rows[-1] + rows[1]
    return total, first, second, scale, held.point.y


def tuples(x):
    """Tuples joined and taken apart."""
    low = x, 2.0 * x
    both = (*low, 3.0)
    first, _, _ = both[:1] + low
    return (first, *both)


def parts(n, y, work):
    """Rows and parts of arrays."""
    row, rest = work[1], work[1:]
    for i in range(work.shape[1]):
        row[i] = 10.0 * n + i
        rest[1, i] -= 1.0
    y[y.shape[0] - 1] = work[n, -1]
    tail = y[2:]
    tail[0] = 5.0
    return last_at_or_below(y, 1.5)


def _changes(y):
    y[0] += 1.0
    return y[0]


def effects(y):
    """Calls that change arrays, in an expression, in a condition, and for nothing."""
    total = _changes(y) + 10.0 * _changes(y)
    total += y[0] * _changes(y) + max(y[0], _changes(y), y[0] - 1.0)
    if y[0] > 100.0 and _changes(y) > 0.0:
        total += 1.0
    _changes(y)
    _unused = _changes(y)
    both = _changes(y) if y[0] > 0.0 else 0.0
    return total, both
