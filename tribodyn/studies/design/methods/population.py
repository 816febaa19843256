"""Global searches: differential evolution, CMA-ES, NSGA-II, every combination of numbers and choices."""

from itertools import product
from typing import Any

import numpy as np

from tribodyn.studies.design.candidates.archive import Archive
from tribodyn.studies.design.methods.local import Scalar, sobol

#: Candidates in a generation per free key.
PER_KEY = 6


def differential_evolution(archive: Archive, start: np.ndarray) -> None:
    """Search by SciPy's differential evolution; a whole generation is evaluated side by side."""
    from scipy.optimize import differential_evolution as evolve

    case, count = archive.case, len(start)
    view = Scalar(archive)
    size = max(8, PER_KEY * count)
    first = sobol(count, size, case.search.seed)
    first[0] = np.clip(start, 0.0, 1.0)

    evolve(
        lambda shares: view.merits(list(np.atleast_2d(shares.T))),
        bounds=[(0.0, 1.0)] * count,
        init=first,  # pyright: ignore[reportArgumentType]
        maxiter=case.search.evaluations,
        tol=case.search.accuracy,
        rng=np.random.default_rng(case.search.seed),
        polish=False,
        updating="deferred",
        vectorized=True,
    )


def cma_es(archive: Archive, start: np.ndarray) -> None:
    """Search by CMA-ES, of the package cma."""
    import cma  # pyright: ignore[reportMissingImports]

    case, count = archive.case, len(start)
    view = Scalar(archive)
    settings = {
        "bounds": [0.0, 1.0],
        "seed": case.search.seed + 1,  # it takes 0 for the clock
        "verbose": -9,
        "popsize": max(8, PER_KEY * count // 2),
        "tolx": case.search.accuracy,
    }
    strategy = cma.CMAEvolutionStrategy(np.clip(start, 0.05, 0.95), 0.25, settings)

    while not strategy.stop():
        candidates = strategy.ask()
        strategy.tell(candidates, view.merits(candidates).tolist())


def every(archive: Archive, _start: np.ndarray) -> None:
    """Evaluate every combination."""
    axes = []
    for free in archive.case.free:
        count = int(free.number_of_values)
        places = np.arange(count)
        axes.append((places + 0.5) / count if free.choices else places / max(1, count - 1))
    archive.score_all(list(product(*axes)))


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
    generations = ("n_gen", max(2, case.search.evaluations // size))
    minimize(Wanted(), NSGA2(pop_size=size), generations, seed=case.search.seed)
