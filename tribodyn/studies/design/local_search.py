"""Local searches by SciPy from the best of a Sobol sequence, and the front that they make of two objectives.

They run one after the other: SciPy runs one COBYQA at a time. What each asks for at once, the first look and
differences, is evaluated side by side.
"""

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from tribodyn.studies.design.candidates.archive import Archive
from tribodyn.studies.design.candidates.candidates import chosen, shares_of
from tribodyn.studies.design.candidates.scoring import NO_QUANTITIES, SLACK, Score, derivatives_of

#: Stands for the objective of a candidate without quantities, over that of the start.
POOR = 1.5
#: Share of the evaluations that go into the first look, and how many of them a free key is worth at most.
FIRST_LOOK, LOOK_PER_KEY = 0.3, 10
#: Relative gain that another search from the best is worth.
GAIN = 1e-3
#: Share of its limit that is kept to a constraint: a search that comes from outside ends inside.
INSIDE = 1e-4
#: First radius of the trust region, and step of differences, as shares of the ranges.
RADIUS, STEP = 0.15, 2e-3


class Scalar:
    """One objective, relative to the start, and margins that must not be negative: what minimisers take."""

    def __init__(self, archive: Archive, objective: int = 0, bound: float | None = None) -> None:
        self.archive = archive
        self.objective = objective
        self.bound = bound  # upper, of the other objective
        self.scales = [self._scale(place) for place in range(len(archive.case.objectives))]

    def _scale(self, place: int) -> float:
        values = (candidate.score.objectives[place] for candidate in self.archive.evaluations)
        return next((abs(value) for value in values if math.isfinite(value) and value), 1.0)

    def value(self, score: Score) -> float:
        """The objective over its scale; a poor one where there is none."""
        value = score.objectives[self.objective] / self.scales[self.objective]
        return value if math.isfinite(value) else POOR

    def margins(self, score: Score) -> list[float]:
        """Margins of the constraints, that of the bound last.

        Those of a candidate without quantities are the distance of its shape, if that is known.
        """
        unknown = -NO_QUANTITIES if score.shape is None else min(score.shape, 0.0)
        margins = [unknown if score.message else margin for margin in score.margins]
        if score.shape is not None:
            margins.append(score.shape)
        if self.bound is not None:
            other = 1 - self.objective
            room = (self.bound - score.objectives[other]) / self.scales[other]
            margins.append(room if math.isfinite(room) else unknown)
        return margins

    def merit(self, score: Score) -> float:
        """Objective of a feasible candidate; of others above all those, growing with what they miss."""
        if score.message:
            return 1e6 + score.violation
        missed = -sum(min(0.0, margin) for margin in self.margins(score))
        return 1e6 + missed if missed > SLACK else self.value(score)

    def merits(self, several: Sequence[np.ndarray]) -> np.ndarray:
        """Merits of candidates that are evaluated side by side."""
        return np.array([self.merit(score) for score in self.archive.score_all(several)])


def local(name: str) -> Callable[[Archive, np.ndarray], None]:
    """Return the method that searches locally by one of SciPy's minimisers.

    It searches again from the best, each time nearer about it, as long as that finds a better one: a quantity
    such as a maximum has kinks, on which a local search may end too early.
    """

    def search(archive: Archive, start: np.ndarray) -> None:
        view = Scalar(archive)
        for place in first_look(view, start):
            minimise(name, view, place)
        best, before, radius = archive.best(), np.inf, RADIUS / 2
        finest = archive.case.search.accuracy
        while best is not None and radius > finest and view.value(best.score) < before - GAIN:
            before = view.value(best.score)
            minimise(name, view, shares_of(archive.case, best.values), radius=radius)
            best, radius = archive.best(), radius / 2

    return search


def epsilon_constraint(archive: Archive, start: np.ndarray) -> None:
    """Minimise each objective alone, then the first under bounds of the second between, by COBYQA.

    Under a bound it starts from the best candidate that keeps it.
    """
    case = archive.case
    share = case.search.evaluations // (case.search.points + 1)
    ends = [Scalar(archive, place) for place in (0, 1)]
    places = [first_look(view, start)[0] for view in ends]
    for view, place in zip(ends, places, strict=True):
        minimise("cobyqa", view, place, share)
    front = archive.front()
    if len(front) < 2:
        return
    high, low = front[0].score.objectives[1], front[-1].score.objectives[1]
    for bound in map(float, np.linspace(high, low, case.search.points)[1:-1]):
        keeping = [point for point in archive.front() if point.score.objectives[1] <= bound]
        if keeping:
            first = shares_of(case, keeping[0].values)
            minimise("cobyqa", Scalar(archive, 0, bound), first, share)


def first_look(view: Scalar, start: np.ndarray) -> list[np.ndarray]:
    """Evaluate points of a Sobol sequence and the start; the best of them that are apart from each other."""
    search, count = view.archive.case.search, len(start)
    room = min(int(FIRST_LOOK * search.evaluations), LOOK_PER_KEY * count)
    points = [np.clip(start, 0.0, 1.0), *sobol(count, max(1, room - 1), search.seed)]
    order = np.argsort(view.merits(points), kind="stable")
    places: list[np.ndarray] = []
    for i in order:
        if all(np.max(np.abs(points[i] - other)) > 1.5 * RADIUS for other in places):
            places.append(points[i])
        if len(places) == search.starts:
            break
    return places


def sobol(dimensions: int, count: int, seed: int) -> np.ndarray:
    """Points (count, dimensions) of a scrambled Sobol sequence in 0 … 1."""
    from scipy.stats import qmc

    power = int(np.ceil(np.log2(max(2, count))))
    return qmc.Sobol(dimensions, rng=np.random.default_rng(seed)).random_base2(power)[:count]


def minimise(
    name: str, view: Scalar, start: np.ndarray, most: int | None = None, radius: float = RADIUS
) -> None:
    """Search from shares of the free keys' ranges, with at most so many evaluations."""
    from scipy.optimize import NonlinearConstraint, minimize

    search = view.archive.case.search
    margins = view.margins(view.archive.score(start))

    derivatives: dict[str, Any] = {}
    slopes: dict[str, Any] = {}
    most = most or search.evaluations
    if name == "cobyqa":
        options = {"initial_tr_radius": radius, "final_tr_radius": search.accuracy, "maxfev": most}
    else:
        of_both = slopes_of(view)
        derivatives = {"jac": lambda shares: of_both(tuple(shares))[0]}
        slopes = {"jac": lambda shares: of_both(tuple(shares))[1], "hess": _curvature()}
        options = {"ftol": 1e-6, "maxiter": most}
    if name == "trust-constr":
        derivatives["hess"] = _curvature()
        options = {"initial_tr_radius": radius, "xtol": search.accuracy, "maxiter": most}
    inside = NonlinearConstraint(
        lambda shares: np.array(view.margins(view.archive.score(shares))), INSIDE, np.inf, **slopes
    )
    minimize(
        lambda shares: view.value(view.archive.score(shares)),
        np.clip(start, 0.0, 1.0),
        method=name,
        bounds=[(0.0, 1.0)] * len(start),
        constraints=(inside,) if margins else (),
        options=options,  # pyright: ignore[reportArgumentType]
        **derivatives,
    )


def _curvature() -> Any:
    """An approximation of the curvature from slopes, which takes those that do not change without a word."""
    from scipy.optimize import BFGS

    class Curvature(BFGS):
        def update(self, delta_x: np.ndarray, delta_grad: np.ndarray) -> None:
            if np.any(delta_grad):
                super().update(delta_x, delta_grad)

    return Curvature()


def slopes_of(view: Scalar) -> Callable[[tuple[float, ...]], tuple[np.ndarray, np.ndarray]]:
    """Slopes of value and of margins: through JAX, or by differences whose candidates are side by side."""
    archive, case, scoring = view.archive, view.archive.case, view.archive.scoring
    derivatives = derivatives_of(case)

    @lru_cache(maxsize=1)  # minimisers ask for one after the other
    def slopes(at: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
        shares = np.clip(at, 0.0, 1.0)
        steps = np.where(shares + STEP <= 1.0, STEP, -STEP)
        around = shares + np.diag(steps)
        middle = archive.score(shares)
        if derivatives is None or middle.message:
            others = archive.score_all(list(around))
            value = np.array([view.value(other) - view.value(middle) for other in others]) / steps
            at_middle = np.array(view.margins(middle))
            return value, np.array([np.array(view.margins(other)) - at_middle for other in others]).T / steps
        results, by_case = archive.found_of(chosen(case, shares)).result(), derivatives.at(shares)
        value = scoring.objective_slope(case.objectives[0], results, by_case) / view.scales[0]
        margins = [scoring.margin_slope(limit, results, by_case) for limit in case.constraints]
        if middle.shape is not None:
            shapes = [archive.shape_of(chosen(case, share)) or 0.0 for share in around]
            margins.append(np.array([shape - middle.shape for shape in shapes]) / steps)
        return value, np.array(margins).reshape(-1, len(shares))

    return slopes
