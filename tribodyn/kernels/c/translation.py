"""Kernels as C: what is translated, and what comes of it."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.kernels.c.body.functions import translate
from tribodyn.kernels.c.data import initialiser
from tribodyn.kernels.c.sources import implementation
from tribodyn.kernels.c.types import (
    DOUBLE,
    TRUTH,
    WHOLE,
    CArray,
    CPointer,
    CRecord,
    CType,
    takes_place,
)
from tribodyn.kernels.c.unit import Unit
from tribodyn.kernels.c.writer import leave_out_unread, reached, written


class CEntry(NamedTuple):
    """A function that C exports, with arguments like those that it will be called with."""

    function: Callable[..., Any]
    examples: Sequence[Any]


class Translation(NamedTuple):
    """C99: the source, which holds its header, and the header for others."""

    source: str
    header: str


def translated(entries: Mapping[str, CEntry], data: Mapping[str, Any], title: str = "kernels") -> Translation:
    """Translate functions, and all that they call, to C; `data` become constants by their names.

    Every entry is a function of its name in the mapping. It takes numbers by value, records by the address of
    a struct, and arrays, which it may change, by that of their first row; what its examples say of functions,
    and of whole numbers and lengths inside records, is compiled in. It returns a number or a struct of
    several.

    Raises OutsideSubsetError, which names function, file and line, for Python that has no counterpart in C.
    """
    unit = Unit(translate)
    for name in (*entries, *data):
        unit.unique(name)
    kinds = {name: unit.structs.of(value) for name, value in data.items()}
    arguments = {
        name: tuple(_argument(unit, one) for one in entry.examples) for name, entry in entries.items()
    }
    for name, entry in entries.items():
        unit.entry(name, implementation(entry.function), arguments[name])
    called = reached(unit)
    leave_out_unread(unit, called)
    constants = {
        name: (kind, initialiser(data[name], kind, name, unit))
        for name, kind in kinds.items()
        if takes_place(kind)
    }
    return Translation(*written(unit, title, called, constants))


def _argument(unit: Unit, example: Any) -> CType:
    if isinstance(example, (bool, np.bool_)):
        return TRUTH
    if isinstance(example, (int, np.integer)):
        return WHOLE
    if isinstance(example, float):
        return DOUBLE
    if isinstance(example, np.ndarray):
        return CArray(DOUBLE if example.dtype.kind == "f" else WHOLE, example.shape, True)
    kind = unit.structs.of(example)
    return CPointer(kind) if isinstance(kind, CRecord) else kind
