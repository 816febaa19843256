"""Archives of a search by resolution: that of the scenario, and finer ones as they are asked for."""

from collections.abc import Callable

from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.archive import Archive, Evaluation
from tribodyn.studies.design.candidates.candidates import Overrides, cases_of
from tribodyn.studies.design.candidates.evaluation import loaded_case
from tribodyn.studies.design.candidates.pool import Evaluators, Figures
from tribodyn.studies.design.candidates.sources import own
from tribodyn.studies.design.candidates.unfinished import NOTHING_LEFT, Left
from tribodyn.studies.design.candidates.worth import Judge
from tribodyn.studies.design.case import DesignCase


class Levels:
    """Archives of a search by factor, one of `layout.FACTORS`: resolution over that of the scenario.

    Parameters
    ----------
    left : what was evaluated before
    begun : called with a factor and the figures of the base scenario's cases there, before any candidate
    keep : called with every evaluation and its factor, as `archive.Keep`
    """

    def __init__(
        self,
        case: DesignCase,
        pool: Evaluators,
        left: Left = NOTHING_LEFT,
        begun: Callable[[int, Figures], None] = lambda *_: None,
        keep: Callable[[Evaluation, int], None] = lambda *_: None,
    ) -> None:
        self.case = case
        self._pool = pool
        self._left = left
        self._begun = begun
        self._keep = keep
        self._known: dict[int, Archive] = {}

    def at(self, factor: int) -> Archive:
        """The archive of a factor."""
        if factor not in self._known:
            case, left = self.case, self._left
            more = resolutions(case, factor) if factor > 1 else {}
            start = left.start.get(factor) or self._pool.submit(cases_of(case, {}, more)).result()
            self._begun(factor, start)
            known = left.known.get(factor, ())
            judge = Judge(case, start)
            archive = Archive(case, judge, self._pool, lambda one: self._keep(one, factor), known, more)
            self._known[factor] = archive
        return self._known[factor]

    @property
    def finer(self) -> int:
        """Evaluations on finer resolutions."""
        return sum(len(one.evaluations) for factor, one in self._known.items() if factor > 1)


def resolutions(case: DesignCase, factor: int) -> Overrides:
    """Resolutions of the scenarios times a factor, by key; of parts with their names before it."""
    found: Overrides = {}
    for name, data in case.scenarios.items():
        study = study_of(data)
        one = loaded_case(data, own(name, study.table(data), {}, case.parts)).case
        table, _, number = study.resolution.rpartition(".")
        if number:
            holder = one if hasattr(one, number) else getattr(one, table)
            key = f"{name}.{study.resolution}" if name else study.resolution
            found[key] = factor * getattr(holder, number)
    return found
