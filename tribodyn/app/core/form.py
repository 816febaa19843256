"""The form of a scenario from its schema: groups of fields with meaning, value, units, choices and range.

Fields of tables by name (``gear.NAME``) and in lists (``stage.0``) are those of the scenario's own tables; of
a table that the scenario does not have its fields are there too, so that a value may be given.
"""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, NamedTuple

from pydantic import BaseModel, Discriminator
from pydantic.fields import FieldInfo

from tribodyn.app.core.document import BY_DEFAULT, Document
from tribodyn.app.core.fields import (
    FieldType,
    Sort,
    as_toml,
    is_first,
    label_of,
    many_tables,
    measures_as,
    of_parameter,
    of_value,
    parts_of_quantity,
    tables_of,
    type_of,
    type_of_model,
)
from tribodyn.geometry.families import FAMILIES
from tribodyn.input.messages import Origins
from tribodyn.input.names import named_in, speaks_of_pair, worded
from tribodyn.input.quantity import LIKE, FamilyShape, Reference, meaning
from tribodyn.input.resolve import toml_value
from tribodyn.input.schema import EACH, Inner, extra_table, parts_of, tagged
from tribodyn.studies import DEFAULT, STUDIES
from tribodyn.studies.protocol.load import filled, table_of
from tribodyn.tribology.law import AUTO

Step = str | int


@dataclass(frozen=True)
class FormField:
    """A value of the scenario, as a form shows it."""

    path: str  # dotted key, for `Document.set`
    label: str
    about: str  # what the key means
    kind: Sort
    value: Any  # in effect, as TOML has it; None: there is none
    shown: str  # in the input: of a quantity the number alone
    unit: str  # of a quantity, as it is written
    units: tuple[str, ...]  # to choose from
    choices: tuple[str, ...]
    default: str  # as TOML has it; "": none
    example: str
    low: float | None  # bounds of a plain number
    high: float | None
    usual: tuple[float, float] | None  # usual range, in `usual_unit`
    usual_unit: str
    usual_source: str
    required: bool
    advanced: bool  # not among those of a first look
    given: bool  # whether this scenario writes it out
    source: str  # where the value is from: "" this scenario, `BY_DEFAULT`, or a model's file


class HeldTables(NamedTuple):
    """Tables that a table may have any number of."""

    path: str  # dotted key of the list, or of the table that holds them by name
    label: str
    about: str
    table: type[BaseModel]
    named: bool  # by name; else in a list


@dataclass(frozen=True)
class FormGroup:
    """A table of the scenario."""

    path: str
    label: str
    about: str
    level: int  # tables that it lies in
    fields: tuple[FormField, ...]
    present: bool  # whether the scenario, or a model that it names, has the table
    optional: bool  # whether it may be taken out
    one_of: str  # key of the list or the named tables that it is one of; "": of none
    given: bool  # whether this scenario writes it out
    holds: tuple[HeldTables, ...]  # where tables can be added


def form_of(document: Document) -> tuple[FormGroup, ...]:
    """The form of a document, in the order of the schema; what is wrong with values is not looked at."""
    written, whole = document.written(), document.resolved.data
    first = _shown_first(document.kind)
    form = _Form(document.resolved.origins, str(document.path), speaks_of_pair(written), first)
    return tuple(form.groups(_Place(table_of(whole), whole, written)))


def written_as(field: FormField, text: str, unit: str = "") -> Any:
    """What the text of an input, with the unit beside it, is for `Document.set`."""
    text = text.strip()
    if field.kind == "quantity":
        own = not _is_number(text) and any(one.isalpha() for one in text)  # "20 um" has its unit
        return text if own else f"{text} {unit or field.unit}".strip()
    if field.kind in ("number", "whole", "switch", "list", "other"):
        return toml_value(text)
    return _choice(field, text)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _choice(field: FormField, text: str) -> Any:
    """A choice as TOML has it: a whole number where the schema has those."""
    number = toml_value(text)
    of_numbers = isinstance(number, int) and field.kind == "choice" and not isinstance(field.value, str)
    return number if of_numbers else text


@cache
def _shown_first(kind: str) -> frozenset[str]:
    """Names of keys that the template of a kind has."""
    return frozenset(_names(tomllib.loads(filled(kind if kind in STUDIES else DEFAULT, "x"))))


def _names(data: Any) -> Iterator[str]:
    inside = data.values() if isinstance(data, Mapping) else data if isinstance(data, list) else ()
    yield from data if isinstance(data, Mapping) else ()
    for value in inside:
        yield from _names(value)


class _Place(NamedTuple):
    """A table of the scenario: its schema, what it holds, what of that the scenario writes out, and where."""

    table: type[BaseModel]
    whole: Any
    written: Any
    path: tuple[Step, ...] = ()
    about: str = ""
    optional: bool = False
    one_of: str = ""
    reference: Reference | None = None


@dataclass(frozen=True)
class _Form:
    """What all groups of a form are made with."""

    origins: Origins
    file: str
    of_pair: bool | None
    first: frozenset[str]

    def groups(self, place: _Place) -> Iterator[FormGroup]:
        """The group of a table, and those of the tables in it."""
        whole, written = _table(place.whole), _table(place.written)
        fields: list[FormField] = [*self._model(place)]
        inside: list[_Place] = []
        known = set()
        for name, field in place.table.model_fields.items():
            key = named_in(whole, worded(field.alias or name, self.of_pair))
            path = (*place.path, key)
            known.add(key)
            if any(isinstance(part, FamilyShape) for part in parts_of(field)):
                fields += self._shape(path, whole, written)
            elif tables := tables_of(field, whole.get(key)):
                inside += self._inside(place, field, key, tables)
            elif key != LIKE:
                fields.append(self._field(_type(place.table, name, path), path, whole.get(key), written))
        held = extra_table(place.table)
        for key, value in whole.items():
            path = (*place.path, key)
            if key in known or key == LIKE:
                continue
            if held is not None and isinstance(value, Mapping):
                more = {"optional": True, "one_of": _dotted(place.path)}
                inside.append(_Place(held, value, written.get(key), path, **more))
            else:
                fields.append(self._field(_of_law(place.table, whole, key, value), path, value, written))
        yield FormGroup(
            _dotted(place.path),
            _label(place.path),
            place.about,
            len(place.path),
            tuple(fields),
            isinstance(place.whole, Mapping),
            place.optional,
            place.one_of,
            isinstance(place.written, Mapping),
            tuple(self._held(place)) if isinstance(place.whole, Mapping) else (),
        )
        for each in inside:
            # of a table that is not there, those that it might hold are not offered
            if isinstance(place.whole, Mapping):
                yield from self.groups(each)

    def _held(self, place: _Place) -> Iterator[HeldTables]:
        """Lists and named tables that a table may hold."""
        for name, inner in many_tables(place.table):
            key = worded(name, self.of_pair)
            there = place.whole.get(key) if key else None
            if isinstance(there, Mapping) and inner.held is tuple:  # one table stands in the list's place
                continue
            path = _dotted((*place.path, *([key] if key else [])))
            label, about = label_of(key) or _label(place.path), meaning(place.table, name)
            yield HeldTables(path, label, about, inner.table, inner.held is dict)

    def _inside(self, place: _Place, field: FieldInfo, key: str, tables: list[Inner]) -> Iterator[_Place]:
        """The tables that a field holds."""
        whole, own = _table(place.whole).get(key), _table(place.written).get(key)
        path, about = (*place.path, key), meaning(place.table, field.alias or key)
        if isinstance(whole, list):
            for number, each in enumerate(whole):
                one = own[number] if isinstance(own, list) and number < len(own) else None
                chosen = _of_list(field, tables, each)
                yield _Place(chosen, each, one, (*path, number), about, True, _dotted(path))
            return
        by_name = next((one.table for one in tables if one.held is dict), None)
        if by_name is not None:
            for name, each in _table(whole).items():
                one = _table(own).get(name)
                yield _Place(by_name, each, one, (*path, name), about, True, _dotted(path))
            return
        single = next((one.table for one in tables if one.held is None), None)
        if single is not None:
            reference = next(
                (one for one in parts_of(field) if isinstance(one, Reference) and one.folder), None
            )
            yield _Place(single, whole, own, path, about, not field.is_required(), "", reference)

    def _model(self, place: _Place) -> Iterator[FormField]:
        """The choice of a model that a table may be like."""
        if place.reference is None:
            return
        own = place.written
        name = own if isinstance(own, str) else _table(own).get(LIKE)
        key = (*place.path, LIKE) if isinstance(own, Mapping) else place.path
        of = type_of_model(place.reference)
        given: Mapping[Step, Any] = {} if name is None else {key[-1]: name}
        yield self._field(of, key, name, given)

    def _shape(self, path: tuple[Step, ...], whole: Mapping[str, Any], written: Any) -> Iterator[FormField]:
        """What the family of the teeth needs."""
        name, values = whole.get("family"), _table(whole.get(str(path[-1])))
        if isinstance(name, str) and name in FAMILIES:
            own = _table(written.get(str(path[-1])))
            for one in FAMILIES[name].parameters:
                yield self._field(of_parameter(one), (*path, one.name), values.get(one.name), own)

    def _field(
        self, of: FieldType, path: tuple[Step, ...], value: Any, written: Mapping[Any, Any]
    ) -> FormField:
        value = written.get(path[-1], of.default if value is None else value)
        plain = of.kind != "quantity" or isinstance(value, list)
        shown, unit = (as_toml(value), "") if plain else parts_of_quantity(value)
        if unit and of.units and unit not in of.units and not measures_as(unit, of.units[0]):
            shown, unit = str(value), ""  # the next number does not get what is no unit here
        given, origin, usual = path[-1] in written, self.origins.of(path), of.usual
        return FormField(
            path=_dotted(path),
            label=of.label,
            about=of.about,
            kind="list" if isinstance(value, list) else of.kind,
            value=value,
            shown=shown,
            unit=unit or next(iter(of.units), ""),
            units=of.units if not unit or unit in of.units else (unit, *of.units),
            choices=of.choices,
            default=as_toml(of.default),
            example=of.example,
            low=of.low,
            high=of.high,
            usual=None if usual is None else (usual.low, usual.high),
            usual_unit="" if usual is None else usual.unit,
            usual_source="" if usual is None else usual.source,
            required=of.required,
            advanced=not (of.required or given or is_first(str(path[-1])) or path[-1] in self.first),
            given=given,
            source="" if given else BY_DEFAULT if value == of.default or origin == self.file else origin,
        )


def _table(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _of_list(field: FieldInfo, tables: list[Inner], value: Any) -> type[BaseModel]:
    """Which of several sorts of tables one of a list is."""
    listed = [one.table for one in tables if one.held is tuple] or [one.table for one in tables]
    for mark in parts_of(field):
        if isinstance(mark, Discriminator) and callable(mark.discriminator):
            tag = mark.discriminator(value)
            if isinstance(tag, str) and (chosen := tagged(field.annotation, tag)) in listed:
                return chosen or listed[0]
    return listed[0]


def _type(table: type[BaseModel], name: str, path: tuple[Step, ...]) -> FieldType:
    """How a key is written; of a law its names."""
    places = (EACH if isinstance(part, int) else part for part in path)
    found = type_of(table, name, ".".join(places))
    if name == "law" and (laws := getattr(table, "laws", None)) is not None:
        automatic = (AUTO,) if getattr(table, "automatic", False) else ()
        return replace(found, kind="choice", choices=(*automatic, *laws))
    return found


def _of_law(table: type[BaseModel], whole: Mapping[str, Any], key: str, value: Any) -> FieldType:
    """How a key is written that only the law knows which the table names; else as the value stands."""
    laws, name = getattr(table, "laws", {}), whole.get("law")
    law = laws[name] if isinstance(name, str) and name in laws else None
    own = next((one for one in getattr(law, "keys", ()) if one.name == key), None)
    return of_parameter(own) if own is not None else of_value(key, value)


def _dotted(path: tuple[Step, ...]) -> str:
    return ".".join(map(str, path))


def _label(path: tuple[Step, ...]) -> str:
    """What a table is called: the last of its key, and the number of one of a list."""
    if not path:
        return "Scenario"
    *above, last = path
    return f"{label_of(str(above[-1]))} {last + 1}" if isinstance(last, int) else label_of(last)
