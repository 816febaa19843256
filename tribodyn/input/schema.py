"""What a schema says of a key: the table that it leads to, and the keys that may name files.

A table may hold others by name (``gear.NAME.teeth``) or in a list (``stage.0.module``); in patterns of keys
`EACH` stands for their names and places.
"""

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any, NamedTuple, get_args, get_origin

from pydantic import BaseModel, Tag
from pydantic.fields import FieldInfo

from tribodyn.input.quantity import FamilyShape, Reference

#: In a pattern of a key: any name or place.
EACH = "*"


class Inner(NamedTuple):
    """A table inside a field, and how the field holds it."""

    table: type[BaseModel]
    held: type | None  # None: itself; dict: by name; tuple: in a list


def inner_tables(annotation: Any, held: type | None = None) -> Iterator[Inner]:
    """Go through the tables in an annotation such as ``Table | tuple[Other, ...]``."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield Inner(annotation, held)
        return
    origin = get_origin(annotation)
    for part in get_args(annotation):
        yield from inner_tables(part, origin if origin in (dict, tuple) else held)


def fields_of(table: type[BaseModel] | None) -> dict[str, FieldInfo]:
    """Fields of a table by all names that a scenario may give them; none of no table."""
    if table is None:
        return {}
    fields = table.model_fields
    other: Mapping[str, str] = getattr(table, "other_names", {})
    return {**fields, **{name: fields[own] for name, own in other.items() if own in fields}}


def table_at(
    model: type[BaseModel], key: Iterable[str | int], wanted: str | int | None = None
) -> type[BaseModel] | None:
    """Return the table that a key leads to; None where it leads to none.

    Of a list that takes several sorts of tables it is the first one that has the next name of the key, or
    the name that is `wanted` in it.
    """
    key, place = tuple(key), 0
    while place < len(key):
        if isinstance(key[place], int):
            place += 1
            continue
        name = str(key[place])
        inner, place = _step(model, key, place, wanted)
        if inner is None:
            return None
        # of a union the branch that pydantic names, (tag) behind the place in the list
        branch = next((str(part) for part in key[place : place + 2] if str(part).startswith("(")), None)
        if branch is not None:
            place += key[place : place + 2].index(branch) + 1
            inner = tagged(fields_of(model)[name].annotation, branch) or inner
        model = inner
    return model


def tagged(annotation: Any, tag: str) -> type[BaseModel] | None:
    """The table in an annotation that a tag marks; None: there is none."""
    for part in get_args(annotation):
        if any(isinstance(mark, Tag) and mark.tag == tag for mark in get_args(annotation)):
            return next((inner.table for inner in inner_tables(annotation)), None)
        if (table := tagged(part, tag)) is not None:
            return table
    return None


def holds_by_name(model: type[BaseModel], key: Iterable[str | int]) -> bool:
    """Whether a key leads to tables that are held by name, and not to one of them."""
    *above, last = key
    if isinstance(last, int):
        return False
    table = table_at(model, above)
    field = fields_of(table).get(last)
    return field is not None and any(inner.held is dict for inner in inner_tables(field.annotation))


def _step(
    model: type[BaseModel], key: tuple[str | int, ...], place: int, wanted: str | int | None
) -> tuple[Any, int]:
    """The table that a part of a key leads to, and the place after it and after a name that follows it."""
    name = str(key[place])
    following = key[place + 1] if place + 1 < len(key) else None
    if (field := fields_of(model).get(name)) is not None:
        inner_models = list(inner_tables(field.annotation))
    else:
        extra = extra_table(model)
        return (extra, place + 1)
    in_list = [inner for inner in inner_models if inner.held is tuple]
    if in_list and (isinstance(following, int) or len(in_list) == len(inner_models)):
        after = next((part for part in (*key[place + 1 :], wanted) if not isinstance(part, int)), None)
        fitting = [inner.table for inner in in_list if after in inner.table.model_fields]
        return (*fitting, in_list[0].table)[0], place + 1
    for inner in inner_models:
        if inner.held is not tuple:
            return inner.table, place + 1 + (inner.held is dict and following is not None)
    return None, place + 1


def extra_table(model: type[BaseModel]) -> type[BaseModel] | None:
    """The table of keys that a table does not name, where it has any."""
    annotation = model.__annotations__.get("__pydantic_extra__")
    return next((inner.table for inner in inner_tables(annotation)), None)


Mark = Reference | FamilyShape


@lru_cache(maxsize=256)
def references(table: type[BaseModel]) -> Mapping[tuple[str, ...], Reference]:
    """Return the keys of a table, and of the tables in it, that may name files; from the outside in."""
    return {key: mark for key, mark in _marked(table) if isinstance(mark, Reference)}


@lru_cache(maxsize=256)
def family_shapes(table: type[BaseModel]) -> tuple[tuple[str, ...], ...]:
    """Return the keys of the tables that hold what a family of teeth needs, with a `family` beside them."""
    return tuple(key for key, mark in _marked(table) if isinstance(mark, FamilyShape))


def _marked(table: type[BaseModel]) -> list[tuple[tuple[str, ...], Mark]]:
    marks: list[tuple[tuple[str, ...], Mark]] = []
    for name, field in fields_of(table).items():
        marks += [((name,), mark) for mark in parts_of(field) if isinstance(mark, (Reference, FamilyShape))]
        for inner in inner_tables(field.annotation):
            above = (name,) if inner.held is None else (name, EACH)
            marks += [((*above, *key), mark) for key, mark in _marked(inner.table)]
    return marks


def expanded(pattern: tuple[str, ...], data: Any) -> Iterator[tuple[str | int, ...]]:
    """Go through the keys of a scenario's data that a pattern stands for; without `EACH` the key itself."""
    if EACH not in pattern:
        yield pattern
        return
    place = pattern.index(EACH)
    for part in pattern[:place]:
        data = data.get(part) if isinstance(data, dict) else None
    inside: list[tuple[str | int, Any]] = []
    if isinstance(data, dict):
        inside = list(data.items())
    elif isinstance(data, list):
        inside = list(enumerate(data))
    for name, value in inside:
        for rest in expanded(pattern[place + 1 :], value):
            yield (*pattern[:place], name, *rest)


def matches(pattern: tuple[str, ...], key: Iterable[str | int]) -> bool:
    """Whether a key is one that a pattern stands for."""
    parts = tuple(map(str, key))
    return len(parts) == len(pattern) and all(
        expected in (EACH, part) for expected, part in zip(pattern, parts, strict=True)
    )


def parts_of(field: Any) -> Iterator[Any]:
    """Go through everything that stands in a field's annotation, metadata included."""

    def parts(annotation: Any) -> Iterator[Any]:
        yield annotation
        for part in (*getattr(annotation, "__args__", ()), *getattr(annotation, "__metadata__", ())):
            yield from parts(part)

    yield from field.metadata
    yield from parts(field.annotation)
