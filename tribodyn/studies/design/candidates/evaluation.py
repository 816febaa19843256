"""Evaluates cases of a base scenario: in this process, or in a child process."""

import copy
import json
import sys
from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

from tribodyn.errors import InputError
from tribodyn.scenario.resolve import resolve_table
from tribodyn.scenario.tables.duty import LOADS, SPEEDS
from tribodyn.studies import study_of
from tribodyn.studies.design.candidates.sources import own
from tribodyn.studies.protocol.evaluated import evaluated
from tribodyn.studies.protocol.load import Loaded, loaded_from, table_of

#: Keys of `operating` of which one is given.
ALTERNATIVES = (SPEEDS, LOADS)
#: Stands for the file of a base scenario: what choices name is looked for from here.
FILE = Path("scenario")


def loaded_case(base: Mapping[str, Any], overrides: Mapping[str, Any]) -> Loaded:
    """Load the base scenario with some keys set; raises as `protocol.load.load`."""
    data = copy.deepcopy(dict(base))
    for group in ALTERNATIVES:
        if any(f"operating.{name}" in overrides for name in group):
            for name in group:  # what is given takes the place of what stands there
                data.get("operating", {}).pop(name, None)
    return loaded_from(resolve_table(data, FILE, overrides, table_of), FILE)


def loaded_source(
    scenarios: Mapping[str, Mapping[str, Any]], name: str, overrides: Mapping[str, Any]
) -> Loaded:
    """Load one of the scenarios of a search with those of the overrides that belong to it."""
    data = scenarios[name]
    return loaded_case(data, own(name, study_of(data).table(data), overrides, scenarios))


def evaluate(
    scenarios: Mapping[str, Mapping[str, Any]],
    several: Sequence[Mapping[str, Any]],
    workers: int | None = None,
) -> list[dict[str, Any] | str]:
    """Figures of cases, numbers alone; a text instead where one fails: why.

    Parameters
    ----------
    scenarios : data of the scenario that is searched through, and of its parts, by their names as sources
    several : overrides of each case
    workers : threads of a study that evaluates cases together
    """
    found: list[dict[str, Any] | str] = [{} for _ in several]
    for name, data in scenarios.items():
        schema = study_of(data).table(data)
        requests = [own(name, schema, overrides, scenarios) for overrides in several]
        once = {json.dumps(request, sort_keys=True): request for request in requests}
        known = dict(zip(once, _figures(data, list(once.values()), workers), strict=True))
        for place, request in enumerate(requests):
            found[place] = _with(found[place], name, known[json.dumps(request, sort_keys=True)])
    return found


def _with(known: dict[str, Any] | str, name: str, more: dict[str, Any] | str) -> dict[str, Any] | str:
    """Figures of a case with those of one more scenario."""
    if isinstance(known, str):
        return known
    if isinstance(more, str):
        return f"{name}: {more}" if name else more
    return known | {f"{name}.{figure}" if name else figure: value for figure, value in more.items()}


def _figures(
    data: Mapping[str, Any], several: Sequence[Mapping[str, Any]], workers: int | None
) -> list[dict[str, Any] | str]:
    """Figures of cases of one scenario."""
    cases: list[Any] = []
    for overrides in several:
        try:
            cases.append(loaded_case(data, overrides).case)
        except InputError as error:
            cases.append(str(error))
    try:
        found = evaluated(study_of(data), cases, workers)
    except InputError as error:  # of all cases together
        found = [str(error)] * len(cases)
    return [value if isinstance(value, str) else numbers(value) for value in found]


def distance_from_limits(base: Mapping[str, Any], overrides: Mapping[str, Any]) -> float:
    """The least distance of a case's gears from the limits of their existence, in modules.

    Negative where they cannot be made or cannot run together; −1 where there is no case.
    """
    from tribodyn.geometry.assembly import assemble
    from tribodyn.geometry.families import family
    from tribodyn.geometry.limits.limits import LIMITS, plain_distances

    try:
        case = loaded_case(base, overrides).case
    except InputError:
        return -1.0
    found, module = plain_distances(assemble(family(case.family), case.drive)), case.drive.module
    return min(value / (module if LIMITS[name].unit == "m" else 1.0) for name, value in found.items())


def numbers(figures: Mapping[str, Any]) -> dict[str, float]:
    """The figures that are single finite numbers."""
    return {
        name: float(value)
        for name, value in figures.items()
        if isinstance(value, (int, float)) and not isinstance(value, bool) and isfinite(value)
    }


def serve() -> None:
    """Evaluate what comes in as lines of JSON: first the scenarios, then lists of overrides."""
    answers, sys.stdout = sys.stdout, sys.stderr  # what a library prints is no answer
    scenarios = json.loads(sys.stdin.readline())
    for line in sys.stdin:
        answers.write(json.dumps(evaluate(scenarios, json.loads(line), workers=1)) + "\n")
        answers.flush()
