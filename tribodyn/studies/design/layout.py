"""Datasets of a search over its evaluations, in their order: written, and read by a search that goes on."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.numerics.parameter import Variable, flag
from tribodyn.record.reader import Record
from tribodyn.record.schema import Layout
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.archive import FACTORS, Candidate, Unfinished
from tribodyn.studies.design.candidates.candidates import Overrides, samples_of, shapes_gears, value_at
from tribodyn.studies.design.candidates.evaluation import Results
from tribodyn.studies.design.candidates.sources import units_by_name
from tribodyn.studies.design.case import DesignCase, Free, Objective

#: Bytes kept of a message.
MESSAGE = 200
OBJECTIVES = ("objective", "objective_2")
#: Datasets of what was evaluated about the best.
LOWER, UPPER = "objective_lower", "objective_upper"
#: Dataset of the quantities of the base scenario as it stands.
START_QUANTITIES = "start_quantities"
#: Dataset of the resolution of every evaluation.
REFINEMENT = "refinement"
#: Share of its range by which a free key is moved about the best.
MOVED = 0.02


def names_of(case: DesignCase, start: Results) -> tuple[str, ...]:
    """Names of the quantities that are kept: of objectives and constraints, of the start, then all others."""
    of_start = (name for of in start if not isinstance(of, str) for name in of)
    return tuple(dict.fromkeys((*case.quantities, *of_start, *_known_units(case))))


def _known_units(case: DesignCase) -> dict[str, str]:
    """SI units of all quantities by name."""
    return units_by_name({name: study_of(data) for name, data in case.scenarios.items()})


def _units(case: DesignCase, objective: Objective) -> str:
    """SI unit of an objective; "1" of a sum of relative quantities."""
    return "1" if objective.relative else _known_units(case).get(objective.terms[0][0], "1")


def layout_of(case: DesignCase) -> Layout:
    """The layout of a search's record."""

    def along(about: str, units: str = "1", *others: str) -> Variable:
        return Variable(("evaluation", *others), units, about)

    samples: dict[str, Variable] = {}
    for free in case.free:
        about = f"free key {', '.join(free.keys)}"
        if free.choices:
            about += f": number of the choice of {', '.join(map(str, free.choices))}"
        samples[f"free_{free.name}"] = along(about, free.units)
    for name, objective in zip(OBJECTIVES, case.objectives, strict=False):
        about = f"objective: {objective.name.removeprefix('-')}"
        samples[name] = along(about, _units(case, objective))
    units = _units(case, case.objectives[0])
    samples["objective_at_duty"] = along("first objective at each duty", units, "duty")
    if case.constraints:
        about = "how far the constraint holds, over its limit; negative where it does not"
        samples["margin"] = along(about, "1", "constraint")
    samples["case_quantities"] = along("quantities of every duty and sample, SI", "1", "case", "quantity")
    if shapes_gears(case):
        samples["shape"] = along("least distance of the gears from the limits of their existence, in modules")
    samples[REFINEMENT] = along(
        "resolution over that of the scenario: 1 in the search, more in its last stage"
    )
    samples["feasible"] = flag(("evaluation",), "whether all constraints hold", "not_judged no yes")
    samples["message"] = along("why a candidate has no quantities")._replace(dtype=f"S{MESSAGE}", fill=b"")
    scales = {
        "duty": "number of the duty",
        "constraint": "number of the constraint",
        "case": "number of the case: samples run within duties",
        "level": "resolutions over that of the scenario",
        "quantity": "names: those of objectives and constraints, then others",
        "moved": "number of a free key, and behind them of a tolerance, moved about the best",
    }
    about = "quantities of every duty and sample at the start, as in case_quantities, on all resolutions"
    lower = "first objective with one key moved down about the best, the others kept"
    upper = "first objective with one key moved up about the best"
    others = {
        START_QUANTITIES: Variable(("level", "case", "quantity"), "1", about),
        LOWER: Variable(("moved",), units, lower),
        UPPER: Variable(("moved",), units, upper),
    }
    return Layout(
        Variable(("evaluation",), "1", "number of the evaluation"),
        samples,
        {name: Variable((name,), "1", text) for name, text in scales.items()},
        others,
    )


def searched(record: Record) -> np.ndarray:
    """Which evaluations of a record are those of the search itself, not of its last stage."""
    return record[REFINEMENT] == 1.0 if REFINEMENT in record else np.ones(record.samples, bool)


def scales_of(case: DesignCase, names: Sequence[str]) -> dict[str, np.ndarray]:
    """Values along the other axes."""
    scales = {
        "duty": np.arange(len(case.duties)),
        "case": np.arange(len(case.duties) * len(samples_of(case))),
        "level": np.array(FACTORS, dtype=float),
        "quantity": np.array(names),
        "moved": np.arange(len(case.free) + len(case.tolerances)),
    }
    return scales | ({"constraint": np.arange(len(case.constraints))} if case.constraints else {})


def row_of(case: DesignCase, names: Sequence[str], candidate: Candidate, number: int) -> dict[str, Any]:
    """The row of the record for an evaluation."""
    score = candidate.score
    row: dict[str, Any] = {
        "evaluation": float(number),
        "objective_at_duty": score.by_duty,
        "case_quantities": numbers_of_cases(names, candidate.found),
        REFINEMENT: float(candidate.factor),
        "feasible": float(score.feasible),
        "message": " ".join(score.message.split()),
    }
    row |= {f"free_{free.name}": value for free, value in zip(case.free, candidate.numbers, strict=True)}
    row |= zip(OBJECTIVES, score.objectives, strict=False)
    if case.constraints:
        row["margin"] = score.margins
    if shapes_gears(case):
        row["shape"] = np.nan if score.shape is None else score.shape
    return {name: np.array([values]) for name, values in row.items()}


def numbers_of_cases(names: Sequence[str], results: Results) -> np.ndarray:
    """Quantities of cases as numbers, (case, quantity); NaN where there is none."""
    return np.array(
        [[np.nan if isinstance(of, str) else of.get(name, np.nan) for name in names] for of in results]
    )


def unfinished_in(case: DesignCase, record: Record) -> Unfinished:
    """Read what a record of the same search holds."""
    names = [str(name) for name in record["quantity"]]

    def quantities(numbers: Sequence[float]) -> dict[str, float]:
        pairs = zip(names, map(float, numbers), strict=True)
        return {name: number for name, number in pairs if not np.isnan(number)}

    columns = [record[f"free_{free.name}"] for free in case.free]
    evaluated: dict[int, list[tuple[Overrides, Results]]] = {}
    for row, (cases, message) in enumerate(zip(record["case_quantities"], record["message"], strict=True)):
        results: Results = [quantities(numbers) or str(message) for numbers in cases]
        if all(results):
            values: Overrides = {}
            for free, column in zip(case.free, columns, strict=True):
                values |= dict.fromkeys(free.keys, _value(free, float(column[row])))
            evaluated.setdefault(int(record[REFINEMENT][row]), []).append((values, results))
    start: dict[int, Results] = {}
    for factor, cases in zip(record["level"], record[START_QUANTITIES], strict=True):
        of_start: Results = [quantities(numbers) for numbers in cases]
        if all(of_start):
            start[int(factor)] = of_start
    moved = {
        (place, name): float(value)
        for name in (LOWER, UPPER)
        for place, value in enumerate(record[name])
        if np.isfinite(value)
    }
    return Unfinished(evaluated, start, moved)


def _value(free: Free, number: float) -> object:
    """Value of a free key, as TOML has it, for its number in the record."""
    if free.choices:
        return free.choices[int(number)]
    return value_at(free, (number / free.si - free.low) / (free.high - free.low))
