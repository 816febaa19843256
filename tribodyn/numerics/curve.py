"""A function given by points: monotone C¹ interpolation without overshoot or extrapolation."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import is_jax, namespace
from tribodyn.numerics.shapes import Array, Float

Table = tuple[NDArray[np.float64], NDArray[np.float64]]
"""(abscissae, strictly increasing; ordinates), both in SI units."""


def monotone_slopes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Slopes at the points of the cubic Hermite curve that is monotone where the data are.

    F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300.
    """
    from scipy.interpolate import PchipInterpolator

    return PchipInterpolator(x, y)(x, 1)


def interpolate(x: np.ndarray, y: np.ndarray, at: Float[Array, "..."]) -> Float[Array, "..."]:
    """Value of the curve through (x, y) at `at`, which must lie inside and may be traced."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    xp = namespace(at)
    cell = xp.clip(xp.searchsorted(x, at, side="right") - 1, 0, len(x) - 2)
    points, values, rates = xp.asarray(x), xp.asarray(y), xp.asarray(monotone_slopes(x, y))
    step = points[cell + 1] - points[cell]
    u = (at - points[cell]) / step
    start, end = values[cell], values[cell + 1]
    rise = end - start
    begin, finish = rates[cell] * step, rates[cell + 1] * step
    return start + u * (begin + u * (3 * rise - 2 * begin - finish + u * (begin + finish - 2 * rise)))


def check_cover(x: np.ndarray, first: Any, last: Any, key: str) -> None:
    """Refuse a table over roll angle that does not reach from the first to the last contact.

    Traced limits are not checked. Half a microradian is allowed, so that limits printed to six digits serve.
    Raises InputError with the range that is needed.
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
