"""Every candidate that was evaluated, each once: asked for by the methods, kept in the record."""

import json
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np

from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.candidates import Overrides, cases_of, chosen, number_of, shapes_gears
from tribodyn.studies.design.candidates.evaluation import distance_from_limits
from tribodyn.studies.design.candidates.pool import Evaluators, Figures
from tribodyn.studies.design.candidates.sources import BASE, split
from tribodyn.studies.design.candidates.worth import Judge, Judged
from tribodyn.studies.design.case import DesignCase

Keep = Callable[["Evaluation"], None]
"""Called with every evaluation as soon as it is there, in their order."""


class Evaluation(NamedTuple):
    """A candidate and what it is worth.

    Attributes
    ----------
    values : of the free keys, as TOML has them
    numbers : (free,), the same as the record has them
    found : figures of its cases
    """

    values: Overrides
    numbers: tuple[float, ...]
    found: Figures
    judged: Judged


class SpentError(Exception):
    """As many candidates were evaluated as may be."""


class Archive:
    """Evaluates candidates of a search; what comes again is not evaluated again.

    Parameters
    ----------
    keep : see `Keep`
    known : values and figures of candidates that were evaluated before: `recorded`. `keep` does not get them.
    more : further keys of every candidate: a resolution other than that of the scenario

    Attributes
    ----------
    evaluations : what the methods asked for, each once: what they decide by
    """

    def __init__(
        self,
        case: DesignCase,
        judge: Judge,
        pool: Evaluators,
        keep: Keep,
        known: Sequence[tuple[Overrides, Figures]] = (),
        more: Mapping[str, Any] | None = None,
    ) -> None:
        self.case = case
        self.more = dict(more or {})
        self.judge = judge
        self.evaluations: list[Evaluation] = []
        self._pool = pool
        self._keep = keep
        self._asked: dict[str, Future[Any]] = {}
        self._done: dict[str, Evaluation] = {}
        self._lock = threading.Lock()
        self._own = threading.local()
        self._closed = False
        self._shaped = study_of({"kind": case.base_kind}).has_gears and shapes_gears(case)
        self._recorded = {identity(values): self._evaluation(values, found) for values, found in known}

    @property
    def recorded(self) -> list[Evaluation]:
        """Candidates that were evaluated before, in their order."""
        return list(self._recorded.values())

    @property
    def room(self) -> int:
        """Candidates that may still be asked for."""
        return self.case.search.evaluations - len(self._asked)

    @property
    def asked(self) -> frozenset[str]:
        """Names of the candidates that were asked for."""
        return frozenset(self._asked)

    @contextmanager
    def at_most(self, count: int, beside: frozenset[str]) -> Iterator[None]:
        """Let this thread ask for so many candidates, those counted that others ask for too.

        Searches that run side by side so end in the same place whichever is faster. Candidates that were
        asked for before all of them began, `beside`, count for none.
        """
        self._own.room, self._own.names = count + len(beside), set(beside)
        try:
            yield
        finally:
            del self._own.room, self._own.names

    def ask(self, shares: Sequence[float] | np.ndarray) -> Judged:
        """Judge a candidate at shares of the free keys' ranges; raises `SpentError`."""
        return self.ask_all([shares])[0]

    def ask_all(self, several: Sequence[Any]) -> list[Judged]:
        """Judge candidates side by side; raises `SpentError` where there is no room for all of them."""
        values = [chosen(self.case, shares) for shares in several]
        names = [identity(one) for one in values]
        with self._lock:
            if self._closed:
                raise SpentError
            allowed = self._allowed(list(dict.fromkeys(names)))
            for name in allowed:
                if name not in self._asked:
                    self._asked[name] = self._submit(name, values[names.index(name)])
        for name in allowed:
            self._take(name, values[names.index(name)])
        if len(allowed) < len(set(names)):
            raise SpentError
        return [self._done[name].judged for name in names]

    def found_of(self, values: Overrides) -> "Future[Any]":
        """Figures of the cases of a candidate about the best, evaluated if they are not known."""
        name = identity(values)
        return self._asked.get(name) or self._submit(name, values)

    def figures_of(self, shares: Sequence[float] | np.ndarray) -> Figures:
        """Figures of a candidate's cases, evaluated if they are not known."""
        self.ask(shares)
        return self._done[identity(chosen(self.case, shares))].found

    def shape_of(self, values: Mapping[str, Any]) -> float | None:
        """See `Judged.shape`; of the first duty, whose gears are those of the others."""
        if not self._shaped:
            return None
        first = cases_of(self.case, values)[0]
        keys = {key: value for key, value in first.items() if split(key, self.case.parts)[0] == BASE}
        return distance_from_limits(self.case.base, keys)

    def close(self) -> None:
        """Let no further candidate be asked for: the threads of the methods end."""
        with self._lock:
            self._closed = True

    def best(self, objective: int = 0) -> Evaluation | None:
        """The feasible candidate with the least objective; None where there is none."""
        feasible = [one for one in self.evaluations if one.judged.feasible]
        return min(feasible, key=lambda one: (one.judged.objectives[objective], one.numbers), default=None)

    def nearest(self) -> Evaluation | None:
        """The candidate that misses the constraints by least, of those that have figures."""
        some = [one for one in self.evaluations if not one.judged.message]
        return min(some, key=lambda one: one.judged.violation, default=None)

    def _allowed(self, names: list[str]) -> list[str]:
        """Those for which there is room, known ones included, in their order."""
        for known, room in self._limits():
            fresh = [name for name in names if name not in known]
            over = set(fresh[max(0, room) :])
            names = [name for name in names if name not in over]
        if hasattr(self._own, "names"):
            self._own.names.update(names)
        return names

    def _limits(self) -> Iterator[tuple[Any, int]]:
        if hasattr(self._own, "names"):
            yield self._own.names, self._own.room - len(self._own.names)
        yield self._asked, self.room

    def _submit(self, name: str, values: Overrides) -> "Future[Any]":
        if name in self._recorded:
            ready: Future[Any] = Future()
            ready.set_result(self._recorded[name].found)
            return ready
        return self._pool.submit(cases_of(self.case, values, self.more))

    def _take(self, name: str, values: Overrides) -> None:
        found = self._asked[name].result()
        with self._lock:
            if name in self._done:
                return
            one = self._recorded.get(name) or self._evaluation(values, found)
            self._done[name] = one
            self.evaluations.append(one)
            if not self._closed and name not in self._recorded:
                self._keep(one)

    def _evaluation(self, values: Overrides, found: Figures) -> Evaluation:
        numbers = tuple(number_of(one, values[one.keys[0]]) for one in self.case.free)
        return Evaluation(values, numbers, found, self.judge.judged(found, self.shape_of(values)))


def identity(values: Mapping[str, Any]) -> str:
    """What tells candidates apart."""
    return json.dumps(values, sort_keys=True)
