"""What a REXS file holds: components with attributes, relations between them, load cases."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

#: A text of XML, or what JSON has; None: nothing, or a matrix, which nobody here reads.
Value = str | float | bool | tuple[str | float | bool, ...] | None
#: Versions that are read.
FIRST, LAST = (1, 0), (2, 0)


class Attribute(NamedTuple):
    """A value with its unit."""

    name: str
    unit: str | None
    value: Value


@dataclass(frozen=True, eq=False)
class Component:
    """A component: a part of the gearbox, or what one of them is made of."""

    number: int
    type: str
    name: str = ""
    attributes: Mapping[str, Attribute] = field(default_factory=dict)
    case: str = ""  # of which load case its values are

    def __str__(self) -> str:
        """How messages call it."""
        named = f" '{self.name}'" if self.name else ""
        return f"{self.type}{named} (id {self.number})"


class RelatedPart(NamedTuple):
    """A part in a relation."""

    role: str
    number: int


class Relation(NamedTuple):
    """How parts belong together."""

    number: int
    type: str
    refs: tuple[RelatedPart, ...]
    order: int = 0

    def part(self, role: str) -> int | None:
        """The id of the part in a role."""
        return next((ref.number for ref in self.refs if ref.role == role), None)


class LoadCase(NamedTuple):
    """Values of parts under one load."""

    name: str
    parts: tuple[Component, ...]


@dataclass(frozen=True)
class RexsModel:
    """A file."""

    version: str
    application: str
    parts: Mapping[int, Component]
    relations: tuple[Relation, ...]
    cases: tuple[LoadCase, ...] = ()
    accumulated: tuple[Component, ...] = ()

    def of_type(self, *types: str) -> Iterator[Component]:
        """Go through the parts of some types, as the file has them."""
        return (part for part in self.parts.values() if part.type in types)

    def related(self, kind: str, role: str, number: int, wanted: str, *types: str) -> list[Component]:
        """Parts in the role `wanted` of relations with the part `number` in another role, by their order.

        `kind` is the relation's type, or what it ends with: an "ordered_assembly" is an "assembly" too.
        """
        found = [*self._relations.get((kind, role, number), ())]
        found += self._relations.get((f"ordered_{kind}", role, number), ())
        parts = [
            self.parts[ref.number]
            for each in sorted(found, key=_order)
            for ref in each.refs
            if ref.role == wanted
        ]
        return [part for part in parts if not types or part.type in types]

    @cached_property
    def _relations(self) -> dict[tuple[str, str, int], list[Relation]]:
        """Relations by type, and a role with the part in it."""
        found: dict[tuple[str, str, int], list[Relation]] = {}
        for relation in self.relations:
            for role, number in set(relation.refs):
                found.setdefault((relation.type, role, number), []).append(relation)
        return found


def _order(relation: Relation) -> int:
    return relation.order
