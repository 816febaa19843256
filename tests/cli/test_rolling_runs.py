"""The gear with rolling elements on the command line: run, show, plot, check, and mistakes."""

import json
from pathlib import Path

import pytest

from tests.support.verbs import complaint, invoke
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


@pytest.mark.parametrize("name", ["irefc", "irefc-as-published"])
def test_every_output_says_the_mode(folder, name):
    mode = "corrected" if name == "irefc" else "as_published"
    assert f"Mode {mode}" in invoke("show", folder / f"{name}.h5")
    shown = json.loads(invoke("show", folder / f"{name}.h5", "--json"))
    assert shown["summary"]["mode"] == shown["scenario"]["mode"] == mode
    checked = json.loads(invoke("check", name, "--json"))
    assert checked["mode"] == mode
    assert checked["geometry"]["teeth of the cam"] == [25, ""]
    assert checked["geometry"]["eccentricity"] == [pytest.approx(0.040 / 26), "m"]


def test_figures_that_a_record_does_not_hold_are_refused(folder):
    position = folder / "irefc-as-published.h5"
    assert "holds a single position" in complaint("plot", position, "efficiency")
    assert "no such figure" in complaint("plot", folder / "irefc.h5", "film")
