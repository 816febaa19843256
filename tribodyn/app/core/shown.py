"""What is computed as plain data with units: rows of quantities, tables, curves."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from tribodyn.cases.results import TextTable
from tribodyn.quantities.quantity import Quantity, Reported

Row = dict[str, Any]


def row_of(quantity: Quantity, value: Any, heading: str = "") -> Row:
    """A quantity with its value in the unit in which it is shown; an array keeps all of its numbers."""
    number = None
    if isinstance(value, (int, float, np.number)) and not isinstance(value, bool):
        number = float(quantity.in_unit(float(value)))
        number = number if math.isfinite(number) else None
    return {
        "name": quantity.name,
        "label": quantity.label,
        "symbol": quantity.symbol,
        "unit": quantity.unit,
        "value": number,
        "text": quantity.written(value),
        "definition": quantity.definition,
        "heading": heading,
    }


def rows_of(reported: Reported, summary: Mapping[str, Any]) -> list[Row]:
    """Rows of all reported quantities that a summary has."""
    return [
        row_of(quantity, summary[quantity.name], heading)
        for heading, some in reported.items()
        for quantity in some
        if summary.get(quantity.name) is not None
    ]


def tables_of(tables: Sequence[TextTable]) -> list[dict[str, Any]]:
    """Tables of texts."""
    return [
        {"title": table.title, "columns": list(table.columns), "rows": [list(row) for row in table.rows]}
        for table in tables
    ]


def harmonics(values: np.ndarray, count: int) -> np.ndarray:
    """Amplitudes of the first harmonics of values evenly over one cycle, last axis."""
    lines = np.abs(np.fft.rfft(values, axis=-1)) * 2.0 / values.shape[-1]
    return lines[..., 1 : count + 1]
