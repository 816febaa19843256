"""docs/scenario.md has every key, with the unit, the default and an example that the schema takes."""

import re
import tomllib
import typing
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError
from pydantic.fields import FieldInfo

from tribodyn.geometry.families import FAMILIES
from tribodyn.input.quantity import Column, InUnit, Reference, Table
from tribodyn.solve.methods import SOLVERS
from tribodyn.studies import STUDIES
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS

PAGE = (Path(__file__).parents[3] / "docs" / "scenario.md").read_text(encoding="utf-8")


def parts(annotation: Any) -> list[Any]:
    """Everything that stands in an annotation, its own metadata included."""
    found = [annotation]
    for inner in (*typing.get_args(annotation), *getattr(annotation, "__metadata__", ())):
        found += parts(inner)
    return found


def inside(field: FieldInfo, kind: type) -> list[Any]:
    return [part for part in (*field.metadata, *parts(field.annotation)) if isinstance(part, kind)]


def tables(table: type[Table]) -> dict[str, type[Table]]:
    """The table and all tables below it, by name."""
    found = {table.__name__: table}
    for field in table.model_fields.values():
        for part in parts(field.annotation):
            if isinstance(part, type) and issubclass(part, Table) and part is not Column:
                found |= tables(part)
    return found


TABLES = {name: table for _, study in STUDIES.items() for name, table in tables(study.table()).items()}


def own(name: str) -> list[str]:
    """Keys of a table that it does not have from another table of the page."""
    table = TABLES[name]
    above = [base for base in table.__mro__[1:] if TABLES.get(base.__name__) is base]
    known = {key for base in above for key in base.model_fields}
    return [key for key in table.model_fields if key not in known or key in table.__annotations__]


KEYS = [(table, key) for table in TABLES for key in own(table)]


def rows(table: str) -> dict[str, list[str]]:
    """Cells by key of the page's table of that name."""
    _, found, rest = PAGE.partition(f"<!-- keys of {table} -->\n")
    assert found, f"docs/scenario.md has no table of {table}"
    lines = rest.partition("\n\n")[0].splitlines()[2:]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
    return {key.strip("`"): others for key, *others in cells}


@pytest.mark.parametrize("table", TABLES)
def test_page_and_schema_have_the_same_keys(table: str):
    assert set(own(table)) <= set(rows(table)) <= set(TABLES[table].model_fields)


@pytest.mark.parametrize(("table", "key"), KEYS)
def test_a_key_is_described(table: str, key: str):
    field = TABLES[table].model_fields[key]
    meaning, value, default, _ = rows(table)[key]
    assert len(meaning) > 0
    kinds = [quantity.kind.name for quantity in inside(field, InUnit)]
    if kinds and typing.get_origin(field.annotation) is tuple:
        assert value == f"list of {kinds[0]}s"
    elif kinds:
        assert value == kinds[0]
    elif inside(field, Reference):
        assert value in ("reference", "CSV")
    if field.is_required():
        assert default == "required"
    else:
        written = field.get_default(call_default_factory=True)
        expected = list(written) if isinstance(written, tuple) else written
        assert (default == "–") if written is None else (toml(default) == expected)


@pytest.mark.parametrize(("table", "key"), KEYS)
def test_its_example_is_taken(table: str, key: str):
    """By the schema of the key itself; what names a file is another test's matter."""
    field = TABLES[table].model_fields[key]
    example = toml(rows(table)[key][3])
    if inside(field, Reference) and isinstance(example, str):
        return
    try:
        TABLES[table].model_validate({key: example})
    except ValidationError as error:
        # the other keys are missing; nothing may be wrong with this one, save references left as names
        wrong = [e for e in error.errors() if e["loc"][:1] == (key,) and e["type"] != "missing"]
        assert not [e for e in wrong if not (e["type"] == "model_type" and e["loc"][-1] == "material")]


def toml(cell: str) -> Any:
    return tomllib.loads(f"value = {cell.strip('`')}")["value"]


@pytest.mark.parametrize("name", [*FILM_LAWS, *FRICTION_LAWS, *FAMILIES, *SOLVERS])
def test_every_name_is_on_the_page(name: str):
    assert f"`{name}`" in PAGE
