"""Datasets of a search: over its evaluations, in their order."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.numerics.variable import Variable, flag
from tribodyn.record.reader import Record
from tribodyn.record.schema import Layout
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.archive import Evaluation
from tribodyn.studies.design.candidates.candidates import samples_of, shapes_gears
from tribodyn.studies.design.candidates.pool import Figures
from tribodyn.studies.design.candidates.sources import units_by_figure
from tribodyn.studies.design.case import DesignCase, Objective

EVALUATION = Variable(("evaluation",), "1", "number of the evaluation")
#: Bytes kept of a message.
MESSAGE = 200
OBJECTIVES = ("objective", "objective_2")
#: Datasets of what was evaluated about the best.
LOWER, UPPER = "objective_lower", "objective_upper"
#: Dataset of the figures of the base scenario as it stands.
START_FIGURES = "start_figures"
#: Resolutions over that of the scenario, none a multiple of the one before: the same positions would give the
#: same extremes. The first is searched on, the others are those of the last stage.
FACTORS = (1, 2, 5, 11, 23, 47)
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
    of_objectives = (name for one in case.objectives for name, _ in one.terms)
    of_start = (name for of in start if not isinstance(of, str) for name in of)
    known = known_units(case)
    of_constraints = (one.figure for one in case.constraints)
    return tuple(dict.fromkeys((*of_objectives, *of_constraints, *of_start, *known)))


def known_units(case: DesignCase) -> dict[str, str]:
    """SI units of all figures by name."""
    return units_by_figure({name: study_of(data) for name, data in case.scenarios.items()})


def objective_units(case: DesignCase, one: Objective) -> str:
    """SI unit of an objective; "1" of a sum of relative figures."""
    units = known_units(case)
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
        "figures of every duty and sample, SI",
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


def rows_of(
    case: DesignCase, names: Sequence[str], some: Sequence[Evaluation], start: int, factor: int
) -> dict[str, Any]:
    """Rows of the record for evaluations on one resolution, the first of which has the number `start`."""
    numbers = np.array([one.numbers for one in some], dtype=float).reshape(len(some), len(case.free))
    rows: dict[str, Any] = {"evaluation": np.arange(start, start + len(some), dtype=float)}
    for place, one in enumerate(case.free):
        rows[f"free_{one.name}"] = numbers[:, place]
    for place, name in enumerate(OBJECTIVES[: len(case.objectives)]):
        rows[name] = np.array([one.judged.objectives[place] for one in some])
    rows["objective_at_duty"] = np.array([one.judged.by_duty for one in some])
    if case.constraints:
        rows["margin"] = np.array([one.judged.margins for one in some])
    rows["case_figures"] = np.array([figure_rows(names, one.found) for one in some])
    if shapes_gears(case):
        rows["shape"] = np.array([np.nan if one.judged.shape is None else one.judged.shape for one in some])
    rows[REFINEMENT] = np.full(len(some), float(factor))
    rows["feasible"] = np.array([float(one.judged.feasible) for one in some])
    rows["message"] = np.array([_cut(one.judged.message) for one in some], dtype=f"S{MESSAGE}")
    return rows


def figure_rows(names: Sequence[str], found: Figures) -> np.ndarray:
    """Figures of cases as numbers, (case, figure); NaN where there is none."""
    return np.array(
        [[np.nan if isinstance(of, str) else of.get(name, np.nan) for name in names] for of in found]
    )


def _cut(text: str) -> bytes:
    raw = " ".join(text.split()).encode()
    return raw if len(raw) <= MESSAGE else raw[: MESSAGE - 3].decode(errors="ignore").encode() + b"..."
