"""Branches of periodic motions: systems along a parameter, ends of branches, and the way along the arclength.

Followed by its arclength a branch leads round folds, and to where it is unstable.

State and parameter are unknown together. A step leads along the tangent of the branch, and Newton's method
goes back to the branch at right angles to it (pseudo-arclength: H. B. Keller, in: P. H. Rabinowitz (ed.),
Applications of Bifurcation Theory, Academic Press 1977, 359-384), so that a fold is a place like others. The
period is kept. Lengths are measured in units of the motion's size and of the parameter's magnitude.
"""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float
from tribodyn.solve.orbit.motions import PeriodMap
from tribodyn.solve.orbit.shooting import eigenvalues

#: Kinds of ends.
FOLD = "fold"
PERIOD_DOUBLING = "period doubling"
NEIMARK_SACKER = "neimark-sacker"
#: A motion of several periods comes to one of fewer: that one's period doubling, met from the other side.
MERGING = "merging"
#: The branch ends with no multiplier near the unit circle: where contact just opens or closes the map has a
#: corner, at which multipliers jump.
CORNER = "corner"
KINDS = (FOLD, PERIOD_DOUBLING, NEIMARK_SACKER, MERGING, CORNER)

#: Distance from +1 of the multiplier at the last point before an end behind which no motion is found, within
#: which that is a fold: it falls with the root of the distance from the fold.
NEAR_ONE = 0.1
#: Share of the largest magnitude of the parameter by which steps are measured near zero.
NEAR_ZERO = 0.25


class SystemFamily(Protocol):
    """Systems along a parameter, on one or several lines that differ in what else there is."""

    def at(self, lines: Sequence[int], values: Sequence[float]) -> tuple[PeriodMap, list[str]]:
        """Systems on lines at values of the parameter, and why there is none; empty where there is.

        Only those that there are count as cases of the map.
        """
        ...


class BranchEnd(NamedTuple):
    """Where a branch that was followed is left."""

    kind: str  # one of `KINDS`
    value: float  # of the parameter
    within: float  # the branch was found on one side of it and not on the other, no farther apart than this
    period: int  # of the motion that ends
    multiplier: complex  # largest by modulus, at the last point found on the branch


class Seed(NamedTuple):
    """A place near the end of a stable branch, from which the branch goes on unstably."""

    value: float  # of the parameter
    state: Float[Array, " state"]  # of a stable motion there
    period: int  # of that: of fewer periods than the branch has had where it ends by merging
    way: float  # sense of the parameter, ±1, in which the end is from there


def kind_of_end(
    before: Complex[Array, " state"], beyond: Complex[Array, " state"] | None, merged: bool
) -> str:
    """How a branch ends, from the multipliers at its last point, and beyond it where it goes on unstably."""
    if merged:
        return MERGING
    if beyond is None:
        return FOLD if np.min(np.abs(before - 1.0)) <= NEAR_ONE else CORNER
    largest = beyond[0]
    if abs(largest.imag) > 1e-6 * abs(largest):
        return NEIMARK_SACKER
    return PERIOD_DOUBLING if largest.real < 0.0 else FOLD


#: Steps: the first, the factor to the next, the largest change of state and of parameter, and the smallest
#: that is tried.
FIRST, GROWTH, LARGEST, LARGEST_PARAMETER, SMALLEST = 1e-3, 1.5, 0.05, 1e-2, 1e-6
#: Cosine of the angle by which the branch turns over a step, at least, unless the step is shorter than this.
STRAIGHT, SHORT = 0.95, 1e-4
#: Newton steps for a place, and the shift of the parameter, over its magnitude, for the derivative.
STEPS, SHIFT = 6, 1e-4
#: Places behind the last one found before a branch turns back or has gone on, at most.
MOST_PLACES = 60
#: Distance over the parameter's magnitude to which ends are located, and that at which a branch has gone on
#: behind its last place.
LOCATED, GONE_ON = 2e-5, 1e-4
#: Distance of a multiplier's modulus from 1 within which it is on the unit circle: until contact is lost a
#: doubled motion grows at one value of the parameter, with the multiplier 1.
NEUTRAL = 1e-6


class BranchPoint(NamedTuple):
    """A motion on a branch."""

    point: Float[Array, " unknown"]  # state and parameter in units of the branch
    tangent: Float[Array, " unknown"]  # of the branch, of length 1
    multipliers: Complex[Array, " state"]
    residual: float  # change over a period, in units
    #: change of the state over half the period, in units; None where the period is odd
    halves: Float[Array, " state"] | None

    @property
    def stable(self) -> bool:
        """Whether all multipliers are inside the unit circle, and none on it."""
        return bool(np.abs(self.multipliers[0]) < 1.0 - NEUTRAL)

    @property
    def unstable(self) -> bool:
        """Whether a multiplier is outside the unit circle, and not on it."""
        return bool(np.abs(self.multipliers[0]) > 1.0 + NEUTRAL)


class Arclength:
    """The way along a branch from a seed on: its units, and steps; `size` measures the parameter."""

    def __init__(self, family: SystemFamily, line: int, seed: Seed, size: float, tolerance: float) -> None:
        self.family, self.line, self.seed = family, line, seed
        period_map, _ = family.at([line], [seed.value])
        scale = period_map.scale[0] if len(period_map.scale) else np.ones_like(seed.state)
        extent = max(1.0, float(np.max(np.abs(seed.state) / scale)))
        self.units = np.append(scale * extent, size)
        self.extent, self.tolerance = extent, tolerance / extent

    def begin(self) -> BranchPoint | None:
        """The place of the seed, the tangent in its sense."""
        along = np.zeros(len(self.units))
        along[-1] = self.seed.way
        return self.met(np.append(self.seed.state, self.seed.value) / self.units, along, along)

    def next(self, here: BranchPoint, step: float) -> tuple[BranchPoint, float] | None:
        """The next place, no farther than a step, and the step that led there."""
        farthest = [LARGEST / np.max(np.abs(here.tangent[:-1])), LARGEST_PARAMETER / abs(here.tangent[-1])]
        step = min(step, *farthest)
        while step >= SMALLEST:
            place = self.met(here.point + step * here.tangent, here.tangent, here.tangent)
            if place is not None and (step <= SHORT or place.tangent @ here.tangent >= STRAIGHT):
                return place, step
            step /= 2.0
        return None

    def met(
        self,
        guess: Float[Array, " unknown"],
        normal: Float[Array, " unknown"],
        before: Float[Array, " unknown"],
    ) -> BranchPoint | None:
        """The place of the branch on the plane through a guess, its tangent in the sense of another."""
        point = guess
        for _ in range(STEPS):
            defect = self.defect(point)
            if defect is None:
                return None
            off, slopes = defect
            if np.max(np.abs(off)) <= self.tolerance:
                tangent = np.linalg.svd(slopes)[2][-1]
                tangent *= 1.0 if tangent @ before >= 0.0 else -1.0
                jacobian = slopes[:, :-1] + np.eye(len(off))
                residual = float(np.max(np.abs(off)))
                return BranchPoint(point, tangent, eigenvalues(jacobian), residual, self.halves(point))
            matrix = np.vstack([slopes, normal])
            wanted = np.append(-off, normal @ (guess - point))
            point = point + np.linalg.lstsq(matrix, wanted)[0]
        return None

    def turning(self, last: BranchPoint, beyond: BranchPoint) -> tuple[BranchPoint, float, float]:
        """Where the parameter turns back between two places: one there, the parameter, and how closely.

        Between places so near the parameter is a parabola over the arclength.
        """
        way, step = np.sign(last.tangent[-1]), float(np.linalg.norm(beyond.point - last.point))
        while True:
            slopes = abs(last.tangent[-1]), abs(beyond.tangent[-1])
            rise = 0.5 * step * slopes[0] ** 2 / (slopes[0] + slopes[1])
            if rise <= 0.1 * LOCATED or step < SMALLEST:
                break
            step /= 2.0
            middle = self.met(last.point + step * last.tangent, last.tangent, last.tangent)
            if middle is None:
                break
            if way * middle.tangent[-1] < 0.0:
                beyond = middle
            else:
                last = middle
        size = self.units[-1]
        return last, float((last.point[-1] + way * rise) * size), float(rise * size)

    def defect(
        self, point: Float[Array, " unknown"]
    ) -> tuple[Float[Array, " state"], Float[Array, "state unknown"]] | None:
        """Change over a period (N,) and its derivatives (N, N + 1), in units; None where there is none."""
        *state, value = point * self.units
        shifted = value + SHIFT * self.units[-1]
        period_map, refusals = self.family.at([self.line] * 2, [float(value), float(shifted)])
        if any(refusals):
            return None
        states, units, period = np.array([state, state]), self.units[:-1], self.seed.period
        tangent = period_map.tangent(states[:1], np.array([0]), period)
        ends = period_map.march(states, np.array([0, 1]), period, True).states[:, -1]
        by_parameter = (ends[1] - ends[0]) / units / SHIFT
        slopes = tangent.jacobian[0] * units / units[:, None] - np.eye(len(units))
        off, slopes = (tangent.image[0] - states[0]) / units, np.column_stack([slopes, by_parameter])
        return (off, slopes) if np.all(np.isfinite(off)) and np.all(np.isfinite(slopes)) else None

    def halves(self, point: Float[Array, " unknown"]) -> Float[Array, " state"] | None:
        """Change over half the period (N,), in units; None where the period is odd."""
        period = self.seed.period
        if period % 2:
            return None
        *state, value = point * self.units
        period_map, _ = self.family.at([self.line], [float(value)])
        end = period_map.march(np.array([state]), np.array([0]), period // 2, True).states[0, -1]
        return (end - state) / self.units[:-1]


class Turn(NamedTuple):
    """How a branch goes on where nothing is found behind a value of the parameter."""

    folded: bool  # whether the parameter turns back
    value: float  # where it does; otherwise a value behind, at which the branch goes on
    within: float  # distance between the places that locate it
    state: Float[Array, " state"]  # there


def follow_arc(
    family: SystemFamily, line: int, seed: Seed, size: float, *, tolerance: float = 1e-7
) -> Turn | None:
    """Follow a branch from near its end by its arclength, until its parameter turns back or it has gone on.

    None where it cannot be followed; parameters as `Arclength` has them.
    """
    branch = Arclength(family, line, seed, size, tolerance)
    here, step = branch.begin(), FIRST
    for _ in range(MOST_PLACES):
        reached = None if here is None else branch.next(here, step)
        if here is None or reached is None:
            break
        beyond, step = reached
        if seed.way * beyond.tangent[-1] < 0.0:
            point, value, within = branch.turning(here, beyond)
            return Turn(True, value, within, point.point[:-1] * branch.units[:-1])
        if seed.way * (beyond.point[-1] - seed.value / size) > GONE_ON:
            return Turn(False, float(beyond.point[-1] * size), 0.0, beyond.point[:-1] * branch.units[:-1])
        here, step = beyond, step * GROWTH
    return None
