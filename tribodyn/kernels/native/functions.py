"""numba's versions of the elementary functions, and registration of the laws, which knows none of them."""

import math
from typing import Any, cast

from numba.core import types
from numba.core.registry import cpu_target
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import lower_builtin

from tribodyn.kernels.native import scalar_functions
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


def _same_as(function, known, *arguments, result: Any = types.float64):
    """Compile a function to what numba makes of one that it knows."""

    @_numeric(function, arguments, result)
    def _(context, builder, sig, args):
        of_floats = signature(result, *sig.args)
        context.typing_context.resolve_function_type(
            context.typing_context.resolve_value_type(known), sig.args, {}
        )
        return context.get_function(known, of_floats)(builder, args)


for _name in ("sqrt", "exp", "log", "sin", "cos", "tan"):
    _same_as(getattr(elementary, _name), getattr(math, _name), types.Number)
_same_as(elementary.arctan2, math.atan2, types.Number, types.Number)
_same_as(elementary.absolute, abs, types.Number)


@_numeric(elementary.truncate, [types.Number], types.int64)
def _truncate(context, builder, sig, args):
    return context.cast(builder, args[0], types.float64, types.int64)


@_numeric(elementary.skippable, [types.Boolean], types.boolean)
def _skippable(context, builder, sig, args):
    return args[0]


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


def _instead(function, implementation, kind):
    """Compile a function of ours where its first argument is of a kind."""

    @part_instead(function)
    def _(first, *others):
        return implementation if isinstance(first, kind) else None


_instead(elementary.log1p, scalar_functions.log1p, types.Number)
_instead(elementary.expm1, scalar_functions.expm1, types.Number)
_instead(elementary.last_at_or_below, scalar_functions.last_at_or_below, types.Array)
_instead(elementary.last_axis_of_four, scalar_functions.last_axis_of_four, types.Array)

_registered: set[Any] = set()


def register_laws() -> None:
    """Make all laws that are marked by now callable from what numba compiles."""
    for law in elementary.LAWS:
        if law not in _registered:
            _registered.add(law)
            part(law, forceinline=True)
    cast(Any, cpu_target.typing_context).refresh()


def function_type(function: Any) -> Any:
    """Type to numba of a function among a kernel's arguments; it need not be marked as a law."""
    if function not in _registered:
        _registered.add(function)
        part(function, forceinline=True)
        cast(Any, cpu_target.typing_context).refresh()
    return cast(Any, cpu_target.typing_context).resolve_value_type(function)
