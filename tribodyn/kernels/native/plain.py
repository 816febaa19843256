"""Kernels through numba's documented interface alone: where its internals are not as `internals` says.

The same functions and laws, compiled one by one and not kept on disk: slower to start, and slower to call, as
numba takes every record apart at each call. Results differ from the usual kernels' by rounding.
"""

import math
from collections.abc import Callable
from functools import cache
from types import FunctionType
from typing import Any, cast

import numba
import numpy as np
from numba import types
from numba.extending import overload, typeof_impl

from tribodyn.kernels.native import scalar_functions
from tribodyn.kernels.native.arguments import PackedValue
from tribodyn.kernels.native.code import KernelFunction
from tribodyn.numerics import elementary

#: IEEE division, and a product and a sum may be one rounding, as in the usual kernels.
_OPTIONS: Any = {"error_model": "numpy", "fastmath": {"contract"}}


def _instead(function: Any, implementation: Any, kind: Any = types.Number) -> None:
    """Compile another function where ours is called with a first argument of a kind."""

    @overload(function, jit_options=_OPTIONS, strict=False)
    def _(first, *others):
        return implementation if isinstance(first, kind) else None


_instead(elementary.sqrt, lambda x: math.sqrt(x))
_instead(elementary.exp, lambda x: math.exp(x))
_instead(elementary.log, lambda x: math.log(x))
_instead(elementary.sin, lambda x: math.sin(x))
_instead(elementary.cos, lambda x: math.cos(x))
_instead(elementary.tan, lambda x: math.tan(x))
_instead(elementary.arctan2, lambda y, x: math.atan2(y, x))
_instead(elementary.absolute, lambda x: abs(x))
_instead(elementary.plain, lambda x: x)
_instead(elementary.largest_slope, lambda x: 0.0)
_instead(elementary.truncate, lambda x: int(x))
_instead(elementary.skippable, lambda condition: condition, types.Boolean)
_instead(elementary.where, lambda condition, a, b: float(a) if condition else float(b), types.Boolean)
_instead(elementary.minimum, lambda a, b: float(b) if b < a or b != b else float(a))
_instead(elementary.maximum, lambda a, b: float(b) if b > a or b != b else float(a))
_instead(elementary.log1p, scalar_functions.log1p)
_instead(elementary.expm1, scalar_functions.expm1)
_instead(elementary.last_at_or_below, scalar_functions.last_at_or_below, types.Array)
_instead(elementary.last_axis_of_four, scalar_functions.last_axis_of_four, types.Array)

_registered = 0


def _register_laws() -> None:
    """Make all laws that are known by now callable from what numba compiles."""
    global _registered
    while _registered < len(elementary.LAWS):
        _register(elementary.LAWS[_registered])
        _registered += 1


def _register(law: Callable[..., Any]) -> None:
    @overload(law, jit_options=_OPTIONS, strict=False)
    def _(*arguments, **named):
        return law


@typeof_impl.register(KernelFunction)
def _typeof_kernel(kernel, c):
    """Inside another kernel a kernel is a function that numba compiles."""
    return numba.typeof(_dispatcher(kernel))


def _dispatcher(kernel: Any) -> Any:
    return _compiled(kernel.function)


@cache
def _compiled(function: Callable[..., Any]) -> Any:
    return cast(Any, numba.njit)(**_OPTIONS)(function)


def plainly_compiled(kernel: KernelFunction) -> Callable[[bytes, tuple[Any, ...]], Any]:
    """Return a function of a block of arguments, which it ignores, and the arguments that runs the kernel."""
    _register_laws()
    dispatcher = _dispatcher(kernel)

    def call(_: bytes, arguments: tuple[Any, ...]) -> Any:
        return dispatcher(*map(_given, arguments))

    return call


def _given(value: Any) -> Any:
    """An argument as numba takes it: a number for an array without axes, a function as a compiled one."""
    if isinstance(value, PackedValue):
        value = value.value
    if isinstance(value, FunctionType):
        return _compiled(value)
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return cast(Any, type(value))(*map(_given, value))
    return value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value
