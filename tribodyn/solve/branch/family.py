"""Systems along a parameter, and where branches of their steady motions end."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float
from tribodyn.solve.orbit.period_map import PeriodMap

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
