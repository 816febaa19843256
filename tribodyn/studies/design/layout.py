"""Datasets of a search: over its evaluations, in their order."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.numerics.variable import Variable, flag
from tribodyn.record.reader import Record
from tribodyn.record.schema import Layout
from tribodyn.studies import study_of
from tribodyn.studies.design.archive import Evaluation, identity
from tribodyn.studies.design.candidates import samples_of, shapes_gears, value_at
from tribodyn.studies.design.case import DesignCase, Objective
from tribodyn.studies.design.pool import Figures
from tribodyn.studies.evaluated import figure_units

EVALUATION = Variable(("evaluation",), "1", "number of the evaluation")
#: Bytes kept of a message.
MESSAGE = 200
OBJECTIVES = ("objective", "objective_2")
#: Datasets of what was evaluated about the best.
LOWER, UPPER = "objective_lower", "objective_upper"
#: Share of its range by which a free key is moved about the best.
MOVED = 0.02


def wanted(case: DesignCase) -> tuple[str, ...]:
    """Names of the figures that objectives and constraints are made of."""
    of_objectives = (name for one in case.objectives for name, _ in one.terms)
    return tuple(dict.fromkeys((*of_objectives, *(one.figure for one in case.constraints))))


def objective_units(case: DesignCase, one: Objective) -> str:
    """SI unit of an objective; "1" of a sum of relative figures."""
    units = figure_units(study_of({"kind": case.base_kind}))
    return "1" if one.relative else units.get(one.terms[0][0], "1")


def layout_of(case: DesignCase) -> Layout:
    """The layout of a search's record."""
    along = ("evaluation",)
    samples: dict[str, Variable] = {}
    for one in case.free:
        about = f"free key {', '.join(one.keys)}"
        if one.choices:
            about += f": number of the choice of {', '.join(map(str, one.choices))}"
        samples[f"free_{one.name}"] = Variable(along, one.units, about)
    for name, one in zip(OBJECTIVES, case.objectives, strict=False):
        about = f"objective: {one.name.removeprefix('-')}"
        samples[name] = Variable(along, objective_units(case, one), about)
    units = objective_units(case, case.objectives[0])
    samples["objective_at_duty"] = Variable((*along, "duty"), units, "first objective at each duty")
    if case.constraints:
        about = "how far the constraint holds, over its limit; negative where it does not"
        samples["margin"] = Variable((*along, "constraint"), "1", about)
    samples["case_figures"] = Variable(
        (*along, "case", "figure"),
        "1",
        "figures of every duty and sample, SI; names in the attribute figures",
    )
    if shapes_gears(case):
        about = "least distance of the gears from the limits of their existence, in modules"
        samples["shape"] = Variable(along, "1", about)
    samples["feasible"] = flag(along, "whether all constraints hold", "not_judged no yes")
    samples["message"] = Variable(along, "1", "why a candidate has no figures", f"S{MESSAGE}", b"")
    scales = {
        "duty": Variable(("duty",), "1", "number of the duty"),
        "constraint": Variable(("constraint",), "1", "number of the constraint"),
        "case": Variable(("case",), "1", "number of the case: samples run within duties"),
        "figure": Variable(("figure",), "1", "number of the figure: those of the objectives, then others"),
        "moved": Variable(
            ("moved",), "1", "number of a free key, and behind them of a tolerance, moved about the best"
        ),
    }
    others = {
        LOWER: Variable(
            ("moved",), units, "first objective with one key moved down about the best, the others kept"
        ),
        UPPER: Variable(("moved",), units, "first objective with one key moved up about the best"),
    }
    return Layout(EVALUATION, samples, scales, others)


def scales_of(case: DesignCase) -> dict[str, np.ndarray]:
    """Values along the other axes."""
    scales = {
        "duty": np.arange(len(case.duties)),
        "case": np.arange(len(case.duties) * len(samples_of(case))),
        "figure": np.arange(len(wanted(case))),
        "moved": np.arange(len(case.free) + len(case.tolerances)),
    }
    return scales | ({"constraint": np.arange(len(case.constraints))} if case.constraints else {})


def rows_of(case: DesignCase, some: Sequence[Evaluation], start: int) -> dict[str, Any]:
    """Rows of the record for evaluations, the first of which has the number `start`."""
    numbers = np.array([one.numbers for one in some], dtype=float).reshape(len(some), len(case.free))
    rows: dict[str, Any] = {"evaluation": np.arange(start, start + len(some), dtype=float)}
    for place, one in enumerate(case.free):
        rows[f"free_{one.name}"] = numbers[:, place]
    for place, name in enumerate(OBJECTIVES[: len(case.objectives)]):
        rows[name] = np.array([one.judged.objectives[place] for one in some])
    rows["objective_at_duty"] = np.array([one.judged.by_duty for one in some])
    if case.constraints:
        rows["margin"] = np.array([one.judged.margins for one in some])
    names = wanted(case)
    rows["case_figures"] = np.array(
        [
            [[np.nan if isinstance(of, str) else of.get(name, np.nan) for name in names] for of in one.found]
            for one in some
        ]
    )
    if shapes_gears(case):
        rows["shape"] = np.array([np.nan if one.judged.shape is None else one.judged.shape for one in some])
    rows["feasible"] = np.array([float(one.judged.feasible) for one in some])
    rows["message"] = np.array([_cut(one.judged.message) for one in some], dtype=f"S{MESSAGE}")
    return rows


def _cut(text: str) -> bytes:
    raw = " ".join(text.split()).encode()
    return raw if len(raw) <= MESSAGE else raw[: MESSAGE - 3].decode(errors="ignore").encode() + b"..."


def known_of(case: DesignCase, record: Record) -> dict[str, Figures]:
    """Figures of the candidates of a record by their identity, to go on from."""
    names = wanted(case)
    columns = [record[f"free_{one.name}"] for one in case.free]
    figures, messages = record["case_figures"], record["message"]
    known: dict[str, Figures] = {}
    for row in range(record.samples):
        values = {}
        for one, column in zip(case.free, columns, strict=True):
            number = float(column[row])
            share = (number + 0.5) / len(one.choices) if one.choices else _share(one, number)
            values |= dict.fromkeys(one.keys, value_at(one, share))
        found: Figures = [_figures(names, numbers) or str(messages[row]) for numbers in figures[row]]
        if any(isinstance(of, str) and not of for of in found):
            continue
        known[identity(values)] = found
    return known


def _share(one: Any, number: float) -> float:
    return (number / one.si - one.low) / (one.high - one.low)


def _figures(names: Sequence[str], numbers: Sequence[float]) -> dict[str, float] | None:
    if np.all(np.isnan(numbers)):
        return None
    return {name: float(value) for name, value in zip(names, numbers, strict=True) if not np.isnan(value)}
