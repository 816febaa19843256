"""Local searches by SciPy from the best of a Sobol sequence, and the front that they make of two objectives.

They run side by side, but COBYQA, which SciPy locks.
"""

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.studies.design.candidates.archive import Archive, SpentError, front
from tribodyn.studies.design.candidates.candidates import chosen, shares_of
from tribodyn.studies.design.candidates.scoring import (
    NO_FIGURES,
    SLACK,
    Derivatives,
    Score,
    margin_slope,
    objective_slope,
)
from tribodyn.studies.design.case import DesignCase

#: Stands for the objective of a candidate without figures, over that of the start.
POOR = 1.5


class Scalar:
    """One objective, relative to the start, and margins that must not be negative.

    Parameters
    ----------
    bound : upper bound of the other objective
    """

    def __init__(self, archive: Archive, objective: int = 0, bound: float | None = None) -> None:
        self.archive = archive
        self.objective = objective
        self.bound = bound
        self.scales = [self._scale(place) for place in range(len(archive.case.objectives))]

    def _scale(self, place: int) -> float:
        values = [candidate.score.objectives[place] for candidate in self.archive.evaluations]
        known = [abs(value) for value in values if math.isfinite(value) and value]
        return known[0] if known else 1.0

    def value(self, score: Score) -> float:
        """The objective over its scale; a poor one where there is none."""
        value = score.objectives[self.objective] / self.scales[self.objective]
        return value if math.isfinite(value) else POOR

    def margins(self, score: Score) -> list[float]:
        """Margins of the constraints, that of the bound last."""
        margins = [self._unknown(score) if score.message else margin for margin in score.margins]
        if score.shape is not None:
            margins.append(score.shape)
        if self.bound is None:
            return margins
        other = score.objectives[1 - self.objective]
        room = (self.bound - other) / self.scales[1 - self.objective]
        return [*margins, room if math.isfinite(room) else self._unknown(score)]

    @staticmethod
    def _unknown(score: Score) -> float:
        """Stands for a margin of a candidate without figures: the distance of its shape, if known."""
        return -NO_FIGURES if score.shape is None else min(score.shape, 0.0)

    def merit(self, score: Score) -> float:
        """Objective of a feasible candidate; of others above all those, growing with what they miss."""
        missed = -sum(min(0.0, margin) for margin in self.margins(score))
        if score.message:
            return 1e6 + score.violation
        return 1e6 + missed if missed > SLACK else self.value(score)

    def merits(self, several: Sequence[np.ndarray]) -> np.ndarray:
        """Merits of candidates that are evaluated side by side."""
        return np.array([self.merit(score) for score in self.archive.score_all(several)])


#: Share of the evaluations that go into the first look, and how many of them a free key is worth at most.
FIRST_LOOK, LOOK_PER_KEY = 0.3, 10
#: Relative gain that another search from the best is worth.
GAIN = 1e-3
#: Share of its limit that is kept to a constraint: a search that comes from outside ends inside.
INSIDE = 1e-4
#: First radius of the trust region, and step of differences, as shares of the ranges.
RADIUS, STEP = 0.15, 2e-3


def local(name: str) -> Callable[[Archive, np.ndarray], None]:
    """Return the method that searches locally by one of SciPy's minimisers."""

    def search(archive: Archive, start: np.ndarray) -> None:
        view = Scalar(archive)
        places = first_look(view, start)
        searches = [lambda place=place: minimise(name, view, place) for place in places]
        if name == "cobyqa":
            in_turn(searches)
        else:
            together(archive, searches)
        ended_when_spent(lambda: rounds(name, view))

    return search


def rounds(name: str, view: Scalar) -> None:
    """Search again from the best, each time nearer about it, as long as that finds a better one.

    A figure such as a maximum has kinks, on which a local search may end too early.
    """
    archive, radius, before = view.archive, RADIUS / 2, np.inf
    best = archive.best()
    finest = archive.case.search.accuracy
    while best is not None and radius > finest and view.value(best.score) < before - GAIN:
        before = view.value(best.score)
        minimise(name, view, shares_of(archive.case, best.values), radius=radius)
        best, radius = archive.best(), radius / 2


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


def in_turn(searches: Sequence[Callable[[], None]]) -> None:
    """Run searches one after the other: SciPy runs one COBYQA at a time, whichever begins first."""
    for search in searches:
        ended_when_spent(search)


def together(archive: Archive, searches: Sequence[Callable[[], None]]) -> None:
    """Run searches side by side; each waits for its own evaluations, and may take its share of them.

    Shares are equal; the first searches take what is left over.
    """
    share, over = divmod(archive.room, max(1, len(searches)))
    before = archive.requested

    def alone(number: int, search: Callable[[], None]) -> None:
        with archive.at_most(share + (number < over), before):
            ended_when_spent(search)

    with ThreadPoolExecutor(len(searches) or 1) as threads:
        try:
            for running in [threads.submit(alone, *each) for each in enumerate(searches)]:
                running.result()
        except BaseException:
            archive.close()
            raise


def ended_when_spent(search: Callable[[], None]) -> None:
    """Run a search until it ends or the evaluations are spent."""
    try:
        search()
    except SpentError:
        return


def minimise(
    name: str, view: Scalar, start: np.ndarray, most: int | None = None, radius: float = RADIUS
) -> None:
    """Search from shares of the free keys' ranges, with at most so many evaluations."""
    from scipy.optimize import NonlinearConstraint, minimize

    search, count = view.archive.case.search, len(start)
    margins = len(view.margins(view.archive.score(start)))

    def function(shares: np.ndarray) -> float:
        return view.value(view.archive.score(shares))

    def constraint(shares: np.ndarray) -> np.ndarray:
        return np.array(view.margins(view.archive.score(shares)))

    derivatives: dict[str, Any] = {}
    slopes: dict[str, Any] = {}
    most = most or search.evaluations
    if name == "cobyqa":
        options = {"initial_tr_radius": radius, "final_tr_radius": search.accuracy, "maxfev": most}
    else:
        gradient, jacobian = slopes_of(view, derivatives_of(view.archive.case))
        derivatives, slopes = {"jac": gradient}, {"jac": jacobian, "hess": _curvature()}
        options = {"ftol": 1e-6, "maxiter": most}
    if name == "trust-constr":
        derivatives["hess"] = _curvature()
        options = {"initial_tr_radius": radius, "xtol": search.accuracy, "maxiter": most}
    constraints: Any = (NonlinearConstraint(constraint, INSIDE, np.inf, **slopes),) if margins else ()
    minimize(
        function,
        np.clip(start, 0.0, 1.0),
        method=name.upper() if name != "trust-constr" else name,
        bounds=[(0.0, 1.0)] * count,
        constraints=constraints,
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


def derivatives_of(case: DesignCase) -> Derivatives | None:
    """Derivatives of a search's figures through JAX; None where they cannot be differentiated."""
    try:
        return Derivatives(case)
    except InputError:
        return None


def slopes_of(
    view: Scalar, derivatives: Derivatives | None
) -> tuple[Callable[[np.ndarray], Any], Callable[[np.ndarray], Any]]:
    """Slopes of value and of margins: through JAX, or by differences whose candidates are side by side."""
    archive = view.archive
    aim = archive.case.objectives[view.objective]

    def exact(shares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        shares = np.clip(shares, 0.0, 1.0)
        found = archive.figures_of(shares)
        assert derivatives is not None
        slopes = derivatives.at(shares)
        value = objective_slope(archive.scoring, aim, found, slopes) / view.scales[view.objective]
        limits = archive.case.constraints
        margins = [margin_slope(archive.scoring, limit, found, slopes) for limit in limits]
        middle = archive.score(shares).shape
        if middle is not None:
            steps = np.where(shares + STEP <= 1.0, STEP, -STEP)
            around = [archive.shape_of(chosen(archive.case, share)) for share in shares + np.diag(steps)]
            margins.append(np.array([(shape or 0.0) - middle for shape in around]) / steps)
        return value, np.array(margins).reshape(-1, len(shares))

    def slopes(shares: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        shares = np.clip(shares, 0.0, 1.0)
        if derivatives is not None and view.bound is None and not archive.score(shares).message:
            return exact(shares)
        steps = np.where(shares + STEP <= 1.0, STEP, -STEP)
        around = shares + np.diag(steps)
        middle, *others = view.archive.score_all([shares, *around])
        value = np.array([view.value(other) - view.value(middle) for other in others]) / steps
        at_middle = np.array(view.margins(middle))
        margins = np.array([np.array(view.margins(other)) - at_middle for other in others]).T / steps
        return value, margins

    return lambda shares: slopes(shares)[0], lambda shares: slopes(shares)[1]


def epsilon_constraint(archive: Archive, start: np.ndarray) -> None:
    """Minimise each objective alone, then the first under bounds of the second between, by COBYQA."""
    case = archive.case
    share = case.search.evaluations // (case.search.points + 1)

    def search() -> None:
        ends = [Scalar(archive, place) for place in (0, 1)]
        places = [first_look(view, start)[0] for view in ends]
        in_turn(
            [
                partial(minimise, "cobyqa", view, place, share)
                for view, place in zip(ends, places, strict=True)
            ]
        )
        found = front(archive.evaluations)
        if len(found) < 2:
            return
        high, low = found[0].score.objectives[1], found[-1].score.objectives[1]
        bounds = np.linspace(high, low, case.search.points)[1:-1]
        in_turn([partial(_under, archive, float(bound), share) for bound in bounds])

    ended_when_spent(search)


def _under(archive: Archive, bound: float, most: int) -> None:
    """Minimise the first objective from the best candidate that keeps a bound of the second."""
    keeping = [point for point in front(archive.evaluations) if point.score.objectives[1] <= bound]
    if keeping:
        best = min(keeping, key=lambda point: point.score.objectives[0])
        minimise("cobyqa", Scalar(archive, 0, bound), shares_of(archive.case, best.values), most)
