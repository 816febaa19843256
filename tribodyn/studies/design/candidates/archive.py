"""Every candidate that was evaluated, once on each resolution: requested by methods, kept in the record."""

import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.candidates import Overrides, cases_of, chosen, number_of, shapes_gears
from tribodyn.studies.design.candidates.evaluation import (
    Answer,
    Evaluators,
    Results,
    distance_from_limits,
    loaded_source,
)
from tribodyn.studies.design.candidates.scoring import Score, Scoring
from tribodyn.studies.design.candidates.sources import BASE, split
from tribodyn.studies.design.case import DesignCase

Moved = Mapping[tuple[int, str], float]
"""First objective with a key or a tolerance moved, by its number and the name of the dataset."""
#: Resolutions over that of the scenario, none a multiple of the one before: the same positions would give the
#: same extremes. The first is searched on, the others are those of the last stage.
FACTORS = (1, 2, 5, 11, 23, 47)


class Candidate(NamedTuple):
    """A candidate and its score."""

    values: Overrides  # of the free keys, as TOML has them
    numbers: tuple[float, ...]  # (free,), the same as the record has them
    found: Results  # quantities of its cases
    score: Score
    factor: int = 1  # its resolution over that of the scenario


class Unfinished(NamedTuple):
    """What an unfinished search has in its record; the first two by their factor, one of `FACTORS`."""

    #: values and quantities of candidates, in their order
    known: Mapping[int, Sequence[tuple[Overrides, Results]]] = MappingProxyType({})
    #: quantities of the base scenario's cases; none where they have to be evaluated
    start: Mapping[int, Results] = MappingProxyType({})
    moved: Moved = MappingProxyType({})


class SpentError(Exception):
    """As many candidates were evaluated as may be."""


class Archive:
    """Evaluates candidates of a search on one resolution; what comes again is not evaluated again.

    `keep` is called with every evaluation as soon as it is there, in their order, but not with what is known
    `before`. `factor` is the resolution over that of the scenario, one of `FACTORS`.
    """

    def __init__(
        self,
        case: DesignCase,
        pool: Evaluators,
        keep: Callable[[Candidate], None] = lambda _: None,
        factor: int = 1,
        before: Unfinished = Unfinished(),
    ) -> None:
        self.case = case
        self.factor = factor
        #: keys of the resolution, of every candidate
        self.more = resolutions(case, factor) if factor > 1 else {}
        start = before.start.get(factor) or pool.submit(cases_of(case, {}, self.more)).result()
        self.scoring = Scoring(case, start)
        self._pool = pool
        self._keep = keep
        self._shaped = study_of(case.base).has_gears and shapes_gears(case)
        self._requested: dict[str, Candidate] = {}
        evaluated = before.known.get(factor, ())
        #: candidates that were evaluated before, by their identities, in their order
        self.recorded = {identity(values): self._candidate(values, results) for values, results in evaluated}

    @property
    def evaluations(self) -> list[Candidate]:
        """What the methods requested, each once, in their order: what they decide by."""
        return list(self._requested.values())

    def score(self, shares: Sequence[float] | np.ndarray) -> Score:
        """Score a candidate at shares of the free keys' ranges; raises `SpentError`."""
        return self.score_all([shares])[0]

    def score_all(self, several: Sequence[Any]) -> list[Score]:
        """Score candidates side by side; raises `SpentError` where there is no room for all of them."""
        candidates = [chosen(self.case, shares) for shares in several]
        values = {identity(candidate): candidate for candidate in candidates}
        new = [name for name in values if name not in self._requested]
        room = self.case.search.evaluations - len(self._requested)
        waiting = {name: self.found_of(values[name]) for name in new[:room]}
        for name, future in waiting.items():
            recorded = self.recorded.get(name)
            self._requested[name] = recorded or self._candidate(values[name], future.result())
            if not recorded:
                self._keep(self._requested[name])
        if len(new) > room:
            raise SpentError
        return [self._requested[identity(candidate)].score for candidate in candidates]

    def found_of(self, values: Overrides) -> Answer:
        """Quantities of the cases of any candidate, evaluated if they are not known."""
        name = identity(values)
        if candidate := self._requested.get(name) or self.recorded.get(name):
            ready: Future[Results] = Future()
            ready.set_result(candidate.found)
            return ready
        return self._pool.submit(cases_of(self.case, values, self.more))

    def shape_of(self, values: Mapping[str, Any]) -> float | None:
        """See `Score.shape`; of the first duty, whose gears are those of the others."""
        if not self._shaped:
            return None
        first = cases_of(self.case, values)[0]
        keys = {key: value for key, value in first.items() if split(key, self.case.parts)[0] == BASE}
        return distance_from_limits(self.case.base, keys)

    def feasible(self) -> list[Candidate]:
        """Candidates of which all constraints hold, by their first objective."""
        some = [candidate for candidate in self.evaluations if candidate.score.feasible]
        return sorted(some, key=lambda candidate: (candidate.score.objectives, candidate.numbers))

    def best(self) -> Candidate | None:
        """The feasible candidate with the least first objective; None where there is none."""
        return next(iter(self.feasible()), None)

    def front(self) -> list[Candidate]:
        """The feasible candidates that no other is better than in both objectives, by the first objective."""
        nondominated: list[Candidate] = []
        for candidate in self.feasible():
            if not nondominated or candidate.score.objectives[1] < nondominated[-1].score.objectives[1]:
                nondominated.append(candidate)
        return nondominated

    def nearest(self) -> Candidate | None:
        """The candidate that misses the constraints by least, of those that have quantities."""
        some = [candidate for candidate in self.evaluations if not candidate.score.message]
        return min(some, key=lambda candidate: candidate.score.violation, default=None)

    def _candidate(self, values: Overrides, results: Results) -> Candidate:
        numbers = tuple(number_of(free, values[free.keys[0]]) for free in self.case.free)
        score = self.scoring.score(results, self.shape_of(values))
        return Candidate(values, numbers, results, score, self.factor)


def resolutions(case: DesignCase, factor: int) -> Overrides:
    """Resolutions of the scenarios times a factor, by key; of parts with their names before it."""
    scaled: Overrides = {}
    for name, data in case.scenarios.items():
        key = study_of(data).resolution
        table, _, number = key.rpartition(".")
        if number:
            loaded = loaded_source(case.scenarios, name, {}).case
            holder = loaded if hasattr(loaded, number) else getattr(loaded, table)
            scaled[f"{name}.{key}" if name else key] = factor * getattr(holder, number)
    return scaled


def identity(values: Mapping[str, Any]) -> str:
    """What tells candidates apart."""
    return json.dumps(values, sort_keys=True)
