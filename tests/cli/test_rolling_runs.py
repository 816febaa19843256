"""The gear with rolling elements on the command line: run, show, plot, check, and mistakes."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from tribodyn.cli.app import app
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """Records of both shipped scenarios."""
    folder = tmp_path_factory.mktemp("rolling")
    for name in ("irefc", "irefc-as-published"):
        shares: list[float] = []
        run(load_scenario(name), folder / f"{name}.h5", progress=shares.append)
        assert shares == sorted(shares)
        assert shares[-1] == 1.0
    return folder


def said(*arguments: object, status: int = 0) -> str:
    ended = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert ended.exit_code == status, ended.stderr
    return ended.stderr if status else ended.stdout


@pytest.mark.parametrize("name", ["irefc", "irefc-as-published"])
def test_every_output_says_the_mode(folder, name):
    mode = "corrected" if name == "irefc" else "as_published"
    assert f"Mode {mode}" in said("show", folder / f"{name}.h5")
    shown = json.loads(said("show", folder / f"{name}.h5", "--json"))
    assert shown["summary"]["mode"] == shown["scenario"]["mode"] == mode
    checked = json.loads(said("check", name, "--json"))
    assert checked["mode"] == mode
    assert checked["geometry"]["teeth of the cam"] == [25, ""]
    assert checked["geometry"]["eccentricity"] == [pytest.approx(40 / 26), "mm"]


def test_figures_that_a_record_does_not_hold_are_refused(folder):
    position = folder / "irefc-as-published.h5"
    assert "holds a single position" in said("plot", position, "efficiency", status=2)
    assert "no such figure" in said("plot", folder / "irefc.h5", "film", status=2)
