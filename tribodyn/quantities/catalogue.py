"""All reported quantities, as `quantities.csv` lists them, and their scatter over samples."""

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.numerics.files.rows import table_rows
from tribodyn.quantities.quantity import Quantity


def _listed() -> dict[str, tuple[Quantity, ...]]:
    """Quantities by group, both in the order of the file; cells that are empty are left to the defaults."""
    groups: dict[str, tuple[Quantity, ...]] = {}
    for row in table_rows(__package__, "quantities.csv"):
        group = row.pop("group")
        cells: dict[str, Any] = {name: name == "listed" or cell for name, cell in row.items() if cell}
        groups[group] = (*groups.get(group, ()), Quantity(**cells))
    return groups


#: Group, such as those of one study or of one standard -> its quantities.
GROUPS: Mapping[str, tuple[Quantity, ...]] = _listed()
EVERY = tuple(quantity for group in GROUPS.values() for quantity in group)
QUANTITIES: Mapping[str, Quantity] = {quantity.name: quantity for quantity in EVERY}


def quantities(*names: str) -> tuple[Quantity, ...]:
    """Quantities of the catalogue by name."""
    return tuple(QUANTITIES[name] for name in names)


#: What tables say of a mesh whose shafts tilt, and of the modification that is proposed for it.
OF_FACE = (*quantities("deflected_misalignment", "face_load_factor", "load_centre"), *GROUPS["proposed"])


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
