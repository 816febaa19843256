"""Types of the C code: numbers, arrays, structs, and what is known when translating, which takes no place.

A value of the caller's gives its type: whole numbers, truths, functions, texts and the lengths of arrays
inside its records are known, and take no place; floats and the elements of arrays are read when the code
runs.
"""

from collections.abc import Hashable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class CNumber:
    """A number or a truth."""

    name: str


DOUBLE, WHOLE, TRUTH = CNumber("double"), CNumber("int64_t"), CNumber("int")


@dataclass(frozen=True)
class CArray:
    """An array, contiguous, the last index varying fastest."""

    item: CNumber
    shape: tuple[int | None, ...]  # None: read when the code runs
    written: bool = False
    with_lengths: bool = False  # a struct that has its lengths, where those of several records differ

    @property
    def is_pointer(self) -> bool:
        """Whether a pointer to its rows is all that it takes."""
        return not self.with_lengths

    @property
    def struct(self) -> str:
        """Name of the struct that it is otherwise."""
        return f"{'Array' if self.item == DOUBLE else 'Integers'}{len(self.shape)}"


class CRecord:
    """A named tuple as a struct; one object for all that are equal, see `Structs.record`."""

    def __init__(self, name: str, about: str, fields: tuple[tuple[str, Any], ...]):
        self.name, self.about = name, about
        self.fields = dict(fields)

    @property
    def stored(self) -> dict[str, Any]:
        """The fields that take a place."""
        return {name: kind for name, kind in self.fields.items() if takes_place(kind)}


@dataclass(frozen=True)
class CPointer:
    """The address of a struct that does not change."""

    record: CRecord


@dataclass(frozen=True)
class CSeveral:
    """Several structs of one type, one after the other."""

    record: CRecord
    count: int


@dataclass(frozen=True)
class CTuple:
    """A tuple, as functions return it."""

    items: tuple[Any, ...]


@dataclass(frozen=True, eq=False)
class CKnown:
    """A value that is known when translating."""

    value: Any

    @property
    def key(self) -> Hashable:
        """Equal where the code is the same."""
        try:
            hash(self.value)
        except TypeError:
            return id(self.value)
        return type(self.value), self.value

    def __eq__(self, other: object) -> bool:
        return isinstance(other, CKnown) and (self.value is other.value or self.key == other.key)

    def __hash__(self) -> int:
        return hash(self.key)


CType = CNumber | CArray | CRecord | CPointer | CSeveral | CTuple | CKnown
_LETTERS = {DOUBLE: "d", WHOLE: "i", TRUTH: "t"}


def takes_place(kind: CType) -> bool:
    """Whether a value of a type is anything when the code runs."""
    if isinstance(kind, CKnown):
        return False
    if isinstance(kind, (CPointer, CSeveral)):
        return takes_place(kind.record)
    return not isinstance(kind, CRecord) or any(map(takes_place, kind.fields.values()))


def declared(kind: CType, name: str) -> str:
    """The declaration of a variable or field."""
    if isinstance(kind, CNumber):
        return f"{kind.name} {name}"
    if isinstance(kind, CArray):
        if not kind.is_pointer:
            return f"{kind.struct} {name}"
        rows = "".join(f"[{max(length or 1, 1)}]" for length in kind.shape[1:])
        pointer = f"(*{name}){rows}" if rows else f"*{name}"
        return f"{'' if kind.written else 'const '}{kind.item.name} {pointer}"
    if isinstance(kind, CPointer):
        return f"const {kind.record.name} *{name}"
    if isinstance(kind, CSeveral):
        return f"{kind.record.name} {name}[{kind.count}]"
    if isinstance(kind, CRecord):
        return f"{kind.name} {name}"
    if isinstance(kind, CTuple):
        return f"{tuple_name(kind)} {name}"
    raise TypeError(f"{kind} takes no place")


def tuple_name(kind: CTuple) -> str:
    """Name of a tuple's struct: its number of items, if all are floats, or a letter for each."""
    stored = [item for item in kind.items if takes_place(item)]
    if all(item == DOUBLE for item in stored):
        return f"Floats{len(stored)}"
    letters = [_LETTERS.get(item, "") if isinstance(item, CNumber) else "" for item in stored]
    return "Tuple_" + "_".join(
        letter or (item.record.name if isinstance(item, CPointer) else getattr(item, "name", "array"))
        for letter, item in zip(letters, stored, strict=True)
    )


def common(kinds: Iterable[CType]) -> CType | None:
    """The type that takes values of several, None where there is none."""
    first, *others = kinds
    for other in others:
        both = _common_of_two(first, other)
        if both is None:
            return None
        first = both
    return first


def _common_of_two(a: CType, b: CType) -> CType | None:
    if a == b:
        return a
    if isinstance(a, CTuple) and isinstance(b, CTuple) and len(a.items) == len(b.items):
        items = [_common_of_two(*pair) for pair in zip(a.items, b.items, strict=True)]
        return None if None in items else CTuple(tuple(items))
    if isinstance(a, CArray) and isinstance(b, CArray) and len(a.shape) == len(b.shape) and a.item == b.item:
        shape = tuple(x if x == y else None for x, y in zip(a.shape, b.shape, strict=True))
        return CArray(a.item, shape, a.written, with_lengths=True) if a.written is b.written else None
    if isinstance(a, CRecord) and isinstance(b, CPointer) and a is b.record:
        return a
    if isinstance(b, CRecord) and isinstance(a, CPointer) and b is a.record:
        return b
    numbers = [number_type(each.value) if isinstance(each, CKnown) else each for each in (a, b)]
    if all(isinstance(each, CNumber) for each in numbers):
        return next(kind for kind in (DOUBLE, WHOLE, TRUTH) if kind in numbers)
    return None


def number_type(value: Any) -> CNumber | None:
    """Type of a number or truth that is known; None of anything else."""
    if isinstance(value, (bool, np.bool_)):
        return TRUTH
    if isinstance(value, (int, np.integer)):
        return WHOLE
    return DOUBLE if isinstance(value, (float, np.floating)) else None


class Structs:
    """The structs of a translation, in an order in which they can be declared."""

    def __init__(self) -> None:
        self.records: dict[Any, CRecord] = {}
        self._names: set[str] = set()

    def record(self, kind: Any, fields: tuple[tuple[str, CType], ...]) -> CRecord:
        """The struct of a type of named tuples with fields of such types."""
        key = kind, fields
        if key not in self.records:
            name, number = kind.__name__.lstrip("_"), 1
            while name in self._names:
                number += 1
                name = f"{kind.__name__.lstrip('_')}_{number}"
            self._names.add(name)
            about = (kind.__doc__ or "").partition("\n")[0]
            self.records[key] = CRecord(name, "" if about.startswith(f"{kind.__name__}(") else about, fields)
        return self.records[key]

    def of(self, *values: Any) -> CType:
        """Type of a value inside a record, or of the values there in several; TypeError for no such type."""
        first = values[0]
        if isinstance(first, tuple) and hasattr(first, "_fields"):
            if len({type(value) for value in values}) > 1:
                raise TypeError("C code takes several records where they are of one type")
            names = type(first)._fields  # pyright: ignore[reportAttributeAccessIssue]
            fields = ((name, self.of(*(getattr(value, name) for value in values))) for name in names)
            return self.record(type(first), tuple(fields))
        if isinstance(first, tuple) and first and all(hasattr(item, "_fields") for item in first):
            record = self.of(*(item for value in values for item in value))
            assert isinstance(record, CRecord)
            return CSeveral(record, len(first))
        joined = common(map(_simple, values))
        if joined is None:
            raise TypeError("C code takes records of one type, with numbers, arrays and the same functions")
        return joined


def _simple(value: Any) -> CType:
    """Type of what is no record."""
    if isinstance(value, np.ndarray) and value.ndim:
        return CArray(DOUBLE if value.dtype.kind == "f" else WHOLE, value.shape)
    if isinstance(value, (float, np.ndarray)):
        return DOUBLE
    if isinstance(value, np.generic):
        return CKnown(value.item())
    if isinstance(value, tuple):
        return CKnown(tuple(value))
    if value is None or isinstance(value, (int, str)) or callable(value):
        return CKnown(int(value) if isinstance(value, int) and not isinstance(value, bool) else value)
    raise TypeError(f"C code takes numbers, arrays, functions and tuples of them, not {type(value).__name__}")
