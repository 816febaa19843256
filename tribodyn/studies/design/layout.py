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
from tribodyn.studies.design.candidates.evaluation import Figures
from tribodyn.studies.design.candidates.sources import units_by_figure
from tribodyn.studies.design.case import DesignCase, Free, Objective

EVALUATION = Variable(("evaluation",), "1", "number of the evaluation")
#: Bytes kept of a message.
MESSAGE = 200
OBJECTIVES = ("objective", "objective_2")
#: Datasets of what was evaluated about the best.
LOWER, UPPER = "objective_lower", "objective_upper"
#: Dataset of the figures of the base scenario as it stands.
START_FIGURES = "start_figures"
#: Dataset of the resolution of every evaluation.
REFINEMENT = "refinement"
#: Share of its range by which a free key is moved about the best.
MOVED = 0.02


def names_of(case: DesignCase, start: Figures) -> tuple[str, ...]:
    """Names of the figures that are kept: of objectives and constraints, then all others.

    Parameters
    ----------
    start : figures of the base scenario's cases
    """
    of_start = (name for of in start if not isinstance(of, str) for name in of)
    known = known_units(case)
    return tuple(dict.fromkeys((*case.figures, *of_start, *known)))


def known_units(case: DesignCase) -> dict[str, str]:
    """SI units of all figures by name."""
    return units_by_figure({name: study_of(data) for name, data in case.scenarios.items()})


def objective_units(case: DesignCase, objective: Objective) -> str:
    """SI unit of an objective; "1" of a sum of relative figures."""
    units = known_units(case)
    return "1" if objective.relative else units.get(objective.terms[0][0], "1")


def layout_of(case: DesignCase) -> Layout:
    """The layout of a search's record."""
    along = ("evaluation",)
    samples: dict[str, Variable] = {}
    for free in case.free:
        about = f"free key {', '.join(free.keys)}"
        if free.choices:
            about += f": number of the choice of {', '.join(map(str, free.choices))}"
        samples[f"free_{free.name}"] = Variable(along, free.units, about)
    for name, objective in zip(OBJECTIVES, case.objectives, strict=False):
        about = f"objective: {objective.name.removeprefix('-')}"
        samples[name] = Variable(along, objective_units(case, objective), about)
    units = objective_units(case, case.objectives[0])
    samples["objective_at_duty"] = Variable((*along, "duty"), units, "first objective at each duty")
    if case.constraints:
        about = "how far the constraint holds, over its limit; negative where it does not"
        samples["margin"] = Variable((*along, "constraint"), "1", about)
    samples["case_figures"] = Variable(
        (*along, "case", "figure"), "1", "figures of every duty and sample, SI"
    )
    if shapes_gears(case):
        about = "least distance of the gears from the limits of their existence, in modules"
        samples["shape"] = Variable(along, "1", about)
    about = "resolution over that of the scenario: 1 in the search, more in its last stage"
    samples[REFINEMENT] = Variable(along, "1", about)
    samples["feasible"] = flag(along, "whether all constraints hold", "not_judged no yes")
    samples["message"] = Variable(along, "1", "why a candidate has no figures", f"S{MESSAGE}", b"")
    scales = {
        "duty": Variable(("duty",), "1", "number of the duty"),
        "constraint": Variable(("constraint",), "1", "number of the constraint"),
        "case": Variable(("case",), "1", "number of the case: samples run within duties"),
        "level": Variable(("level",), "1", "resolutions over that of the scenario"),
        "figure": Variable(("figure",), "1", "figures: those of objectives and constraints, then others"),
        "moved": Variable(
            ("moved",), "1", "number of a free key, and behind them of a tolerance, moved about the best"
        ),
    }
    others = {
        START_FIGURES: Variable(
            ("level", "case", "figure"),
            "1",
            "figures of every duty and sample at the start, as in case_figures, on the resolutions asked for",
        ),
        LOWER: Variable(
            ("moved",), units, "first objective with one key moved down about the best, the others kept"
        ),
        UPPER: Variable(("moved",), units, "first objective with one key moved up about the best"),
    }
    return Layout(EVALUATION, samples, scales, others)


def searched(record: Record) -> np.ndarray:
    """Which evaluations of a record are those of the search itself, not of its last stage."""
    return record[REFINEMENT] == 1.0 if REFINEMENT in record else np.ones(record.samples, bool)


def scales_of(case: DesignCase, names: Sequence[str]) -> dict[str, np.ndarray]:
    """Values along the other axes."""
    scales = {
        "duty": np.arange(len(case.duties)),
        "case": np.arange(len(case.duties) * len(samples_of(case))),
        "level": np.array(FACTORS, dtype=float),
        "figure": np.array(names),
        "moved": np.arange(len(case.free) + len(case.tolerances)),
    }
    return scales | ({"constraint": np.arange(len(case.constraints))} if case.constraints else {})


def rows_of(case: DesignCase, names: Sequence[str], some: Sequence[Candidate], start: int) -> dict[str, Any]:
    """Rows of the record for evaluations, the first of which has the number `start`."""
    numbers = np.array([candidate.numbers for candidate in some], dtype=float)
    numbers = numbers.reshape(len(some), len(case.free))
    scores = [candidate.score for candidate in some]
    rows: dict[str, Any] = {"evaluation": np.arange(start, start + len(some), dtype=float)}
    for place, free in enumerate(case.free):
        rows[f"free_{free.name}"] = numbers[:, place]
    for place, name in enumerate(OBJECTIVES[: len(case.objectives)]):
        rows[name] = np.array([score.objectives[place] for score in scores])
    rows["objective_at_duty"] = np.array([score.by_duty for score in scores])
    if case.constraints:
        rows["margin"] = np.array([score.margins for score in scores])
    rows["case_figures"] = np.array([figure_rows(names, candidate.found) for candidate in some])
    if shapes_gears(case):
        rows["shape"] = np.array([np.nan if score.shape is None else score.shape for score in scores])
    rows[REFINEMENT] = np.array([float(candidate.factor) for candidate in some])
    rows["feasible"] = np.array([float(score.feasible) for score in scores])
    rows["message"] = np.array([_cut(score.message) for score in scores], dtype=f"S{MESSAGE}")
    return rows


def figure_rows(names: Sequence[str], found: Figures) -> np.ndarray:
    """Figures of cases as numbers, (case, figure); NaN where there is none."""
    return np.array(
        [[np.nan if isinstance(of, str) else of.get(name, np.nan) for name in names] for of in found]
    )


def _cut(text: str) -> bytes:
    raw = " ".join(text.split()).encode()
    return raw if len(raw) <= MESSAGE else raw[: MESSAGE - 3].decode(errors="ignore").encode() + b"..."


def unfinished_in(case: DesignCase, record: Record) -> Unfinished:
    """Read what a record of the same search holds."""
    names = [str(name) for name in record["figure"]]
    columns = [record[f"free_{free.name}"] for free in case.free]
    known: dict[int, list[tuple[Overrides, Figures]]] = {}
    for row, (cases, message) in enumerate(zip(record["case_figures"], record["message"], strict=True)):
        values: Overrides = {}
        for free, column in zip(case.free, columns, strict=True):
            values |= dict.fromkeys(free.keys, _value(free, float(column[row])))
        found: Figures = [_figures_in(names, numbers) or str(message) for numbers in cases]
        if not any(isinstance(of, str) and not of for of in found):
            known.setdefault(int(record[REFINEMENT][row]), []).append((values, found))
    start: dict[int, Figures] = {}
    for factor, cases in zip(record["level"], record[START_FIGURES], strict=True):
        of_start = [of for numbers in cases if (of := _figures_in(names, numbers))]
        if len(of_start) == len(cases):
            start[int(factor)] = list(of_start)
    moved = {
        (place, name): float(value)
        for name in (LOWER, UPPER)
        for place, value in enumerate(record[name])
        if np.isfinite(value)
    }
    return Unfinished(known, start, moved)


def _value(free: Free, number: float) -> object:
    """Value of a free key, as TOML has it, for its number in the record."""
    if free.choices:
        return free.choices[int(number)]
    return value_at(free, (number / free.si - free.low) / (free.high - free.low))


def _figures_in(names: Sequence[str], numbers: Sequence[float]) -> dict[str, float] | None:
    if np.all(np.isnan(numbers)):
        return None
    return {name: float(value) for name, value in zip(names, numbers, strict=True) if not np.isnan(value)}
