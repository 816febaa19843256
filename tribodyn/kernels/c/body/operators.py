"""Python's operators on numbers, as C has them; numbers that are known are computed at once."""

import ast
import operator
from collections.abc import Callable
from typing import Any

from tribodyn.kernels.c.types import DOUBLE, TRUTH, WHOLE
from tribodyn.kernels.c.values import (
    AND,
    ATOM,
    EQUAL,
    LESS,
    OR,
    PRODUCT,
    SUM,
    TERNARY,
    UNARY,
    Expression,
    Known,
    UnknownOperationError,
    Value,
    bounds_of,
    condition,
    number_of,
    plain,
    python_number,
    text_of,
)

_COMPUTED: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda item, items: item in items,
    ast.NotIn: lambda item, items: item not in items,
}
SYMBOLS = {
    ast.Add: ("+", SUM),
    ast.Sub: ("-", SUM),
    ast.Mult: ("*", PRODUCT),
    ast.Eq: ("==", EQUAL),
    ast.NotEq: ("!=", EQUAL),
    ast.Lt: ("<", LESS),
    ast.LtE: ("<=", LESS),
    ast.Gt: (">", LESS),
    ast.GtE: (">=", LESS),
}
LESS_THAN, MINUS = ast.Lt(), ast.USub()
_BOOLEAN = {ast.BitAnd: AND, ast.BitOr: OR}


def binary(kind: ast.operator, a: Value, b: Value) -> Value:
    """`a` and `b` with an operator between."""
    if isinstance(a, Known) and isinstance(b, Known):
        return Known(python_number(_COMPUTED[type(kind)](a.value, b.value)))
    types = number_of(a), number_of(b)
    if None in types:
        raise UnknownOperationError("an operator between what are no numbers")
    if type(kind) in _BOOLEAN and types == (TRUTH, TRUTH):
        return both(a, b) if isinstance(kind, ast.BitAnd) else either(a, b)
    wanted = DOUBLE if DOUBLE in types else WHOLE
    if isinstance(kind, ast.Div):
        left = text_of(a, PRODUCT, DOUBLE)
        if wanted == WHOLE and not isinstance(a, Known):
            left = f"(double){text_of(a, UNARY)}"
        return Expression(f"{left} / {text_of(b, UNARY, DOUBLE)}", DOUBLE, PRODUCT)
    if isinstance(kind, ast.Pow):
        if wanted == WHOLE:
            raise UnknownOperationError("a power of a whole number")
        return Expression(f"pow({text_of(a, wanted=DOUBLE)}, {text_of(b, wanted=DOUBLE)})", DOUBLE)
    if isinstance(kind, (ast.Mod, ast.FloorDiv)):
        name = "remainder_of" if isinstance(kind, ast.Mod) else "quotient_of"
        name = name if wanted == WHOLE else f"float_{name}"
        return Expression(f"{name}({text_of(a, wanted=wanted)}, {text_of(b, wanted=wanted)})", wanted)
    if type(kind) not in SYMBOLS:
        raise UnknownOperationError(f"the operator {type(kind).__name__}")
    symbol, level = SYMBOLS[type(kind)]
    return Expression(f"{text_of(a, level, wanted)} {symbol} {text_of(b, level + 1, wanted)}", wanted, level)


def compared(kind: ast.cmpop, a: Value, b: Value) -> Value:
    """Whether `a` compares so with `b`."""
    if isinstance(a, Known) and isinstance(b, Known):
        return Known(bool(_COMPUTED[type(kind)](a.value, b.value)))
    types = number_of(a), number_of(b)
    if isinstance(kind, (ast.Is, ast.IsNot)):
        return Known(isinstance(kind, ast.IsNot))  # a number that runs is no None
    if None in types or type(kind) not in SYMBOLS:
        raise UnknownOperationError("a comparison of what are no numbers")
    of_a, of_b = bounds_of(a), bounds_of(b)
    if of_a is not None and of_b is not None:
        (least, greatest), (lowest, highest) = of_a, of_b
        at_ends = {bool(_COMPUTED[type(kind)](x, y)) for x in {least, greatest} for y in {lowest, highest}}
        apart = greatest < lowest or highest < least
        if len(at_ends) == 1 and (apart or not isinstance(kind, (ast.Eq, ast.NotEq))):
            return Known(at_ends.pop())
    wanted = DOUBLE if DOUBLE in types else WHOLE
    symbol, level = SYMBOLS[type(kind)]
    return Expression(
        f"{text_of(a, level + 1, wanted)} {symbol} {text_of(b, level + 1, wanted)}", TRUTH, level
    )


def both(a: Value, b: Value) -> Value:
    """Whether both hold."""
    for one, other in ((a, b), (b, a)):
        if isinstance(one, Known):
            return other if one.value else Known(False)
    return Expression(f"{condition(a, AND)} && {condition(b, AND + 1)}", TRUTH, AND)


def either(a: Value, b: Value) -> Value:
    """Whether one of them holds."""
    for one, other in ((a, b), (b, a)):
        if isinstance(one, Known):
            return Known(True) if one.value else other
    # compilers warn of && within || without parentheses
    return Expression(f"{_in_or(a, OR)} || {_in_or(b, OR + 1)}", TRUTH, OR)


def _in_or(value: Value, level: int) -> str:
    text = condition(value, level)
    return f"({text})" if isinstance(value, Expression) and value.level == AND else text


def opposite(a: Value) -> Value:
    """Whether it does not hold."""
    if isinstance(a, Known):
        return Known(not a.value)
    return Expression(f"!{condition(a, UNARY)}", TRUTH, UNARY)


def unary(kind: ast.unaryop, a: Value) -> Value:
    """An operator before a number."""
    if isinstance(kind, ast.Not):
        return opposite(a)
    if number_of(a) is None or not isinstance(kind, (ast.USub, ast.UAdd)):
        raise UnknownOperationError(f"the operator {type(kind).__name__}")
    if isinstance(a, Known):
        return Known(-a.value if isinstance(kind, ast.USub) else +a.value)
    if isinstance(kind, ast.UAdd):
        return a
    inner = text_of(a, UNARY)
    kind_of = number_of(a)
    assert kind_of is not None
    return Expression(f"-({inner})" if inner.startswith("-") else f"-{inner}", kind_of, UNARY)


def chosen(test: Value, a: Value, b: Value) -> Value:
    """`a` where a truth holds, else `b`; of numbers."""
    if isinstance(test, Known):
        return a if test.value else b
    types = number_of(a), number_of(b)
    if None in types:
        raise UnknownOperationError("a choice between what are no numbers")
    wanted = next(kind for kind in (DOUBLE, WHOLE, TRUTH) if kind in types)
    whole = f"{condition(test, OR)} ? {text_of(a, OR, wanted)} : {text_of(b, TERNARY, wanted)}"
    return Expression(whole, wanted, TERNARY)


def called(name: str, kind: Any, *arguments: Value, wanted: Any = DOUBLE) -> Value:
    """A function of C of numbers."""
    return Expression(f"{name}({', '.join(text_of(one, wanted=wanted) for one in arguments)})", kind, ATOM)


def converted(value: Value, name: str, kind: Any) -> Value:
    """A number as one of another type."""
    return Expression(f"({name}){text_of(plain(value), UNARY)}", kind, UNARY)
