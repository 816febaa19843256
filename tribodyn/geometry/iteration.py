"""Newton's method with a fixed number of steps, the same under NumPy and, differentiable, under JAX."""

from collections.abc import Callable
from typing import Any

from tribodyn.elementary import namespace


def newton(step: Callable[..., Any], start: Any, count: int, *parameters: Any) -> Any:
    """Apply a Newton step a fixed number of times.

    Under JAX only the last step is differentiated: at the root that is the implicit function theorem, because
    the derivative of a Newton step by its start vanishes there. First derivatives are exact (in both modes),
    higher ones are not. The step must be Newton's with the exact slope.

    Parameters
    ----------
    step : callable
        (state, *parameters) -> state of the same shape; must not close over anything that is differentiated.
    start : array or tuple of arrays
        Where to start; near enough to converge in count − 1 steps.
    count : int
        Number of steps.
    *parameters : arrays, pytrees of arrays
        What the root depends on.
    """
    xp = namespace(start, *parameters)
    if xp.__name__ == "numpy":
        for _ in range(count):
            start = step(start, *parameters)
        return start
    import jax

    start = jax.tree.map(lambda leaf: xp.asarray(leaf, dtype=xp.result_type(leaf, 1.0)), start)
    fixed_start, fixed = jax.lax.stop_gradient((start, parameters))
    root = jax.lax.fori_loop(0, count - 1, lambda _, state: step(state, *fixed), fixed_start)
    return step(root, *parameters)
