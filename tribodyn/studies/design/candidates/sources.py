"""What a search evaluates: the scenario that is searched through, and further ones, its parts, on its drive.

Sources go by name; that of the scenario itself is "". Results and keys of a part begin with its name:
``efficiency.loss``, ``efficiency.operating.pinion_speed``.
"""

import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from pydantic import ValidationError, create_model

from tribodyn.errors import InputError, near_name, quoted, unknown_name
from tribodyn.input.messages import explain
from tribodyn.input.quantity import Table
from tribodyn.input.schema import fields_of, holds_by_name, table_at
from tribodyn.input.units import base_units
from tribodyn.input.vary import given_at
from tribodyn.studies import study_of
from tribodyn.studies.protocol.evaluated import evaluated_quantities
from tribodyn.studies.protocol.study import Study

#: The scenario that is searched through.
BASE = ""
NAME = re.compile(r"[A-Za-z][A-Za-z0-9-]*", re.ASCII)


class Source(NamedTuple):
    """The study of a scenario, and the schema of its file."""

    study: Study
    schema: type[Table]


Sources = Mapping[str, Source]


def sources_of(datas: Mapping[str, Mapping[str, Any]]) -> dict[str, Source]:
    """Studies and schemas of scenarios by name."""
    return {name: Source(study_of(data), study_of(data).table(data)) for name, data in datas.items()}


def units_by_name(studies: Mapping[str, Study]) -> dict[str, str]:
    """SI units of all quantities by their full names."""
    return {
        _joined(name, key): quantity.si
        for name, study in studies.items()
        for key, quantity in evaluated_quantities(study).items()
    }


def quantity_name(place: str, name: Any, studies: Mapping[str, Study]) -> str:
    """Return the full name of a quantity; raises InputError for a name that is none, suggesting another."""
    if not isinstance(name, str):
        first = next(iter(evaluated_quantities(studies[BASE])), "")
        raise InputError(place, quoted(name), "not the name of a quantity", f"such as {first}")
    part, dot, plain = name.partition(".")
    if not dot:
        part, plain = BASE, name
    elif part not in studies:
        names = [study for study in studies if study != BASE]
        remedy = f"there is: {', '.join(names)}" if names else "add [design.part]"
        raise InputError(place, quoted(name), f"there is no part {quoted(part)}", remedy)
    study = studies[part]
    quantities = evaluated_quantities(study)
    full = study.short_names().get(plain, plain)
    if full not in quantities:
        what = f"quantity of studies of kind {study.kind}"
        raise unknown_name(place, plain, [*study.short_names(), *quantities], what)
    return _joined(part, full)


def _joined(part: str, name: str) -> str:
    return f"{part}.{name}" if part else name


def split(key: str, names: Any) -> tuple[str, str]:
    """Name of the source that a key or a quantity belongs to, and the rest of it."""
    part, dot, rest = key.partition(".")
    return (part, rest) if dot and part in names else (BASE, key)


def own(name: str, schema: type[Table], overrides: Mapping[str, Any], names: Any) -> dict[str, Any]:
    """The overrides that belong to a source.

    A part takes the keys that its schema knows, and those that begin with its name in their place.
    """
    common = {key: value for key, value in overrides.items() if split(key, names)[0] == BASE}
    if name == BASE:
        return common
    unambiguous = {key: value for key, value in common.items() if unknown_part(key, schema) is None}
    named = ((split(key, names), value) for key, value in overrides.items())
    return unambiguous | {rest: value for (part, rest), value in named if part == name}


def require_key(place: str, key: str, sources: Sources) -> tuple[Source, str]:
    """Return the source of a key, and the key within it.

    Raises InputError for a key that the schema of its scenario does not know; it suggests another.
    """
    part, rest = split(key, sources)
    if (missing := unknown_part(rest, sources[part].schema)) is not None:
        above, name, fields = missing
        near = near_name(name, fields)
        mean = f'did you mean "{".".join((*above, near))}"?' if near else f"there is: {', '.join(fields)}"
        raise InputError(place, quoted(key), "unknown key", mean)
    return sources[part], rest


def refused(place: str, key: str, value: Any, source: Source) -> InputError | None:
    """Why the schema of a scenario does not take a value at a key, said of `place`; None where it does.

    Keys of a family or of a law are left to the scenario's own rules.
    """
    field: Any = None
    for *_, part, fields in _fields_along(key, source.schema):
        if fields is None or part not in fields:
            return None
        field = fields[part]
    model: Any = create_model("Value", value=(field.annotation, field))
    try:
        model.model_validate({"value": value})
    except ValidationError as error:
        first = explain(error, model)[0]
        return InputError(place, quoted(value), f"{key}: {first.rule}", first.remedy)
    return None


def unknown_part(key: str, schema: type[Table]) -> tuple[list[str], str, list[str]] | None:
    """What stands above the first part of a key that a schema does not know, that part, and what it knows.

    None where it knows the key. Keys of a family or of a law are known: the scenario's own rules judge them.
    """
    for above, part, fields in _fields_along(key, schema):
        if fields is None:
            return None
        if part not in fields:
            return None if "law" in fields or "shape" in above else (above, part, list(fields))
    return None


def _fields_along(key: str, schema: type[Table]) -> Iterator[tuple[list[str], str, Mapping[str, Any] | None]]:
    """Parts of a dotted key, with those before each and the fields among which it stands.

    None in place of fields below the tables. Names and places of tables are passed over but at the end.
    """
    names = key.split(".")
    parts = [int(name) if name.isdecimal() else name for name in names]
    for place, part in enumerate(parts):
        table = table_at(schema, parts[:place], part)
        fields = fields_of(table) or None
        named = isinstance(part, int) or (place and holds_by_name(schema, parts[:place]))
        if fields and part not in fields and table_at(schema, parts[: place + 1]) is not None:
            named = True  # a table with names of its own beside its keys
        if not named:
            yield names[:place], names[place], fields
        elif place == len(parts) - 1:
            yield names[:place], names[place], None


def standing(scenarios: Mapping[str, Mapping[str, Any]], key: str) -> Any:
    """What stands at a dotted key of the scenarios of a search; None where nothing does."""
    name, key = split(key, [scenario for scenario in scenarios if scenario != BASE])
    return given_at(scenarios[name], key)


def in_unit(value: Any, unit: str, si: float) -> float | None:
    """Number of a quantity in a unit, of which one is `si` in SI; None for no value."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return float(value)
    if not isinstance(value, str):
        return None
    number, _, value_unit = value.strip().partition(" ")
    if value_unit.strip() == unit:
        return float(number)
    base = base_units(value)
    return base[0] / si if base else None
