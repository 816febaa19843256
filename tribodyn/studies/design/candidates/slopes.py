"""Slopes of objectives and margins by the free keys, through JAX where the figures are differentiable."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.derivatives.differentiable import Differentiable
from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, start_of
from tribodyn.studies.design.candidates.evaluation import loaded_case
from tribodyn.studies.design.candidates.worth import Judge
from tribodyn.studies.design.case import Constraint, DesignCase, Objective

Slopes = list[list[dict[str, Float[Array, " key"]]]]
"""Slopes of figures by the shares of the free keys, by duty and sample."""


class Derivatives:
    """Derivatives of the figures of a search by its free keys.

    Raises
    ------
    InputError
        For a search whose figures cannot be differentiated by its keys: motions, whole numbers, choices,
        finite elements, parts.
    """

    def __init__(self, case: DesignCase) -> None:
        study = study_of({"kind": case.base_kind})
        if case.parts or study.batch() or not study.has_gears or not all(one.continuous for one in case.free):
            raise InputError("design.method", None, "cannot be differentiated", "search by differences")
        self.case = case
        of_objectives = (name for one in case.objectives for name, _ in one.terms)
        self.names = tuple(dict.fromkeys((*of_objectives, *(one.figure for one in case.constraints))))
        self.keys = tuple(key for one in case.free for key in one.keys)
        self._function(cases_of(case, chosen(case, start_of(case)))[0])

    def _function(self, overrides: dict[str, Any]) -> Differentiable:
        loaded = loaded_case(self.case.base, overrides)
        table = loaded.study.table()
        return Differentiable(loaded.case, table, self.names, self.keys)

    def at(self, shares: Sequence[float] | np.ndarray) -> Slopes:
        """Slopes of the figures of all cases of a candidate."""
        case = self.case
        spans = [(one.high - one.low) * one.si for one in case.free]
        rows = []
        for overrides in cases_of(case, chosen(case, shares)):
            function = self._function(overrides)
            _, by_key = function.jacobian(function.at)
            columns, first = [], 0
            for one, span in zip(case.free, spans, strict=True):
                columns.append(span * by_key[:, first : first + len(one.keys)].sum(axis=1))
                first += len(one.keys)
            slopes = np.stack(columns, axis=1)
            rows.append(dict(zip(self.names, slopes, strict=True)))
        count = len(rows) // len(case.duties)
        return [rows[i : i + count] for i in range(0, len(rows), count)]


def objective_slope(
    judge: Judge, one: Objective, found: Sequence[dict[str, Any] | str], slopes: Slopes
) -> Float[Array, " key"]:
    """Slope of an objective by the shares of the free keys."""
    total: Any = 0.0
    for name, factor in one.terms:
        reference = abs(judge.at_start.get(name, 1.0)) or 1.0 if one.relative else 1.0
        total = total + factor / reference * _over_all(judge, name, np.sign(factor), found, slopes)
    return total


def margin_slope(
    judge: Judge, one: Constraint, found: Sequence[dict[str, Any] | str], slopes: Slopes
) -> Float[Array, " key"]:
    """Slope of the margin of a constraint by the shares of the free keys."""
    rows = judge.rows(found) or []
    over = "quantile" if judge.case.robust.over == "quantile" else "worst"
    of_duties = [
        _over_samples(
            judge, [case[one.figure] for case in row], [at[one.figure] for at in slope], one.sign, over
        )
        for row, slope in zip(rows, slopes, strict=True)
    ]
    _, slope = max(of_duties, key=lambda pair: one.sign * pair[0])
    return -one.sign * slope / judge.scales[one.text]


def _over_all(
    judge: Judge, name: str, sign: float, found: Sequence[dict[str, Any] | str], slopes: Slopes
) -> Any:
    case, rows = judge.case, judge.rows(found) or []
    of_duties = [
        _over_samples(judge, [one[name] for one in row], [one[name] for one in slope], sign, case.robust.over)
        for row, slope in zip(rows, slopes, strict=True)
    ]
    if case.over_duties == "worst":
        return max(of_duties, key=lambda pair: sign * pair[0])[1]
    weights = [duty.weight for duty in case.duties]
    return np.average([slope for _, slope in of_duties], axis=0, weights=weights)


def _over_samples(
    judge: Judge, values: Sequence[float], slopes: Sequence[Any], sign: float, over: str
) -> tuple[float, Any]:
    """Value and slope over the samples; of a quantile those of the sample that is nearest to it."""
    if over == "mean":
        return float(np.mean(values)), np.mean(slopes, axis=0)
    order = np.argsort(sign * np.array(values))
    share = judge.case.robust.quantile if over == "quantile" else 1.0
    place = order[round(share * (len(values) - 1))]
    return values[place], slopes[place]
