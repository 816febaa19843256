"""Values put into the text of a scenario, comments kept: into tables, lists of tables, and models' tables."""

from collections.abc import Mapping, MutableMapping
from pathlib import Path
from typing import Any, NamedTuple

import tomlkit
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, InlineTable

from tribodyn.errors import InputError, quoted
from tribodyn.input.messages import Key, value_at
from tribodyn.input.names import named_in
from tribodyn.input.quantity import LIKE, Reference, Table
from tribodyn.input.schema import fields_of, matches, references, table_at
from tribodyn.input.sources import find_model, read_toml


class Models(NamedTuple):
    """A scenario's data, defaults in, its schema, and where it lies: what stands in the models it names."""

    data: Mapping[str, Any]
    table: type[Table]
    path: Path

    def begun(self, key: Key) -> dict[str, Any]:
        """What a table at a key begins with that the scenario does not write out: its model, or defaults."""
        name = self.raw(key)
        if isinstance(name, str):
            self.require_model(key, name)
            return {LIKE: name}
        field = fields_of(table_at(self.table, key[:-1])).get(str(key[-1]))
        default = None if field is None else field.get_default(call_default_factory=True)
        return dict(default) if isinstance(default, dict) else {}

    def require_model(self, key: Key, name: str) -> None:
        """Raise InputError where a text is not the name of a model, such as a CSV file's."""
        if self._mark(key) is None:
            dotted = ".".join(map(str, key))
            rule = f"{dotted} is {quoted(name)}, whose values are changed there"
            raise InputError(dotted, quoted(name), rule, "edit that file, or write the table out")

    def raw(self, key: Key) -> Any:
        """What stands at a key as it is written, in the scenario or in a model on the way; else None."""
        here: Any = self.data
        file = self.path
        for depth, part in enumerate(key, start=1):
            here = value_at(here, (named_in(here, part) if isinstance(here, dict) else part,))
            mark = self._mark(key[:depth])
            name = here if isinstance(here, str) else value_at(here, (LIKE,))
            if depth < len(key) and mark is not None and isinstance(name, str):
                file = find_model(name, mark.folder, ".".join(map(str, key[:depth])), file)
                here = {**read_toml(file), **(here if isinstance(here, dict) else {})}
        return here

    def _mark(self, key: Key) -> Reference | None:
        """What model the value at a key may name."""
        marks = references(self.table).items()
        return next((mark for pattern, mark in marks if mark.folder and matches(pattern, key)), None)


def with_values(text: str, values: Mapping[Key, Any], models: Models) -> str:
    """The text of a scenario with values put in, all else as it is; see `put`."""
    document = tomlkit.parse(text)
    for key, value in values.items():
        written_out(document, key, models)
        put(document, key, value, models)
    return tomlkit.dumps(document)


def put(document: MutableMapping[str, Any], key: Key, value: Any, models: Models) -> None:
    """Put a value in; tables on the way are made, models on the way become tables that are like them.

    The document may be plain data: tomlkit takes minutes for many numbers. Raises InputError where the key
    leads to no table.
    """
    place: Any = document
    for depth, part in enumerate(key[:-1], start=1):
        inner = _inside(place, part)
        if inner is None or isinstance(inner, str):
            if isinstance(part, int):
                raise _no_table(key, depth, value, place)
            if inner is not None:
                models.require_model(key[:depth], str(inner))
            begun = models.begun(key[:depth])
            inner = _empty_table(place)
            inner.update(begun)
            _replace(place, str(part), inner)
            inner = place[part]
        place = inner
    last = key[-1]
    try:
        if isinstance(place, MutableMapping):
            _replace(place, str(last), value)
        elif isinstance(place, list) and isinstance(last, int) and last < len(place):
            place[last] = value
        else:
            raise _no_table(key, len(key), value, place)
    except (TOMLKitError, ValueError, TypeError):
        raise InputError(".".join(map(str, key)), None, "no value that TOML has", "write another") from None


def _empty_table(place: Any) -> MutableMapping[str, Any]:
    """A table as the one that it is to stand in: plain data stay plain."""
    if type(place) is dict:
        return {}
    return tomlkit.inline_table() if isinstance(place, InlineTable) else tomlkit.table()


def _inside(place: Any, part: str | int) -> Any:
    """What stands in a table or a list; None: nothing."""
    if isinstance(place, MutableMapping):
        return place.get(str(part))
    if isinstance(place, list) and isinstance(part, int) and part < len(place):
        return place[part]
    return None


def _replace(place: MutableMapping[str, Any], name: str, value: Any) -> None:
    """Put a value into a table; a table that takes the place of a plain value stands behind all values."""
    before = place.get(name)
    is_table = isinstance(value, MutableMapping) and not isinstance(value, InlineTable)
    if is_table and before is not None and not isinstance(before, (MutableMapping, AoT)):
        comment = before.trivia.comment if hasattr(before, "trivia") else ""
        place.pop(name)
        if comment and LIKE in value:
            value[LIKE].comment(comment.lstrip("# "))
    place[name] = value


def _no_table(key: Key, depth: int, value: Any, place: Any) -> InputError:
    """What to say of a key that leads to no table."""
    above, dotted = ".".join(map(str, key[: depth - 1])), ".".join(map(str, key))
    if isinstance(place, list):
        rule = f"there is no {above}.{key[depth - 1]}: {above} has {len(place)}, counted from 0"
        return InputError(dotted, quoted(value), rule, "add a table first")
    rule = f"{above} is not a table"
    return InputError(dotted, quoted(value), rule, "see the keys with: tribodyn schema")


def written_out(document: MutableMapping[str, Any], key: Key, models: Models) -> None:
    """Write the lists of tables out that a key leads into, where only a model has them."""
    for depth, part in enumerate(key):
        if isinstance(part, int) and value_at(document, key[:depth]) is None:
            rows = models.raw(key[:depth])
            if isinstance(rows, list) and rows:
                put(document, key[:depth], rows, models)


def taken_out(document: MutableMapping[str, Any], key: Key) -> bool:
    """Take out what is written at a key; False: nothing is."""
    place: Any = document
    for part in key[:-1]:
        place = _inside(place, part)
    last = key[-1]
    if _inside(place, last) is None:
        return False
    if isinstance(place, list):
        del place[int(last)]
        if not place:
            taken_out(document, key[:-1])
    else:
        place.pop(str(last))
    return True


def table_added(document: MutableMapping[str, Any], key: Key, table: Mapping[str, Any]) -> int:
    """Add a table to a list of tables; return its number, from 0."""
    place: Any = document
    for part in key[:-1]:
        place = _inside(place, part)
    tables = _inside(place, key[-1])
    new = tomlkit.table()
    new.update(table)
    tables.append(new if isinstance(tables, AoT) else dict(table))
    return len(tables) - 1
