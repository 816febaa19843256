"""The scatter of a quantity over samples."""

import warnings
from typing import Any

import numpy as np

#: What is said of a scatter: percentiles.
SPREAD = {"median": 50.0, "p5": 5.0, "p95": 95.0}


def scatter(values: Any, over: tuple[int, ...] | None = None) -> dict[str, Any]:
    """Median, 5 and 95 % of values over axes, by default all, linear between samples.

    NaN is left out; the result is NaN where nothing else is left.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # no sample is known
        found = np.nanpercentile(np.asarray(values, dtype=float), list(SPREAD.values()), axis=over)
    return dict(zip(SPREAD, found, strict=True))
