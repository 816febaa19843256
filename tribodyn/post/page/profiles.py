"""Profiles of a page: quantities over a place, at the sample under the cursor."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.post.page.series import in_engineers_units, packed
from tribodyn.record.reader import Record


class Profile(NamedTuple):
    """A quantity that a page shows over a place, as a study describes it."""

    name: str  # of the dataset, over the record's axis and the place
    top: float | None = None  # upper end of its axis, SI; None: its maximum


class Profiles(NamedTuple):
    """What a page shows at the sample under the cursor."""

    title: str  # heading of the section
    #: place, label: scale that the profiles are over, and what is said of it at the axis
    place: str
    label: str
    rows: Sequence[Profile]


def as_data(record: Record, found: Profiles) -> dict[str, Any]:
    """Profiles as the page reads them, in engineers' units; samples × places, row after row."""
    rows = []
    for one in found.rows:
        values, unit = in_engineers_units(np.asarray(record[one.name]), record.units(one.name))
        finite = values[np.isfinite(values)]
        top = float(finite.max()) if finite.size else 1.0
        if one.top is not None and top > 0.0:
            top *= one.top / float(np.nanmax(record[one.name]))
        rows.append(
            {
                "name": one.name,
                "title": record.long_name(one.name),
                "unit": unit,
                "low": min(float(finite.min()), 0.0) if finite.size else 0.0,
                "high": top,
                "y": packed(values),
            }
        )
    return {"title": found.title, "label": found.label, "x": packed(record[found.place]), "rows": rows}
