"""Fatigue under loads of several sizes: permissible stress over load cycles, Miner's sum, safety and life.

ISO 6336-6:2019. A permissible stress falls along straight lines of its logarithm over that of the number of
cycles. It is constant before the first point and after the last one: smaller stresses than there do no
damage, and a life under them alone has no end.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, cast

#: Bounds within which a safety is looked for.
_SAFETIES = (1e-4, 1e4)


class StressCurve(NamedTuple):
    """Permissible stress, Pa, or its factor, over load cycles; cycles increase, stresses fall."""

    cycles: tuple[float, ...]
    stress: tuple[float, ...]

    def at(self, cycles: float) -> float:
        """Permissible stress for a number of load cycles."""
        first, last = self.cycles[0], self.cycles[-1]
        return self._line(min(max(cycles, first), last))

    def _line(self, cycles: float) -> float:
        for n1, n2, s1, s2 in self._segments():
            if cycles <= n2:
                share = math.log(cycles / n1) / math.log(n2 / n1)
                return s1 * (s2 / s1) ** share
        return self.stress[-1]

    def endured(self, stress: float) -> float:
        """Load cycles that a stress is endured; infinite below the last point, 0 above the first."""
        if stress <= self.stress[-1]:
            return math.inf
        if stress > self.stress[0]:
            return 0.0
        for n1, n2, s1, s2 in self._segments():
            if stress >= s2 and s1 > s2:
                share = math.log(stress / s1) / math.log(s2 / s1)
                return n1 * (n2 / n1) ** share
        return self.cycles[-1]

    def _segments(self) -> list[tuple[float, float, float, float]]:
        return list(zip(self.cycles[:-1], self.cycles[1:], self.stress[:-1], self.stress[1:], strict=True))

    def times(self, factors: Sequence[float]) -> "StressCurve":
        """The curve with every stress times its factor."""
        return StressCurve(self.cycles, tuple(s * f for s, f in zip(self.stress, factors, strict=True)))


class Bin(NamedTuple):
    """Cycles of one stress."""

    stress: float  # Pa
    cycles: float
    curve: StressCurve | None = None  # permissible at the speed of these cycles; None: as of all bins


def damage(bins: Sequence[Bin], curve: StressCurve, safety: float = 1.0) -> float:
    """Miner's sum Σ n/N of stresses times a safety: 1 where life ends; infinite above the static limit."""
    total = 0.0
    for one in bins:
        endured = (one.curve or curve).endured(one.stress * safety)
        if one.cycles > 0.0:
            total += one.cycles / endured if endured > 0.0 else math.inf
    return total


def safety(bins: Sequence[Bin], curve: StressCurve) -> float:
    """Factor S by which all stresses may grow until Miner's sum is 1: ISO 6336-6, 4.

    Of a single bin permissible stress over stress. Infinite without stress.
    """
    loaded = [one for one in bins if one.stress > 0.0 and one.cycles > 0.0]
    if not loaded:
        return math.inf
    if len(loaded) == 1:
        return (loaded[0].curve or curve).at(loaded[0].cycles) / loaded[0].stress
    from scipy.optimize import brentq  # heavy, and materials need none of it

    highest = max(one.stress for one in loaded)

    def excess(logarithm: float) -> float:
        miner_sum = damage(loaded, curve, math.exp(logarithm))
        return min(miner_sum, 1e30) - 1.0

    low, high = (math.log(bound * curve.stress[-1] / highest) for bound in _SAFETIES)
    return math.exp(float(cast(Any, brentq(excess, low, high, xtol=1e-10))))


def life_share(bins: Sequence[Bin], curve: StressCurve, required: float) -> float:
    """How many times the bins' cycles are endured at a required safety; infinite where nothing is damaged."""
    miner_sum = damage(bins, curve, required)
    return 1.0 / miner_sum if miner_sum > 0.0 else math.inf
