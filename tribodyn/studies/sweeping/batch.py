"""How many cases of a study are evaluated together, for sweeps."""

from collections.abc import Hashable, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np

from tribodyn.record.sweep_schema import SweepLayout
from tribodyn.studies.protocol.estimate import Estimate


class NeighbourWay(NamedTuple):
    """The way to a case along the first varied parameter, from the neighbour whose motion it goes on from."""

    neighbour: Any
    #: start, target: values of the parameter, SI units
    start: float
    target: float
    period: int  # of the neighbour's motion; 0: it has none
    span: tuple[float, float]  # (lowest, highest), range of the parameter in the sweep

    @property
    def reach(self) -> float:
        """Largest magnitude of the parameter in the sweep."""
        return max(map(abs, self.span))


class Chunk(NamedTuple):
    """Cases to be evaluated together."""

    numbers: np.ndarray  # (n,) int, of the cases in the sweep's record
    cases: tuple[Any, ...]  # a text where the case could not even be made: why
    #: (n, states) or None, where to start from; NaN, or None for all, where a case begins by itself
    states: np.ndarray | None = None
    #: how each got there; None, also for all, where a case begins by itself
    ways: tuple[NeighbourWay | None, ...] | None = None


class Batch(Protocol):
    """Evaluates cases of one kind; its results for a case do not depend on the others beside it.

    Attributes
    ----------
    states : numbers from which a neighbouring case can continue; 0: every case begins by itself
    """

    states: int

    def settings(self, cases: Sequence[Any], transient: int | None, engine: str) -> Any:
        """How cases are evaluated, as a named tuple of plain data.

        Parameters
        ----------
        cases : those at both ends of the grid
        transient : mesh cycles to march instead of seeking a steady state
        engine : where: "native", "jax", "dask"

        Raises
        ------
        InputError
            For what such a study does not know.
        """
        ...

    def following(self, settings: Any, unstable: bool) -> Any:
        """The settings of a sweep whose cases go on from each other, and maybe continue branches unstably.

        Raises
        ------
        InputError
            Where there are no such branches.
        """
        ...

    def layout(self, settings: Any) -> SweepLayout:
        """What is recorded of every case."""
        ...

    def size_of_chunk(self, settings: Any, total: int, width: int) -> int:
        """Cases to be evaluated together, of so many; `width` of them at the cost of one."""
        ...

    def estimate(self, case: Any, settings: Any, total: int, width: int) -> Estimate:
        """What one of so many cases takes: the memory of those evaluated together, the bytes of its row."""
        ...

    def sharing(self, case: Any) -> Hashable:
        """Cases for which this is equal share costly work, and are evaluated one after the other."""
        ...

    def check(self, case: Any, settings: Any) -> None:
        """Prepare a case; InputError says why it cannot be evaluated."""
        ...

    def evaluate(self, chunk: Chunk, settings: Any, workers: int | None) -> dict[str, np.ndarray]:
        """Evaluate; rows (n, …) of every variable of the layout."""
        ...
