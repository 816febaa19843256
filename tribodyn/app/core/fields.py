"""What the schema says of a key: how its value is written, its units, choices, bounds and usual range."""

import json
import re
import typing
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, lru_cache
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin

import tomli_w
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tribodyn.gears.plausibility import USUAL, UsualRange
from tribodyn.input.quantity import Column, Columns, InUnit, Names, Reference, Table, meaning
from tribodyn.input.schema import Inner, extra_table, inner_tables, parts_of
from tribodyn.input.sources import SCENARIOS, names, shipped
from tribodyn.input.unit_grammar import COMMON_UNITS, OWN_UNITS
from tribodyn.input.units import QUANTITIES, TEMPERATURE_KIND, Kind, NotAQuantity, to_si
from tribodyn.numerics.parameter import Parameter

Sort = Literal["quantity", "number", "whole", "choice", "model", "text", "switch", "list", "other"]
#: Units of a kind of quantity that may be written in more ways -> one spelling of each.
_SPELLED = {"Nm": "N*m", "µm": "um", "Nm/rad": "N*m/rad", "mm^2/s": "mm**2/s", "mm²/s": "mm**2/s"}
#: Kind of quantity -> the unit of a value that is not given yet, where it is another than the example's.
_FIRST_UNIT = {"angular speed": ["rpm"]}
_TEMPERATURES = ("degC", "K", "degF")
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(\S.*?)\s*$", re.ASCII)
#: Ends of keys -> what is usual of them, as `check` judges it.
_USUAL = {
    "module": "module",
    "mean_roughness": "roughness",
    "mesh.damping_ratio": "mesh_damping",
    "viscosity_40": "viscosity_40",
    **{f"stiffness_{axis}": "bearing_stiffness" for axis in "xy"},
    **{f"bearings.{end}.damping_ratio": "bearing_damping" for end in ("pinion", "gear", "default")},
}
#: Fields of a gear's tables that stand among a case's first numbers, whatever a file says of them.
_FIRST = frozenset({"profile_shift", "tip_relief", "tip_relief_length", "helix_angle", "crowning"})


@dataclass(frozen=True)
class FieldType:
    """How the value of a key is written."""

    kind: Sort
    label: str
    about: str  # what the key means
    units: tuple[str, ...]  # to choose from; the first is the usual one
    choices: tuple[str, ...]
    default: Any  # as TOML has it; None: there is none
    example: str
    low: float | None  # bounds of a plain number
    high: float | None
    usual: UsualRange | None
    required: bool
    read_as: Kind | None  # the kind of quantity


@lru_cache(maxsize=4096)
def type_of(table: type[Table], name: str, dotted: str) -> FieldType:
    """How a key of a table is written; `dotted` is where it stands, names and places as `EACH`."""
    field = table.model_fields[name]
    key = field.alias or name
    annotation = without_none(field.annotation)
    marks = list(parts_of(field))
    in_unit = next((mark for mark in marks if isinstance(mark, InUnit)), None)
    reference = next((mark for mark in marks if isinstance(mark, Reference)), None)
    listed = next((mark for mark in marks if isinstance(mark, Names)), None)
    kind, choices = _sort(annotation, in_unit, reference)
    if listed is not None and kind == "text":
        kind, choices = "choice", tuple(listed.known)
    default = None if field.is_required() else field.get_default(call_default_factory=True)
    quantity = in_unit.kind if in_unit is not None else None
    ends = _ends(annotation, field.metadata)
    usual = next((USUAL[end] for tail, end in _USUAL.items() if f".{dotted}".endswith(f".{tail}")), None)
    return FieldType(
        kind,
        label_of(key),
        meaning(table, key) or field.description or "",
        _units(quantity, default),
        choices,
        list(default) if isinstance(default, tuple) else default,
        quantity.example if quantity is not None else "",
        *ends,
        usual,
        field.is_required(),
        quantity,
    )


def of_parameter(one: Parameter) -> FieldType:
    """How a key is written that a family of teeth or a law has of its own."""
    quantity = QUANTITIES.get(one.kind.removeprefix("signed "))
    kind: Sort = "list" if one.listed else "quantity" if quantity is not None else "number"
    if one.kind == "path":
        kind = "text"
    example = one.example or (quantity.example if quantity is not None else "")
    about = one.about + (f" ({one.source})" if one.source else "")
    units, required = _units(quantity, None), one.default is None and not one.optional
    usual_unit = None if quantity is None or one.default is None else f"{one.default:g} {quantity.si}"
    default = one.default if quantity is None else usual_unit
    return FieldType(
        kind, label_of(one.name), about, units, (), default, example, None, None, None, required, quantity
    )


def of_value(key: str, value: Any) -> FieldType:
    """How a key is written that the schema does not know."""
    kinds: dict[type, Sort] = {bool: "switch", int: "number", float: "number", str: "text", list: "list"}
    kind = kinds.get(type(value), "other")
    return FieldType(kind, label_of(key), "", (), (), None, "", None, None, None, False, None)


def type_of_model(reference: Reference) -> FieldType:
    """The choice of a file that a table is like."""
    folder = shipped(SCENARIOS) if reference.folder == SCENARIOS else shipped("models") / reference.folder
    known, about = tuple(names(folder)), reference.what
    return FieldType("model", "Like", about, (), known, None, "", None, None, None, False, None)


def tables_of(field: FieldInfo, value: Any = None) -> list[Inner]:
    """Tables that a field may hold; none where it is a list of values, or a curve, which a file may have."""
    if isinstance(value, list) and value and not any(isinstance(one, Mapping) for one in value):
        return []
    inner = list(inner_tables(field.annotation))
    return [] if any(issubclass(one.table, (Columns, Column)) for one in inner) else inner


@cache
def many_tables(table: type[BaseModel]) -> tuple[tuple[str, Inner], ...]:
    """Lists of tables and tables by name in a table, by key; "": its own keys are names."""
    found = [
        (field.alias or name, inner)
        for name, field in table.model_fields.items()
        for inner in {one.held: one for one in tables_of(field)}.values()
        if inner.held in (tuple, dict)
    ]
    own = extra_table(table)
    return tuple(found) if own is None else (*found, ("", Inner(own, dict)))


def without_none(annotation: Any) -> Any:
    """The annotation of a key that may be absent, as where it is given; of several, the first one."""
    while get_origin(annotation) in (Union, UnionType, typing.Annotated):
        if get_origin(annotation) is typing.Annotated:
            annotation = get_args(annotation)[0]
            continue
        members = [member for member in get_args(annotation) if member is not type(None)]
        if len(members) != 1:
            break
        annotation = members[0]
    return annotation


def _sort(
    annotation: Any, in_unit: InUnit | None, reference: Reference | None
) -> tuple[Sort, tuple[str, ...]]:
    """How a value is written, and what there is to choose from."""
    origin = get_origin(annotation)
    if origin in (tuple, list):
        return "list", ()
    if in_unit is not None and origin is not dict:
        return "quantity", ()
    if origin is Literal:
        return "choice", tuple(map(str, get_args(annotation)))
    if origin is dict or any(inner_tables(annotation)):
        return "other", ()
    if origin in (Union, UnionType):
        members = {without_none(member) for member in get_args(annotation)}
        return ("text", ()) if str in members else ("other", ())
    plain: dict[Any, Sort] = {bool: "switch", int: "whole", float: "number", str: "text"}
    return plain.get(annotation, "text" if reference is not None else "other"), ()


def _ends(annotation: Any, metadata: list[Any]) -> tuple[float | None, float | None]:
    """Least and greatest value of a plain number."""
    marks = [*metadata]
    for part in _annotated(annotation):
        marks += getattr(part, "metadata", ())

    def given(*names: str) -> list[float]:
        ends = (getattr(mark, name, None) for mark in marks for name in names)
        return [float(end) for end in ends if end is not None]

    return max(given("ge", "gt"), default=None), min(given("le", "lt"), default=None)


def _annotated(annotation: Any) -> Iterator[Any]:
    for part in (*get_args(annotation), *getattr(annotation, "__metadata__", ())):
        yield part
        yield from _annotated(part)


def _units(kind: Kind | None, default: Any) -> tuple[str, ...]:
    """Units to choose from, that of the default or of the example first."""
    if kind is None:
        return ()
    if kind.name == "temperature":
        return _TEMPERATURES
    first = [parts_of_quantity(text)[1] for text in (default, kind.example) if isinstance(text, str)]
    known = [*COMMON_UNITS.get(kind.name, ()), *OWN_UNITS.get(kind.name, ()), kind.si]
    first = _FIRST_UNIT.get(kind.name, first)
    spelled = [_SPELLED.get(unit, unit) for unit in (*first, *known) if unit]
    return tuple(dict.fromkeys(unit for unit in spelled if "^" not in unit))


def parts_of_quantity(text: Any) -> tuple[str, str]:
    """Number and unit of a quantity as texts; of what is none the text and no unit."""
    match = _QUANTITY.fullmatch(text) if isinstance(text, str) else None
    return (match[1], match[2]) if match else ("" if text is None else str(text), "")


def converted(number: str, unit: str, to: str) -> str:
    """The number of a quantity in another unit, as short as it is exact; the same where it has none there."""
    for kind_of in _kinds_with(unit):
        try:
            value = to_si(f"{number} {unit}", kind_of)
            if kind_of.name == "temperature":
                zero, one = (to_si(f"{each} {to}", kind_of) for each in ("300", "301"))
                return f"{300.0 + (value - zero) / (one - zero):.9g}"
            return f"{value / to_si(f'1 {to}', kind_of):.12g}"
        except NotAQuantity:
            continue
    return number


def measures_as(unit: str, other: str) -> bool:
    """Whether a unit is of a quantity that the other one is of, as far as that is known."""

    def takes(kind: Kind) -> bool:
        with suppress(NotAQuantity):
            to_si(f"1 {unit}", kind)
            return True
        return False

    kinds = list(_kinds_with(other))
    return not kinds or any(map(takes, kinds))


def _kinds_with(unit: str) -> Iterator[Kind]:
    """Kinds of quantities of which a unit may be."""
    if unit in _TEMPERATURES:
        yield TEMPERATURE_KIND
    for name, units in COMMON_UNITS.items():
        if unit in units:
            yield Kind(name, _si_of(name), f"1 {unit}")


def _si_of(name: str) -> str:
    return next(unit for unit, factor in COMMON_UNITS[name].items() if factor == 1.0)


def as_toml(value: Any) -> str:
    """A value as TOML writes it in one line; a text without its quotes where it needs none."""
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(name)} = {_in_line(each)}" for name, each in value.items()) + "}"
    return _in_line(value)


def _in_line(value: Any) -> str:
    if isinstance(value, dict):
        return as_toml(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_in_line, value))}]"
    return tomli_w.dumps({"v": value}).removeprefix("v = ").strip()


def _key(name: str) -> str:
    return name if re.fullmatch(r"[\w-]+", name, re.ASCII) else json.dumps(name, ensure_ascii=False)


def label_of(key: str) -> str:
    """What a key is called: its name as words."""
    words = key.replace("_", " ")
    return words[:1].upper() + words[1:]


def is_first(name: str) -> bool:
    """Whether a key is among those that a designer changes first."""
    return name in _FIRST
