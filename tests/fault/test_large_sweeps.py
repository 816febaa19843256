"""Sweeps that take too much are refused before anything is made, with what they take."""

from importlib import import_module
from pathlib import Path

import pytest

from tests.support.verbs import complaint
from tribodyn.grid.engines import LocalEngine
from tribodyn.grid.grid import Grid
from tribodyn.grid.plan import estimate_of
from tribodyn.grid.run import run, settings_of
from tribodyn.record.sweep_reader import SweepRecord

SPEEDS = "operating.pinion_speed=100:300:100rad/s"
SAMPLES = "output.samples_per_cycle"
TORQUES = "operating.gear_torque=1:1000/1000 N*m"
CASES = {
    "cases": ([*("--vary", "operating.pinion_speed=1:1100/1100rad/s"), "--vary", TORQUES], "--vary"),
    "samples": (["--vary", SPEEDS, "--set", f"{SAMPLES}=1000000000000"], SAMPLES),
    "marches": (["--vary", "operating.pinion_speed=1:3:1rad/s", "--transient", "1000000000"], "--transient"),
}


@pytest.mark.parametrize("name", CASES)
def test_a_sweep_that_takes_too_much(name: str, tmp_path: Path):
    words, key = CASES[name]
    said = complaint("sweep", "crc-23-47", *words, "-o", tmp_path / "s.h5")
    assert said.startswith(key)
    assert "of memory, a record of" in said
    assert "--allow-large" in said
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("samples", [40, 1000])
def test_the_record_of_a_sweep_is_what_was_said(
    samples: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    grid = Grid("crc-23-47", [SPEEDS], {"output.samples_per_cycle": samples})
    settings = settings_of(grid, transient=8)
    said = estimate_of(grid, settings, 0)
    monkeypatch.setattr(import_module("tribodyn.grid.plan"), "MOST_CASES", 2)
    result = run(grid, settings, LocalEngine(), tmp_path / "s.h5", allow_large=True)
    with SweepRecord(result.path) as record:
        assert record.summary["cases"] == 3
    assert 0.5 < result.path.stat().st_size / said.record < 2.0
