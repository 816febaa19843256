"""What a search leaves beside its record: the best scenario as TOML, its drive as DXF; and its summary."""

import tomllib
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from tribodyn.errors import printable
from tribodyn.numerics.files.output_files import MARKS, check_output, write_output
from tribodyn.studies.design.candidates.archive import Archive, Candidate
from tribodyn.studies.design.candidates.evaluation import loaded_source
from tribodyn.studies.design.candidates.sources import BASE, standing
from tribodyn.studies.design.case import DesignCase

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

        gears = every[BASE].case
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
