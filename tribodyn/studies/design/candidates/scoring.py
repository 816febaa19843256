"""From the quantities of a candidate's cases to objectives, margins of constraints, and their slopes.

Slopes by the free keys are through JAX, where the quantities are differentiable.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.candidates import cases_of, chosen, start_of
from tribodyn.studies.design.candidates.evaluation import Results, loaded_case
from tribodyn.studies.design.case import START, Constraint, DesignCase, Objective

#: Share of its limit within which a constraint holds.
SLACK = 1e-6
#: What a candidate without quantities misses its constraints by: more than any other.
NO_QUANTITIES = 10.0

Rows = Sequence[Sequence[Mapping[str, float]]]
"""Quantities by duty and sample."""
Slopes = list[list[dict[str, Float[Array, " key"]]]]
"""Slopes of quantities by the shares of the free keys, by duty and sample."""


class Score(NamedTuple):
    """What a candidate is worth."""

    objectives: tuple[float, ...]  # NaN where it has no quantities
    margins: tuple[float, ...]  # of the constraints, over their limits: not negative where they hold
    by_duty: tuple[float, ...]  # (duties,), the first objective at each duty
    quantities: dict[str, float]  # over all duties, as the objectives take them
    message: str = ""  # why it has no quantities
    #: the least distance of its gears from the limits of their existence, in modules; None where the free
    #: keys do not change them
    shape: float | None = None

    @property
    def violation(self) -> float:
        """Sum of what the constraints are missed by; 0 where all hold."""
        if self.message:
            return NO_QUANTITIES - min(0.0, self.shape or 0.0)
        return -sum(min(0.0, margin) for margin in self.margins)

    @property
    def feasible(self) -> bool:
        """Whether it has quantities and all constraints hold."""
        return not self.message and self.violation <= SLACK


class Scoring:
    """Scores candidates of a search, once it knows the quantities of the base scenario's cases, `start`."""

    def __init__(self, case: DesignCase, start: Results) -> None:
        self.case = case
        self.start = start
        self.at_start: dict[str, float] = {}  # over all duties
        #: way over the samples of constraints: the worst, or the quantile
        self.over = "quantile" if case.robust.over == "quantile" else "worst"
        self._start = self.rows(start)
        if self._start is not None:
            self.at_start = self._over_all_duties(self._start)
        limits = {constraint.text: self.limit(constraint) for constraint in case.constraints}
        self.scales = {
            text: abs(limit) if limit and math.isfinite(limit) else 1.0 for text, limit in limits.items()
        }

    def limit(self, constraint: Constraint) -> float:
        """Limit of a constraint, SI; infinite where it is that of a start without quantities."""
        if constraint.limit != START:
            return float(constraint.limit)
        if self._start is None or constraint.quantity not in self.at_start:
            return constraint.sign * math.inf
        return constraint.sign * self._worst(constraint, self._start)

    def score(self, results: Results, shape: float | None = None) -> Score:
        """Score the quantities of a candidate's cases, in the order of `candidates.cases_of`."""
        case, rows = self.case, self.rows(results)
        missing = sorted(set(case.quantities) - set(rows[0][0])) if rows else []
        if rows is None or missing:
            message = next((value for value in results if isinstance(value, str)), "")
            message = message or f"it has no {missing[0]}"
            none, missed = (math.nan,), (-NO_QUANTITIES,)
            sizes = len(case.objectives), len(case.constraints), len(case.duties)
            return Score(none * sizes[0], missed * sizes[1], none * sizes[2], {}, message, shape)
        objectives = tuple(self._objective(objective, rows) for objective in case.objectives)
        by_duty = tuple(self._objective(case.objectives[0], [row]) for row in rows)
        margins = tuple(self._margin(constraint, rows) for constraint in case.constraints)
        return Score(objectives, margins, by_duty, self._over_all_duties(rows), shape=shape)

    def rows(self, results: Results) -> list[list[Mapping[str, float]]] | None:
        """Quantities by duty and sample, those that all cases have; None where a case has none."""
        some = [quantities for quantities in results if not isinstance(quantities, str)]
        if len(some) < len(results):
            return None
        shared = set(some[0]).intersection(*some[1:])
        plain: list[Mapping[str, float]] = [
            {name: case[name] for name in some[0] if name in shared} for case in some
        ]
        count = len(some) // len(self.case.duties)
        return [plain[i : i + count] for i in range(0, len(plain), count)]

    def constrained(self, results: Results) -> dict[str, float]:
        """The quantity of every constraint at its worst duty and sample, by the constraint's text."""
        rows = self.rows(results)
        if rows is None:
            return {}
        evaluated = (constraint for constraint in self.case.constraints if constraint.quantity in rows[0][0])
        return {each.text: each.sign * self._worst(each, rows) for each in evaluated}

    def objective_slope(self, objective: Objective, results: Results, slopes: Slopes) -> Float[Array, " key"]:
        """Slope of an objective by the shares of the free keys."""
        case, total = self.case, np.zeros(())
        for name, factor in objective.terms:
            sign = math.copysign(1.0, factor)
            by_duty = self._by_duty(results, slopes, name, sign, case.robust.over)
            if case.over_duties == "worst":
                slope = max(by_duty, key=lambda pair: sign * pair[0])[1]
            else:
                weights = [duty.weight for duty in case.duties]
                slope = np.average([slope for _, slope in by_duty], axis=0, weights=weights)
            total = total + factor / self._reference(objective, name) * slope
        return total

    def margin_slope(self, constraint: Constraint, results: Results, slopes: Slopes) -> Float[Array, " key"]:
        """Slope of the margin of a constraint by the shares of the free keys."""
        sign = constraint.sign
        by_duty = self._by_duty(results, slopes, constraint.quantity, sign, self.over)
        _, slope = max(by_duty, key=lambda pair: sign * pair[0])
        return -sign * slope / self.scales[constraint.text]

    def _objective(self, objective: Objective, rows: Rows) -> float:
        total = 0.0
        for name, factor in objective.terms:
            value = self._over_all(name, rows, math.copysign(1.0, factor))
            total += factor * (value / self._reference(objective, name))
        return total

    def _reference(self, objective: Objective, name: str) -> float:
        """What a quantity of an objective counts relative to."""
        return abs(self.at_start.get(name, 1.0)) or 1.0 if objective.relative else 1.0

    def _over_all_duties(self, rows: Rows) -> dict[str, float]:
        return {name: self._over_all(name, rows, 1.0) for name in rows[0][0]}

    def _over_all(self, name: str, rows: Rows, sign: float) -> float:
        """A quantity over samples, then over duties if there are several; larger is worse for sign 1."""
        over = self.case.robust.over
        values = [sign * self._over_samples([sign * case[name] for case in row], over) for row in rows]
        if len(values) == 1:
            return values[0]
        if self.case.over_duties == "worst":
            return sign * max(sign * value for value in values)
        return float(np.average(values, weights=[duty.weight for duty in self.case.duties]))

    def _over_samples(self, values: Sequence[float], over: str) -> float:
        if over == "worst":
            return max(values)
        if over == "quantile":
            return float(np.quantile(values, self.case.robust.quantile))
        return float(np.mean(values))

    def _margin(self, constraint: Constraint, rows: Rows) -> float:
        limit = self.limit(constraint) * constraint.sign
        if not math.isfinite(limit):
            return 1.0
        return (limit - self._worst(constraint, rows)) / self.scales[constraint.text]

    def _worst(self, constraint: Constraint, rows: Rows) -> float:
        """A quantity times its sign at the worst duty, and the worst or the quantile of its samples."""
        name, sign = constraint.quantity, constraint.sign
        return max(self._over_samples([case[name] * sign for case in row], self.over) for row in rows)

    def _by_duty(
        self, results: Results, slopes: Slopes, name: str, sign: float, over: str
    ) -> list[tuple[float, Any]]:
        """Value and slope of a quantity at each duty; of a quantile those of the sample nearest to it."""
        pairs = []
        for row, of_row in zip(self.rows(results) or [], slopes, strict=True):
            values, of_values = [case[name] for case in row], [case[name] for case in of_row]
            if over == "mean":
                pairs.append((float(np.mean(values)), np.mean(of_values, axis=0)))
                continue
            share = self.case.robust.quantile if over == "quantile" else 1.0
            place = np.argsort(sign * np.array(values))[round(share * (len(values) - 1))]
            pairs.append((values[place], of_values[place]))
        return pairs


def derivatives_of(case: DesignCase) -> "Derivatives | None":
    """Derivatives of a search's quantities by its free keys; None where they cannot be differentiated.

    That is so with motions, whole numbers, choices, finite elements, parts.
    """
    study = study_of(case.base)
    smooth = all(free.continuous for free in case.free)
    if case.parts or study.batch() or not study.has_gears or not smooth:
        return None
    derivatives = Derivatives(case)
    try:
        derivatives.function(cases_of(case, chosen(case, start_of(case)))[0])
    except InputError:
        return None
    return derivatives


class Derivatives:
    """Derivatives of the quantities of a search by its free keys."""

    def __init__(self, case: DesignCase) -> None:
        self.case = case
        self.names = tuple(dict.fromkeys(case.quantities))
        self.keys = tuple(key for free in case.free for key in free.keys)

    def function(self, overrides: dict[str, Any]) -> Any:
        """A `Differentiable` of a case's quantities by the keys; raises InputError where there is none."""
        loaded = loaded_case(self.case.base, overrides)
        return loaded.study.differentiable(loaded.case, self.names, self.keys)

    def at(self, shares: Sequence[float] | np.ndarray) -> Slopes:
        """Slopes of the quantities of all cases of a candidate."""
        case = self.case
        spans = [(free.high - free.low) * free.si for free in case.free]
        first_keys = np.cumsum([0, *(len(free.keys) for free in case.free[:-1])])
        rows = []
        for overrides in cases_of(case, chosen(case, shares)):
            function = self.function(overrides)
            _, by_key = function.jacobian(function.at)
            slopes = spans * np.add.reduceat(by_key, first_keys, axis=1)
            rows.append(dict(zip(self.names, slopes, strict=True)))
        count = len(rows) // len(case.duties)
        return [rows[i : i + count] for i in range(0, len(rows), count)]
