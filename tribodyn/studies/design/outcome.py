"""What a search leaves: datasets over its evaluations, summary, the best scenario as TOML, its drive as DXF.

The datasets are read by a search that goes on.
"""

import tomllib
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from tribodyn.errors import printable
from tribodyn.numerics.files.output_files import MARKS, check_output, write_output
from tribodyn.numerics.parameter import Variable, flag
from tribodyn.record.reader import Record
from tribodyn.record.schema import Layout
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.archive import FACTORS, Archive, Candidate, Unfinished
from tribodyn.studies.design.candidates.candidates import Overrides, samples_of, shapes_gears, value_at
from tribodyn.studies.design.candidates.evaluation import Results, loaded_source
from tribodyn.studies.design.candidates.sources import BASE, standing, units_by_name
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


#: First line of a file with the best scenario, before the title of the search.
HEAD = MARKS[".toml"].decode()


def best_path(record: Path, ending: str, part: str = "") -> Path:
    """Name of a file with the best candidate of a search, beside its record."""
    return record.with_name(f"{record.stem}-best{'-' * bool(part)}{part}.{ending}")


def check_targets(case: DesignCase, record: Path, force: bool = False) -> None:
    """Raise InputError where a file is in the way that no search wrote, see `check_output`."""
    for path in (*(best_path(record, "toml", name) for name in case.scenarios), best_path(record, "dxf")):
        check_output(path, force)


def write_best(case: DesignCase, values: Mapping[str, Any], record: Path, force: bool = False) -> list[Path]:
    """Write the best scenario and its parts, and the drawing of the gears where it has some; the files.

    Raises as `write_output`.
    """
    files: list[Path] = []
    every = {name: loaded_source(case.scenarios, name, values) for name in case.scenarios}
    for name, source in every.items():
        data = tomllib.loads(source.case.toml)
        more = f"-{name}" if name else ""
        data |= {"title": f"{data['title']}: best of {case.name}", "name": f"{case.name}-best{more}"}
        text = f"{HEAD}{printable(case.title)}\n{tomli_w.dumps(data)}"
        files.append(write_output(best_path(record, "toml", name), text, force=force))
    if every[BASE].study.has_gears:
        from tribodyn.drawing.cad import write_pair
        from tribodyn.geometry.families import family
        from tribodyn.geometry.limits.checks import check

        gears = every[BASE].case.pair
        assembly = check(family(gears.family), gears.drive)
        files.append(write_pair(best_path(record, "dxf"), assembly, force=force))
    return files


def headline(case: DesignCase, archive: Archive, searched: Archive) -> dict[str, Any]:
    """Quantities of the summary that say what was found: at the start and at the best.

    They are those of an archive; what was evaluated is that of the one that was searched.
    """
    scoring, best = archive.scoring, chosen_best(case, archive)
    score = scoring.score(scoring.start)
    scores = [candidate.score for candidate in searched.evaluations]
    summary: dict[str, Any] = {
        "objective_name": " and ".join(objective.name.removeprefix("-") for objective in case.objectives),
        "objective_start": None if score.message else signed(case, score.objectives),
        "start_feasible": score.feasible,
        "evaluations": len(scores),
        "evaluations_without_quantities": sum(bool(other.message) for other in scores),
        "evaluations_feasible": sum(other.feasible for other in scores),
    }
    if score.message:
        summary["start_message"] = score.message
    if messages := Counter(other.message for other in scores if other.message):
        summary["without_quantities_message"] = messages.most_common(1)[0][0]
    if best is None:
        return summary
    summary["objective"] = signed(case, best.score.objectives)
    summary["best"] = {
        key: value if isinstance(value, (int, float)) else str(value) for key, value in best.values.items()
    }
    start = {key: standing(case.scenarios, key) for key in best.values}
    summary["start"] = {key: value for key, value in start.items() if isinstance(value, (int, float, str))}
    if len(case.duties) > 1:
        summary["duties"] = {"start": list(score.by_duty), "best": list(best.score.by_duty)}
    if case.constraints:
        summary["constraints_start"] = scoring.constrained(scoring.start)
        summary["constraints_best"] = scoring.constrained(best.found)
    summary["quantities_start"] = dict(scoring.at_start)
    summary["quantities_best"] = dict(best.score.quantities)
    if len(case.objectives) > 1:
        points = archive.front()
        summary["front"] = {
            "points": len(points),
            "objective": [point.score.objectives[0] for point in points],
            "objective_2": [point.score.objectives[1] for point in points],
        }
    return summary


def signed(case: DesignCase, objectives: tuple[float, ...]) -> Any:
    """Objectives with the signs of their quantities; of one objective that number alone."""
    with_signs = [
        -objective if aim.name.startswith("-") else objective
        for objective, aim in zip(objectives, case.objectives, strict=True)
    ]
    return with_signs[0] if len(with_signs) == 1 else with_signs


def chosen_best(case: DesignCase, archive: Archive) -> Candidate | None:
    """The best candidate; of a front the one that is nearest to the best of both objectives."""
    if len(case.objectives) == 1:
        return archive.best()
    points = archive.front()
    if not points:
        return None
    objectives = np.array([point.score.objectives for point in points])
    spans = np.ptp(objectives, axis=0)
    shares = (objectives - objectives.min(axis=0)) / np.where(spans > 0.0, spans, 1.0)
    return points[int(np.argmin((shares**2).sum(axis=1)))]
