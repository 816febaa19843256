"""A search from a scenario and a few options: the short form, of the command line and of Python."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tribodyn.errors import InputError, quoted
from tribodyn.input.resolve import resolve_table, toml_value
from tribodyn.input.sources import find_scenario, read_toml
from tribodyn.studies.design.case import unit_of
from tribodyn.studies.protocol.load import Loaded, loaded_from, table_of
from tribodyn.studies.protocol.study import CaseHead

KIND = "design"
FREE = "--free"


def entries(free: Mapping[str, Any] | Sequence[Any]) -> list[Any]:
    """Entries of `design.free`, from a mapping of keys to bounds, or from texts as `free_of` reads them.

    Raises InputError for bounds that are none.
    """
    if isinstance(free, Mapping):
        return [{"key": str(key), **_bounds(str(key), bounds)} for key, bounds in free.items()]
    return [free_of(entry) if isinstance(entry, str) else entry for entry in free]


def _bounds(key: str, bounds: Any) -> Mapping[str, Any]:
    if isinstance(bounds, Mapping):
        return bounds
    if isinstance(bounds, list):
        words = [isinstance(end, str) and end.strip()[:1] not in "+-.0123456789" for end in bounds]
        if len(bounds) == 2 and not all(words):
            return {"from": bounds[0], "to": bounds[1]}
        return {"choices": bounds}
    rule = "neither two bounds nor a list of choices"
    raise InputError(key, quoted(bounds), rule, 'give them like ("0 um", "40 um")')


def free_of(option: str) -> dict[str, Any]:
    """Read ``KEY=FROM:TO`` or ``KEY=VALUE,VALUE,…``; a unit may stand once, at the end.

    Raises InputError for what is neither.
    """
    key, equals, text = option.partition("=")
    keys = [part.strip() for part in key.split("+")]
    if not equals or not text.strip() or not all(keys):
        raise _refusal(option)
    named: dict[str, Any] = {"key": keys if len(keys) > 1 else keys[0]}
    if ":" in text:
        low, _, high = text.partition(":")
        unit, low_unit = unit_of(high), unit_of(low)
        if unit is None or low_unit is None:
            raise _refusal(option)
        if unit and not low_unit:
            low = f"{low.strip()} {unit}"
        return {**named, "from": toml_value(low.strip()), "to": toml_value(high.strip())}
    values = [value.strip() for value in text.split(",")]
    if len(values) < 2 or not all(values):
        raise _refusal(option)
    if unit := unit_of(values[-1]):
        values = [f"{value} {unit}" if re.fullmatch(r"[\d.eE+-]+", value) else value for value in values]
    return {**named, "choices": [toml_value(value) for value in values]}


def _refusal(option: str) -> InputError:
    remedy = f'write it like {FREE} drive.pinion.modification.tip_relief="0 um:40 um"'
    return InputError(FREE, quoted(option), "neither KEY=FROM:TO nor KEY=VALUE,VALUE,…", remedy)


def parts_of(options: Sequence[str]) -> dict[str, str]:
    """Read several ``NAME=SCENARIO``; raises InputError for what is none."""
    parts: dict[str, str] = {}
    for option in options:
        name, equals, scenario = (part.strip() for part in option.partition("="))
        if not equals or not name or not scenario or name in parts:
            rule = "is given twice" if name in parts else "not NAME=SCENARIO"
            remedy = "write it like --part efficiency=efficiency-involute-18-36"
            raise InputError("--part", quoted(option), rule, remedy)
        parts[name] = scenario
    return parts


def loaded_search(
    source: str | Path | Mapping[str, Any] | CaseHead, design: Mapping[str, Any], overrides: Mapping[str, Any]
) -> Loaded:
    """Make the case of a search through a scenario, or of a search: name, file, tables, or a case.

    `design` are keys of its table `[design]`, in place of those of a search; `overrides`, by dotted keys, are
    of the scenario to search through. Raises InputError for what cannot be searched, and where nothing says
    what is free and what is sought.
    """
    if isinstance(source, CaseHead):
        path, data = Path("scenario"), tomllib.loads(source.toml)
    elif isinstance(source, Mapping):
        path, data = Path("scenario"), dict(source)
    else:
        path = find_scenario(str(source))
        data = read_toml(path)
    if data.get("kind") == KIND:
        search = data | {"design": {**data.get("design", {}), **design}}
    else:
        name = str(data.get("name", path.stem))
        search = {
            "title": f"Search through {data.get('title', name)}",
            "name": f"{name}-design",
            "kind": KIND,
            "scenario": data,
            "design": {"free": [], **design},
        }
    # keys of the scenario within, but for those of the search itself
    prefixes = (f"{KIND}.", "scenario.")
    within = {
        key if key.startswith(prefixes) else f"scenario.{key}": value for key, value in overrides.items()
    }
    return loaded_from(resolve_table(search, path, within, table_of), path)
