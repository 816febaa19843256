"""Global searches by a population of candidates: differential evolution, CMA-ES."""

import numpy as np

from tribodyn.studies.design.candidates.archive import Archive
from tribodyn.studies.design.methods.local import ended_when_spent, sobol
from tribodyn.studies.design.methods.views import Scalar

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

    def search() -> None:
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

    ended_when_spent(search)


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

    def search() -> None:
        while not strategy.stop():
            candidates = strategy.ask()
            strategy.tell(candidates, view.merits(candidates).tolist())

    ended_when_spent(search)
