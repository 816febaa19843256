"""Tolerances by the size of what is compared, for `pytest.approx` and `numpy.testing.assert_allclose`.

pytest adds an absolute 1e-12, which is more than a compliance in m/N. NumPy adds nothing, so that a sum which
cancels to almost zero had to be right in its own last digits, which no other BLAS or vector width repeats.
Here a number alone counts by its own size; one among others also by the rounding of the largest of them.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pytest

#: What pytest takes where nothing is said.
RELATIVE, ABSOLUTE = 1e-6, 1e-12
#: Rounding of the largest number that a smaller one beside it may carry; less where less is asked for.
ROUNDING = 1e-12
_approx, _assert_allclose = pytest.approx, np.testing.assert_allclose


def approx(expected: Any, rel: Any = None, abs: Any = None, nan_ok: bool = False) -> Any:
    """As `pytest.approx`, with `rounding` for the absolute tolerance; zeros alone keep its 1e-12."""
    if getattr(expected, "ndim", None) == 0 and hasattr(expected, "item"):
        expected = expected.item()
    if abs is None and (largest := _largest(expected)) is not None:
        rel = RELATIVE if rel is None else rel
        abs = rounding(expected, rel) if largest else ABSOLUTE
    return _approx(expected, rel=rel, abs=abs, nan_ok=nan_ok)


def assert_allclose(actual: Any, desired: Any, rtol: Any = 1e-7, atol: Any = None, **given: Any) -> None:
    """As `numpy.testing.assert_allclose`, with `rounding` for the absolute tolerance; `atol=0` adds none."""
    __tracebackhide__ = True
    _assert_allclose(actual, desired, rtol, rounding(desired, rtol) if atol is None else atol, **given)


def rounding(expected: Any, relative: float) -> float:
    """Absolute tolerance beside a relative one: nothing for a number alone, nor for anything but numbers."""
    alone = isinstance(expected, int | float | complex) or getattr(expected, "ndim", 1) == 0
    return 0.0 if alone else min(relative, ROUNDING) * (_largest(expected) or 0.0)


def _largest(expected: Any) -> float | None:
    """Magnitude of the largest number; None of anything else than numbers."""
    values = list(expected.values()) if isinstance(expected, Mapping) else expected
    if isinstance(values, str | bytes) or not isinstance(
        values, Iterable | int | float | complex | np.generic
    ):
        return None
    try:
        numbers = np.abs(np.atleast_1d(np.asarray(values)).astype(complex))
    except (TypeError, ValueError):
        return None
    finite = numbers[np.isfinite(numbers)]
    return float(finite.max()) if finite.size else 0.0
