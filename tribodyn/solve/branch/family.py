"""Systems along a parameter."""

from collections.abc import Sequence
from typing import Protocol

from tribodyn.solve.orbit.period_map import PeriodMap


class Family(Protocol):
    """Systems along a parameter, on one or several lines that differ in what else there is."""

    def at(self, lines: Sequence[int], values: Sequence[float]) -> tuple[PeriodMap, list[str]]:
        """Systems on lines at values of the parameter, and why there is none; empty where there is.

        Only those that there are count as cases of the map.
        """
        ...
