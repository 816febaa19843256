"""Listings of other programs and of standards, number by number as printed, and our values beside them."""

from collections.abc import Mapping
from typing import Any

from tribodyn.validation.rows import Row, compare, published

#: Our value of a line, in its unit: one, or (pinion, gear); of a name that is not there none is computed.
Values = Mapping[str, float | tuple[float, float]]


def book_rows(book: str, values: Values, otherwise: tuple[str, Values] | None = None) -> list[Row]:
    """Every row of a book compared with our values, some also with those under another choice."""
    found = []
    for key, row in published(book).items():
        other = None if otherwise is None else _value(otherwise[1], key)
        beside = None if otherwise is None or other is None else (otherwise[0], other)
        found.append(compare(row, _value(values, key), "", beside))
    return found


def _value(values: Values, key: str) -> Any:
    name = key.partition("/")[2]
    if name in values:
        return values[name]
    name, _, side = name.rpartition("-")
    found = values.get(name)
    return found[side == "gear"] if isinstance(found, tuple) else found
