"""A search from a scenario and a few options: the short form, of the command line and of Python."""

import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tribodyn.errors import InputError, quoted
from tribodyn.scenario.resolve import resolve_table, toml_value
from tribodyn.scenario.sources import find_scenario, read_toml
from tribodyn.studies.protocol.load import Loaded, loaded_from, table_of
from tribodyn.studies.protocol.study import CaseHead

KIND = "design"
FREE = "--free"
_UNIT = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*(\S.*?)?\s*$", re.ASCII)


def free_of(option: str) -> dict[str, Any]:
    """Read ``KEY=FROM:TO`` or ``KEY=VALUE,VALUE,…``; a unit may stand once, at the end.

    Raises
    ------
    InputError
        For what is neither.
    """
    key, equals, text = option.partition("=")
    keys = [one.strip() for one in key.split("+")]
    if not equals or not text.strip() or not all(keys):
        raise _refusal(option)
    named: dict[str, Any] = {"key": keys if len(keys) > 1 else keys[0]}
    if ":" in text:
        low, _, high = text.partition(":")
        match, own = _UNIT.match(high), _UNIT.match(low)
        if match is None or own is None:
            raise _refusal(option)
        unit = match[1] or ""
        if unit and not own[1]:
            low = f"{low.strip()} {unit}"
        return {**named, "from": toml_value(low.strip()), "to": toml_value(high.strip())}
    values = [value.strip() for value in text.split(",")]
    if len(values) < 2 or not all(values):
        raise _refusal(option)
    match = _UNIT.match(values[-1])
    if match and match[1]:
        values = [f"{one} {match[1]}" if re.fullmatch(r"[\d.eE+-]+", one) else one for one in values]
    return {**named, "choices": [toml_value(one) for one in values]}


def _refusal(option: str) -> InputError:
    remedy = f'write it like {FREE} drive.pinion.modification.tip_relief="0 um:40 um"'
    return InputError(FREE, quoted(option), "neither KEY=FROM:TO nor KEY=VALUE,VALUE,…", remedy)


def parts_of(options: Sequence[str]) -> dict[str, str]:
    """Read several ``NAME=SCENARIO``.

    Raises
    ------
    InputError
        For what is none.
    """
    parts: dict[str, str] = {}
    for option in options:
        name, equals, scenario = (one.strip() for one in option.partition("="))
        if not equals or not name or not scenario or name in parts:
            rule = "is given twice" if name in parts else "not NAME=SCENARIO"
            remedy = "write it like --part efficiency=efficiency-involute-18-36"
            raise InputError("--part", quoted(option), rule, remedy)
        parts[name] = scenario
    return parts


def loaded_search(
    source: str | Path | Mapping[str, Any] | CaseHead,
    design: Mapping[str, Any],
    overrides: Mapping[str, Any],
) -> Loaded:
    """Make the case of a search.

    Parameters
    ----------
    source : str, Path, mapping or case
        The scenario to search through, or a search: name, file, tables, or a case.
    design : keys of its table `[design]`; they take the place of those of a search
    overrides : dotted key to value, of the scenario to search through

    Raises
    ------
    InputError
        For what cannot be searched, and where nothing says what is free and what is sought.
    """
    if isinstance(source, CaseHead):
        path, data = Path("scenario"), tomllib.loads(source.toml)
    elif isinstance(source, Mapping):
        path, data = Path("scenario"), dict(source)
    else:
        path = find_scenario(str(source))
        data = read_toml(path)
    data = dict(data)
    design = {key: value for key, value in design.items() if value is not None}
    if data.get("kind") == KIND:
        data["design"] = {**data.get("design", {}), **design}
        return loaded_from(resolve_table(data, path, _prefixed(overrides), table_of), path)
    name = str(data.get("name", path.stem))
    search = {
        "title": f"Search through {data.get('title', name)}",
        "name": f"{name}-design",
        "kind": KIND,
        "scenario": data,
        "design": {"free": [], **design},
    }
    return loaded_from(resolve_table(search, path, _prefixed(overrides), table_of), path)


def _prefixed(overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of the scenario within; those of the search itself stay."""
    own = (f"{KIND}.", "scenario.")
    return {key if key.startswith(own) else f"scenario.{key}": value for key, value in overrides.items()}


def as_options(
    free: Sequence[str],
    minimise: Sequence[str],
    maximise: str | None,
    subject_to: Sequence[str],
    more: Mapping[str, Any],
) -> dict[str, Any]:
    """Keys of `[design]` from the options of the command line; those that are not given are left out."""
    design: dict[str, Any] = {name: value for name, value in more.items() if value is not None}
    if free:
        design["free"] = [free_of(option) for option in free]
    if minimise:
        design["minimise"] = minimise[0] if len(minimise) == 1 else list(minimise)
    if maximise is not None:
        design["maximise"] = maximise
    if subject_to:
        design["subject_to"] = list(subject_to)
    return design
