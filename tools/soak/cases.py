"""Cases: from a seed and a number to a scenario."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import tomli_w

from tools.soak import duties, searches, studies, trains
from tools.soak.draw import Draw
from tools.soak.drives import FAMILIES, drive
from tools.soak.keyed import keyed
from tribodyn.errors import InputError
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.studies.protocol.load import load_scenario

#: A drive that cannot be made is drawn again, so often at most; what was refused is looked into as well.
MOST_DRAWS = 40
#: Cases of shipped scenarios with other values at their keys.
KEYS = "keys"
#: What a case is, and its share of all: so many of `SHARES` groups.
SORTS = {
    "gear-pair": 20,
    "efficiency": 4,
    "load-contact": 6,
    "ehl": 4,
    "wear": 4,
    "assessment": 4,
    "train-assessment": 2,
    "design": 6,
    "sweep, steady": 3,
    "sweep, transient": 3,
    KEYS: 8,
}
SHARES = sum(SORTS.values())
#: Cases of a group, of one sort: one of every tooth family.
GROUP = len(FAMILIES)
#: Cases of `make soak`: every sort in its share.
CASES = GROUP * SHARES


class Refused(NamedTuple):
    """A scenario that was refused, and with what words."""

    scenario: dict[str, Any]
    error: InputError


class SoakCase(NamedTuple):
    """A case: its sort, its scenario, and the drives that were refused on the way to it."""

    sort: str
    scenario: dict[str, Any]
    refused: tuple[Refused, ...]


def case(seed: int, number: int, folder: Path, short: bool = False) -> SoakCase:
    """Make a case; scenarios that are tried are written into the folder.

    In short: dynamics alone, under laws whose kernels other tests compile, for tests that have seconds.
    """
    draw = Draw(seed, number)
    sort = "gear-pair" if short else sort_of(number)
    if sort == KEYS:
        return SoakCase(sort, keyed(seed, number).change.data, ())
    make = _MAKERS.get(sort, lambda draw, table: duties.gear_pair(draw, table, short))
    table, refused = _drive(draw, FAMILIES[number % GROUP], folder)
    return SoakCase(sort, make(draw, table), refused)


def sort_of(number: int) -> str:
    """What the case of that number is: each group is of the sort that is farthest behind its share."""
    done = dict.fromkeys(SORTS, 0)
    sort = ""
    for group in range(1, number // GROUP % SHARES + 2):
        sort = max(SORTS, key=lambda name: SORTS[name] * group - SHARES * done[name])
        done[sort] += 1
    return sort


_MAKERS: dict[str, Callable[[Draw, dict[str, Any]], dict[str, Any]]] = {
    "efficiency": studies.efficiency,
    "load-contact": studies.load_contact,
    "ehl": studies.solved_contact,
    "wear": studies.wear,
    "assessment": studies.assessment,
    "train-assessment": trains.assessed,
    "design": searches.search,
    "sweep, steady": lambda draw, table: studies.steady(duties.gear_pair(draw, table, True)),
    "sweep, transient": lambda draw, table: studies.marched(duties.gear_pair(draw, table, True)),
}


def _drive(draw: Draw, family: str, folder: Path) -> tuple[dict[str, Any], tuple[Refused, ...]]:
    """Return a drive of a family that can be made; the last one drawn where none can."""
    refused: list[Refused] = []
    table = drive(draw, family)
    while (error := geometry_error(table, folder)) and len(refused) < MOST_DRAWS:
        refused.append(Refused(bare(table), error))
        table = drive(draw, family)
    return table, tuple(refused)


def bare(table: dict[str, Any]) -> dict[str, Any]:
    """Return a scenario that needs no more than a drive's geometry: a load contact study."""
    return {
        "title": "A random drive",
        "kind": "load-contact",
        "drive": table,
        "operating": {"gear_torque": "1 N*m"},
    }


def geometry_error(table: dict[str, Any], folder: Path) -> InputError | None:
    """Return what is wrong with a drive's table, if it is anything."""
    try:
        read = load_scenario(written(bare(table), folder / "drive.toml"))
        check(family(read.family), read.drive)
    except InputError as error:
        return error
    return None


def written(scenario: dict[str, Any], path: Path) -> Path:
    """Write a scenario; return its path."""
    path.write_text(tomli_w.dumps(scenario), encoding="utf-8")
    return path
