"""The last stage of a search: finer, until the figure of the best no longer depends on the resolution.

Methods search on the resolution of the scenario. Where the figure of the best changes on a finer one, the
best candidates are evaluated again and searched about on one that is `SEARCHED` times as fine, and the best
of those on finer ones. Of a front its members, and what may be members on a finer resolution, are evaluated
again; nothing is searched about them. Constraints and dominance are those of the last one.
"""

from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from tribodyn.studies.design.candidates.archive import (
    Archive,
    Candidate,
    Levels,
    SpentError,
    front,
    resolutions,
)
from tribodyn.studies.design.candidates.candidates import shares_of
from tribodyn.studies.design.case import DesignCase
from tribodyn.studies.design.layout import FACTORS
from tribodyn.studies.design.methods import SMOOTH
from tribodyn.studies.design.methods.local import RADIUS, Scalar, minimise

#: Relative change of the figure from one resolution to the next, twice in a row, within which it stands. What
#: is left of errors of first order is as much again.
STANDS = 2.5e-3
#: Factor at which is searched about the best.
SEARCHED = FACTORS[2]
#: Candidates that are evaluated on finer resolutions; share of `evaluations` of the search about the best.
KEPT, SHARE = 6, 1 / 2
#: Change of a figure below which no two differ.
TINY = 1e-200
#: Size of the first simplex about the best, as a share of the ranges.
SIMPLEX = 0.01

At = Callable[[int], Archive]
"""Archives by factor, see `Levels`."""


class Converged(NamedTuple):
    """Where a search ended."""

    archive: Archive  # of the last resolution
    stands: bool | None = None  # whether the figures stand; None where that was not tested
    evaluations: int = 0  # on finer resolutions


def converged(case: DesignCase, levels: Levels, method: str) -> Converged:
    """Go on from what a search found until the figures of its best, or of its front, stand."""
    archive = levels.at(1)
    if not resolutions(case, 1) or archive.best() is None:
        return Converged(archive)
    if len(case.objectives) > 1:
        factor, stands = _of_front(case, levels.at)
    else:
        factor, stands = _of_one(case, levels.at, method)
    return Converged(levels.at(factor), stands, levels.finer)


def counts(case: DesignCase, method: str) -> dict[int, int]:
    """How many candidates a search evaluates by factor, about; the figures may stand sooner."""
    most = case.search.evaluations
    if len(case.objectives) > 1:
        each = 2 * max(KEPT, case.search.points)
        return {factor: min(each, most) if factor > 1 else most for factor in FACTORS}
    about = int(SHARE * most) if method in SMOOTH else 0
    more = {factor: KEPT for factor in FACTORS[2:]}
    return {1: most, 2: 1} | more | {SEARCHED: KEPT + about}


def _of_one(case: DesignCase, at: At, method: str) -> tuple[int, bool]:
    """Factor at which the figure of the best stands, and whether it does."""
    some = _best_of(at(1), 1)
    if _stands(some[0], [at(factor) for factor in FACTORS[:3]], case):
        return SEARCHED, True
    some = _asked(at(SEARCHED), _best_of(at(1), KEPT), case)
    if method in SMOOTH:
        _search_about(at(SEARCHED))
        some = _best_of(at(SEARCHED), KEPT) or some
    for number, factor in enumerate(FACTORS[3:], 3):
        _asked(at(factor), some, case)
        if at(factor).best() is None and method in SMOOTH:  # what held before fails here, by little
            _search_about(at(factor), near=True)
        best = _best_of(at(factor), 1)
        if best and _stands(best[0], [at(last) for last in FACTORS[number - 2 : number + 1]], case):
            return factor, True
    return FACTORS[-1], False


def _of_front(case: DesignCase, at: At) -> tuple[int, bool]:
    """Factor at which both figures of every member of the front stand, and whether they do."""
    for number, factor in enumerate(FACTORS[1:], 1):
        coarse, fine = at(FACTORS[number - 1]), at(factor)
        members = _asked(fine, front(coarse.evaluations) or coarse.evaluations, case)
        _asked(fine, _near(coarse, fine, members), case)
        end = front(fine.evaluations)
        last = [at(each) for each in FACTORS[number - 2 : number + 1]] if number > 1 else []
        if last and end and all(_stands(member, last, case) for member in end):
            return factor, True
    return FACTORS[-1], False


def _near(coarse: Archive, fine: Archive, members: list[Candidate]) -> list[Candidate]:
    """Feasible candidates that members of a front are better than by less than a finer resolution changes.

    The nearest of them, at most as many as there are members, or `KEPT`.
    """
    known = {candidate.numbers: candidate.score for candidate in fine.evaluations}
    both = [member for member in members if member.numbers in known]
    moved = [np.subtract(known[same.numbers].objectives, same.score.objectives) for same in both]
    # what is left of errors of first order is as much again
    changes = 2.0 * np.nanmax(np.abs(moved), axis=0, initial=TINY)
    some = [other for other in coarse.evaluations if other.score.feasible and other.numbers not in known]
    if not some:
        return []
    better = np.array([member.score.objectives for member in members])
    over = np.array([candidate.score.objectives for candidate in some])[:, None] - better
    gaps = (over / changes).min(axis=2).max(axis=1)
    nearest = [some[place] for place in np.argsort(gaps, kind="stable") if gaps[place] <= 1.0]
    return nearest[: max(KEPT, len(members))]


def _best_of(archive: Archive, count: int) -> list[Candidate]:
    """The best feasible candidates, the nearest to holding where none is."""
    some = [candidate for candidate in archive.evaluations if candidate.score.feasible]
    some.sort(key=lambda candidate: (candidate.score.objectives[0], candidate.numbers))
    nearest = archive.nearest()
    return some[:count] or ([nearest] if nearest else [])


def _asked(archive: Archive, some: list[Candidate], case: DesignCase) -> list[Candidate]:
    """Evaluate candidates on another resolution; gives them back."""
    with suppress(SpentError):
        archive.score_all([shares_of(case, candidate.values) for candidate in some])
    return some


def _search_about(archive: Archive, near: bool = False) -> None:
    """Search locally from the best of an archive: by a trust region, then by a simplex, which takes kinks.

    Near about it by a few steps of the trust region alone: what a constraint takes that was just met.
    """
    from scipy.optimize import minimize

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


def _stands(candidate: Candidate, levels: list[Archive], case: DesignCase) -> bool:
    """Whether a candidate's figures change little from level to level; its constraints hold on the last."""
    try:
        several = [level.score(shares_of(case, candidate.values)) for level in levels]
    except SpentError:
        return False
    values = np.array([score.objectives for score in several])
    if not np.isfinite(values).all() or not several[-1].feasible:
        return False
    return bool(np.all(np.abs(np.diff(values, axis=0)) <= STANDS * np.abs(values[-1])))
