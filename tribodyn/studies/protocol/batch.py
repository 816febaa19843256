"""Cases of a study that are evaluated together, for sweeps, and cases between two cases."""

import dataclasses
from collections.abc import Hashable, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np

from tribodyn.cases.cost import Estimate
from tribodyn.record.sweep_schema import SweepLayout

#: Turns of the reference body before a signal begins: the run in, after which a start at rest is forgotten.
RUN_IN = 3.0


class SignalRequest(NamedTuple):
    """Signals of sensors in place of steady states: a data set."""

    duration: float  # s, of every signal
    run_in: float = RUN_IN  # turns of the reference body before it
    seed: int = 0  # of the moments at which signals begin, and of the sensors' noise


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
    """Evaluates cases of one kind; its results for a case do not depend on the others beside it."""

    states: int  # numbers from which a neighbouring case can continue; 0: every case begins by itself

    def settings(self, cases: Sequence[Any], transient: int | None, engine: str) -> Any:
        """How cases are evaluated, as a named tuple of plain data; InputError for what no such study knows.

        Of the cases at both ends of a grid, with the mesh cycles to march instead of seeking a steady state;
        `engine` says where: "native", "jax", "dask".
        """
        ...

    def following(self, settings: Any, unstable: bool) -> Any:
        """The settings of a sweep whose cases go on from each other, and maybe continue branches unstably.

        Raises InputError where there are no such branches.
        """
        ...

    def hearing(self, request: SignalRequest) -> "Batch":
        """The batch whose cases give the signals of their sensors; InputError where they have none."""
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

    def evaluate(self, chunk: Chunk, settings: Any, workers: int | None) -> dict[str, np.ndarray]:
        """Evaluate; rows (n, …) of every variable of the layout."""
        ...


#: Fields that name a case or hold its text, and say nothing of it beyond the others.
_TEXTS = ("title", "name", "toml", "sha256")


class NothingBetween(Exception):
    """The cases differ in something that is no number."""


def case_between(first: Any, last: Any, share: float) -> Any:
    """The case at a share of the way from one case to another, every number in proportion.

    Numbers of a case are in SI units and proportional to what a scenario says, up to a constant; so for a
    varied quantity this is the case of the value in between. A share above 1 goes on beyond the last case.
    Raises NothingBetween where they differ in a name, a switch, a whole number, or the number of numbers.
    """
    if share == 0.0:
        return first
    return last if share == 1.0 else _between(first, last, share)


def _between(first: Any, last: Any, share: float) -> Any:
    if dataclasses.is_dataclass(first) and type(first) is type(last):
        changed = {
            field.name: _between(getattr(first, field.name), getattr(last, field.name), share)
            for field in dataclasses.fields(first)
            if field.init and field.name not in _TEXTS
        }
        return dataclasses.replace(first, **changed)  # pyright: ignore[reportArgumentType]
    if isinstance(first, tuple) and isinstance(last, tuple) and len(first) == len(last):
        parts = [_between(*ends, share) for ends in zip(first, last, strict=True)]
        return type(first)(*parts) if hasattr(first, "_fields") else tuple(parts)
    if isinstance(first, np.ndarray) and isinstance(last, np.ndarray):
        if first.shape != last.shape:
            raise NothingBetween
        return first if np.array_equal(first, last) else first + share * (last - first)
    if isinstance(first, dict) and isinstance(last, dict) and first.keys() == last.keys():
        return {key: _between(first[key], last[key], share) for key in first}
    if isinstance(first, float) and isinstance(last, float):
        return first if first == last else first + share * (last - first)
    if type(first) is type(last) and first == last:
        return first
    raise NothingBetween
