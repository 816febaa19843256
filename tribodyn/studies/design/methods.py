"""The methods of a search by name: local ones, differential evolution, CMA-ES, NSGA-II, every combination.

All of them ask the archive and return nothing.
"""

import math
from collections.abc import Callable
from importlib.util import find_spec
from itertools import product
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.studies.design.candidates.archive import Archive
from tribodyn.studies.design.candidates.scoring import derivatives_of
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.local_search import Scalar, epsilon_constraint, local, sobol

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


Method = Callable[[Archive, np.ndarray], None]
"""Searches from the shares at which the base scenario stands."""

METHODS: dict[str, Method] = {
    "cobyqa": local("cobyqa"),
    "slsqp": local("slsqp"),
    "trust-constr": local("trust-constr"),
    "differential-evolution": differential_evolution,
    "cma-es": cma_es,
    "epsilon-constraint": epsilon_constraint,
    "nsga2": nsga2,
    "every": every,
}
FRONTS = ("epsilon-constraint", "nsga2")
#: Packages that methods are from.
PACKAGES = {"cma-es": "cma", "nsga2": "pymoo"}
#: Free keys above which derivatives are worth their program.
MANY = 6
#: Those that need values between which there are others.
SMOOTH = ("cobyqa", "slsqp", "trust-constr", "epsilon-constraint")


def method_of(case: DesignCase) -> tuple[str, str]:
    """Name of the method for a search, and why it is that one.

    Raises InputError for a method that does not fit what is searched, or whose package is not installed.
    """
    name, reason = _fitting(case)
    package = PACKAGES.get(name)
    if package and find_spec(package) is None:
        rule = f"the package {package} is not installed"
        raise InputError("design.method", f'"{name}"', rule, 'install it: pip install "tribodyn[design]"')
    return name, reason


def _fitting(case: DesignCase) -> tuple[str, str]:
    """The method that is wanted, or that fits, and why."""
    wanted = case.search.method
    count = math.prod(free.number_of_values for free in case.free)
    smooth = all(free.continuous for free in case.free)
    two = len(case.objectives) == 2
    if wanted == "auto":
        if not smooth and not two and count <= case.search.evaluations:
            return "every", "few enough values to evaluate every one"
        if two:
            name = "epsilon-constraint" if smooth else "nsga2"
            return name, "two objectives" + ("" if smooth else ", and whole numbers or choices")
        if not smooth:
            return "differential-evolution", "whole numbers or choices"
        if len(case.free) > MANY and derivatives_of(case):
            return "slsqp", "many continuous values, derivatives through JAX"
        return "cobyqa", "continuous values, quantities that may have kinks"
    if two != (wanted in FRONTS) and wanted != "every":
        rule = "needs two objectives" if not two else "takes one objective"
        remedy = "choose auto, or " + ("another method" if not two else " or ".join(FRONTS))
        raise InputError("design.method", f'"{wanted}"', rule, remedy)
    if wanted in SMOOTH and not smooth:
        rule = "whole numbers and choices are free, which it cannot search"
        raise InputError("design.method", f'"{wanted}"', rule, "choose differential-evolution or nsga2")
    if wanted == "every" and not count <= case.search.evaluations:
        rule = "there are more values than design.evaluations"
        raise InputError("design.method", f'"{wanted}"', rule, "choose another method, or more evaluations")
    return wanted, "chosen by the scenario"
