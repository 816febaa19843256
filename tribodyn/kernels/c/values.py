"""What Python expressions become: values that are known when translating, and C expressions."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from tribodyn.kernels.c.types import DOUBLE, TRUTH, WHOLE, CKnown, CNumber, CTuple, CType, number_type

#: How tightly operators bind, as in C.
TERNARY, OR, AND, EQUAL, LESS, SUM, PRODUCT, UNARY, ATOM = range(9)


class UnknownOperationError(Exception):
    """What has no counterpart in C; the message says what."""


@dataclass(frozen=True, eq=False)
class Known:
    """A value that is known when translating; a number may have a name in the C code."""

    value: Any
    name: str = ""

    @property
    def type(self) -> CKnown:
        """Its type, which says it all."""
        return CKnown(self.value)


@dataclass(frozen=True)
class Expression:
    """A C expression without effects that matter to its neighbours."""

    text: str
    type: CType
    level: int = ATOM
    #: of a struct: "kept" where it stays as it is at an address, "local" of a variable, "" of a result
    place: str = ""
    bounds: tuple[int, int] | None = None  # least and greatest of a whole number, where these are known


@dataclass(frozen=True)
class Several:
    """A tuple, item by item."""

    items: tuple["Value", ...]

    @property
    def type(self) -> CTuple:
        """Its type."""
        return CTuple(tuple(item.type for item in self.items))


@dataclass(frozen=True)
class Counting:
    """A range of whole numbers."""

    start: "Value"
    stop: "Value"
    step: int

    @property
    def type(self) -> CKnown:
        """No C type."""
        return CKnown(self)


Value = Known | Expression | Several | Counting


def number_of(value: Value) -> CNumber | None:
    """Type of a number or truth, None of anything else."""
    if isinstance(value, Known):
        return number_type(value.value)
    return value.type if isinstance(value, Expression) and isinstance(value.type, CNumber) else None


def bounds_of(value: Value) -> tuple[int, int] | None:
    """Least and greatest of a whole number, where these are known."""
    if isinstance(value, Known):
        return (int(value.value), int(value.value)) if number_type(value.value) == WHOLE else None
    return value.bounds if isinstance(value, Expression) else None


def literal(value: Any, wanted: CNumber | None = None) -> str:
    """A number that is known as C has it."""
    kind = wanted or number_type(value)
    if kind == DOUBLE:
        number = float(value)
        if math.isnan(number):
            return "NAN"
        if math.isinf(number):
            return "INFINITY" if number > 0 else "-INFINITY"
        return repr(number)
    number = int(value)
    return str(number) if abs(number) < 2**31 else f"INT64_C({number})"


def plain(value: Value, wanted: CNumber | None = None) -> Expression:
    """A number as a C expression; a known one in the type that is wanted."""
    if isinstance(value, Known):
        kind = number_type(value.value)
        assert kind is not None
        if value.name and (wanted is None or wanted == kind):
            return Expression(value.name, kind)
        text = literal(value.value, wanted if wanted == DOUBLE else None)
        return Expression(text, wanted or kind, UNARY if text.startswith("-") else ATOM)
    assert isinstance(value, Expression)
    return value


def text_of(value: Value, level: int = TERNARY, wanted: CNumber | None = None) -> str:
    """A number as text that stands as an operand of an operator that binds so tightly."""
    expression = plain(value, wanted)
    return expression.text if expression.level >= level else f"({expression.text})"


def condition(value: Value, level: int = TERNARY) -> str:
    """A number as a truth."""
    kind = number_of(value)
    if kind == TRUTH:
        return text_of(value, level)
    compared = f"{text_of(value, EQUAL + 1)} != {'0.0' if kind == DOUBLE else '0'}"
    return compared if level <= EQUAL else f"({compared})"


def python_number(value: Any) -> Any:
    """A known number without NumPy's type."""
    return value.item() if isinstance(value, np.generic) else value
