"""Maps of a page: a quantity of one pair over its roll angle and the face."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.post.page.series import in_engineers_units, packed
from tribodyn.record.reader import Record


class PageMap(NamedTuple):
    """A map as a study describes it."""

    name: str  # of the dataset
    roll: np.ndarray  # (positions,); roll angle of the pair from the pitch point, rad
    face: np.ndarray  # (slices,); place on the face from its middle, m
    values: np.ndarray  # (positions, slices); SI; NaN: left blank
    top: float = 100.0  # percentile of the values at the top of the scale of colours


def as_data(record: Record, found: PageMap) -> dict[str, Any]:
    """A map as the page reads it, in engineers' units."""
    values, unit = in_engineers_units(found.values, record.units(found.name))
    return {
        "name": found.name,
        "title": f"{record.long_name(found.name)}, of one pair from entry to exit",
        "unit": unit,
        "x": packed(np.degrees(found.roll)),
        "y": packed(found.face * 1e3),
        "z": packed(values.T),
        "top": float(np.nanpercentile(values, found.top)) if np.any(np.isfinite(values)) else 0.0,
    }
