"""What an unfinished search left in its record, to go on from."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.record.reader import Record
from tribodyn.studies.design.candidates.candidates import Overrides, value_at
from tribodyn.studies.design.candidates.pool import Figures
from tribodyn.studies.design.case import DesignCase, Free
from tribodyn.studies.design.layout import LOWER, REFINEMENT, START_FIGURES, UPPER

Moved = Mapping[tuple[int, str], float]
"""First objective with a key or a tolerance moved, by its number and the name of the dataset."""


class Left(NamedTuple):
    """What an unfinished search left.

    Attributes
    ----------
    known : values and figures of candidates, in their order, by their resolution over that of the scenario
    start : figures of the base scenario's cases, by the same; none where they have to be evaluated
    moved : see `Moved`
    """

    known: Mapping[int, Sequence[tuple[Overrides, Figures]]]
    start: Mapping[int, Figures]
    moved: Moved


NOTHING_LEFT = Left({}, {}, {})


def left_in(case: DesignCase, record: Record) -> Left:
    """Read what a record of the same search holds."""
    names = [str(name) for name in record["figure"]]
    columns = [record[f"free_{one.name}"] for one in case.free]
    known: dict[int, list[tuple[Overrides, Figures]]] = {}
    for row, (cases, message) in enumerate(zip(record["case_figures"], record["message"], strict=True)):
        values: Overrides = {}
        for one, column in zip(case.free, columns, strict=True):
            values |= dict.fromkeys(one.keys, _value(one, float(column[row])))
        found: Figures = [_figures(names, numbers) or str(message) for numbers in cases]
        if not any(isinstance(of, str) and not of for of in found):
            known.setdefault(int(record[REFINEMENT][row]), []).append((values, found))
    start: dict[int, Figures] = {}
    for factor, cases in zip(record["level"], record[START_FIGURES], strict=True):
        of_start = [of for numbers in cases if (of := _figures(names, numbers))]
        if len(of_start) == len(cases):
            start[int(factor)] = list(of_start)
    moved = {
        (place, name): float(value)
        for name in (LOWER, UPPER)
        for place, value in enumerate(record[name])
        if np.isfinite(value)
    }
    return Left(known, start, moved)


def _value(one: Free, number: float) -> object:
    """Value of a free key, as TOML has it, for its number in the record."""
    if one.choices:
        return one.choices[int(number)]
    return value_at(one, (number / one.si - one.low) / (one.high - one.low))


def _figures(names: Sequence[str], numbers: Sequence[float]) -> dict[str, float] | None:
    if np.all(np.isnan(numbers)):
        return None
    return {name: float(value) for name, value in zip(names, numbers, strict=True) if not np.isnan(value)}
