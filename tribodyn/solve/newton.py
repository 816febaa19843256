"""Roots of many systems of equations at once, by damped Newton steps with Jacobians by differences."""

from collections.abc import Callable

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Values of the unknowns of rows, or what is left of their equations.
Trials = Float[Array, "row trial unknown"]
#: Change over the scale at which steps end, and steps at most.
_SETTLED, _MOST_STEPS = 1e-12, 60
#: Difference of an unknown over its scale; least share of a step.
_DIFFERENCE, _LEAST = 1e-5, 1e-4
_ROUNDING = float(np.finfo(float).eps)


def roots_of(
    residual: Callable[[Array, Trials], Trials],
    start: Float[Array, "row unknown"],
    scale: Float[Array, " unknown"],
    tolerance: Float[Array, " row"],
    bending: Float[Array, "number unknown"] | None = None,
) -> tuple[Float[Array, "row unknown"], Array]:
    """Where residuals are below a tolerance, by damped Newton steps, and of which rows they get there.

    `residual` takes numbers of rows and trials of each. It is linear, and alike in all rows, in whatever
    leaves the numbers bending @ values as they are; without these nothing is known of it, and what does not
    change it stays where it is.
    """
    count = bent = len(scale)
    basis = np.diag(scale)
    if bending is not None:
        _, sizes, directions = np.linalg.svd(bending * scale)
        basis, bent = scale[:, None] * directions.T, int(np.sum(sizes > count * _ROUNDING * sizes[0]))
    steps = np.vstack([np.zeros(count), _DIFFERENCE * basis.T])  # with a trial itself

    rows, values = np.arange(len(start)), start.copy()
    found = residual(rows, values[:, None] + steps[: 1 + bent])
    left, slopes = found[:, 0].copy(), np.empty((len(values), count, count))  # direction, equation
    slopes[:, :bent] = found[:, 1:] - found[:, :1]
    linear = residual(rows[:1], np.vstack([np.zeros(count), basis.T[bent:]])[None])[0]
    slopes[:, bent:] = _DIFFERENCE * (linear[1:] - linear[0])
    for _ in range(_MOST_STEPS):
        jacobian = np.swapaxes(slopes[rows], 1, 2) / _DIFFERENCE
        full = np.linalg.matrix_rank(jacobian) == count
        if bending is not None:
            rows, jacobian = rows[full], jacobian[full]  # of the others nothing resists
        if not rows.size:
            break
        if bending is not None or np.all(full):
            parts = -np.linalg.solve(jacobian, left[rows, :, None])[..., 0]
        else:
            parts = -(np.linalg.pinv(jacobian, _ROUNDING * count) @ left[rows, :, None])[..., 0]
        change, length = parts @ basis.T, np.linalg.norm(parts, axis=-1)
        size, factor = np.linalg.norm(left[rows], axis=-1), np.ones(len(rows))
        waiting, taken = np.arange(len(rows)), np.zeros(len(rows), bool)
        while waiting.size:
            at = rows[waiting]
            trial = values[at] + factor[waiting, None] * change[waiting]
            found = residual(at, trial[:, None] + steps[: 1 + bent])
            good = np.linalg.norm(found[:, 0], axis=-1) < size[waiting]  # false of what is not a number
            values[at[good]], left[at[good]] = trial[good], found[good, 0]
            slopes[at[good], :bent] = found[good, 1:] - found[good, :1]
            taken[waiting[good]] = True
            waiting = waiting[~good & (length[waiting] >= _SETTLED)]
            factor[waiting] *= 0.5
            waiting = waiting[factor[waiting] > _LEAST]
        rows = rows[taken & (factor * length >= _SETTLED)]
    return values, np.linalg.norm(left, axis=-1) <= tolerance
