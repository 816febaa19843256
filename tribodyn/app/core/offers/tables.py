"""Tables added to a scenario: one more of a list, or one of a new name."""

import re
from collections.abc import Mapping
from typing import Any

from tribodyn.app.core.document import Document
from tribodyn.app.core.fields import type_of
from tribodyn.app.core.form import HeldTables
from tribodyn.errors import InputError, quoted

#: Names of tables that need no quotes.
_NAME = re.compile(r"[\w-]+")


def add_table(document: Document, held: HeldTables, name: str = "") -> str:
    """Add an empty table to a list, or one of a name, as the last one beside it is; return its key."""
    if not held.named:
        return document.append(held.path, {})
    if not _NAME.fullmatch(name):
        raise InputError("name", quoted(name), "not a name for a table", "write letters, digits, - and _")
    beside = document.value(held.path)
    beside = beside if isinstance(beside, Mapping) else {}
    if name in beside:
        raise InputError("name", quoted(name), f"is there already in {held.path}", "write another")
    alike = [one for one in beside.values() if isinstance(one, Mapping)]
    key = f"{held.path}.{name}"
    document.set(key, dict(alike[-1]) if alike else _required(held))
    return key


def copy_table(document: Document, key: str) -> str:
    """Add a table to a list as one of it is, under a name of its own; return its key."""
    path, _, number = key.rpartition(".")
    rows = document.rows(path)
    copied = dict(rows[int(number)])
    if "name" in copied:
        taken = {one.get("name") for one in rows}
        numbers = range(2, len(rows) + 3)
        copied["name"] = next(one for k in numbers if (one := f"{copied['name']}-{k}") not in taken)
    return document.append(path, copied)


def _required(held: HeldTables) -> dict[str, Any]:
    """The first key that a table must have, with an example: an empty table over a model says nothing."""
    for name, field in held.table.model_fields.items():
        if field.is_required():
            of = type_of(held.table, name, held.path)
            if value := (*of.choices, of.example)[0]:
                return {field.alias or name: value}
    return {}
