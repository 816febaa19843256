"""Two objectives: the front of candidates of which no other is better in both."""

from functools import partial
from typing import Any

import numpy as np

from tribodyn.studies.design.candidates.archive import Archive, Candidate
from tribodyn.studies.design.candidates.candidates import shares_of
from tribodyn.studies.design.methods.local import ended_when_spent, first_look, in_turn, minimise
from tribodyn.studies.design.methods.population import PER_KEY
from tribodyn.studies.design.methods.views import Scalar


def front(evaluations: list[Candidate]) -> list[Candidate]:
    """The feasible candidates that no other is better than in both objectives, by the first objective."""
    some = [candidate for candidate in evaluations if candidate.score.feasible]
    some.sort(key=lambda candidate: (candidate.score.objectives, candidate.numbers))
    found: list[Candidate] = []
    for candidate in some:
        if not found or candidate.score.objectives[1] < found[-1].score.objectives[1]:
            found.append(candidate)
    return found


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


def nsga2(archive: Archive, start: np.ndarray) -> None:
    """Search by NSGA-II, of the package pymoo."""
    from pymoo.algorithms.moo.nsga2 import NSGA2  # pyright: ignore[reportMissingImports]
    from pymoo.core.problem import Problem  # pyright: ignore[reportMissingImports]
    from pymoo.optimize import minimize  # pyright: ignore[reportMissingImports]

    case, count = archive.case, len(start)
    views = [Scalar(archive, place) for place in (0, 1)]

    class Wanted(Problem):  # pyright: ignore[reportGeneralTypeIssues, reportUntypedBaseClass]
        def __init__(self) -> None:
            super().__init__(n_var=count, n_obj=2, n_ieq_constr=len(case.constraints) + 1, xl=0.0, xu=1.0)

        def _evaluate(self, x: np.ndarray, out: dict[str, np.ndarray], *_: Any, **__: Any) -> None:
            scores = archive.score_all(list(x))
            out["F"] = np.array([[view.value(score) for view in views] for score in scores])
            missed = [[*(-m for m in score.margins), float(bool(score.message))] for score in scores]
            out["G"] = np.array(missed)

    size = max(16, PER_KEY * count)

    def search() -> None:
        minimize(
            Wanted(),
            NSGA2(pop_size=size),
            ("n_gen", max(2, case.search.evaluations // size)),
            seed=case.search.seed,
        )

    ended_when_spent(search)
