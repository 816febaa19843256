"""Values of the caller's as constants of a C file."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from tribodyn.kernels.c.lines import LONGEST
from tribodyn.kernels.c.types import (
    DOUBLE,
    CArray,
    CNumber,
    CPointer,
    CRecord,
    CSeveral,
    CType,
    declared,
    takes_place,
)
from tribodyn.kernels.c.unit import Unit
from tribodyn.kernels.c.values import literal


def initialiser(value: Any, kind: CType, name: str, unit: Unit, depth: int = 1) -> str:
    """What initialises a constant; its arrays become tables."""
    if isinstance(kind, CNumber):
        return literal(value, DOUBLE if kind == DOUBLE else None)
    if isinstance(kind, CArray):
        numbers = np.asarray(value)
        table = unit.tables.name_of(numbers, name) if numbers.size else "0"
        if kind.is_pointer:
            return table
        first = table if numbers.ndim == 1 or not numbers.size else "&" + table + "[0]" * numbers.ndim
        return f"{{{first}, {{{', '.join(map(str, numbers.shape))}}}}}"
    indent = "    " * depth
    if isinstance(kind, CSeveral):
        items = [
            initialiser(item, kind.record, f"{name}_{i}", unit, depth + 1) for i, item in enumerate(value)
        ]
        inside = "".join(f"\n{indent}{item}," for item in items)
        return f"{{{inside}\n{indent[4:]}}}"
    assert isinstance(kind, CRecord)
    fields = []
    for field, inner in kind.stored.items():
        text = initialiser(getattr(value, field), inner, f"{name}_{field}", unit, depth + 1)
        fields.append(f"\n{indent}.{field} = {text},")
    return f"{{{''.join(fields)}\n{indent[4:]}}}"


def table(name: str, numbers: np.ndarray) -> Iterator[str]:
    """Lines that define an array of numbers."""
    kind = "double" if numbers.dtype.kind == "f" else "int64_t"
    lengths = "".join(f"[{length}]" for length in numbers.shape)
    yield f"static const {kind} {name}{lengths} = {{"
    yield from _rows(numbers, 1)
    yield "};"


def _rows(numbers: np.ndarray, depth: int) -> Iterator[str]:
    """Rows of an array; of zeros alone only the first, as C takes the rest for zero."""
    indent = " " * depth
    if not numbers.any() and not np.signbit(numbers).any():
        zero = "0.0" if numbers.dtype.kind == "f" else "0"
        yield f"{indent}{'{' * (numbers.ndim - 1)}{zero}{'}' * (numbers.ndim - 1)}"
    elif numbers.ndim > 2:
        for row in numbers:
            yield f"{indent}{{"
            yield from _rows(row, depth + 1)
            yield f"{indent}}},"
    elif numbers.ndim == 2:
        for row in numbers:
            yield from _wrapped(f"{{{_joined(row)}}},", indent)
    else:
        yield from _wrapped(_joined(numbers), indent)


def _joined(numbers: np.ndarray) -> str:
    texts = map(repr, numbers.tolist()) if np.isfinite(numbers).all() else map(literal, numbers.tolist())
    return ", ".join("0" if text == "0.0" else text for text in texts)


def _wrapped(text: str, indent: str) -> Iterator[str]:
    while len(text) > LONGEST:
        end = text.rfind(" ", 0, LONGEST)
        yield indent + text[:end]
        text = text[end + 1 :]
    yield indent + text


def needed_by(kind: CType) -> list[CType]:
    """Types that the declaration of a struct needs before."""
    if isinstance(kind, CRecord):
        return list(kind.stored.values())
    if isinstance(kind, (CPointer, CSeveral)):
        return [kind.record]
    return [item for item in getattr(kind, "items", ()) if takes_place(item)]


def field_lines(fields: list[tuple[str, CType]]) -> Iterator[str]:
    """Lines of a struct's fields."""
    for name, kind in fields:
        note = ""
        if isinstance(kind, CArray) and kind.is_pointer:
            note = f" /* {' x '.join(map(str, kind.shape))} */"
        yield f"    {declared(kind, name)};{note}"
