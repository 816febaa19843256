"""Every film and friction law beside the solved contact, over a pair's way and over load and speed."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.scenario.resolve import resolve_table
from tribodyn.scenario.spectrum import OiledOperatingTable
from tribodyn.studies.ehl.along_path import by_laws, prepare, seen_by, way
from tribodyn.studies.ehl.case import EhlCase
from tribodyn.studies.ehl.run import solve
from tribodyn.studies.load import load, loaded_from, table_of
from tribodyn.studies.study import Progress

Array = Any

#: Deviation from the solved contact up to which a law is called right: of the film, of friction.
RIGHT = {"film": 0.10, "friction": 0.25}
#: Positions of the pair at each point of the map over load and speed.
AT_A_POINT = 5
#: Needed of a scenario.
_TABLES = ("drive", "lubricant", "operating")


class Judged(NamedTuple):
    """A law beside the solved contact; all numbers are shares.

    Attributes
    ----------
    what : "film" or "friction"
    law : its name
    minimum, median, maximum : of the ratio of the law's value to the solved one over the pair's way
    in_range : share of the way inside the range that the law states; NaN: it states none
    right : share of the way where the ratio is within `RIGHT` of 1
    map : (loads, speeds), median ratio; empty without a map
    """

    what: str
    law: str
    minimum: float
    median: float
    maximum: float
    in_range: float
    right: float
    map: tuple[tuple[float, ...], ...] = ()


def case_for(scenario: str | Path, overrides: Mapping[str, Any], positions: int) -> EhlCase:
    """Return the solved contact of a scenario's drive, oil and duty, of whatever kind it is.

    Raises
    ------
    InputError
        For a scenario without a drive of two gears, a lubricant and a duty, or whose load is not positive.
    """
    loaded = load(scenario, overrides)
    data = tomllib.loads(loaded.case.toml)
    if missing := [name for name in _TABLES if not isinstance(data.get(name), dict)]:
        rule = f"a scenario without {' and without '.join(missing)}: there is no contact to solve"
        raise InputError(
            "kind", loaded.case.kind, rule, "name a scenario with drive, lubricant and operating"
        )
    known = OiledOperatingTable.model_fields
    tables = {
        "title": loaded.case.title,
        "name": loaded.case.name,
        "kind": "ehl",
        "drive": data["drive"],
        "lubricant": data["lubricant"],
        "operating": {name: value for name, value in data["operating"].items() if name in known},
        "output": {"positions": positions},
    }
    if "duty" in data:
        tables["duty"] = data["duty"]
    return loaded_from(resolve_table(tables, loaded.path, {}, table_of), loaded.path).case


def judged(
    case: EhlCase,
    loads: Sequence[float] = (),
    speeds: Sequence[float] = (),
    progress: Progress | None = None,
) -> list[Judged]:
    """Compare every law with the solved contact.

    Parameters
    ----------
    case : EhlCase
    loads, speeds : sequence of float
        Factors on torque and speed that span a map; none: no map.
    progress : callable, optional
        Called with the share done, 0 … 1.
    """
    tell = progress or (lambda _share: None)
    points = [(torque, speed) for torque in loads for speed in speeds]
    done = case.positions / (case.positions + AT_A_POINT * len(points))
    found = _compared(case, lambda share: tell(done * share))
    medians: dict[tuple[str, str], list[float]] = {(one.what, one.law): [] for one in found}
    for number, (torque, speed) in enumerate(points):
        duty = replace(
            case.operating,
            gear_torque=case.operating.gear_torque * torque,
            pinion_speed=case.operating.pinion_speed * speed,
        )
        for one in _compared(replace(case, operating=duty, positions=AT_A_POINT), lambda _share: None):
            medians[one.what, one.law].append(one.median)
        tell(done + (1.0 - done) * (number + 1) / len(points))
    width = max(len(speeds), 1)
    return [
        one._replace(
            map=tuple(
                tuple(medians[one.what, one.law][row : row + width]) for row in range(0, len(points), width)
            )
        )
        for one in found
    ]


def _compared(case: EhlCase, progress: Progress) -> list[Judged]:
    study = prepare(case)
    over = way(study)
    arrays = solve(study, over, progress)
    solved = {"film": arrays["central_film_thickness"], "friction": arrays["friction_coefficient"]}
    found = []
    for what, laws in by_laws(study, over).items():
        for law, values in laws.items():
            ratio = values / solved[what]
            ratio = ratio[np.isfinite(ratio)]
            seen = (
                seen_by(study, over, law, "none").surface.closure_in_range
                if what == "film"
                else seen_by(study, over, None, law).surface.friction_in_range
            )
            inside = float(np.mean(np.broadcast_to(np.asarray(seen, dtype=float), over.roll.shape)))
            if not len(ratio):
                nothing = float("nan")
                found.append(Judged(what, law, nothing, nothing, nothing, inside, 0.0))
                continue
            right = float(np.mean(np.abs(ratio - 1.0) <= RIGHT[what]))
            low, middle, high = (float(one(ratio)) for one in (np.min, np.median, np.max))
            found.append(Judged(what, law, low, middle, high, inside, right))
    return found


def sentence(found: Sequence[Judged]) -> str:
    """Say which laws are right over the whole way of this duty."""
    said = []
    for what, share in RIGHT.items():
        names = [one.law for one in found if one.what == what and one.right == 1.0]
        which = ", ".join(names) if names else "none"
        said.append(f"within {100 * share:.0f} % of the solved {what} at every position: {which}")
    return f"{'; '.join(said)}.".capitalize()
