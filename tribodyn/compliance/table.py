"""A user's curve, given by points: monotone C¹ interpolation without overshoot or extrapolation."""

from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import is_jax, namespace
from tribodyn.numerics.shapes import Array, Float


def monotone_slopes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Slopes at the points of a cubic Hermite curve that is monotone where the data are.

    Inside, the weighted harmonic mean of the neighbouring secants, zero at an extremum; at the ends a
    one-sided three-point rule, limited (F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300).
    """
    step = np.diff(x)
    secant = np.diff(y) / step
    if len(x) == 2:
        return np.repeat(secant, 2)
    slopes = np.zeros_like(y)
    before, after = secant[:-1], secant[1:]
    heavy, light = 2 * step[1:] + step[:-1], step[1:] + 2 * step[:-1]
    same = before * after > 0
    slopes[1:-1][same] = ((heavy + light)[same]) / (heavy[same] / before[same] + light[same] / after[same])
    for end, (near, far) in ((0, (0, 1)), (-1, (-1, -2))):
        guess = ((2 * step[near] + step[far]) * secant[near] - step[near] * secant[far]) / (
            step[near] + step[far]
        )
        if guess * secant[near] <= 0:
            guess = 0.0
        elif secant[near] * secant[far] <= 0 and abs(guess) > 3 * abs(secant[near]):
            guess = 3 * secant[near]
        slopes[end] = guess
    return slopes


def interpolate(x: np.ndarray, y: np.ndarray, at: Float[Array, "..."]) -> Float[Array, "..."]:
    """Value of the curve through (x, y) at `at`, which must lie inside; x increases strictly."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    slopes = monotone_slopes(x, y)
    xp = namespace(at)
    cell = xp.clip(xp.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    points, values, rates = xp.asarray(x), xp.asarray(y), xp.asarray(slopes)
    step = points[cell + 1] - points[cell]
    u = (at - points[cell]) / step
    start, end = values[cell], values[cell + 1]
    rise = end - start
    begin, finish = rates[cell] * step, rates[cell + 1] * step
    return start + u * (begin + u * (3 * rise - 2 * begin - finish + u * (begin + finish - 2 * rise)))


def check_cover(x: np.ndarray, first: Any, last: Any, key: str) -> None:
    """Refuse a table over roll angle that does not reach from the first to the last contact.

    Traced limits are not checked. Half a microradian is allowed, so that limits printed to six digits serve.

    Raises
    ------
    InputError
        With the range that is needed.
    """
    if is_jax(first) or is_jax(last):
        return
    if x[0] > first + 5e-7 or x[-1] < last - 5e-7:
        raise InputError(
            key,
            f"{x[0]:.6g} … {x[-1]:.6g} rad",
            f"the table does not cover the contact, from {first:.6g} to {last:.6g} rad of pinion rotation",
            "add points up to both ends (roll angle is counted from the pitch point)",
        )
