"""The gear with rolling elements on the command line: run, show, plot, check, and mistakes."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from tribodyn.cli.app import app
from tribodyn.record.reader import open_record
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


def test_a_record_holds_a_revolution_of_every_element(folder):
    with open_record(folder / "irefc.h5") as record:
        assert record.kind == "irefc"
        assert record.elements == tuple(range(1, 27))
        assert record.pairs == ()
        assert record["normal_load"].shape == (27 * 40 + 1, 26)
        assert record["time"][-1] == pytest.approx(0.04)  # 1500 rpm
        assert record.units("slip_speed") == "m/s"
        assert (record["normal_load"].max(axis=0) > 900).all()  # each has its turn
        assert "displacement" not in record
        lost = record["power_cam"].sum(axis=1) + record["power_crown"].sum(axis=1)
        assert record["power_friction"] == pytest.approx(lost)
        # by energy over the revolution, the last sample being the first of the next
        work = {name: np.sum(record[name][:-1]) for name in ("power_in", "power_out")}
        assert record.summary["efficiency"] == pytest.approx(work["power_out"] / work["power_in"])


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


MISTAKES = {
    "two elements": ("drive.elements=2", "drive.elements = 2", "too few", "use 3 or more"),
    "overlap": ('drive.element_radius="3.4 mm"', "drive.element_radius = 3.4 mm", "overlap", "3.375 mm"),
    "undercut": ('drive.element_radius="5 mm"', "drive.element_radius = 5 mm", "undercut", "3.375 mm"),
    "no room": ("drive.elements=80", "drive.element_radius = 2 mm", "overlap", "fewer elements"),
    "on the pitch circle": ("drive.displacement=1.0", "drive.displacement = 1.0", "cusps", "more than 1"),
    "locked by rolling": ('friction.rolling_arm="2 mm"', "friction.rolling_arm = 2 mm", "locks", "1.04 mm"),
    "locked by sliding": ("friction.sliding_coefficient=90", "friction.sliding_coefficient", "locks", "16.2"),
    "key of a gear pair": ("solver.cycles=2", "solver", "unknown key", "known keys"),
    "drive of a gear pair": ('drive="liu-ni-crc-23-47"', "drive.pitch_radius", "missing", "20 mm"),
}


@pytest.mark.parametrize("verb", ["check", "run"])
@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=list(MISTAKES))
def test_a_mistake_gives_one_clear_line_each(mistake, verb, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    setting, key, rule, remedy = mistake
    lines = said(verb, "irefc", "--set", setting, status=2).splitlines()
    (line,) = [line for line in lines if key in line]
    assert rule in line
    assert remedy in line
    assert not list(tmp_path.iterdir())
