"""The last stage of a search: finer, until the quantity of the best no longer depends on the resolution.

Methods search on the resolution of the scenario. Where the quantity of the best changes on a finer one, the
best candidates are evaluated again and searched about on one that is `SEARCHED` times as fine, and the best
of those on finer ones. Of a front its members, and what may be members on a finer resolution, are evaluated
again; nothing is searched about them. Constraints and dominance are those of the last one.
"""

from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from tribodyn.studies.design.candidates.archive import FACTORS, Archive, Candidate, SpentError, resolutions
from tribodyn.studies.design.candidates.candidates import shares_of
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.local_search import RADIUS, Scalar, minimise
from tribodyn.studies.design.methods import SMOOTH

#: Relative change of the quantity from one resolution to the next, twice in a row, within which it stands.
#: What is left of errors of first order is as much again.
STANDS = 2.5e-3
#: Factor at which is searched about the best.
SEARCHED = FACTORS[2]
#: Candidates that are evaluated on finer resolutions; share of `evaluations` of the search about the best.
KEPT, SHARE = 6, 1 / 2
#: Change of a quantity below which no two differ.
TINY = 1e-200
#: Size of the first simplex about the best, as a share of the ranges.
SIMPLEX = 0.01

At = Callable[[int], Archive]
"""The archive of a factor, one of `FACTORS`: of each the same."""


class Converged(NamedTuple):
    """Where a search ended."""

    archive: Archive  # of the last resolution
    stands: bool | None = None  # whether the quantities stand; None where that was not tested
    evaluations: int = 0  # on finer resolutions


def converged(case: DesignCase, at: At, method: str) -> Converged:
    """Go on from what a search found until the quantities of its best, or of its front, stand."""
    if not resolutions(case, 1) or at(1).best() is None:
        return Converged(at(1))
    last, stands = _of_front(at) if len(case.objectives) > 1 else _of_best(at, method in SMOOTH)
    finer = sum(len(at(factor).evaluations) for factor in FACTORS[1:] if factor <= last)
    computed = [factor for factor in FACTORS if factor <= last and at(factor).nearest() is not None]
    return Converged(at(computed[-1]), stands and computed[-1] == last, finer)


def counts(case: DesignCase, method: str) -> dict[int, int]:
    """How many evaluations a search takes by factor, about; the quantities may stand sooner.

    The start of every resolution and what is evaluated about the best are among them.
    """
    most = case.search.evaluations
    further = 2 * (len(case.free) + len(case.tolerances)) * case.sensitivities + 2 * bool(case.confirm)
    finer = FACTORS[1:] if resolutions(case, 1) else ()
    if len(case.objectives) > 1:
        each = min(2 * max(KEPT, case.search.points), most)
        evaluations = {1: most} | dict.fromkeys(finer, each)
    else:
        about = int(SHARE * most) if method in SMOOTH else 0
        evaluations = {1: most} | {factor: KEPT + about * (factor == SEARCHED) for factor in finer}
        evaluations |= dict.fromkeys(finer[:1], 1)
    evaluations = {factor: count + 1 for factor, count in evaluations.items()}
    last = SEARCHED if finer else 1
    return evaluations | {last: evaluations[last] + further}


def _of_best(at: At, smooth: bool) -> tuple[int, bool]:
    """Factor at which the quantity of the best stands, and whether it does."""
    if _stands(_best_of(at(1), 1)[0], [at(factor) for factor in FACTORS[:3]]):
        return SEARCHED, True
    some = _best_of(at(1), KEPT)
    _evaluate(at(SEARCHED), some)
    if smooth:
        _search_about(at(SEARCHED))
        some = _best_of(at(SEARCHED), KEPT) or some
    for number, factor in enumerate(FACTORS[3:], 3):
        _evaluate(at(factor), some)
        if at(factor).best() is None and smooth:  # what held before fails here, by little
            _search_about(at(factor), near=True)
        best = _best_of(at(factor), 1)
        if best and _stands(best[0], [at(last) for last in FACTORS[number - 2 : number + 1]]):
            return factor, True
    return FACTORS[-1], False


def _of_front(at: At) -> tuple[int, bool]:
    """Factor at which both quantities of every member of the front stand, and whether they do."""
    for number, factor in enumerate(FACTORS[1:], 1):
        coarse, fine = at(FACTORS[number - 1]), at(factor)
        members = coarse.front() or coarse.evaluations
        _evaluate(fine, members)
        _evaluate(fine, _near(coarse, fine, members))
        end = fine.front()
        last = [at(each) for each in FACTORS[number - 2 : number + 1]] if number > 1 else []
        if last and end and all(_stands(member, last) for member in end):
            return factor, True
    return FACTORS[-1], False


def _near(coarse: Archive, fine: Archive, members: list[Candidate]) -> list[Candidate]:
    """Feasible candidates that members of a front are better than by less than a finer resolution changes.

    The nearest of them, at most as many as there are members, or `KEPT`.
    """
    scores = {candidate.numbers: candidate.score for candidate in fine.evaluations}
    both = [member for member in members if member.numbers in scores]
    moved = [np.subtract(scores[same.numbers].objectives, same.score.objectives) for same in both]
    # what is left of errors of first order is as much again
    changes = 2.0 * np.nanmax(np.abs(moved), axis=0, initial=TINY)
    some = [other for other in coarse.evaluations if other.score.feasible and other.numbers not in scores]
    if not some:
        return []
    better = np.array([member.score.objectives for member in members])
    over = np.array([candidate.score.objectives for candidate in some])[:, None] - better
    gaps = (over / changes).min(axis=2).max(axis=1)
    nearest = [some[place] for place in np.argsort(gaps, kind="stable") if gaps[place] <= 1.0]
    return nearest[: max(KEPT, len(members))]


def _best_of(archive: Archive, count: int) -> list[Candidate]:
    """The best feasible candidates, the nearest to holding where none is."""
    nearest = archive.nearest()
    return archive.feasible()[:count] or ([nearest] if nearest else [])


def _evaluate(archive: Archive, some: list[Candidate]) -> None:
    """Evaluate candidates of another resolution, as many as there is room for."""
    with suppress(SpentError):
        archive.score_all([shares_of(archive.case, candidate.values) for candidate in some])


def _search_about(archive: Archive, near: bool = False) -> None:
    """Search locally from the best of an archive: by a trust region, then by a simplex, which takes kinks.

    Near about it by a few steps of the trust region alone: what a constraint takes that was just met.
    """
    from scipy.optimize import minimize

    if not _best_of(archive, 1):  # nothing could be computed at this resolution
        return
    case = archive.case
    count = len(case.free)
    most = max(2 * count + 2, int(SHARE * case.search.evaluations) // 2)
    view = Scalar(archive)
    with suppress(SpentError):
        first = shares_of(case, _best_of(archive, 1)[0].values)
        if near:
            minimise("cobyqa", view, first, min(most, 4 * (count + 1)), SIMPLEX)
            return
        minimise("cobyqa", view, first, most, RADIUS / 3)
        best = shares_of(case, _best_of(archive, 1)[0].values)
        steps = np.where(best > 0.5, -SIMPLEX, SIMPLEX)
        minimize(
            lambda shares: view.merit(archive.score(shares)),
            best,
            method="Nelder-Mead",
            bounds=[(0.0, 1.0)] * count,
            options={"maxfev": most, "initial_simplex": np.vstack([best, best + np.diag(steps)])},
        )


def _stands(candidate: Candidate, levels: list[Archive]) -> bool:
    """Whether a candidate's quantities change little from level to level; it is feasible on the last."""
    try:
        several = [level.score(shares_of(level.case, candidate.values)) for level in levels]
    except SpentError:
        return False
    values = np.array([score.objectives for score in several])
    if not np.isfinite(values).all() or not several[-1].feasible:
        return False
    return bool(np.all(np.abs(np.diff(values, axis=0)) <= STANDS * np.abs(values[-1])))
