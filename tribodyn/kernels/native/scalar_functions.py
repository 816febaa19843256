"""Elementary functions of one number or table where the C library has none, or none as fast."""

import math


def log1p(x):
    """log(1 + x) with the rounding of the sum put right: half the time of the C library's."""
    shifted = 1.0 + x
    return math.log(shifted) + (x - (shifted - 1.0)) / shifted


def expm1(x):
    """exp(x) − 1: Taylor's series to x¹³ where the difference would cancel, exact to rounding."""
    if abs(x) > 0.35:
        return math.exp(x) - 1.0
    square = x * x
    low = 1.0 + x * (1 / 2) + square * (1 / 6 + x * (1 / 24))
    middle = 1 / 120 + x * (1 / 720) + square * (1 / 5040 + x * (1 / 40320))
    high = 1 / 362880 + x * (1 / 3628800) + square * (1 / 39916800 + x * (1 / 479001600))
    high = high + square * square * (1 / 6227020800)
    fourth = square * square
    return x * (low + fourth * (middle + fourth * high))


def last_at_or_below(grid, x):
    """Index of the last grid value ≤ x, see `elementary.last_at_or_below`; by halving."""
    low, high = 0, grid.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if grid[middle] <= x:
            low = middle
        else:
            high = middle
    return low


def last_axis_of_four(table, a, b, c, d):
    """The four neighbours on the last axis, see `elementary.last_axis_of_four`."""
    return table[a, b, c, d, 0], table[a, b, c, d, 1], table[a, b, c, d, 2], table[a, b, c, d, 3]
