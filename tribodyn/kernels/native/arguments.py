"""How a kernel's arguments lie in memory: a single block of words of 8 bytes, the same for every caller.

A number is a word; an array its address and lengths; a named tuple its fields one after the other; a function
no word at all. The layout says which of these a value is, and the machine code of a kernel depends on nothing
else: numbers and lengths are never compiled in, functions are.
"""

import struct
from collections.abc import Iterator
from functools import cache
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np

from tribodyn.kernels.native.identity import FunctionLayout, function_layout


class Numeric(NamedTuple):
    """A number: "float", "int" or "bool"."""

    name: str


class Array(NamedTuple):
    """An array: type of its elements, number of axes, and whether it is contiguous ("C") or not ("A")."""

    dtype: str
    ndim: int
    order: str

    @property
    def words(self) -> int:
        """Words that it takes: address, lengths, and strides where they do not follow from the lengths."""
        return 1 + self.ndim * (1 if self.order == "C" else 2)


class RecordLayout:
    """A named tuple: its name, and the layout of every field. One object for all that are equal.

    Get one from `record`.
    """

    def __init__(self, name: str, fields: tuple[tuple[str, Any], ...]):
        self.name = name
        self.fields = fields

    def __repr__(self) -> str:
        return f"{self.name}({', '.join(f'{name}={layout!r}' for name, layout in self.fields)})"


class PackedValue(NamedTuple):
    """A value as the kernels read it; stands for it among a kernel's arguments.

    What many calls have in common is packed once. Arrays inside are pointed at: the value keeps them alive.
    """

    #: Numeric, Array, RecordLayout, FunctionLayout, or what an object makes of itself by `as_argument`
    layout: Any
    words: bytes
    value: Any = None  # what was packed


FLOAT, INT, BOOL = Numeric("float"), Numeric("int"), Numeric("bool")
_float, _int = struct.Struct("=d").pack, struct.Struct("=q").pack
_array = cache(Array)


@cache
def record(name: str, names: tuple[str, ...], layouts: tuple[Any, ...]) -> RecordLayout:
    """The layout of a named tuple."""
    return RecordLayout(name, tuple(zip(names, layouts, strict=True)))


def packed(value: Any) -> PackedValue:
    """Pack a value as kernels read it.

    Raises
    ------
    TypeError
        For what kernels do not take: an error of the program.
    """
    if isinstance(value, PackedValue):
        return value
    if isinstance(value, float):
        return PackedValue(FLOAT, _float(value), value)
    if isinstance(value, np.ndarray):
        return _packed_array(value)
    if isinstance(value, (bool, np.bool_)):
        return PackedValue(BOOL, _int(value), value)
    if isinstance(value, (int, np.integer)):
        return PackedValue(INT, _int(value), value)
    if isinstance(value, FunctionType):
        return PackedValue(function_layout(value), b"", value)
    if hasattr(value, "as_argument"):
        return value.as_argument()
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return together(type(value).__qualname__, value._fields, value)  # pyright: ignore[reportAttributeAccessIssue]
    raise TypeError(
        f"a kernel takes numbers, arrays, functions and named tuples of them, not {type(value).__name__}"
    )


def _packed_array(array: np.ndarray) -> PackedValue:
    if array.ndim == 0:
        return packed(array.item())
    contiguous = array.flags.c_contiguous
    described = (array.ctypes.data, *array.shape)
    if not contiguous:
        described += array.strides
    layout = _array(array.dtype.str, array.ndim, "C" if contiguous else "A")
    return PackedValue(layout, struct.pack(f"={len(described)}q", *described), array)


def together(name: str, names: tuple[str, ...], values: tuple[Any, ...]) -> PackedValue:
    """Pack several values as the fields of one record."""
    items = [packed(value) for value in values]
    layouts = tuple(one.layout for one in items)
    return PackedValue(record(name, names, layouts), b"".join(one.words for one in items), values)


def functions_in(layout: Any) -> Iterator[FunctionLayout]:
    """Go through the functions that a layout holds."""
    if isinstance(layout, FunctionLayout):
        yield layout
    elif isinstance(layout, RecordLayout):
        for _, field in layout.fields:
            yield from functions_in(field)


def is_kept(layout: Any) -> bool:
    """Whether machine code for a layout may be kept on disk: no function in it is this process's own."""
    return all(one.kept for one in functions_in(layout))
