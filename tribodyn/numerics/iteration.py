"""Fixed numbers of steps, written once for NumPy and JAX: iterations, Newton's method, recurrences.

Under tracing an unrolled loop multiplies the size of the program and the time it takes to compile; here the
steps after the first become one loop of the compiled program, differentiable in both modes.
"""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.shapes import Array, Float

State = TypeVar("State")


def iterate(step: Callable[[State], State], state: State, steps: int, differentiated: int = 0) -> State:
    """Apply `step` to `state` (an array or a tuple of arrays) `steps` ≥ 1 times.

    From the first step on the state must keep its shapes and types; one that has them from the start makes
    half the program. Under JAX only the last `differentiated` steps are differentiated, 0: all. That is for
    iterations that forget where they started: where a step shrinks the error by the factor q, derivatives
    have an error of q to that power.
    """
    if namespace(state) is np:
        state, steps = step(state), steps - 1
    if namespace(state) is np:
        for _ in range(steps):
            state = step(state)
        return state
    import jax

    if jax.eval_shape(step, state) != jax.eval_shape(lambda same: same, state):
        state, steps = step(state), steps - 1
    if 0 < differentiated < steps:
        plain_step, parameters = jax.closure_convert(step, state)
        fixed, state = jax.lax.stop_gradient((parameters, state))
        first = steps - differentiated
        state = jax.lax.fori_loop(0, first, lambda _, current: plain_step(current, *fixed), state)
        steps = differentiated
    return jax.lax.fori_loop(0, steps, lambda _, current: step(current), state)


def by_rows(function: Callable[[Any], Any], rows: tuple[Any, ...], count: int) -> list[Any]:
    """Apply a function of arrays, which takes each row by itself, to so many rows at a time.

    It takes a list of arrays and returns one. Under JAX one loop of the compiled program, whose last part is
    filled up with the last row: memory is that of some rows, for derivatives too.
    """
    xp, length = namespace(*rows), len(rows[0])
    if xp is np:
        results = [function([row[i : i + count] for row in rows]) for i in range(0, length, count)]
        return [xp.concatenate(parts) for parts in zip(*results, strict=True)]
    import jax

    place = np.minimum(np.arange(-(-length // count) * count), length - 1).reshape(-1, count)
    results = jax.lax.map(function, [xp.asarray(row)[place] for row in rows])
    return [part.reshape(-1, *part.shape[2:])[:length] for part in results]


def newton(step: Callable[..., Any], start: Any, count: int, *parameters: Any) -> Any:
    """Apply a Newton step a fixed number of times; with NumPy, until it changes nothing.

    Under JAX only the last step is differentiated: at the root that is the implicit function theorem, because
    the derivative of a Newton step by its start vanishes there. First derivatives are exact (in both modes),
    higher ones are not. The step, (state, *parameters) -> state of the same shape, must be Newton's with the
    exact slope, or become it at the root, and close over nothing that is differentiated. The start must be
    near enough to converge in count − 1 steps.
    """
    xp = namespace(start, *parameters)
    if xp.__name__ == "numpy":
        for _ in range(count):
            before, start = start, step(start, *parameters)
            if _equal(before, start):  # further steps leave it
                break
        return start
    import jax

    start = jax.tree.map(lambda leaf: xp.asarray(leaf, dtype=xp.result_type(leaf, 1.0)), start)
    fixed_start, fixed = jax.lax.stop_gradient((start, parameters))
    root = jax.lax.fori_loop(0, count - 1, lambda _, state: step(state, *fixed), fixed_start)
    return step(root, *parameters)


def _equal(state: Any, other: Any) -> bool:
    """Whether two states of arrays are equal, bit for bit; NaN never is."""
    if isinstance(state, tuple):
        return all(map(_equal, state, other))
    return bool(np.all(state == other)) and np.shape(state) == np.shape(other)


def chebyshev_basis(x: Float[Array, "*point"], degree: int) -> Float[Array, "*point degree"]:
    """Chebyshev polynomials T_0(x) … T_degree(x), degree ≥ 1, along a new last axis.

    By the three-term recurrence: stable on −1 … 1 and, unlike cos(n arccos x), differentiable at the ends.
    """
    xp = namespace(x)
    if xp is np:
        columns = [np.ones_like(x), x]
        while len(columns) <= degree:
            columns.append(2.0 * x * columns[-1] - columns[-2])
        return np.stack(columns, axis=-1)
    import jax

    def advance(pair: Any, _: Any) -> Any:
        return (pair[1], 2.0 * x * pair[1] - pair[0]), pair[0]

    _, columns = jax.lax.scan(advance, (xp.ones_like(x), x), length=degree + 1)
    return xp.moveaxis(columns, 0, -1)
