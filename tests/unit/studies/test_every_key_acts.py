"""Every key of a scenario that is taken says something: another value makes another case, or is refused.

What keys of single teeth do to a motion, which may reach a case and end on a flank that nobody touches, is
the matter of `tests/cross/test_errors_of_teeth.py`.
"""

import dataclasses
import re
import tomllib
import typing
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel

from tribodyn.errors import InputError
from tribodyn.scenario.quantity import InUnit
from tribodyn.scenario.resolve import resolve_table
from tribodyn.scenario.schema import inner_tables
from tribodyn.scenario.sources import find_scenario
from tribodyn.studies.protocol.load import load_data, table_of

#: Pattern of a key that may leave the case as it is -> why.
NO_EFFECT = {
    r"(^|\.)(title|name|source|assumptions|kind)$": "says what the scenario is, and is left out below",
    r"\.(span_teeth|pin_diameter)$": "choose the dimension that the gear's sheet prints",
    r"^gear\..*\.quality$|^drive\.(pinion|gear)\.quality$": "tolerances of a pair need those of both gears",
}
#: What the case has of its own text.
_TEXT = ("toml", "sha256", "title", "name")


_QUANTITY = re.compile(r"^\s*([-+]?\d[\d.e+-]*)\s+(\S.*)$")


def leaves(model: type[BaseModel], data: dict[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple]:
    """Go through the keys of a table that hold no others: key, field, value as written or by default."""
    for name, field in model.model_fields.items():
        value = data.get(name, None if field.is_required() else field.get_default(call_default_factory=True))
        value = value.model_dump(exclude_unset=True) if isinstance(value, BaseModel) else value
        inner, key = list(inner_tables(field.annotation)), (*above, name)
        if inner and isinstance(value, dict):
            if inner[0].held is dict:
                for part, table in value.items():
                    yield from leaves(inner[0].table, table, (*key, part))
            else:
                names, fits = set(value), [one.table for one in inner if one.held is None]
                table = max(fits, key=lambda each, names=names: len(names & set(each.model_fields)))
                yield from leaves(table, value, key)
        elif inner and isinstance(value, list | tuple) and value and isinstance(value[0], dict):
            for place, table in enumerate(value):
                yield from leaves(inner[0].table, table, (*key, str(place)))
        else:
            yield key, field, value


def parts(annotation: Any) -> Iterator[Any]:
    """Go through an annotation and all that it is made of."""
    yield annotation
    for part in (*typing.get_args(annotation), *getattr(annotation, "__metadata__", ())):
        yield from parts(part)


def other_values(field: Any, value: Any) -> list[Any]:
    """Values that a key may have in place of its own."""
    found: list[Any] = []
    known = [*parts(field.annotation), *field.metadata]
    named = [a for part in known if typing.get_origin(part) is typing.Literal for a in typing.get_args(part)]
    number = _QUANTITY.match(value) if isinstance(value, str) else None
    if isinstance(value, bool):
        found = [not value]
    elif named:
        found = named
    elif isinstance(value, int):
        found = [value + 1, value + 2, 2 * value]
    elif isinstance(value, float):
        found = [1.1 * value, 0.9 * value, 0.1]
    elif number and float(number[1]):
        found = [f"{factor * float(number[1])!r} {number[2]}" for factor in (1.05, 0.95, -1.0)]
    found += [unit.kind.example for unit in known if isinstance(unit, InUnit)]
    found += field.examples or []
    found += [
        f"{1.3 * float(q[1])!r} {q[2]}"
        for q in map(_QUANTITY.match, [each for each in found if isinstance(each, str)])
        if q
    ]
    return [each for each in (found or [3, 1, 0.5, True]) if each != value]


def comparable(value: Any) -> Any:
    """A case as plain data."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [field.name for field in dataclasses.fields(value) if field.name not in _TEXT]
        return {name: comparable(getattr(value, name)) for name in names}
    if isinstance(value, dict):
        return {name: comparable(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [comparable(each) for each in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


@pytest.mark.parametrize(
    "name",
    [
        "involute-18-36",
        "load-contact-18-36",
        "irefc",
        pytest.param("two-stage-reducer", marks=pytest.mark.soak),
        pytest.param("run-up", marks=pytest.mark.soak),
        pytest.param("wear-18-36", marks=pytest.mark.soak),
    ],
)
def test_a_key_that_is_taken_changes_the_case(name: str):
    path = find_scenario(name)
    written = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    data, _, errors = resolve_table(written, Path(path), {}, table_of)
    assert not errors
    plain = repr(comparable(load_data(written, name).case))
    idle, acting = [], 0
    for parts_of_key, field, value in leaves(table_of(data), data):
        key, taken, acts = ".".join(parts_of_key), False, False
        for other in other_values(field, value):
            try:
                case = load_data(written, name, {key: other}).case
            except InputError:
                continue
            taken = True
            if acts := repr(comparable(case)) != plain:
                break
        acting += acts
        if taken and not acts and not any(re.search(pattern, key) for pattern in NO_EFFECT):
            idle.append(f"{key} = {value!r}")
    assert idle == []
    assert acting >= 10
