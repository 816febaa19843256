"""Scenarios with another value at some key: rules that ask for more keys, or for fewer, are followed."""

import copy
import re
import tomllib
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

from pydantic import BaseModel

from tools.by_schema.keys import Pattern, SchemaKey, every_key
from tools.by_schema.values import (
    Surroundings,
    drawn_table,
    drawn_value,
    law_and_keys,
    names_in,
    own_value,
)
from tribodyn.errors import InputError
from tribodyn.geometry.families import FAMILIES
from tribodyn.input.names import named_in
from tribodyn.input.quantity import FamilyShape
from tribodyn.input.resolve import resolve_table, toml_value
from tribodyn.input.schema import EACH, matches, parts_of
from tribodyn.input.sources import find_scenario, shipped
from tribodyn.input.tables.laws import LawTable
from tribodyn.studies.protocol.load import load_data, table_of

#: So often a scenario that is refused is changed again.
MOST_REPAIRS = 12
_ASSIGNED = re.compile(r"(?:^|[ ,;(])([a-z][\w.]*) = (\"[^\"]*\"|\[[^\]]*\]|[-+\d.e]+|true|false)")
_IN_TABLE = re.compile(r"give \[([\w.]+)\] an? (\w+)")


class Change(NamedTuple):
    """A scenario that is taken, with a value of its own at a key."""

    key: str  # dotted, with names and places
    value: Any
    data: dict[str, Any]  # the whole scenario
    case: Any


def opened(scenario: str | Path, overrides: dict[str, Any] | None = None) -> dict[str, Any]:
    """The data of a scenario with models, files and defaults written out."""
    path = find_scenario(str(scenario))
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    found = resolve_table(data, path, overrides or {}, table_of)
    for error in found.errors:
        raise error
    return copy.deepcopy(found.data)


def keys_of(data: dict[str, Any]) -> list[SchemaKey]:
    """All keys that a scenario of this kind, with these scenarios within it, may have."""
    return _keys(table_of(data))


@cache
def _keys(table: type[BaseModel]) -> list[SchemaKey]:
    return list(every_key(table))


def changed(random: Random, data: dict[str, Any], key: SchemaKey) -> tuple[str, dict[str, Any]]:
    """Put a drawn value at a key of a copy of the data: the key with names and places, and the copy."""
    if not key.owner and any(isinstance(mark, FamilyShape) for mark in parts_of(key.field)):
        return changed(
            random,
            data,
            random.choice([own for own in keys_of(data) if own.owner and own.pattern[:-1] == key.pattern]),
        )
    data = copy.deepcopy(data)
    around = Surroundings(tuple(sorted(names_in(data))))
    tables = {inside.depth: inside.table for inside in key.inside}
    place: Any = data
    concrete: list[str] = []
    for depth, part in enumerate(key.pattern[:-1], start=1):
        name = _chosen(random, place, tables.get(depth), around) if part == EACH else named_in(place, part)
        place = _entered(random, place, name, (key.pattern, depth), tables, around)
        concrete.append(str(name))
    last = named_in(place, key.pattern[-1])
    if key.owner and issubclass(key.holder, LawTable):
        kept = {name: value for name, value in place.items() if name in key.holder.model_fields}
        place.clear()
        own = next(own for own in key.holder.laws[key.owner].keys if own.name == last)
        place.update(kept | law_and_keys(random, key.holder, key.owner) | {last: own_value(random, own)})
    elif key.owner:
        _of_family(random, key, data, concrete)
    else:
        place[last] = drawn_value(random, key, around._replace(present=place.get(last)))
    return ".".join((*concrete, last)), data


def _chosen(random: Random, place: Any, table: type[BaseModel] | None, around: Surroundings) -> Any:
    """A name or place that holds tables of this sort, or a new one."""
    fields = set(table.model_fields) if table else set()
    if isinstance(place, dict):
        fitting = [name for name, held in place.items() if isinstance(held, dict)]
        return random.choice(fitting or list(around.names) or ["a"])
    fitting = [i for i, held in enumerate(place) if isinstance(held, dict) and set(held) <= fields]
    return random.choice([*fitting, *fitting, len(place)])


def _entered(
    random: Random,
    place: Any,
    name: Any,
    at: tuple[Pattern, int],
    tables: dict[int, type[BaseModel]],
    around: Surroundings,
) -> Any:
    """What stands at a name or place; a table, or a list of them, is made where none is."""
    pattern, depth = at
    inner = place[name] if isinstance(place, list) and name < len(place) else None
    inner = place.get(name) if isinstance(place, dict) else inner
    in_list = depth < len(pattern) and pattern[depth] == EACH and depth not in tables
    if in_list and (isinstance(inner, list) or (isinstance(inner, dict) and _by_name(tables, depth, name))):
        return inner
    if not in_list and isinstance(inner, dict):
        return inner
    if in_list:
        inner = {} if _by_name(tables, depth, name) else []
    else:
        inner = drawn_table(random, tables[depth], around, 0.1) if depth in tables else {}
    if isinstance(place, list):
        place.append(inner) if name >= len(place) else place.__setitem__(name, inner)
    else:
        place[name] = inner
    return inner


def _by_name(tables: dict[int, type[BaseModel]], depth: int, name: Any) -> bool:
    """Whether a field holds its tables by name."""
    holder = tables[max(own for own in tables if own < depth)]
    field = holder.model_fields.get(name)
    return field is not None and str(field.annotation).startswith("dict")


def _of_family(random: Random, key: SchemaKey, data: dict[str, Any], above: list[str]) -> None:
    """Give teeth of another family, those of a shipped drive, with another value of a key of its own."""
    place: Any = data
    for part in above[:-1]:
        place = place[int(part)] if isinstance(place, list) else place[part]
    model = _drive_of(key.owner)
    kept = {name: value for name, value in model.items() if name in key.holder.model_fields}
    own = next(own for own in FAMILIES[key.owner].parameters if own.name == key.pattern[-1])
    place.update(copy.deepcopy(kept))
    example = place["shape"].get(own.name)
    place["shape"][own.name] = own_value(random, own, example)


@cache
def _drive_of(family: str) -> dict[str, Any]:
    """A shipped drive of a family."""
    for path in sorted((shipped("models") / "drives").glob("*.toml")):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        if data.get("family") == family and "shape" in data and isinstance(data["shape"], dict):
            return data
    return {"family": family, "shape": {}}


def taken(random: Random, base: dict[str, Any], key: SchemaKey, repairs: int = MOST_REPAIRS) -> Change | None:
    """Draw a value of a key that the scenario takes; None where none was found in so many repairs."""
    dotted, data = changed(random, base, key)
    for _ in range(repairs):
        try:
            case = load_data(copy.deepcopy(data), "drawn").case
        except InputError as error:
            repaired = _repaired(random, data, dotted, error)
            if repaired is None or at(repaired, dotted) is None:
                dotted, data = changed(random, base, key)
            else:
                data = repaired
        else:
            return Change(dotted, at(data, dotted), data, case)
    return None


def at(data: Any, dotted: str) -> Any:
    """What stands at a dotted key; None where nothing does."""
    for part in dotted.split("."):
        if isinstance(data, list):
            data = data[int(part)] if part.isdecimal() and int(part) < len(data) else None
        else:
            data = data.get(part) if isinstance(data, dict) else None
    return data


def _repaired(random: Random, data: dict[str, Any], wanted: str, error: InputError) -> dict[str, Any] | None:
    """The scenario with what the refusal asks for; None where it says nothing to do."""
    data = copy.deepcopy(data)
    acted = [_followed(random, data, wanted, each) for each in getattr(error, "errors", (error,))]
    return data if any(acted) else None


def _followed(random: Random, data: dict[str, Any], wanted: str, error: InputError) -> bool:
    """Do what a refusal says; False where it says nothing that is known here."""
    key, said = error.key, f"{error.rule}; {error.remedy}"
    above, _, last = key.rpartition(".")
    holder = at(data, above) if above else data
    if not isinstance(holder, dict):
        holder = {}
    if table := _IN_TABLE.search(error.remedy):
        return _added(random, data, f"{table[1]}.{table[2]}")
    if "leave one of them out" in said or "says the same" in said:
        others = [name for name in re.findall(r"[a-z]\w+", error.rule) if name in holder and name != last]
        out = others if key == wanted else [last]
        return any([holder.pop(name, None) is not None for name in out])
    if key == wanted and (value := _fitting(random, holder.get(last), error)) is not None:
        holder[last] = value
        return True
    if assigned := [(name, toml_value(text)) for name, text in _ASSIGNED.findall(error.remedy)]:
        (name, value), *_ = assigned
        there = re.search(r"to \[([\w.]+)\]", error.remedy)
        if "." in name:
            return put(data, name, value)
        target = at(data, there[1]) if there else holder
        if not there and name not in _siblings(data, key) and name in _siblings(data, name):
            target = data
        if isinstance(target, dict) and (target is not holder or name != wanted.rpartition(".")[2]):
            target[name] = value
            return True
    if "missing" in error.rule or last not in holder or holder[last] is None:
        return _added(random, data, key)
    if key != wanted and not wanted.startswith(f"{key}."):
        return holder.pop(last, None) is not None
    return False


def _fitting(random: Random, present: Any, error: InputError) -> Any:
    """A value that a refusal speaks of: a list of as many, or a quantity that it names."""
    if (
        isinstance(present, list)
        and present
        and (count := re.search(r"\b(\d+) (?:teeth|planets)", error.rule))
    ):
        return [random.choice(present) for _ in range(min(int(count[1]), 1000))]
    if isinstance(present, str) and " " in present:
        unit = re.escape(present.split()[-1])
        named = re.findall(rf"(-?[\d.]+(?:e-?\d+)? ?{unit})(?!\w)", f"{error.rule} {error.remedy}")
        return random.choice(named) if named else None
    return None


def _siblings(data: dict[str, Any], dotted: str) -> set[str]:
    """Names of the keys in the table of a key."""
    return {name for key in _known(data, dotted) for name in key.holder.model_fields}


def put(data: dict[str, Any], dotted: str, value: Any) -> bool:
    """Put a value at a dotted key, with tables on the way; False where something else is on the way."""
    *above, last = dotted.split(".")
    place: Any = data
    for part in above:
        if isinstance(place, list):
            place = place[int(part)] if part.isdecimal() and int(part) < len(place) else None
        elif isinstance(place, dict):
            place = place.setdefault(part, {})
    if isinstance(place, dict):
        place[last] = value
    return isinstance(place, dict)


def _added(random: Random, data: dict[str, Any], dotted: str) -> bool:
    """Draw a value for a key that is missing."""
    found = list(_known(data, dotted))
    if not found:
        return False
    value = drawn_value(random, random.choice(found), Surroundings(tuple(sorted(names_in(data)))))
    return put(data, dotted, value)


def _known(data: dict[str, Any], dotted: str) -> Iterator[SchemaKey]:
    parts: Sequence[str] = dotted.split(".")
    return (key for key in keys_of(data) if matches(key.pattern, parts))
