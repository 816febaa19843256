"""The ways between neighbouring cases of a followed sweep, as legs of a continuation."""

from collections.abc import Callable, Sequence

import numpy as np

from tribodyn.solve.branch.continuation import Leg
from tribodyn.studies.gear_pair.case import Case
from tribodyn.studies.gear_pair.prepare import Prepared, Tabulated, prepare, table_key
from tribodyn.studies.sweeping.batch import Way
from tribodyn.studies.sweeping.between import NothingBetween, case_between

#: Parts of a way at most, where every place on it needs a table of its own.
PARTS = 4


def legs_of(cases: Sequence[tuple[Prepared, np.ndarray]], ways: Sequence[Way | None]) -> list[Leg]:
    """The leg to each case, with the state that it begins from."""
    legs = []
    for line, ((prepared, state), way) in enumerate(zip(cases, ways, strict=True)):
        if way is None:
            legs.append(Leg(line, 0.0, 0.0, state, 0))
        else:
            finest = _finest(way, prepared.case)
            legs.append(Leg(line, way.start, way.target, state, way.period, finest, way.reach))
    return legs


PreparedAt = Callable[[int, float], Prepared]
"""Gives the prepared case on a line at a value of the parameter; raises InputError where there is none."""


def prepared_between(
    cases: Sequence[Prepared], ways: Sequence[Way | None], tabulated: Callable[[Case], Tabulated]
) -> PreparedAt:
    """Gives the prepared case at a place on the way to a case, or beyond it."""

    def prepared_at(line: int, value: float) -> Prepared:
        way = ways[line]
        if way is None or value == way.target:
            return cases[line]
        share = (value - way.start) / (way.target - way.start)
        case = case_between(way.neighbour, cases[line].case, share)
        return prepare(case, tabulated(case))

    return prepared_at


def _finest(way: Way, case: Case) -> float:
    try:
        case_between(way.neighbour, case, 0.5)
    except NothingBetween:
        return np.inf
    dear = table_key(way.neighbour) != table_key(case)
    return abs(way.target - way.start) / PARTS if dear else 0.0
