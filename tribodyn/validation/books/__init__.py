"""Listings of other programs and of standards, number by number as printed, and our values beside them."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from tribodyn.geometry.drive import SIDES
from tribodyn.validation.published import published
from tribodyn.validation.rows import Row, compare

#: Our value of a line, in its unit: one, or (pinion, gear); of a name that is not there none is computed.
Values = Mapping[str, float | tuple[float, float] | np.ndarray]


#: Remarks on rows by name, put before their reasons; called as `progress` with the share done.
Remarks = Callable[[Callable[[float], None]], Mapping[str, str]]


def rows_of(
    book: str, values: Callable[[], Values], remarks: Remarks | None = None
) -> Callable[..., list[Row]]:
    """Return the function that compares every row of a book with our values.

    It is called as the `rows` of a paper; nothing is written into its folder.
    """

    def rows(folder: Path, progress: Callable[[float], None]) -> list[Row]:
        ours, said = values(), remarks(progress) if remarks else {}
        progress(1.0)
        return [
            compare(row, _value(ours, key), said.get(key.partition("/")[2], ""))
            for key, row in published(book).items()
        ]

    return rows


def _value(values: Values, key: str) -> Any:
    name = key.partition("/")[2]
    if name not in values:
        name, _, side = name.rpartition("-")
        value: Any = values.get(name)
        return value if value is None or np.ndim(value) == 0 else float(value[int(side == "gear")])
    return values[name]


def printed(book: str) -> dict[str, Any]:
    """Numbers of a book as printed: what follows from one that differs is computed from it."""
    return {key.partition("/")[2]: row["published"] for key, row in published(book).items()}


def printed_sides(numbers: Mapping[str, Any], name: str) -> np.ndarray:
    """A printed number of pinion and gear."""
    return np.array([numbers[f"{name}-{side}"] for side in SIDES])


def sides(named: Mapping[str, Any], name: str, unit: float = 1.0) -> np.ndarray:
    """A number of a rating by name, of pinion and gear."""
    return np.array([named[name][side] for side in SIDES]) / unit
