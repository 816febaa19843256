"""docs/scenario.md is made of the schema: every key has a meaning, and an example that the schema takes."""

import re
import tomllib
from typing import Any

import pytest
from pydantic import ValidationError

from tools.scenario_page import PAGE, every_table, inside, own_keys, page
from tribodyn.geometry.families import FAMILIES
from tribodyn.input.quantity import Reference, meaning, meanings
from tribodyn.solve.methods import SOLVERS
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS

TEXT = PAGE.read_text(encoding="utf-8")
TABLES = every_table()
#: Keys in tables of examples that name files.
FILES = ("material", "matrices", "torque_table", "table")


def test_the_page_is_what_the_schema_makes_of_it():
    """``python -m tools.scenario_page --write`` after a change of a key."""
    assert page(TEXT) == TEXT


def test_every_key_has_a_meaning():
    keys = [
        (table, field.alias or key) for table in TABLES.values() for key, field in table.model_fields.items()
    ]
    assert [f"{table.__name__}.{key}" for table, key in keys if not meaning(table, key)] == []


def test_every_meaning_is_of_a_key():
    used = {
        (base.__name__, field.alias or key)
        for table in TABLES.values()
        for base in table.__mro__
        for key, field in table.model_fields.items()
    }
    listed = {(table, key) for table, keys in meanings().items() for key in keys}
    assert listed - used == set()


def rows(table: str) -> dict[str, list[str]]:
    """Cells by key of the page's table of that name."""
    lines = TEXT.partition(f"<!-- keys of {table} -->\n")[2].partition("\n\n")[0].splitlines()[2:]
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]
    return {key.strip("`"): others for key, *others in cells}


@pytest.mark.parametrize("name", TABLES)
def test_examples_are_taken(name: str):
    """By the schema of the key itself; what names a file is another test's matter."""
    table, cells = TABLES[name], rows(name)
    for key, field in own_keys(table, TABLES).items():
        alias = field.alias or key
        example = toml(cells[alias][3])
        if inside(field, Reference) and isinstance(example, str):
            continue
        try:
            table.model_validate({alias: example})
        except ValidationError as error:
            # the other keys are missing; nothing may be wrong with this one, save references left as names
            wrong = [e for e in error.errors() if e["loc"][:1] == (alias,) and e["type"] != "missing"]
            assert not [e for e in wrong if not (e["type"] == "model_type" and e["loc"][-1] in FILES)], key


def toml(cell: str) -> Any:
    return tomllib.loads("value = " + cell.strip("`").replace("\\|", "|"))["value"]


@pytest.mark.parametrize("name", [*FILM_LAWS, *FRICTION_LAWS, *FAMILIES, *SOLVERS])
def test_every_name_is_on_the_page(name: str):
    assert f"`{name}`" in TEXT
