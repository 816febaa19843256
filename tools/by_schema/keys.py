"""Every key that the schema of a kind knows: in lists and named tables, of laws and tooth families too."""

from collections.abc import Iterator
from typing import NamedTuple

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from tribodyn.geometry.families import FAMILIES
from tribodyn.input.quantity import FamilyShape
from tribodyn.input.schema import EACH, inner_tables, parts_of
from tribodyn.input.tables.laws import LawTable
from tribodyn.numerics.parameter import Parameter

Pattern = tuple[str, ...]


class Inside(NamedTuple):
    """A table on the way to a key, and how many parts of the key lead to it."""

    depth: int
    table: type[BaseModel]


class SchemaKey(NamedTuple):
    """A key; `EACH` stands for the names and places of tables that another holds."""

    pattern: Pattern
    field: FieldInfo | Parameter  # of a law or a family: what it says of its own key
    inside: tuple[Inside, ...]  # from the outside
    owner: str = ""  # the law or family whose key it is

    @property
    def holder(self) -> type[BaseModel]:
        """The table that it is a key of."""
        return self.inside[-1].table


def every_key(
    table: type[BaseModel], above: Pattern = (), on: tuple[Inside, ...] = ()
) -> Iterator[SchemaKey]:
    """Go through the keys of a table and of all tables in it; a key of several laws comes once for each."""
    on = (*on, Inside(len(above), table))
    for name, field in table.model_fields.items():
        key = (*above, name)
        yield SchemaKey(key, field, on)
        for inner in inner_tables(field.annotation):
            yield from every_key(inner.table, key if inner.held is None else (*key, EACH), on)
        if any(isinstance(mark, FamilyShape) for mark in parts_of(field)):
            for family in FAMILIES:
                for own in FAMILIES[family].parameters:
                    yield SchemaKey((*key, own.name), own, on, family)
    for inner in inner_tables(table.__annotations__.get("__pydantic_extra__")):
        yield from every_key(inner.table, (*above, EACH), on)
    if issubclass(table, LawTable):
        for name, law in table.laws.items():
            for own in law.keys:
                yield SchemaKey((*above, own.name), own, on, name)


def patterns(table: type[BaseModel]) -> tuple[Pattern, ...]:
    """Patterns of all keys of a table, each once."""
    return tuple(dict.fromkeys(key.pattern for key in every_key(table)))
