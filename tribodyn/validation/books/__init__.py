"""Listings of other programs and of standards, number by number as printed, and our values beside them."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from tribodyn.validation.published import published
from tribodyn.validation.rows import Row, compare

#: Our value of a line, in its unit: one, or (pinion, gear); of a name that is not there none is computed.
Values = Mapping[str, float | tuple[float, float]]


def rows_of(book: str, values: Callable[[], Values]) -> Callable[..., list[Row]]:
    """Return the function that compares every row of a book with our values.

    It is called as the `rows` of a paper; nothing needs a run, and nothing is written into its folder.
    """

    def rows(folder: Path, progress: Callable[[float], None] | None = None) -> list[Row]:
        ours = values()
        comparisons = [compare(row, _value(ours, key)) for key, row in published(book).items()]
        if progress:
            progress(1.0)
        return comparisons

    return rows


def _value(values: Values, key: str) -> Any:
    name = key.partition("/")[2]
    if name in values:
        return values[name]
    name, _, side = name.rpartition("-")
    value = values.get(name)
    return value[side == "gear"] if isinstance(value, tuple) else value
