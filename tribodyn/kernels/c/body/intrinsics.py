"""What C has of its own, or takes at once, in place of functions: the elementary ones, and Python's."""

import math
import re
from collections.abc import Callable
from typing import Any

from tribodyn.kernels.c.body import operators
from tribodyn.kernels.c.types import DOUBLE, TRUTH, WHOLE, CArray, CTuple
from tribodyn.kernels.c.values import Expression, Known, Several, Value, number_of, plain
from tribodyn.numerics import elementary

#: Functions of Python that are computed where everything is known.
PYTHON = frozenset({float, int, bool, abs, min, max, len, math.sqrt, math.log, math.exp})

#: Named as in Python; C before all other functions.
HELPERS = """
/* The smaller of the two; not a number if either is. */
static inline double minimum(double a, double b)
{
    return b < a || b != b ? b : a;
}

/* The larger of the two; not a number if either is. */
static inline double maximum(double a, double b)
{
    return b > a || b != b ? b : a;
}

/* log(1 + x), accurate for small x. */
static inline double log_of_one_and(double x)
{
    const double shifted = 1.0 + x;
    return log(shifted) + (x - (shifted - 1.0)) / shifted;
}

/* Index of the last value of an increasing grid that is not above x, but one less than the last. */
static inline int64_t last_at_or_below(const double *grid, int64_t length, double x)
{
    int64_t low = 0;
    int64_t high = length - 1;
    while (high - low > 1) {
        const int64_t middle = (low + high) / 2;
        if (grid[middle] <= x) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/* The smaller of two whole numbers. */
static inline int64_t smaller_of(int64_t a, int64_t b)
{
    return b < a ? b : a;
}

/* The larger of two whole numbers. */
static inline int64_t larger_of(int64_t a, int64_t b)
{
    return b > a ? b : a;
}

/* a // b as Python has it, rounded down. */
static inline int64_t quotient_of(int64_t a, int64_t b)
{
    return a / b - (a % b != 0 && (a % b < 0) != (b < 0));
}

/* a % b as Python has it, of the sign of b. */
static inline int64_t remainder_of(int64_t a, int64_t b)
{
    const int64_t rest = a % b;
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

/* a % b of floats as Python has it, of the sign of b. */
static inline double float_remainder_of(double a, double b)
{
    const double rest = fmod(a, b);
    return rest != 0.0 && (rest < 0.0) != (b < 0.0) ? rest + b : rest;
}

/* a // b of floats as Python has it, rounded down. */
static inline double float_quotient_of(double a, double b)
{
    return floor((a - float_remainder_of(a, b)) / b + 0.5);
}
"""

HELPER_NAMES = frozenset(re.findall(r"^static .*?(\w+)\(", HELPERS, re.MULTILINE))
INTRINSICS: dict[Any, Callable[..., Value]] = {}


def _is(*functions: Any) -> Callable[[Callable[..., Value]], Callable[..., Value]]:
    """Decorator of what stands for functions."""

    def given(implementation: Callable[..., Value]) -> Callable[..., Value]:
        for function in functions:
            INTRINSICS[function] = implementation
        return implementation

    return given


def _of_c(name: str, in_python: Callable[..., float] | None = None) -> Callable[..., Value]:
    def evaluated(translator: Any, *arguments: Value) -> Value:
        if len(arguments) != (2 if name in ("atan2", "minimum", "maximum") else 1):
            raise operators.UnknownOperationError(f"{name} takes other arguments")
        known = [float(one.value) for one in arguments if isinstance(one, Known)]
        if in_python is not None and len(known) == len(arguments):
            return Known(in_python(*known))
        return operators.called(name, DOUBLE, *arguments)

    return evaluated


for _name in ("sqrt", "exp", "log", "sin", "cos", "tan"):
    _is(getattr(elementary, _name), getattr(math, _name))(_of_c(_name, getattr(math, _name)))
_is(elementary.arctan2, math.atan2)(_of_c("atan2", math.atan2))
_is(elementary.expm1, math.expm1)(_of_c("expm1", math.expm1))
_is(elementary.log1p, math.log1p)(_of_c("log_of_one_and", math.log1p))
_is(elementary.minimum)(_of_c("minimum"))
_is(elementary.maximum)(_of_c("maximum"))
_is(math.floor)(
    lambda translator, x: operators.converted(operators.called("floor", DOUBLE, x), "int64_t", WHOLE)
)
for _name in ("isnan", "isfinite", "isinf"):
    _is(getattr(math, _name))(lambda translator, x, name=_name: operators.called(name, TRUTH, x))


@_is(elementary.absolute, abs, math.fabs)
def _absolute(translator: Any, x: Value) -> Value:
    if isinstance(x, Known):
        return Known(abs(x.value))
    if number_of(x) == WHOLE:
        x = translator.atomic(x, "size")
        negative = operators.compared(operators.LESS_THAN, x, Known(0))
        return operators.chosen(negative, operators.unary(operators.MINUS, x), x)
    return operators.called("fabs", DOUBLE, x)


def _extreme(name: str, of_whole: str, in_python: Callable[..., Any]) -> Callable[..., Value]:
    def evaluated(translator: Any, first: Value, *others: Value) -> Value:
        for other in others:
            if isinstance(first, Known) and isinstance(other, Known):
                first = Known(in_python(first.value, other.value))
            elif number_of(first) == WHOLE and number_of(other) == WHOLE:
                first = operators.called(of_whole, WHOLE, first, other, wanted=WHOLE)
            else:
                first = operators.called(name, DOUBLE, first, other)
        return first

    return evaluated


_is(min)(_extreme("minimum", "smaller_of", min))
_is(max)(_extreme("maximum", "larger_of", max))


@_is(elementary.where)
def _where(translator: Any, test: Value, a: Value, b: Value) -> Value:
    return operators.chosen(test, a, b)


@_is(elementary.skippable, elementary.anywhere, bool)
def _truth(translator: Any, holds: Value) -> Value:
    return holds


@_is(elementary.opposite)
def _opposite(translator: Any, holds: Value) -> Value:
    return operators.opposite(holds)


@_is(elementary.plain, elementary.independent, elementary.by_chain_rule)
def _the_same(translator: Any, value: Value, *others: Value) -> Value:
    return value


@_is(elementary.largest_slope)
def _no_slope(translator: Any, x: Value) -> Value:
    return Known(0.0)


@_is(elementary.truncate, int)
def _whole(translator: Any, x: Value) -> Value:
    if isinstance(x, Known):
        return Known(int(x.value))
    return x if number_of(x) == WHOLE else operators.converted(x, "int64_t", WHOLE)


@_is(float)
def _float(translator: Any, x: Value) -> Value:
    if isinstance(x, Known):
        return Known(float(x.value))
    return x if number_of(x) == DOUBLE else operators.converted(x, "double", DOUBLE)


@_is(len)
def _length(translator: Any, whole: Value) -> Value:
    if isinstance(whole, Known):
        return Known(len(whole.value))
    if isinstance(whole, Several):
        return Known(len(whole.items))
    if isinstance(whole, Expression) and isinstance(whole.type, CArray):
        return translator.length(whole, 0)
    if isinstance(whole, Expression) and isinstance(whole.type, CTuple):
        return Known(len(whole.type.items))
    raise operators.UnknownOperationError("the length of what is no array or tuple")


@_is(elementary.last_at_or_below)
def _last_at_or_below(translator: Any, grid: Value, x: Value) -> Value:
    assert isinstance(grid, Expression)
    assert isinstance(grid.type, CArray)
    data = grid.text if grid.type.is_pointer else f"{grid.text}.data"
    length = plain(translator.length(grid, 0)).text
    return Expression(f"last_at_or_below({data}, {length}, {plain(x, DOUBLE).text})", WHOLE)


@_is(elementary.last_axis_of_four)
def _last_axis_of_four(translator: Any, table: Value, *indices: Value) -> Value:
    assert isinstance(table, Expression)
    atoms = [translator.atomic(index, "index") for index in indices]
    return Several(
        tuple(translator.element(table, [*atoms, Known(last)], translator.source.node) for last in range(4))
    )
