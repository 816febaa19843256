"""Shooting: Newton's method on x − Pⁿ(x) = 0 for many systems at once, and the Floquet multipliers there."""

from typing import NamedTuple

import numpy as np

from tribodyn.solve.period_map import PeriodMap

#: Halvings of a Newton step before shooting gives up, and the least relative decrease that it must bring.
HALVINGS = 7
DECREASE = 1e-3


class Shot(NamedTuple):
    """Where shooting came to for one system.

    Attributes
    ----------
    state : (N,)
    residual : float
        max |x − Pⁿ(x)| over the scale of each state; inf where the map failed.
    multipliers : (N,) complex
        Eigenvalues of the n-fold map's derivative, greatest modulus first: Floquet's where the residual
        vanishes.
    steps : int
        Newton steps taken.
    reason : str
        Why there is no solution; empty where the residual is within the tolerance.
    """

    state: np.ndarray
    residual: float
    multipliers: np.ndarray
    steps: int
    reason: str


def shoot(
    period_map: PeriodMap,
    states: np.ndarray,
    cases: np.ndarray,
    periods: int,
    tolerance: float,
    max_steps: int = 20,
) -> list[Shot]:
    """Look for fixed points of the n-fold map near given states.

    Parameters
    ----------
    period_map : PeriodMap
    states : (R, N)
        Where to start.
    cases : (R,) int
        The system of each row.
    periods : int
        n.
    tolerance : float
        Greatest scaled residual of a solution.
    max_steps : int
        Newton steps allowed; 0 only judges the states given.

    Notes
    -----
    Each row has its own damping: a step is halved until the residual falls. Rows fail on their own.
    """
    x = states.copy()
    scale = period_map.scale[cases]
    steps = np.zeros(len(x), dtype=int)
    found: list[Shot | None] = [None] * len(x)
    active = np.arange(len(x))
    while active.size:
        tangent = period_map.tangent(x[active], cases[active], periods)
        direction, residual = _newton_directions(x[active], tangent.image, tangent.jacobian, scale[active])
        going = []
        for k, row in enumerate(active):
            reason = tangent.reasons[k]
            if not reason and residual[k] > tolerance:
                if not np.all(np.isfinite(direction[k])):
                    reason = "the map's derivative has the multiplier 1: the steady state is not isolated"
                elif steps[row] >= max_steps:
                    reason = f"shooting ended after {max_steps} steps with the residual {residual[k]:.1e}"
                else:
                    going.append(k)
                    continue
            found[row] = Shot(
                x[row].copy(), float(residual[k]), _eigenvalues(tangent.jacobian[k]), int(steps[row]), reason
            )
        factor = _line_search(
            period_map, x[active[going]], direction[going], residual[going], cases[active[going]], periods
        )
        for k, share in zip(going, factor, strict=True):
            row = active[k]
            if share == 0.0:
                reason = f"shooting found no way down from the residual {residual[k]:.1e}"
                multipliers = _eigenvalues(tangent.jacobian[k])
                found[row] = Shot(x[row].copy(), float(residual[k]), multipliers, int(steps[row]), reason)
            x[row] += share * direction[k]
            steps[row] += 1
        active = np.array([row for row in active if found[row] is None], dtype=int)
    return [one for one in found if one is not None]


def _newton_directions(x, image, jacobian, scale) -> tuple[np.ndarray, np.ndarray]:
    """Newton steps (R, N), NaN where the equations are singular, and the scaled residuals (R,)."""
    off = (image - x) / scale
    residual = np.where(np.all(np.isfinite(off), axis=1), np.max(np.abs(off), axis=1), np.inf)
    direction = np.full_like(x, np.nan)
    for k in range(len(x)):
        # in units of the scale, so that the singular values can be compared
        matrix = jacobian[k] * scale[k] / scale[k][:, None]
        if np.all(np.isfinite(matrix)) and np.isfinite(residual[k]):
            left, values, right = np.linalg.svd(np.eye(len(matrix)) - matrix)
            if values[-1] > 1e-9 * max(1.0, values[0]):
                direction[k] = scale[k] * (right.T @ ((left.T @ off[k]) / values))
    return direction, residual


def _line_search(period_map, x, direction, residual, cases, periods) -> np.ndarray:
    """Shares of the Newton steps that lower the residuals; 0 where none does."""
    factor = np.ones(len(x))
    searching = np.arange(len(x))
    for _ in range(HALVINGS + 1):
        if not searching.size:
            return factor
        trial = x[searching] + factor[searching, None] * direction[searching]
        end = period_map.march(trial, cases[searching], periods, True).states[:, -1]
        off = np.max(np.abs(end - trial) / period_map.scale[cases[searching]], axis=1)
        lower = off < (1.0 - DECREASE * factor[searching]) * residual[searching]
        searching = searching[~lower]
        factor[searching] *= 0.5
    factor[searching] = 0.0
    return factor


def _eigenvalues(jacobian: np.ndarray) -> np.ndarray:
    if not np.all(np.isfinite(jacobian)):
        return np.full(len(jacobian), np.nan, dtype=complex)
    values = np.asarray(np.linalg.eigvals(jacobian), dtype=complex)
    return values[np.lexsort((-np.imag(values), -np.round(np.abs(values), 12)))]
