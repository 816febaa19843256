"""Names from installed packages: sound ones, broken ones, those that are offered twice."""

import logging
from fractions import Fraction
from types import SimpleNamespace

import pytest

from tribodyn.errors import InputError
from tribodyn.numerics.registry import FROM_PYTHON, Registry


class Thing(SimpleNamespace):
    """What the registry lists; `shipped` is of this module as a place names it."""


SHIPPED = Thing(name="shipped")


def broken():
    raise ModuleNotFoundError("No module named\n'absent'")


def entry(name, package, load):
    return SimpleNamespace(name=name, dist=SimpleNamespace(name=package), value=f"{package}:x", load=load)


@pytest.fixture
def registry(monkeypatch):
    offered = [
        entry("shipped", "thief", lambda: Thing(name="shipped")),
        entry("sound", "good", lambda: Thing(name="sound")),
        entry("broken", "bad", broken),
        entry("twice", "one-package", lambda: Thing(name="twice")),
        entry("twice", "other-package", lambda: Thing(name="twice")),
        entry("half", "careless", lambda: Fraction(1, 2)),
        entry("misnamed", "careless", lambda: Thing(name="other")),
    ]
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: offered if group == "things" else [])
    return Registry("table.thing", "thing", {"shipped": f"{__name__}:SHIPPED"}, "things", Thing)


def test_a_shipped_name_cannot_be_taken(registry):
    assert registry["shipped"] is SHIPPED
    assert registry["sound"].name == "sound"
    assert list(registry) == ["shipped", "broken", "half", "misnamed", "sound", "twice"]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        (
            "broken",
            "the package bad that offers it cannot be loaded: ModuleNotFoundError: No module named 'absent'",
        ),
        ("twice", "offered more than once, by one-package and other-package"),
        ("half", "careless offers a Fraction, expected a Thing"),
        ("misnamed", 'careless offers it by this name, but it calls itself "other"'),
        ("soundd", 'did you mean "sound"'),
        (f"{FROM_PYTHON}sound", "handed over from Python"),
    ],
)
def test_what_cannot_be_had_is_one_line(registry, name, said):
    with pytest.raises(InputError) as caught:
        registry[name]
    assert said in str(caught.value)
    assert str(caught.value).startswith(f'table.thing = "{name}"')
    assert "\n" not in str(caught.value)


def test_a_walk_leaves_out_what_cannot_be_had_and_says_so_once(registry, caplog):
    with caplog.at_level(logging.WARNING):
        for _ in range(2):
            assert [name for name, _ in registry.items()] == ["shipped", "sound"]
    assert len(caplog.records) == 4
    assert sum("package bad" in record.getMessage() for record in caplog.records) == 1


def test_a_part_that_fails_is_left_out_too(registry, caplog):
    """Of a package's things; an error of this package's own is raised."""

    def part_of(name):
        def part(thing):
            if thing.name == name:
                raise InputError("table.thing", name, "no part")
            return thing.name

        return part

    assert dict(registry.each(part_of("sound"))) == {"shipped": "shipped"}
    assert "no part" in caplog.text
    with pytest.raises(InputError, match="no part"):
        dict(registry.each(part_of("shipped")))
