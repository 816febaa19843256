"""Unknowns of a model by least squares, with their covariance, and whether what is left is noise.

Unknowns are shares of their ranges, 0 … 1. For independent noise of one variance in all residuals the
estimate is normal about the truth, to first order in the noise, with the covariance s² (JᵀJ)⁻¹,
s² = rᵀr/(n − p) of n residuals r and p unknowns (Seber & Wild, Nonlinear Regression (1989), 2.1.2): intervals
are by Student's t of n − p degrees of freedom.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Gives residuals (n,) at several places (k, p) at once.
Residuals = Callable[[Float[Array, "place unknown"]], list[Float[Array, " residual"]]]
Search = Callable[[Callable[[Float[Array, "place unknown"]], Float[Array, " place"]], np.ndarray], np.ndarray]

#: Difference of a share over which a derivative is taken: far above the error of the integration, which is
#: about its tolerance, and so small that curvature does not matter.
STEP = 2e-3
#: Tolerance of the shares and of the sum of squares, and evaluations at most.
TOLERANCE, EVALUATIONS = 1e-6, 60
#: Room that a start keeps from the ends of its range.
MARGIN = 0.02
#: Ratio of singular values beyond which the data do not tell the unknowns apart.
WORST_CONDITION = 1e8
#: Lags of the residual's autocorrelation, and the probability below which it is not called white.
LAGS, WHITE = 20, 1e-3


class Fit(NamedTuple):
    """An estimate."""

    shares: Float[Array, " unknown"]
    covariance: Float[Array, "unknown unknown"]  # of the shares; infinite where the data do not tell them
    deviation: float  # of the noise, in the unit of the residuals
    freedom: int  # residuals less unknowns
    evaluations: int  # of the residuals, those for derivatives included
    residuals: Float[Array, " residual"]

    def half_width(self, level: float) -> Float[Array, " unknown"]:
        """Half the width of the shares' intervals of a level, such as 0.95."""
        from scipy.special import stdtrit

        return stdtrit(self.freedom, 0.5 + level / 2.0) * np.sqrt(np.diag(self.covariance))


def fitted(
    residuals: Residuals, starts: Sequence[Float[Array, " unknown"]], search: Search | None = None
) -> Fit:
    """Fit from the best of some starts, by Gauss-Newton in a trust region within the ranges.

    Derivatives are central differences, taken side by side. A `search` goes before: from a function of many
    places at once, their sums of squares, and a start to a better one.
    """
    from scipy.optimize import least_squares

    count = 0

    def at(places: np.ndarray) -> list[np.ndarray]:
        nonlocal count
        count += len(places)
        return residuals(np.clip(places, 0.0, 1.0))

    def squares(places: np.ndarray) -> np.ndarray:
        return np.array([float(np.sum(values**2)) for values in at(np.atleast_2d(places))])

    def jacobian(place: np.ndarray) -> np.ndarray:
        ends = np.repeat(place[None], 2 * len(place), axis=0)
        for i in range(len(place)):
            ends[2 * i, i], ends[2 * i + 1, i] = min(place[i] + STEP, 1.0), max(place[i] - STEP, 0.0)
        values = at(ends)
        columns = [
            (values[2 * i] - values[2 * i + 1]) / (ends[2 * i, i] - ends[2 * i + 1, i])
            for i in range(len(place))
        ]
        return np.stack(columns, axis=1)

    begun = np.clip(np.array(starts), MARGIN, 1.0 - MARGIN)
    start = begun[int(np.argmin(squares(begun)))] if len(begun) > 1 else begun[0]
    if search is not None:
        start = np.clip(search(squares, start), MARGIN, 1.0 - MARGIN)
    solution = least_squares(
        lambda place: at(place[None])[0],
        start,
        jac=jacobian,  # pyright: ignore[reportArgumentType]
        bounds=(0.0, 1.0),
        xtol=TOLERANCE,
        ftol=TOLERANCE**2,
        gtol=None,  # pyright: ignore[reportArgumentType]
        max_nfev=EVALUATIONS,
    )
    rest = np.asarray(solution.fun)
    freedom = len(rest) - len(start)
    variance = float(rest @ rest) / freedom
    return Fit(
        np.asarray(solution.x),
        covariance_of(jacobian(np.asarray(solution.x)), variance),
        float(np.sqrt(variance)),
        freedom,
        count,
        rest,
    )


def covariance_of(
    jacobian: Float[Array, "residual unknown"], variance: float
) -> Float[Array, "unknown unknown"]:
    """s² (JᵀJ)⁻¹; infinite where the columns of J are dependent."""
    _, values, rows = np.linalg.svd(jacobian, full_matrices=False)
    if not values.size or not values[-1] * WORST_CONDITION > values[0]:
        return np.full((jacobian.shape[1],) * 2, np.inf)
    return variance * (rows.T / values**2) @ rows


def whiteness(residuals: Float[Array, " sample"]) -> float:
    """Probability of so large an autocorrelation in white noise: Ljung & Box, Biometrika 65 (1978) 297.

    Q = n (n + 2) Σ r_k²/(n − k) over `LAGS` lags, which is χ² of as many degrees of freedom.
    """
    from scipy.special import chdtrc

    values = np.asarray(residuals, dtype=float) - np.mean(residuals)
    count, power = len(values), float(values @ values)
    lags = min(LAGS, count // 4)
    if power == 0.0 or lags < 1:
        return 1.0
    each = np.array([values[k:] @ values[:-k] for k in range(1, lags + 1)]) / power
    statistic = count * (count + 2.0) * float(np.sum(each**2 / (count - np.arange(1, lags + 1))))
    return float(chdtrc(lags, statistic))


def sobol(unknowns: int, count: int, seed: int) -> Float[Array, "place unknown"]:
    """Starts that are spread evenly over the ranges; `count` is a power of two."""
    from scipy.stats.qmc import Sobol

    return Sobol(unknowns, rng=np.random.default_rng(seed)).random(count)


def evolution(
    seed: int,
) -> Search:
    """A search by CMA-ES, of the package cma: where sums of squares have many valleys."""
    import cma  # pyright: ignore[reportMissingImports]

    def search(squares: Callable[[np.ndarray], np.ndarray], start: np.ndarray) -> np.ndarray:
        settings = {"bounds": [0.0, 1.0], "seed": seed + 1, "verbose": -9, "tolx": 1e-3}
        settings["popsize"] = max(8, 4 * len(start))
        strategy = cma.CMAEvolutionStrategy(start, 0.25, settings)
        while not strategy.stop():
            places = np.array(strategy.ask())
            strategy.tell(list(places), squares(places).tolist())
        return np.asarray(strategy.result.xbest)

    return search
