"""Long answers begin with one screen; the rest is a name or `--full` away."""

import json
from typing import Any

import pytest
from typer.testing import CliRunner

from tribodyn.cli.app import app

#: Lines of a usual window.
SCREEN = 50
REDUCER = "two-stage-reducer"


def said(*words: str) -> Any:
    return CliRunner().invoke(app, list(words))


def test_a_list_of_everything_is_an_overview_of_sorts():
    brief, full, data = said("list"), said("list", "--full"), json.loads(said("list", "--json").stdout)
    assert len(brief.stdout.splitlines()) <= SCREEN
    for sort, names in data.items():
        assert sort in brief.stdout
        assert all(name in full.stdout for name in names)
        assert str(len(names)) in brief.stdout


@pytest.fixture(scope="module")
def full() -> str:
    return said("check", REDUCER, "--full").stdout


def test_a_train_begins_with_the_train(full: str):
    brief = said("check", REDUCER).stdout
    assert len(brief.splitlines()) <= SCREEN
    assert "Gears, mesh first" not in brief
    assert "--full" in brief
    assert full.count("mesh first") > 5
    assert full.count("mesh second") >= 5


def test_a_mesh_or_a_word_names_what_is_shown(full: str):
    of_mesh = said("check", REDUCER, "first").stdout
    assert "Gears, mesh first" in of_mesh
    assert "Gears, mesh second" not in of_mesh
    assert len(said("check", REDUCER, "campbell").stdout.splitlines()) < 25
    unknown = said("check", REDUCER, "third")
    assert unknown.exit_code == 2
