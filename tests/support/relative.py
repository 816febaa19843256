"""`pytest.approx` with a relative tolerance alone: its absolute 1e-12 is more than a compliance in m/N."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pytest

#: What pytest takes where nothing is said.
RELATIVE, ABSOLUTE = 1e-6, 1e-12
_approx = pytest.approx


def approx(expected: Any, rel: Any = None, abs: Any = None, nan_ok: bool = False) -> Any:
    """As `pytest.approx`, but that a number counts by its own size, and a zero by that of those beside it."""
    if getattr(expected, "ndim", None) == 0 and hasattr(expected, "item"):
        expected = expected.item()
    if abs is None and (largest := _largest(expected)) is not None:
        alone = isinstance(expected, int | float | complex | np.generic)
        abs = 0.0 if alone and largest else ABSOLUTE * (largest or 1.0)
        rel = RELATIVE if rel is None else rel
    return _approx(expected, rel=rel, abs=abs, nan_ok=nan_ok)


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
