"""Branches of periodic motions beyond the ends of their stable parts, followed by their arclength."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float
from tribodyn.solve.branch.arclength import FIRST, GROWTH, LOCATED, MOST_PLACES, SMALLEST, Arclength, Place
from tribodyn.solve.branch.end import FOLD, MERGING, NEAR_ZERO, BranchEnd, Seed, kind_of_end
from tribodyn.solve.branch.family import Family
from tribodyn.solve.orbit.result import UNSTABLE, Orbit

#: Places on a branch at most.
MOST = 600
#: Change over half a period, over the motion's size, below which the motion is one of half the period.
MERGED = 1e-3


class UnstableBranch(NamedTuple):
    """Unstable periodic motions along a branch, in the order of its arclength.

    Attributes
    ----------
    period : int
        Periods of the excitation in one of the motion.
    values : (P,)
        Of the parameter.
    states : (P, N)
    multipliers : (P, N) complex
        Largest first.
    residuals : (P,)
        Scaled change over a period of the motion.
    finish : BranchEnd or None
        Where it becomes stable again, or merges with a motion of fewer periods; None: it goes on beyond the
        range, or cannot be followed farther.
    """

    period: int
    values: Float[Array, " point"]
    states: Float[Array, "point state"]
    multipliers: Complex[Array, "point state"]
    residuals: Float[Array, " point"]
    finish: BranchEnd | None

    def thinned(self, most: int) -> "UnstableBranch":
        """At most so many of the motions, the first and the last among them."""
        count = len(self.values)
        kept = np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))
        return self._replace(
            values=self.values[kept],
            states=self.states[kept],
            multipliers=self.multipliers[kept],
            residuals=self.residuals[kept],
        )

    def orbits(self) -> list[Orbit]:
        """The motions, as the search for stable ones gives them."""
        return [
            Orbit(state, state, self.period, float(residual), multipliers, False, UNSTABLE, "shooting", 0, "")
            for state, multipliers, residual in zip(
                self.states, self.multipliers, self.residuals, strict=True
            )
        ]


def unstable_branches(
    family: Family,
    line: int,
    seeds: Sequence[Seed],
    span: tuple[float, float],
    *,
    tolerance: float = 1e-7,
) -> list[UnstableBranch | None]:
    """The unstable motions beyond the ends of stable branches, within a range of the parameter.

    None where there are none that can be followed.

    Parameters
    ----------
    family : Family
    line : int
        Which of its lines.
    seeds : sequence of Seed
    span : (lowest, highest)
        Range of the parameter.
    tolerance : float
        Maximum scaled change over a period of the motion.
    """
    reach = max(map(abs, span))
    found = []
    for seed in seeds:
        size = max(abs(seed.value), NEAR_ZERO * reach)
        found.append(_followed(Arclength(family, line, seed, size, tolerance), span))
    return found


def _followed(way: Arclength, span: tuple[float, float]) -> UnstableBranch | None:
    """The unstable part within a range of the parameter; None where there is none."""
    seed = way.seed
    here = way.begin()
    step, places, count = FIRST, list[Place](), 0
    finish = None
    while here is not None and count < MOST and not (count > MOST_PLACES and not places):
        found = way.next(here, step)
        if found is None:
            break
        beyond, step = found
        count += 1
        merged = _merged(here, beyond)
        if merged or (beyond.stable and places):
            finish = _finish(way, here, beyond, merged)
            break
        if not _inside(way, beyond, span):
            last = _at_border(way, here, beyond, span)
            places += [last] if last is not None and last.unstable else []
            break
        if beyond.unstable:
            places.append(beyond)
        here, step = beyond, step * GROWTH
    if not places:
        return None
    points = np.array([one.point for one in places]) * way.units
    multipliers = np.array([one.multipliers for one in places])
    residuals = way.extent * np.array([one.residual for one in places])
    return UnstableBranch(seed.period, points[:, -1], points[:, :-1], multipliers, residuals, finish)


def _at_border(way: Arclength, here: Place, beyond: Place, span: tuple[float, float]) -> Place | None:
    """The place at the border of the range, between one inside and one outside."""
    borders = np.array(span) / way.units[-1]
    border = borders[int(beyond.point[-1] > borders[1])]
    share = (border - here.point[-1]) / (beyond.point[-1] - here.point[-1])
    along = np.zeros(len(way.units))
    along[-1] = 1.0
    return way.met(here.point + share * (beyond.point - here.point), along, here.tangent)


def _inside(way: Arclength, place: Place, span: tuple[float, float]) -> bool:
    return span[0] <= place.point[-1] * way.units[-1] <= span[1]


def _finish(way: Arclength, last: Place, beyond: Place, merged: bool) -> BranchEnd:
    """Where the branch becomes stable, or merges, between two of its places."""
    period, multiplier = way.seed.period, complex(last.multipliers[0])
    if not merged and last.tangent[-1] * beyond.tangent[-1] < 0.0:
        _, value, within = way.turning(last, beyond)
        return BranchEnd(FOLD, value, within, period, multiplier)
    step = float(np.linalg.norm(beyond.point - last.point))
    while abs(beyond.point[-1] - last.point[-1]) > LOCATED and step > SMALLEST:
        step /= 2.0
        middle = way.met(last.point + step * last.tangent, last.tangent, last.tangent)
        if middle is None:
            break
        if _merged(last, middle) if merged else middle.stable:
            beyond = middle
        else:
            last = middle
    kind = MERGING if merged else kind_of_end(beyond.multipliers, last.multipliers, False)
    value, behind = (float(one.point[-1] * way.units[-1]) for one in (last, beyond))
    return BranchEnd(kind, 0.5 * (value + behind), abs(value - behind), period, multiplier)


def _merged(one: Place, other: Place) -> bool:
    """Whether a motion's halves become equal, or have changed places, so that they were equal in between."""
    if one.halves is None or other.halves is None:
        return False
    return float(one.halves @ other.halves) < 0.0 or float(np.max(np.abs(other.halves))) <= MERGED
