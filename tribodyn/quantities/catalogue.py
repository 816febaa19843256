"""All reported quantities by name, and their scatter over samples."""

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.quantities import drive_cycle, load, loss_map, losses, motion, single_studies
from tribodyn.quantities.quantity import Quantity

EVERY = (
    *(*motion.QUANTITIES, *losses.QUANTITIES, *load.QUANTITIES, *single_studies.QUANTITIES),
    *(*load.OF_SHAFTS, *motion.SIGNALS, *single_studies.WEAR, *loss_map.QUANTITIES),
    *drive_cycle.QUANTITIES,
)
QUANTITIES: Mapping[str, Quantity] = {quantity.name: quantity for quantity in EVERY}


def quantities(*names: str) -> tuple[Quantity, ...]:
    """Quantities of the catalogue by name."""
    return tuple(QUANTITIES[name] for name in names)


def scatter_of(name: str) -> Quantity:
    """Percentiles of a quantity over samples of what is not known."""
    return QUANTITIES[name]._replace(
        name=f"{name}_spread",
        label=f"{QUANTITIES[name].label}, over samples: median, 5, 95 %",
        digits=".3f",
        definition="Percentiles of the same over the samples of an assessment.",
        symbol="",
        below="over samples: median, 5, 95 %",
        listed=True,
    )


#: What is said of a scatter: percentiles.
SPREAD = {"median": 50.0, "p5": 5.0, "p95": 95.0}


def scatter(values: Any, over: tuple[int, ...] | None = None) -> dict[str, Any]:
    """Median, 5 and 95 % of values over axes, by default all, linear between samples.

    NaN is left out; the result is NaN where nothing else is left.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # no sample is known
        percentiles = np.nanpercentile(np.asarray(values, dtype=float), list(SPREAD.values()), axis=over)
    return dict(zip(SPREAD, percentiles, strict=True))
