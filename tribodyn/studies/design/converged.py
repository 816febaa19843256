"""The last stage of a search: finer, until the figure of the best no longer depends on the resolution.

Methods search on the resolution of the scenario. Where the figure of the best changes on a finer one, the
best candidates are evaluated again and searched about on one that is `SEARCHED` times as fine, and the best
of those on finer ones. Constraints are those of the last one.
"""

import math
from contextlib import suppress
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from tribodyn.studies import study_of
from tribodyn.studies.design.archive import Archive, Evaluation, SpentError
from tribodyn.studies.design.candidates import Overrides, cases_of, share_of
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.evaluation import loaded_case
from tribodyn.studies.design.judged import Judge
from tribodyn.studies.design.methods import SMOOTH
from tribodyn.studies.design.methods.local import RADIUS, minimise
from tribodyn.studies.design.methods.views import Scalar
from tribodyn.studies.design.pool import Evaluators
from tribodyn.studies.design.sources import own

#: Relative change of the figure from one resolution to the next, twice in a row, within which it stands. What
#: is left of errors of first order is as much again.
STANDS = 2.5e-3
#: Resolutions over that of the scenario, none a multiple of the one before: the same positions would give the
#: same extremes. On the third of them is searched about the best.
FACTORS = (1, 2, 5, 11, 23, 47)
SEARCHED = FACTORS[2]
#: Candidates that are evaluated on finer resolutions; share of `evaluations` of the search about the best.
KEPT, SHARE = 6, 1 / 2
#: Size of the first simplex about the best, as a share of the ranges.
SIMPLEX = 0.01


class Converged(NamedTuple):
    """Where a search ended.

    Attributes
    ----------
    archive : Archive
        Of the last resolution.
    factor : int
        That one over the resolution of the scenario; 1: there is none to refine.
    stands : bool or None
        Whether the figure stands; None where that was not asked.
    evaluations : int
        On finer resolutions.
    """

    archive: Archive
    factor: int = 1
    stands: bool | None = None
    evaluations: int = 0


def resolutions(case: DesignCase, factor: int) -> Overrides:
    """Resolutions of the scenarios times a factor, by key; of parts with their names before it."""
    found: Overrides = {}
    for name, data in case.scenarios.items():
        study = study_of(data)
        one = loaded_case(data, own(name, study.table(data), {}, case.parts)).case
        table, _, number = study.resolution.rpartition(".")
        if number:
            holder = one if hasattr(one, number) else getattr(one, table)
            key = f"{name}.{study.resolution}" if name else study.resolution
            found[key] = factor * getattr(holder, number)
    return found


def converged(case: DesignCase, archive: Archive, pool: Evaluators, method: str) -> Converged:
    """Go on from what a search found until the figure of its best stands; a front is left as it is."""
    if len(case.objectives) > 1 or not resolutions(case, 1) or archive.best() is None:
        return Converged(archive)
    levels = {1: archive}

    def at(factor: int) -> Archive:
        if factor not in levels:
            more = resolutions(case, factor)
            judge = Judge(case, pool.submit(cases_of(case, {}, more)).result())
            levels[factor] = Archive(case, judge, pool, lambda _: None, more=more)
        return levels[factor]

    def ended(factor: int, stands: bool) -> Converged:
        count = sum(len(one.evaluations) for key, one in levels.items() if key > 1)
        return Converged(levels[factor], factor, stands, count)

    some = _best_of(archive, 1)
    if _stands(some[0], [at(one) for one in FACTORS[:3]], case):
        return ended(SEARCHED, True)
    some = _asked(at(SEARCHED), _best_of(archive, KEPT), case)
    if method in SMOOTH:
        _search_about(at(SEARCHED))
        some = _best_of(at(SEARCHED), KEPT) or some
    for number, factor in enumerate(FACTORS[3:], 3):
        _asked(at(factor), some, case)
        if at(factor).best() is None and method in SMOOTH:  # what held before fails here
            _search_about(at(factor))
        best = _best_of(at(factor), 1)
        if best and _stands(best[0], [at(one) for one in FACTORS[number - 2 : number + 1]], case):
            return ended(factor, True)
    return ended(FACTORS[-1], False)


def _shares(case: DesignCase, one: Evaluation) -> np.ndarray:
    return np.array([share_of(free, one.values[free.keys[0]]) for free in case.free])


def _best_of(archive: Archive, count: int) -> list[Evaluation]:
    """The best feasible candidates, the nearest to holding where none is."""
    some = [one for one in archive.evaluations if one.judged.feasible]
    some.sort(key=lambda one: (one.judged.objectives[0], one.numbers))
    nearest = archive.nearest()
    return some[:count] or ([nearest] if nearest else [])


def _asked(archive: Archive, some: list[Evaluation], case: DesignCase) -> list[Evaluation]:
    """Evaluate candidates on another resolution; gives them back."""
    with suppress(SpentError):
        archive.ask_all([_shares(case, one) for one in some])
    return some


def _search_about(archive: Archive) -> None:
    """Search locally from the best of an archive: by a trust region, then by a simplex, which takes kinks."""
    from scipy.optimize import minimize

    case = archive.case
    count = len(case.free)
    most = max(2 * count + 2, int(SHARE * case.search.evaluations) // 2)
    view = Scalar(archive)
    with suppress(SpentError):
        minimise("cobyqa", view, _shares(case, _best_of(archive, 1)[0]), most, RADIUS / 3)
        best = _shares(case, _best_of(archive, 1)[0])
        steps = np.where(best > 0.5, -SIMPLEX, SIMPLEX)
        minimize(
            lambda shares: view.merit(archive.ask(shares)),
            best,
            method="Nelder-Mead",
            bounds=[(0.0, 1.0)] * count,
            options={"maxfev": most, "initial_simplex": np.vstack([best, best + np.diag(steps)])},
        )


def _stands(one: Evaluation, levels: list[Archive], case: DesignCase) -> bool:
    """Whether a candidate's figure changes little from level to level; its constraints hold on the last."""
    try:
        several = [level.ask(_shares(case, one)) for level in levels]
    except SpentError:
        return False
    values = [judged.objectives[0] for judged in several]
    if not all(math.isfinite(value) for value in values) or not several[-1].feasible:
        return False
    return all(abs(b - a) <= STANDS * abs(values[-1]) for a, b in pairwise(values))
