"""The period of a motion, recognised from its states once per period of the excitation."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Maximum number of excitation periods in one period of the motion.
MAX_PERIOD = 8
#: Periods between the two changes whose ratio gives the rate of contraction, and changes of which each is the
#: maximum, at least: an oscillating approach passes zero now and then.
HALF, WINDOW = 6, 3
#: Distance from what a motion is coming to, at least, over its change in a period: the rate is an estimate.
FARTHER = 25.0


class Recurrence(NamedTuple):
    """How nearly a motion repeats after a number of excitation periods.

    Attributes
    ----------
    period : int
    change : float
        Maximum change over that period, of states in units of their scale.
    earlier : float
        The same, `half` periods before.
    half : int
    """

    period: int
    change: float
    earlier: float
    half: int

    @property
    def rate(self) -> float:
        """Factor by which the change falls in a period of the excitation; at least 1 where it does not."""
        return (self.change / self.earlier) ** (1.0 / self.half) if self.earlier > 0.0 else 0.0

    @property
    def distance(self) -> float:
        """Cautious estimate of the distance from a motion that repeats."""
        return self.change * max(1.0 / max(1.0 - self.rate**self.period, 1e-3), FARTHER)


def recurrences(track: Float[Array, "period state"]) -> list[Recurrence]:
    """How nearly a motion repeats after 1, 2, … periods, as many as its states (K, N) can tell, K ≥ 5."""
    found = []
    for n in range(1, min(MAX_PERIOD, (len(track) - 1) // 2) + 1):
        change = np.max(np.abs(track[n:] - track[:-n]), axis=1)
        width = max(n, min(WINDOW, len(change) - 1))
        half = min(HALF, len(change) - width)
        last, before = change[-width:], change[-width - half : len(change) - half]
        found.append(Recurrence(n, float(np.max(last)), float(np.max(before)), half))
    return found


def recognised(found: list[Recurrence]) -> list[Recurrence]:
    """The periods that the motion may come to repeat after, the smallest first.

    A motion of n periods changes over m < n of them by as much as its points are apart, however near it is;
    over n it changes by what is left of the transient. So m is excluded where its change exceeds twice the
    distance that is left by the change over n.
    """
    limit = 2.0 * min(one.distance for one in found)
    return [one for one in found if one.change <= limit]
