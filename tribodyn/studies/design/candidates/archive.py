"""Every candidate that was evaluated, once on each resolution: requested by methods, kept in the record."""

import json
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.candidates import Overrides, cases_of, chosen, number_of, shapes_gears
from tribodyn.studies.design.candidates.evaluation import (
    Evaluators,
    Figures,
    distance_from_limits,
    loaded_source,
)
from tribodyn.studies.design.candidates.scoring import Score, Scoring
from tribodyn.studies.design.candidates.sources import BASE, split
from tribodyn.studies.design.case import DesignCase

Moved = Mapping[tuple[int, str], float]
"""First objective with a key or a tolerance moved, by its number and the name of the dataset."""


class Candidate(NamedTuple):
    """A candidate and its score."""

    values: Overrides  # of the free keys, as TOML has them
    numbers: tuple[float, ...]  # (free,), the same as the record has them
    found: Figures  # figures of its cases
    score: Score
    factor: int = 1  # its resolution over that of the scenario


Keep = Callable[[Candidate], None]
"""Called with every evaluation as soon as it is there, in their order."""


class Unfinished(NamedTuple):
    """What an unfinished search has in its record."""

    #: values and figures of candidates, in their order, by their resolution over that of the scenario
    known: Mapping[int, Sequence[tuple[Overrides, Figures]]] = MappingProxyType({})
    #: figures of the base scenario's cases, by the same; none where they have to be evaluated
    start: Mapping[int, Figures] = MappingProxyType({})
    moved: Moved = MappingProxyType({})


class SpentError(Exception):
    """As many candidates were evaluated as may be."""


class Archive:
    """Evaluates candidates of a search on one resolution; what comes again is not evaluated again.

    Parameters
    ----------
    start : figures of the base scenario's cases
    known : values and figures of candidates that were evaluated before: `recorded`. `keep` does not get them.
    factor : resolution over that of the scenario

    Attributes
    ----------
    evaluations : what the methods requested, each once: what they decide by
    more : keys of the resolution, of every candidate
    """

    def __init__(
        self,
        case: DesignCase,
        start: Figures,
        pool: Evaluators,
        keep: Keep,
        known: Sequence[tuple[Overrides, Figures]] = (),
        factor: int = 1,
    ) -> None:
        self.case = case
        self.factor = factor
        self.more = resolutions(case, factor) if factor > 1 else {}
        self.scoring = Scoring(case, start)
        self.evaluations: list[Candidate] = []
        self._pool = pool
        self._keep = keep
        self._submitted: dict[str, Future[Any]] = {}
        self._done: dict[str, Candidate] = {}
        self._lock = threading.Lock()
        self._own = threading.local()
        self._closed = False
        self._shaped = study_of(case.base).has_gears and shapes_gears(case)
        self._recorded = {identity(values): self._evaluation(values, found) for values, found in known}

    @property
    def recorded(self) -> list[Candidate]:
        """Candidates that were evaluated before, in their order."""
        return list(self._recorded.values())

    @property
    def room(self) -> int:
        """Candidates that may still be requested."""
        return self.case.search.evaluations - len(self._submitted)

    @property
    def requested(self) -> frozenset[str]:
        """Names of the candidates that were requested."""
        return frozenset(self._submitted)

    @contextmanager
    def at_most(self, count: int, beside: frozenset[str]) -> Iterator[None]:
        """Let this thread request so many candidates, counting those that others request too.

        Searches that run side by side so end in the same place whichever is faster. Candidates that were
        requested before all of them began, `beside`, do not count.
        """
        self._own.room, self._own.names = count + len(beside), set(beside)
        try:
            yield
        finally:
            del self._own.room, self._own.names

    def score(self, shares: Sequence[float] | np.ndarray) -> Score:
        """Score a candidate at shares of the free keys' ranges; raises `SpentError`."""
        return self.score_all([shares])[0]

    def score_all(self, several: Sequence[Any]) -> list[Score]:
        """Score candidates side by side; raises `SpentError` where there is no room for all of them."""
        values = [chosen(self.case, shares) for shares in several]
        names = [identity(candidate) for candidate in values]
        with self._lock:
            if self._closed:
                raise SpentError
            allowed = self._allowed(list(dict.fromkeys(names)))
            for name in allowed:
                if name not in self._submitted:
                    self._submitted[name] = self._submit(name, values[names.index(name)])
        for name in allowed:
            self._take(name, values[names.index(name)])
        if len(allowed) < len(set(names)):
            raise SpentError
        return [self._done[name].score for name in names]

    def found_of(self, values: Overrides) -> "Future[Any]":
        """Figures of the cases of a candidate about the best, evaluated if they are not known."""
        name = identity(values)
        return self._submitted.get(name) or self._submit(name, values)

    def figures_of(self, shares: Sequence[float] | np.ndarray) -> Figures:
        """Figures of a candidate's cases, evaluated if they are not known."""
        self.score(shares)
        return self._done[identity(chosen(self.case, shares))].found

    def shape_of(self, values: Mapping[str, Any]) -> float | None:
        """See `Score.shape`; of the first duty, whose gears are those of the others."""
        if not self._shaped:
            return None
        first = cases_of(self.case, values)[0]
        keys = {key: value for key, value in first.items() if split(key, self.case.parts)[0] == BASE}
        return distance_from_limits(self.case.base, keys)

    def close(self) -> None:
        """Refuse further candidates: the threads of the methods end."""
        with self._lock:
            self._closed = True

    def best(self, objective: int = 0) -> Candidate | None:
        """The feasible candidate with the least objective; None where there is none."""
        feasible = [candidate for candidate in self.evaluations if candidate.score.feasible]
        key = lambda candidate: (candidate.score.objectives[objective], candidate.numbers)  # noqa: E731
        return min(feasible, key=key, default=None)

    def nearest(self) -> Candidate | None:
        """The candidate that misses the constraints by least, of those that have figures."""
        some = [candidate for candidate in self.evaluations if not candidate.score.message]
        return min(some, key=lambda candidate: candidate.score.violation, default=None)

    def _allowed(self, names: list[str]) -> list[str]:
        """Those for which there is room, known ones included, in their order."""
        limits: list[tuple[Any, int]] = [(self._submitted, self.room)]
        if hasattr(self._own, "names"):
            limits.insert(0, (self._own.names, self._own.room - len(self._own.names)))
        for known, room in limits:
            over = set([name for name in names if name not in known][max(0, room) :])
            names = [name for name in names if name not in over]
        if hasattr(self._own, "names"):
            self._own.names.update(names)
        return names

    def _submit(self, name: str, values: Overrides) -> "Future[Any]":
        if name in self._recorded:
            ready: Future[Any] = Future()
            ready.set_result(self._recorded[name].found)
            return ready
        return self._pool.submit(cases_of(self.case, values, self.more))

    def _take(self, name: str, values: Overrides) -> None:
        found = self._submitted[name].result()
        with self._lock:
            if name in self._done:
                return
            candidate = self._recorded.get(name) or self._evaluation(values, found)
            self._done[name] = candidate
            self.evaluations.append(candidate)
            if not self._closed and name not in self._recorded:
                self._keep(candidate)

    def _evaluation(self, values: Overrides, found: Figures) -> Candidate:
        numbers = tuple(number_of(free, values[free.keys[0]]) for free in self.case.free)
        score = self.scoring.score(found, self.shape_of(values))
        return Candidate(values, numbers, found, score, self.factor)


class Levels:
    """Archives of a search by factor, one of `layout.FACTORS`: resolution over that of the scenario.

    Parameters
    ----------
    begun : called with a factor and the figures of the base scenario's cases there, before any candidate
    keep : of all archives
    """

    def __init__(
        self,
        case: DesignCase,
        pool: Evaluators,
        unfinished: Unfinished = Unfinished(),
        begun: Callable[[int, Figures], None] = lambda *_: None,
        keep: Keep = lambda _: None,
    ) -> None:
        self.case = case
        self._pool = pool
        self._unfinished = unfinished
        self._begun = begun
        self._keep = keep
        self._archives: dict[int, Archive] = {}

    def at(self, factor: int) -> Archive:
        """The archive of a factor."""
        if factor not in self._archives:
            case, known = self.case, self._unfinished
            start = known.start.get(factor)
            if not start:
                more = resolutions(case, factor) if factor > 1 else {}
                start = self._pool.submit(cases_of(case, {}, more)).result()
            self._begun(factor, start)
            archive = Archive(case, start, self._pool, self._keep, known.known.get(factor, ()), factor)
            self._archives[factor] = archive
        return self._archives[factor]

    @property
    def finer(self) -> int:
        """Evaluations on finer resolutions."""
        return sum(len(archive.evaluations) for factor, archive in self._archives.items() if factor > 1)


def resolutions(case: DesignCase, factor: int) -> Overrides:
    """Resolutions of the scenarios times a factor, by key; of parts with their names before it."""
    found: Overrides = {}
    for name, data in case.scenarios.items():
        key = study_of(data).resolution
        table, _, number = key.rpartition(".")
        if number:
            loaded = loaded_source(case.scenarios, name, {}).case
            holder = loaded if hasattr(loaded, number) else getattr(loaded, table)
            found[f"{name}.{key}" if name else key] = factor * getattr(holder, number)
    return found


def identity(values: Mapping[str, Any]) -> str:
    """What tells candidates apart."""
    return json.dumps(values, sort_keys=True)


def front(evaluations: list[Candidate]) -> list[Candidate]:
    """The feasible candidates that no other is better than in both objectives, by the first objective."""
    some = [candidate for candidate in evaluations if candidate.score.feasible]
    some.sort(key=lambda candidate: (candidate.score.objectives, candidate.numbers))
    found: list[Candidate] = []
    for candidate in some:
        if not found or candidate.score.objectives[1] < found[-1].score.objectives[1]:
            found.append(candidate)
    return found
