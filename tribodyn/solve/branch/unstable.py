"""Branches of periodic motions beyond the ends of their stable parts, followed by their arclength."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float
from tribodyn.solve.branch import arclength
from tribodyn.solve.orbit.motions import UNSTABLE, Orbit

#: Places on a branch at most.
MOST = 600
#: Change over half a period, over the motion's size, below which the motion is one of half the period.
MERGED = 1e-3


class UnstableBranch(NamedTuple):
    """Unstable periodic motions along a branch, in the order of its arclength."""

    period: int  # periods of the excitation in one of the motion
    values: Float[Array, " point"]  # of the parameter
    orbits: list[Orbit]  # the motions
    #: where it becomes stable again, or merges with a motion of fewer periods; None: it goes on beyond the
    #: range, or cannot be followed farther
    finish: arclength.BranchEnd | None

    @property
    def states(self) -> Float[Array, "point state"]:
        """States of the motions."""
        return np.array([orbit.state for orbit in self.orbits])

    @property
    def multipliers(self) -> Complex[Array, "point state"]:
        """Their multipliers, largest first."""
        return np.array([orbit.multipliers for orbit in self.orbits])

    def thinned(self, most: int) -> "UnstableBranch":
        """At most so many of the motions, the first and the last among them."""
        count = len(self.values)
        kept = np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))
        return self._replace(values=self.values[kept], orbits=[self.orbits[place] for place in kept])


def unstable_branches(
    family: arclength.SystemFamily,
    line: int,
    seeds: Sequence[arclength.Seed],
    span: tuple[float, float],
    *,
    tolerance: float = 1e-7,
) -> list[UnstableBranch | None]:
    """The unstable motions beyond the ends of stable branches, within a range of the parameter.

    None where there are none that can be followed.
    """
    reach = max(map(abs, span))
    followed = []
    for seed in seeds:
        size = max(abs(seed.value), arclength.NEAR_ZERO * reach)
        followed.append(_followed(arclength.Arclength(family, line, seed, size, tolerance), span))
    return followed


def _followed(way: arclength.Arclength, span: tuple[float, float]) -> UnstableBranch | None:
    """The unstable part within a range of the parameter; None where there is none."""
    seed = way.seed
    here = way.begin()
    step, places, count = arclength.FIRST, list[arclength.BranchPoint](), 0
    finish = None
    while here is not None and count < MOST and not (count > arclength.MOST_PLACES and not places):
        reached = way.next(here, step)
        if reached is None:
            break
        beyond, step = reached
        count += 1
        merged = _merged(here, beyond)
        if merged or (beyond.stable and places):
            finish = _finish(way, here, beyond, merged)
            break
        if not span[0] <= beyond.point[-1] * way.units[-1] <= span[1]:
            last = _at_border(way, here, beyond, span)
            places += [last] if last is not None and last.unstable else []
            break
        if beyond.unstable:
            places.append(beyond)
        here, step = beyond, step * arclength.GROWTH
    if not places:
        return None
    values = np.array([place.point[-1] for place in places]) * way.units[-1]
    return UnstableBranch(seed.period, values, [_orbit(way, place) for place in places], finish)


def _orbit(way: arclength.Arclength, place: arclength.BranchPoint) -> Orbit:
    state, residual = place.point[:-1] * way.units[:-1], way.extent * place.residual
    return Orbit(
        state, state, way.seed.period, residual, place.multipliers, False, UNSTABLE, "shooting", 0, ""
    )


def _at_border(
    way: arclength.Arclength,
    here: arclength.BranchPoint,
    beyond: arclength.BranchPoint,
    span: tuple[float, float],
) -> arclength.BranchPoint | None:
    """The place at the border of the range, between one inside and one outside."""
    borders = np.array(span) / way.units[-1]
    border = borders[int(beyond.point[-1] > borders[1])]
    share = (border - here.point[-1]) / (beyond.point[-1] - here.point[-1])
    along = np.zeros(len(way.units))
    along[-1] = 1.0
    return way.met(here.point + share * (beyond.point - here.point), along, here.tangent)


def _finish(
    way: arclength.Arclength, last: arclength.BranchPoint, beyond: arclength.BranchPoint, merged: bool
) -> arclength.BranchEnd:
    """Where the branch becomes stable, or merges, between two of its places."""
    period, multiplier = way.seed.period, complex(last.multipliers[0])
    if not merged and last.tangent[-1] * beyond.tangent[-1] < 0.0:
        _, value, within = way.turning(last, beyond)
        return arclength.BranchEnd(arclength.FOLD, value, within, period, multiplier)
    step = float(np.linalg.norm(beyond.point - last.point))
    while abs(beyond.point[-1] - last.point[-1]) > arclength.LOCATED and step > arclength.SMALLEST:
        step /= 2.0
        middle = way.met(last.point + step * last.tangent, last.tangent, last.tangent)
        if middle is None:
            break
        if _merged(last, middle) if merged else middle.stable:
            beyond = middle
        else:
            last = middle
    kind = arclength.MERGING if merged else arclength.kind_of_end(beyond.multipliers, last.multipliers, False)
    value, behind = (float(place.point[-1] * way.units[-1]) for place in (last, beyond))
    return arclength.BranchEnd(kind, 0.5 * (value + behind), abs(value - behind), period, multiplier)


def _merged(last: arclength.BranchPoint, place: arclength.BranchPoint) -> bool:
    """Whether a motion's halves become equal, or have changed places, so that they were equal in between."""
    if last.halves is None or place.halves is None:
        return False
    return float(last.halves @ place.halves) < 0.0 or float(np.max(np.abs(place.halves))) <= MERGED
