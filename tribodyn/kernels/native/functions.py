"""numba's versions of the elementary functions, and registration of the laws, which knows none of them."""

import math
from typing import Any, cast

from numba.core import types
from numba.core.registry import cpu_target
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin

from tribodyn.kernels.native.parts import part, part_instead
from tribodyn.numerics import elementary

_infer_global = cast(Any, infer_global)


def _numeric(function: Any, arguments: Any, result: Any = types.float64) -> Any:
    """Tell numba the types of a function of floats, or integers as such; returns what registers its code."""

    @_infer_global(function)
    class _Types(AbstractTemplate):
        key = function

        def generic(self, args, kws):
            if len(args) == len(arguments) and all(map(isinstance, args, arguments)):
                wanted = (types.boolean if kind is types.Boolean else types.float64 for kind in arguments)
                return signature(result, *wanted)
            return None

    return lower_builtin(
        function, *(types.Boolean if kind is types.Boolean else types.Float for kind in arguments)
    )


def _same_as(function, equivalent, *arguments, result: Any = types.float64):
    """Compile a function to what numba makes of one that it knows."""

    @_numeric(function, arguments, result)
    def _(context, builder, sig, args):
        of_floats = signature(result, *sig.args)
        context.typing_context.resolve_function_type(
            context.typing_context.resolve_value_type(equivalent), sig.args, {}
        )
        return context.get_function(equivalent, of_floats)(builder, args)


for _name in ("sqrt", "exp", "log", "sin", "cos", "tan"):
    _same_as(getattr(elementary, _name), getattr(math, _name), types.Number)
_same_as(elementary.arctan2, math.atan2, types.Number, types.Number)
_same_as(elementary.absolute, abs, types.Number)


@_numeric(elementary.truncate, [types.Number], types.int64)
def _truncate(context, builder, sig, args):
    return context.cast(builder, args[0], types.float64, types.int64)


@_numeric(elementary.skippable, [types.Boolean], types.boolean)
@_numeric(elementary.anywhere, [types.Boolean], types.boolean)
def _truth(context, builder, sig, args):
    return args[0]


@_numeric(elementary.opposite, [types.Boolean], types.boolean)
def _opposite(context, builder, sig, args):
    return builder.not_(args[0])


@_numeric(elementary.plain, [types.Number])
def _plain(context, builder, sig, args):
    return args[0]


@_numeric(elementary.largest_slope, [types.Number])
def _largest_slope(context, builder, sig, args):
    return context.get_constant(types.float64, 0.0)


@_numeric(elementary.where, [types.Boolean, types.Number, types.Number])
def _where(context, builder, sig, args):
    return builder.select(*args)


def _extreme_by(comparison):
    def emit(context, builder, sig, args):
        a, b = args
        second = builder.or_(builder.fcmp_ordered(comparison, b, a), builder.fcmp_unordered("uno", b, b))
        return builder.select(second, b, a)

    return emit


_numeric(elementary.minimum, [types.Number, types.Number])(_extreme_by("<"))
_numeric(elementary.maximum, [types.Number, types.Number])(_extreme_by(">"))


def log1p(x):
    """log(1 + x) with the rounding of the sum put right: half the time of the C library's."""
    shifted = 1.0 + x
    return math.log(shifted) + (x - (shifted - 1.0)) / shifted


def expm1(x):
    """exp(x) − 1: Taylor's series to x¹³ where the difference would cancel, exact to rounding."""
    if abs(x) > 0.35:
        return math.exp(x) - 1.0
    square = x * x
    low = 1.0 + x * (1 / 2) + square * (1 / 6 + x * (1 / 24))
    middle = 1 / 120 + x * (1 / 720) + square * (1 / 5040 + x * (1 / 40320))
    high = 1 / 362880 + x * (1 / 3628800) + square * (1 / 39916800 + x * (1 / 479001600))
    high = high + square * square * (1 / 6227020800)
    fourth = square * square
    return x * (low + fourth * (middle + fourth * high))


def last_at_or_below(grid, x):
    """Index of the last grid value ≤ x, see `elementary.last_at_or_below`; by halving."""
    low, high = 0, grid.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if grid[middle] <= x:
            low = middle
        else:
            high = middle
    return low


def last_axis_of_four(table, a, b, c, d):
    """The four neighbours on the last axis, see `elementary.last_axis_of_four`."""
    return table[a, b, c, d, 0], table[a, b, c, d, 1], table[a, b, c, d, 2], table[a, b, c, d, 3]


def smaller(a, b):
    """The smaller of two numbers that are more than floats; NaN if either is."""
    return elementary.where((b < a) | (b != b), b, a)


def larger(a, b):
    """The larger of two numbers that are more than floats; NaN if either is."""
    return elementary.where((b > a) | (b != b), b, a)


def _instead(function, implementation, kind):
    """Compile a function of ours where its first argument is of a kind."""

    @part_instead(function)
    def _(first, *others):
        return implementation if isinstance(first, kind) else None


_instead(elementary.log1p, log1p, types.Number)
_instead(elementary.expm1, expm1, types.Number)
_instead(elementary.last_at_or_below, last_at_or_below, types.Array)
_instead(elementary.last_axis_of_four, last_axis_of_four, types.Array)


def without_derivatives(holds):
    """Compile what is of independent numbers to what was given, where arrays hold numbers alone."""

    @part_instead(elementary.independent)
    def _(numbers, store):
        return (lambda numbers, store: numbers) if holds(store) else None

    @part_instead(elementary.by_chain_rule)
    def _(results, numbers, store):
        return (lambda results, numbers, store: results) if holds(store) else None


without_derivatives(lambda store: isinstance(store, types.Array))


_registered: set[Any] = set()


def register_laws() -> None:
    """Make all laws that are marked by now callable from what numba compiles."""
    for law in elementary.LAWS:
        if law not in _registered:
            _registered.add(law)
            part(law, forceinline=True, implementation=elementary.COMPILED.get(law))
    cast(Any, cpu_target.typing_context).refresh()


def function_type(function: Any) -> Any:
    """Type to numba of a function among a kernel's arguments; it need not be marked as a law."""
    if function not in _registered:
        _registered.add(function)
        part(function, forceinline=True)
        cast(Any, cpu_target.typing_context).refresh()
    return cast(Any, cpu_target.typing_context).resolve_value_type(function)
