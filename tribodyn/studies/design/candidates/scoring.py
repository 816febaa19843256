"""From the quantities of a candidate's cases to objectives, margins of constraints, and their slopes.

Slopes by the free keys are through JAX, where the quantities are differentiable.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.derivatives.differentiable import Differentiable
from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, start_of
from tribodyn.studies.design.candidates.evaluation import loaded_case
from tribodyn.studies.design.case import START, Constraint, DesignCase, Objective

#: Share of its limit within which a constraint holds.
SLACK = 1e-6
#: What a candidate without figures misses its constraints by: more than any other.
NO_FIGURES = 10.0


Rows = Sequence[Sequence[Mapping[str, float]]]
"""Figures by duty and sample."""


class Score(NamedTuple):
    """What a candidate is worth."""

    objectives: tuple[float, ...]  # NaN where it has no figures
    margins: tuple[float, ...]  # of the constraints, over their limits: not negative where they hold
    by_duty: tuple[float, ...]  # (duties,), the first objective at each duty
    figures: dict[str, float]  # figures over all duties, as the objectives take them
    message: str = ""  # why it has no figures
    #: the least distance of its gears from the limits of their existence, in modules; None where the free
    #: keys do not change them
    shape: float | None = None

    @property
    def violation(self) -> float:
        """Sum of what the constraints are missed by; 0 where all hold."""
        if self.message:
            return NO_FIGURES - min(0.0, self.shape or 0.0)
        return -sum(min(0.0, margin) for margin in self.margins)

    @property
    def feasible(self) -> bool:
        """Whether it has figures and all constraints hold."""
        return not self.message and self.violation <= SLACK


class Scoring:
    """Scores candidates of a search, once it knows the figures at the start.

    Parameters
    ----------
    start : figures of the base scenario's cases, as `evaluation.evaluate` gives them
    """

    def __init__(self, case: DesignCase, start: Sequence[dict[str, Any] | str]) -> None:
        self.case = case
        self.start = list(start)
        self.scales: dict[str, float] = {}
        self.at_start: dict[str, float] = {}
        self._start = self.rows(start)
        if self._start is not None:
            self.at_start = {name: self._over_all(name, self._start, 1.0) for name in self._start[0][0]}
        for constraint in case.constraints:
            limit = self.limit(constraint)
            self.scales[constraint.text] = abs(limit) if limit and math.isfinite(limit) else 1.0

    def limit(self, constraint: Constraint) -> float:
        """Limit of a constraint, SI; infinite where it is that of a start without figures."""
        if constraint.limit != START:
            return float(constraint.limit)
        if self._start is None or constraint.figure not in self.at_start:
            return constraint.sign * math.inf
        return constraint.sign * self._worst(constraint, self._start)

    def score(self, found: Sequence[dict[str, Any] | str], shape: float | None = None) -> Score:
        """Score the figures of a candidate's cases, in the order of `candidates.cases_of`."""
        case, rows = self.case, self.rows(found)
        missing = sorted(set(case.figures) - set(rows[0][0])) if rows else []
        if rows is None or missing:
            message = next((value for value in found if isinstance(value, str)), "")
            message = message or f"it has no {missing[0]}"
            none, missed = (math.nan,), (-NO_FIGURES,)
            sizes = len(case.objectives), len(case.constraints), len(case.duties)
            return Score(none * sizes[0], missed * sizes[1], none * sizes[2], {}, message, shape)
        objectives = tuple(self._objective(objective, rows) for objective in case.objectives)
        by_duty = tuple(self._objective(case.objectives[0], [row]) for row in rows)
        margins = tuple(self._margin(constraint, rows) for constraint in case.constraints)
        figures = {name: self._over_all(name, rows, 1.0) for name in rows[0][0]}
        return Score(objectives, margins, by_duty, figures, shape=shape)

    def rows(self, found: Sequence[dict[str, Any] | str]) -> list[list[Mapping[str, float]]] | None:
        """Figures by duty and sample, those that all cases have; None where a case has none."""
        if any(isinstance(value, str) for value in found):
            return None
        some: list[Any] = list(found)
        shared = set(some[0]).intersection(*some[1:])
        names = [name for name in some[0] if name in shared]
        plain: list[Mapping[str, float]] = [{name: candidate[name] for name in names} for candidate in some]
        count = len(some) // len(self.case.duties)
        return [plain[i : i + count] for i in range(0, len(plain), count)]

    def _objective(self, objective: Objective, rows: Rows) -> float:
        total = 0.0
        for name, factor in objective.terms:
            value = self._over_all(name, rows, math.copysign(1.0, factor))
            reference = abs(self.at_start.get(name, 1.0)) or 1.0
            total += factor * (value / reference if objective.relative else value)
        return total

    def _over_all(self, name: str, rows: Rows, sign: float) -> float:
        """A figure over samples, then over duties if there are several; larger is worse for sign 1."""
        values = [sign * self._over_samples([sign * figures[name] for figures in row]) for row in rows]
        if len(values) == 1:
            return values[0]
        if self.case.over_duties == "worst":
            return sign * max(sign * value for value in values)
        weights = [duty.weight for duty in self.case.duties]
        return float(np.average(values, weights=weights))

    def _over_samples(self, values: Sequence[float]) -> float:
        robust = self.case.robust
        if robust.over == "worst":
            return max(values)
        if robust.over == "quantile":
            return float(np.quantile(values, robust.quantile))
        return float(np.mean(values))

    def constrained(self, found: Sequence[dict[str, Any] | str]) -> dict[str, float]:
        """The figure of every constraint at its worst duty and sample, by the constraint's text."""
        rows = self.rows(found)
        if rows is None:
            return {}
        known = (constraint for constraint in self.case.constraints if constraint.figure in rows[0][0])
        return {each.text: each.sign * self._worst(each, rows) for each in known}

    def _margin(self, constraint: Constraint, rows: Rows) -> float:
        limit = self.limit(constraint) * constraint.sign
        return (
            (limit - self._worst(constraint, rows)) / self.scales[constraint.text]
            if math.isfinite(limit)
            else 1.0
        )

    def _worst(self, constraint: Constraint, rows: Rows) -> float:
        """A figure times its sign at the worst duty, and the worst or the quantile of its samples."""
        robust = self.case.robust
        return max(
            float(np.quantile(values, robust.quantile)) if robust.over == "quantile" else max(values)
            for values in ([case[constraint.figure] * constraint.sign for case in row] for row in rows)
        )


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
