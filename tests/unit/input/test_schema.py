"""Keys through tables that are held by name and in lists."""

from typing import Annotated, Any

import pytest

from tribodyn.input.messages import keys_in
from tribodyn.input.quantity import FamilyShape, Table, csv_file, defaults_written_out, model_file, written
from tribodyn.input.schema import expanded, family_shapes, matches, references, table_at
from tribodyn.input.vary import is_whole
from tribodyn.studies import STUDIES


class Inner(Table):
    """The innermost table."""

    number: int = 3
    curve: Annotated[dict | None, csv_file("x", "y")] = None


class Named(Table):
    """Held by name."""

    inner: Inner = written({})
    solid: Annotated[Inner | None, model_file("materials")] = None


class Listed(Table):
    """Held in a list."""

    family: str = "involute"
    shape: Annotated[dict[str, Any] | None, FamilyShape()] = None
    inner: Inner = written({})


class Outer(Table):
    """The whole."""

    named: dict[str, Named] = written({})
    listed: tuple[Listed, ...] = ()
    either: Inner | tuple[Listed, ...] = ()


def test_patterns_of_keys_that_name_files():
    assert set(references(Outer)) == {
        ("named", "*", "inner", "curve"),
        ("named", "*", "solid"),
        ("named", "*", "solid", "curve"),
        ("listed", "*", "inner", "curve"),
        ("either", "curve"),
        ("either", "*", "inner", "curve"),
    }
    assert family_shapes(Outer) == (("listed", "*", "shape"), ("either", "*", "shape"))


def test_a_pattern_stands_for_what_the_data_hold():
    data = {"named": {"a": {}, "b": 3}, "listed": [{}, {}]}
    assert list(expanded(("named", "*", "solid"), data)) == [("named", "a", "solid"), ("named", "b", "solid")]
    assert list(expanded(("listed", "*", "inner"), data)) == [("listed", 0, "inner"), ("listed", 1, "inner")]
    assert list(expanded(("either", "*", "inner"), data)) == []
    assert list(expanded(("drive",), data)) == [("drive",)]
    assert matches(("listed", "*", "inner"), ("listed", 1, "inner"))
    assert not matches(("listed", "*", "inner"), ("listed", 1))


@pytest.mark.parametrize(
    ("key", "table"),
    [
        (("named", "solid"), Named),  # a name like a key's
        (("named", "a", "inner"), Inner),
        (("named", "a", "number"), None),
        (("listed", 3), Listed),
        (("listed", 3, "inner"), Inner),
        (("either",), Inner),
        (("either", 0), Listed),
        (("either", 0, "inner"), Inner),
        ((), Outer),
    ],
)
def test_the_table_that_a_key_leads_to(key: tuple, table: type | None):
    assert table_at(Outer, key) is table


def test_keys_for_the_command_line():
    assert keys_in(Outer, ()) == ["named.", "listed.", "either."]
    assert keys_in(Outer, ("named",)) == []
    assert keys_in(Outer, ("named", "a")) == ["named.a.inner.", "named.a.solid."]


def test_defaults_of_tables_by_name():
    assert defaults_written_out({"named": {"a": {}}}, Outer)["named"] == {"a": {"inner": {"number": 3}}}


def test_the_table_of_a_list_that_has_the_key():
    """Of the sorts of stages a planetary one has planets."""
    table = STUDIES["gear-train"].table()
    assert is_whole(table, "stage.0.planets")
    assert not is_whole(table, "stage.0.module")
