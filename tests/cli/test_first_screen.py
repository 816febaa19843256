"""Long answers begin with one screen; the rest is a name or `--full` away."""

import json

import pytest

from tests.support.verbs import ended, invoke

#: Lines of a usual window.
SCREEN = 50
REDUCER = "two-stage-reducer"


def test_a_list_of_everything_is_an_overview_of_sorts():
    brief, full, data = invoke("list"), invoke("list", "--full"), json.loads(invoke("list", "--json"))
    assert len(brief.splitlines()) <= SCREEN
    for sort, names in data.items():
        assert sort in brief
        assert all(name in full for name in names)
        assert str(len(names)) in brief


@pytest.fixture(scope="module")
def full() -> str:
    return invoke("check", REDUCER, "--full")


def test_a_train_begins_with_the_train(full: str):
    brief = invoke("check", REDUCER)
    assert len(brief.splitlines()) <= SCREEN
    assert "Gears, mesh first" not in brief
    assert "--full" in brief
    assert full.count("mesh first") > 5
    assert full.count("mesh second") >= 5


def test_a_mesh_or_a_word_names_what_is_shown(full: str):
    of_mesh = invoke("check", REDUCER, "first")
    assert "Gears, mesh first" in of_mesh
    assert "Gears, mesh second" not in of_mesh
    assert len(invoke("check", REDUCER, "campbell").splitlines()) < 25
    assert ended("check", REDUCER, "third").exit_code == 2
