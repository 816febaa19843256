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
from tribodyn.studies.design.candidates.scoring import Rows, Scoring
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
        study = study_of(case.base)
        if (
            case.parts
            or study.batch()
            or not study.has_gears
            or not all(free.continuous for free in case.free)
        ):
            raise InputError("design.method", None, "cannot be differentiated", "search by differences")
        self.case = case
        self.names = tuple(dict.fromkeys(case.figures))
        self.keys = tuple(key for free in case.free for key in free.keys)
        self._function(cases_of(case, chosen(case, start_of(case)))[0])

    def _function(self, overrides: dict[str, Any]) -> Differentiable:
        loaded = loaded_case(self.case.base, overrides)
        table = loaded.study.table()
        return Differentiable(loaded.case, table, self.names, self.keys)

    def at(self, shares: Sequence[float] | np.ndarray) -> Slopes:
        """Slopes of the figures of all cases of a candidate."""
        case = self.case
        spans = [(free.high - free.low) * free.si for free in case.free]
        rows = []
        for overrides in cases_of(case, chosen(case, shares)):
            function = self._function(overrides)
            _, by_key = function.jacobian(function.at)
            columns, first = [], 0
            for free, span in zip(case.free, spans, strict=True):
                columns.append(span * by_key[:, first : first + len(free.keys)].sum(axis=1))
                first += len(free.keys)
            slopes = np.stack(columns, axis=1)
            rows.append(dict(zip(self.names, slopes, strict=True)))
        count = len(rows) // len(case.duties)
        return [rows[i : i + count] for i in range(0, len(rows), count)]


def objective_slope(
    scoring: Scoring, objective: Objective, found: Sequence[dict[str, Any] | str], slopes: Slopes
) -> Float[Array, " key"]:
    """Slope of an objective by the shares of the free keys."""
    total: Any = 0.0
    for name, factor in objective.terms:
        reference = abs(scoring.at_start.get(name, 1.0)) or 1.0 if objective.relative else 1.0
        total = total + factor / reference * _over_all(scoring, name, np.sign(factor), found, slopes)
    return total


def margin_slope(
    scoring: Scoring, constraint: Constraint, found: Sequence[dict[str, Any] | str], slopes: Slopes
) -> Float[Array, " key"]:
    """Slope of the margin of a constraint by the shares of the free keys."""
    rows = scoring.rows(found) or []
    over = "quantile" if scoring.case.robust.over == "quantile" else "worst"
    of_duties = _by_duty(scoring, rows, slopes, constraint.figure, constraint.sign, over)
    _, slope = max(of_duties, key=lambda pair: constraint.sign * pair[0])
    return -constraint.sign * slope / scoring.scales[constraint.text]


def _over_all(
    scoring: Scoring, name: str, sign: float, found: Sequence[dict[str, Any] | str], slopes: Slopes
) -> Any:
    case, rows = scoring.case, scoring.rows(found) or []
    of_duties = _by_duty(scoring, rows, slopes, name, sign, case.robust.over)
    if case.over_duties == "worst":
        return max(of_duties, key=lambda pair: sign * pair[0])[1]
    weights = [duty.weight for duty in case.duties]
    return np.average([slope for _, slope in of_duties], axis=0, weights=weights)


def _by_duty(
    scoring: Scoring, rows: Rows, slopes: Slopes, name: str, sign: float, over: str
) -> list[tuple[float, Any]]:
    """Value and slope of a figure at each duty, over its samples."""
    return [
        _over_samples(scoring, [case[name] for case in row], [case[name] for case in slope], sign, over)
        for row, slope in zip(rows, slopes, strict=True)
    ]


def _over_samples(
    scoring: Scoring, values: Sequence[float], slopes: Sequence[Any], sign: float, over: str
) -> tuple[float, Any]:
    """Value and slope over the samples; of a quantile those of the sample that is nearest to it."""
    if over == "mean":
        return float(np.mean(values)), np.mean(slopes, axis=0)
    order = np.argsort(sign * np.array(values))
    share = scoring.case.robust.quantile if over == "quantile" else 1.0
    place = order[round(share * (len(values) - 1))]
    return values[place], slopes[place]
