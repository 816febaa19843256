"""Elementary functions that serve Python floats, NumPy, JAX and numba alike.

A physical law is written once, over these functions and arithmetic, and runs everywhere: on floats and
NumPy arrays as it stands, under JAX tracing (JAX is used only when an argument already is a JAX array, so
a plain run never imports it), and inside the native kernel, for which `tribodyn.kernels.native` gives numba a
version of each function and registers every function marked `law`.

Array code (geometry, energy method) asks `namespace` for the module that fits its arguments.
"""

import math
import sys
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np

F = TypeVar("F", bound=Callable[..., Any])

LAWS: list[Callable[..., Any]] = []
_ROUNDING = 1e-13  # relative; more than two computations of a number differ by
_PLAIN = frozenset({float, int, bool, np.ndarray, np.float64, np.bool_})


def law(function: F) -> F:
    """Mark a module-level scalar function as a law that the native kernel may call."""
    LAWS.append(function)
    return function


#: What kernels compile in place of functions.
COMPILED: dict[Callable[..., Any], Callable[..., Any]] = {}


def compiled_as(implementation: Callable[..., Any]) -> Callable[[F], F]:
    """Mark a function over arrays: kernels compile the law `implementation`, of the same result, instead."""

    def marked(function: F) -> F:
        COMPILED[function] = implementation
        return law(function)

    return marked


def is_jax(value: Any) -> bool:
    """Whether `value` is a JAX array or tracer; never imports JAX."""
    jax = sys.modules.get("jax")
    return jax is not None and isinstance(value, jax.Array)


def as_float(value: Any) -> Any:
    """A Python float, or arrays and what JAX holds as they are."""
    return value if is_jax(value) or np.ndim(value) else float(value)


def namespace(*values: Any) -> Any:
    """`jax.numpy` if any leaf of `values` (nested tuples and lists allowed) is a JAX array, else `numpy`."""
    if "jax" in sys.modules and _has_jax(values):
        import jax.numpy as jnp

        return jnp
    return np


def _has_jax(values: Sequence[Any]) -> bool:
    for value in values:
        if type(value) in _PLAIN:  # by far the quickest answer, and the usual one
            continue
        if _has_jax(value) if isinstance(value, (tuple, list)) else is_jax(value):
            return True
    return False


def sqrt(x: Any) -> Any:
    """Square root."""
    return math.sqrt(x) if type(x) is float else namespace(x).sqrt(x)


def exp(x: Any) -> Any:
    """Exponential; arguments above 709 overflow, so laws clip them."""
    return math.exp(x) if type(x) is float else namespace(x).exp(x)


def log(x: Any) -> Any:
    """Natural logarithm."""
    return math.log(x) if type(x) is float else namespace(x).log(x)


def log1p(x: Any) -> Any:
    """log(1 + x), accurate for small x."""
    return math.log1p(x) if type(x) is float else namespace(x).log1p(x)


def expm1(x: Any) -> Any:
    """exp(x) − 1, accurate for small x."""
    return math.expm1(x) if type(x) is float else namespace(x).expm1(x)


def sin(x: Any) -> Any:
    """Sine."""
    return math.sin(x) if type(x) is float else namespace(x).sin(x)


def cos(x: Any) -> Any:
    """Cosine."""
    return math.cos(x) if type(x) is float else namespace(x).cos(x)


def tan(x: Any) -> Any:
    """Tangent."""
    return math.tan(x) if type(x) is float else namespace(x).tan(x)


def arctan2(y: Any, x: Any) -> Any:
    """Angle of the point (x, y)."""
    if type(x) is float and type(y) is float:
        return math.atan2(y, x)
    return namespace(x, y).arctan2(y, x)


def where(condition: Any, a: Any, b: Any) -> Any:
    """`a` where `condition` holds, else `b`; both are evaluated."""
    if type(condition) is bool:
        return a if condition else b
    return namespace(condition, a, b).where(condition, a, b)


def skippable(condition: Any) -> bool:
    """Whether what only counts where `condition` fails may be left out: compiled for one case, if it holds.

    Arrays and tracers hold many cases, so everything is evaluated there; what is left out must have no
    weight in the result.
    """
    return False


def anywhere(condition: Any) -> bool:
    """Whether a condition holds; compiled for many cases at once, in any of them."""
    return bool(np.any(condition))


def opposite(condition: Any) -> Any:
    """Where a condition fails; compiled for one case, a truth and no integer."""
    return namespace(condition).logical_not(condition)


def minimum(a: Any, b: Any) -> Any:
    """The smaller of the two; NaN if either is. With JAX the mean of two variables equal to rounding.

    JAX's own minima, maxima and `clip` find by equality which argument their derivative follows. A large
    program may compute an argument twice, with other last digits, and the result is then neither of them.
    """
    if type(a) is float and type(b) is float:
        return b if b < a or b != b else a
    xp = namespace(a, b)
    if xp is np:
        return np.minimum(a, b)
    if type(b) is float:  # a constant is equal to nothing else by more than chance
        return xp.where(b < a, b, a)
    smaller = xp.where(a < b, a, xp.where(b <= a, b, a + b))
    return xp.where(xp.abs(a - b) < _ROUNDING * xp.abs(b), (a + b) / 2, smaller)


def maximum(a: Any, b: Any) -> Any:
    """The larger of the two; NaN if either is. With JAX the mean of two variables equal to rounding."""
    if type(a) is float and type(b) is float:
        return b if b > a or b != b else a
    return np.maximum(a, b) if namespace(a, b) is np else -minimum(-a, -b)


def smallest(values: Any) -> Any:
    """The smallest of all values of an array; derivatives are those of the first such value."""
    flat = values.ravel()
    return flat[namespace(flat).argmin(flat)]


def within(x: Any, lower: Any, upper: Any) -> Any:
    """Values x of an array, limited to lower … upper."""
    return minimum(maximum(x, lower), upper)


def absolute(x: Any) -> Any:
    """Absolute value."""
    return abs(x)


def sense(radius: Any) -> Any:
    """−1 for the radius or number of teeth of an internal gear, which is negative, else 1."""
    return absolute(radius) / radius


def plain(x: Any) -> Any:
    """The number alone, where compiled code carries derivatives beside it."""
    return x


def largest_slope(x: Any) -> Any:
    """The largest magnitude of the derivatives that compiled code carries beside a number; 0.0 without."""
    return 0.0


def independent(numbers: Any, store: Any) -> Any:
    """A named tuple of numbers as what functions are differentiated by whose values go to `store`.

    Compiled code that carries derivatives in many directions carries there those by these few numbers alone;
    `by_chain_rule` takes the results back. Everywhere else the numbers themselves.
    """
    return numbers


def by_chain_rule(results: Any, numbers: Any, store: Any) -> Any:
    """A tuple of results that were evaluated at `independent` numbers, as results of these."""
    return results


def truncate(x: Any) -> Any:
    """The integer part of x ≥ 0, as an index."""
    return int(x) if type(x) is float else namespace(x).asarray(x).astype(int)


def last_at_or_below(grid: Any, x: Any) -> Any:
    """Index i of the last grid value ≤ x, limited to 0 … len(grid) − 2; `grid` increases."""
    xp = namespace(grid, x)
    return xp.clip(xp.searchsorted(grid, x, side="right") - 1, 0, grid.shape[0] - 2)


def last_axis_of_four(table: Any, a: Any, b: Any, c: Any, d: Any) -> Any:
    """The four neighbours table[a, b, c, d, 0 … 3], which compiled code can read at once.

    Of many places, arrays a and b, NumPy takes them from contiguous columns in a third of the time.
    """
    if isinstance(table, np.ndarray) and isinstance(b, np.ndarray) and b.ndim:
        columns = np.ascontiguousarray(table[:, :, c, d].reshape(-1, 4).T)
        return tuple(columns.take(a * table.shape[1] + b, axis=1))
    return table[a, b, c, d, 0], table[a, b, c, d, 1], table[a, b, c, d, 2], table[a, b, c, d, 3]


class StaticInt(int):
    """A number that kernels are compiled for, e.g. the number of states, so that their loops are unrolled."""


class Indices(tuple[int, ...]):
    """Whole numbers by place, e.g. the bodies at the ends of links."""


class RuntimeIndices(tuple[int, ...]):
    """The same as kernels read them at run time; hashable, static for JAX."""
