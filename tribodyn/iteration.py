"""Fixed numbers of steps, written once for NumPy and JAX.

Under tracing an unrolled loop multiplies the size of the program and the time it takes to compile; here the
steps after the first become one loop of the compiled program, differentiable in both modes.
"""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from tribodyn.elementary import namespace

State = TypeVar("State")
Array = Any


def iterate(step: Callable[[State], State], state: State, steps: int) -> State:
    """Apply `step` to `state` (an array or a tuple of arrays) `steps` ≥ 1 times.

    From the first step on the state must keep its shapes and types.
    """
    state = step(state)
    if namespace(state) is np:
        for _ in range(steps - 1):
            state = step(state)
        return state
    import jax

    return jax.lax.fori_loop(0, steps - 1, lambda _, current: step(current), state)


def chebyshev_basis(x: Array, degree: int) -> Array:
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
