"""A value for a key, as TOML has it: drawn by the key's type, near what stands there where a number does."""

import copy
import re
import tomllib
import typing
from collections.abc import Iterator, Sequence
from functools import cache
from random import Random
from types import UnionType
from typing import Any, Literal, NamedTuple

import annotated_types
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tools.by_schema.keys import Inside, SchemaKey
from tribodyn.input import units
from tribodyn.input.quantity import Column, Columns, CurveTable, InUnit, Names, Reference
from tribodyn.input.resolve import resolve_table
from tribodyn.input.schema import inner_tables
from tribodyn.input.sources import shipped
from tribodyn.input.specific_keys import example_of, key_schema
from tribodyn.input.tables.laws import LawTable
from tribodyn.numerics.parameter import Parameter
from tribodyn.studies.protocol.load import table_of

#: By which a number is multiplied.
FACTORS = (1.05, 0.95, 1.3, 0.5, 2.0, 0.1, 10.0, -1.0)
#: Texts where the schema names none: what formulas, levels, keys and quantities look like.
TEXTS = (
    *("2 * sin(2 * pi * i / z)", "5 * h", "0.1 N", "0.5 m/s**2", "1 N*m", "efficiency", "loss >= 0"),
    *("operating.gear_torque", "drive.pinion.profile_shift", "pinion", "gear", "+z", "0.2 um"),
)
#: Share of the keys that a table may lack, but has.
EXTRA = 0.25
#: Share of the tables that are taken from a shipped scenario, where one has such a table.
SHIPPED = 0.7
#: Values that no type says: the stiffness of a shaft and its bearings.
_MATRIX = [
    [float(value) if row == place else 0.0 for place in range(6)]
    for row, value in enumerate((1e9, 1e9, 1e9, 1e6, 1e6, 0))
]
_SPECIAL = {"matrix": _MATRIX}
#: Other units of columns.
_UNITS = {
    "um": "mm",
    "mm": "um",
    "deg": "rad",
    "rad": "deg",
    "s": "ms",
    "N*m": "kN*m",
    "N/m": "kN/m",
    "Hz": "kHz",
}
_NUMBER = re.compile(r"^\s*([-+]?\d[\d.e+-]*)\s*(\S.*)?$")


class Surroundings(NamedTuple):
    """What a value may refer to."""

    names: tuple[str, ...] = ()  # of gears, bodies, shafts, points
    present: Any = None  # what stands at the key


def drawn_value(random: Random, key: SchemaKey, around: Surroundings) -> Any:
    """Draw what may stand at a key."""
    if isinstance(key.field, Parameter):
        return own_value(random, key.field)
    if key.pattern[-1] in _SPECIAL:
        return copy.deepcopy(_SPECIAL[key.pattern[-1]])
    if key.pattern[-1] == "law" and issubclass(key.holder, LawTable):
        return random.choice(tuple(key.holder.laws))
    return _value(random, key.field.annotation, key.field.metadata, around, _examples(key.field))


def own_value(random: Random, own: Parameter, present: Any = None) -> Any:
    """Draw the value of a law's or a family's own key, near the present one."""
    if own.kind == "path":
        places = [-6.0, -3.0, 0.0, 3.0, 6.0]
        columns = {"x": [2.8 * place for place in places], "y": places}
        return {name: {"unit": "mm", "values": values} for name, values in columns.items()}
    example = present or tomllib.loads(f"value = {example_of(own)}")["value"]
    if own.listed:
        return [near(random, item) for item in example]
    lowest = key_schema(own)
    value = near(random, example)
    signed = "minimum" not in lowest and "exclusiveMinimum" not in lowest
    return value if signed or not str(value).startswith("-") else example


def drawn_table(
    random: Random, table: type[BaseModel], around: Surroundings, extra: float = EXTRA
) -> dict[str, Any]:
    """Draw a table: what it needs, and by chance what it may have."""
    if random.random() < SHIPPED and (known := shipped_tables().get(table)):
        return copy.deepcopy(random.choice(known))
    if issubclass(table, Columns):
        return _columns(random, table)
    found: dict[str, Any] = {}
    for name, field in table.model_fields.items():
        if field.is_required() or random.random() < extra:
            found[name] = drawn_value(
                random, SchemaKey((name,), field, (Inside(0, table),)), around._replace(present=None)
            )
    if issubclass(table, LawTable):
        found |= law_and_keys(random, table, random.choice(tuple(table.laws)))
    return {name: value for name, value in found.items() if value is not None}


def law_and_keys(random: Random, table: type[LawTable], law: str) -> dict[str, Any]:
    """Draw the name of a law with the keys that it needs, and by chance the others."""
    keys = [
        own
        for own in table.laws[law].keys
        if (own.default is None and not own.optional) or random.random() < 0.5
    ]
    return {"law": law, **{own.name: own_value(random, own) for own in keys}}


def near(random: Random, value: Any) -> Any:
    """Draw a value of the type of another, and mostly of its size: of a quantity with the same unit."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return random.choice((value + 1, max(value - 1, 1), value + 3, 2 * value, 1))
    if isinstance(value, float):
        return random.choice((random.choice(FACTORS) * value, 0.1, 0.0))
    number = _NUMBER.match(value) if isinstance(value, str) else None
    if number and number[2] and _is_number(number[1]):
        size = float(number[1]) or random.choice((1.0, 10.0))
        return f"{random.choice(FACTORS) * size:.6g} {number[2]}"
    if isinstance(value, list) and value:
        return [near(random, item) for item in value]
    return value


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _examples(field: FieldInfo) -> list[Any]:
    return list(field.examples or [])


def _value(
    random: Random, annotation: Any, marks: Sequence[Any], around: Surroundings, examples: list[Any]
) -> Any:
    """Draw a value of an annotation, with what is marked at it."""
    marks = [part for mark in marks for part in (mark.metadata if isinstance(mark, FieldInfo) else [mark])]
    for mark in marks:
        if isinstance(mark, Reference) and mark.folder and random.random() < 0.5:
            return _model(random, mark.folder)
        if isinstance(mark, Names):
            return random.choice(list(mark.known))
        if isinstance(mark, InUnit):
            return _quantity(random, mark.kind, around.present)
        if isinstance(mark, units.Kind) and annotation is Column:
            return _column(random, mark, random.randint(2, 5))
    origin, inside = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is typing.Annotated:
        inner = [
            example
            for mark in annotation.__metadata__
            if isinstance(mark, FieldInfo)
            for example in _examples(mark)
        ]
        return _value(random, inside[0], [*annotation.__metadata__, *marks], around, inner or examples)
    if origin in (typing.Union, UnionType):
        return _value(
            random, random.choice([part for part in inside if part is not type(None)]), (), around, examples
        )
    if origin is Literal:
        return random.choice([value for value in inside if value != around.present] or list(inside))
    if origin is tuple:
        return _list(random, inside, marks, around, examples)
    if origin is dict:
        names = random.sample(around.names, min(len(around.names), random.randint(1, 2))) or ["a"]
        return {name: _value(random, inside[1], (), around, examples) for name in names}
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return drawn_table(random, annotation, around)
    return _plain(random, annotation, marks, around, examples)


def _plain(
    random: Random, annotation: Any, marks: Sequence[Any], around: Surroundings, examples: list[Any]
) -> Any:
    """Draw a number, a switch or a text."""
    present = around.present
    if annotation is bool:
        return not present if isinstance(present, bool) else random.random() < 0.5
    if annotation in (int, float):
        low, high = _bounds(marks, annotation)
        known = [
            value
            for value in (present, *examples)
            if isinstance(value, int | float) and not isinstance(value, bool)
        ]
        sizes = [near(random, annotation(value)) for value in known]
        usual = (
            [random.randint(1, 9), random.randint(1, 40)]
            if annotation is int
            else [random.random(), 1.5, 3.0, -0.2]
        )
        value = random.choice(sizes or usual)
        return min(max(value, low), high)
    if isinstance(present, str) and present in _UNITS:
        return _UNITS[present]
    if annotation is str and not examples:
        return random.choice(around.names if around.names and random.random() < 0.7 else TEXTS)
    values = [*examples, near(random, random.choice(examples))] if examples else [*TEXTS, 1, 2.5, True, ["a"]]
    known = [near(random, present)] if present is not None and annotation is not str else []
    return random.choice([*known, *values])


def _bounds(marks: Sequence[Any], annotation: type) -> tuple[Any, Any]:
    """Lowest and highest value that a number may have."""
    step = 1 if annotation is int else 1e-3
    said = {
        name: getattr(mark, name)
        for mark in marks
        for name in ("ge", "gt", "le", "lt")
        if hasattr(mark, name)
    }
    low = said.get("ge", said["gt"] + step if "gt" in said else -1e30)
    high = said.get("le", said["lt"] - step if "lt" in said else 1e30)
    return low, high


def _quantity(random: Random, kind: units.Kind, present: Any) -> str:
    known = [text for text in (present, kind.example) if isinstance(text, str) and _NUMBER.match(text)]
    value = near(random, random.choice(known))
    return value.removeprefix("-") if kind.allowed != "any" else value


def _list(
    random: Random, inside: tuple[Any, ...], marks: Sequence[Any], around: Surroundings, examples: list[Any]
) -> Any:
    if examples and random.random() < 0.5:
        return random.choice(examples)
    if inside[-1:] != (Ellipsis,):
        return [_value(random, part, (), around, []) for part in inside]
    if isinstance(around.present, list) and around.present and random.random() < 0.7:
        kept = list(around.present)  # the same number of them, one changed
        place = random.randrange(len(kept))
        kept[place] = _value(random, inside[0], (), around._replace(present=kept[place]), [])
        return kept
    least = next((mark.min_length for mark in marks if isinstance(mark, annotated_types.MinLen)), 0)
    most = next((mark.max_length for mark in marks if isinstance(mark, annotated_types.MaxLen)), 3)
    count = random.randint(max(least, 1), max(least, 1, min(most, 3)))
    return [_value(random, inside[0], (), around._replace(present=None), []) for _ in range(count)]


def _columns(random: Random, table: type[Columns]) -> dict[str, Any]:
    """Columns of one length; of a map every place of a grid."""
    kinds = {name: field.metadata[0] for name, field in table.model_fields.items()}
    *axes, values = kinds
    if issubclass(table, CurveTable):
        count = random.randint(2, 5)
        return {name: _column(random, kind, count, rising=name in axes[:1]) for name, kind in kinds.items()}
    places: list[tuple[float, ...]] = [()]
    for number, name in enumerate(axes):
        steps = (
            (1.0, 2.0)
            if kinds[name].si == "dimensionless" and number == 0 and len(axes) == 3
            else (0.0, 0.5, 1.0)
        )
        places = [(*place, step) for place in places for step in steps]
    found = {name: _column(random, kinds[name], len(places)) for name in (*axes, values)}
    for axis, name in enumerate(axes):
        found[name]["values"] = [place[axis] for place in places]
    return found


def _column(random: Random, kind: units.Kind, count: int, *, rising: bool = False) -> dict[str, Any]:
    number, _, unit = kind.example.partition(" ")
    size = float(number) if _is_number(number) else 1.0
    values = [round(abs(size) * random.uniform(0.2, 2.0), 6) for _ in range(count)]
    if rising:
        values = sorted({round(abs(size) * place * random.uniform(0.9, 1.1), 6) for place in range(count)})
    return {"unit": unit or "1", "values": values}


def _model(random: Random, folder: str) -> str:
    """The name of a shipped model, or of a shipped scenario."""
    if folder == "scenarios":
        return random.choice(sorted(path.stem for path in shipped("scenarios").glob("*.toml")))
    return random.choice(sorted(path.stem for path in (shipped("models") / folder).glob("*.toml")))


def names_in(data: Any) -> set[str]:
    """Words of a scenario that may be names: of gears, bodies, shafts, points, and keys that hold them."""
    if isinstance(data, dict):
        inner = set().union(*(names_in(value) for value in data.values()), set())
        return inner | {name for name, value in data.items() if isinstance(value, dict)}
    if isinstance(data, list):
        return set().union(*(names_in(value) for value in data), set())
    return {data} if isinstance(data, str) and re.fullmatch(r"\w[\w-]{0,30}", data) else set()


@cache
def shipped_tables() -> dict[type[BaseModel], list[dict[str, Any]]]:
    """Tables of the shipped scenarios by their sort."""
    found: dict[type[BaseModel], list[dict[str, Any]]] = {}
    for path in sorted(shipped("scenarios").glob("*.toml")):
        data = resolve_table(tomllib.loads(path.read_text(encoding="utf-8")), path, {}, table_of).data
        for table, held in tables_in(table_of(data), data):
            if held not in found.setdefault(table, []):
                found[table].append(held)
    return found


def tables_in(
    table: type[BaseModel], data: dict[str, Any]
) -> Iterator[tuple[type[BaseModel], dict[str, Any]]]:
    """Go through the tables within a table's data, each with its sort."""
    extra = table.__annotations__.get("__pydantic_extra__")
    for name, held in data.items():
        field = table.model_fields.get(name)
        inner = list(inner_tables(field.annotation if field else extra))
        for one in _held(inner, held):
            fitting = [
                each.table
                for each in inner
                if set(one) <= set(each.table.model_fields) or each.table.model_config.get("extra") == "allow"
            ]
            for sort in fitting[:1]:
                yield sort, one
                yield from tables_in(sort, one)


def _held(inner: list[Any], held: Any) -> list[dict[str, Any]]:
    if isinstance(held, dict):
        by_name = inner and inner[0].held is dict
        return [one for one in held.values() if isinstance(one, dict)] if by_name else [held]
    return [one for one in held if isinstance(one, dict)] if isinstance(held, list) else []
