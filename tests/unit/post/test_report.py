"""The summary of a record on the terminal and as JSON."""

import json
from pathlib import Path

import numpy as np
import pytest

from tests.support.record_samples import block, gear_pair_writer, geometry, printed
from tribodyn.cli.printing import plain
from tribodyn.record.reader import Record
from tribodyn.studies.pages import summary_json, summary_table

SUMMARY = {
    "contact_ratio": 1.6677,
    "mesh_frequency": 36.606,
    "stiffness_single_pair_at_pitch_point": 3.2e8,
    "transmission_error_mean": 2.2e-5,
    "transmission_error_normal_mean": 2.1e-5,
    "normal_load_max": 7850.0,
    "film_min": 0.9e-7,
    "hertz_pressure_max": 1.4e9,
    "friction_force_mean": np.array([150.0, 310.0]),
    "efficiency": 0.9868,
    "solver": "dopri5",
    "steps": 4200,
}


@pytest.fixture
def record(tmp_path: Path) -> Record:
    with gear_pair_writer(tmp_path / "run.h5", 9, outlines=geometry()) as writer:
        writer.write(0, block(0, 9))
        return Record(writer.finish(SUMMARY))


def figures(record: Record) -> str:
    return printed(summary_table(record, full=True))


def failed(path: Path, summary: dict) -> Record:
    with gear_pair_writer(path, 9, outlines=geometry()) as writer:
        writer.write(0, block(0, 4))
        return Record(writer.fail("stopped at t = 0.1 s: step too small", summary))


@pytest.mark.parametrize(
    "line",
    [
        ["Contact ratio", "1.6677"],
        ["Stiffness of one pair at the pitch point", "320", "N/µm"],
        ["Mesh frequency", "36.61", "Hz"],
        ["Transmission error, mean", "22", "µm"],
        ["Deflection along the normal, mean", "21", "µm"],
        ["Maximum normal load", "7,850", "N"],
        ["Minimum film thickness", "0.09", "µm"],
        ["Maximum Hertz pressure", "1.4", "GPa"],
        ["entering / leaving pair", "310.0 / 150.0", "N"],
        ["Efficiency", "98.68", "%"],
        ["Method", "dopri5"],
        ["Steps", "4,200"],
    ],
)
def test_figures_are_in_engineers_units(record: Record, line: list[str]):
    assert any(all(part in row for part in line) for row in figures(record).splitlines()), line


def test_a_law_that_no_contact_bears_out_is_said(tmp_path: Path):
    judged = {"low": 0.42, "median": 2.2, "high": 13.6, "limits": 0}
    summary = {"friction_law": "xu", "friction_judged": judged, "closure_in_range_fraction": 1.0}
    text = " ".join(figures(failed(tmp_path / "run.h5", summary)).split())
    assert "friction law xu has no range by the solved contact" in text
    assert "0.42 to 14 times the solved friction" in text
    summary["friction_judged"] = judged | {"limits": 3}
    assert "no range by" not in figures(failed(tmp_path / "other.h5", summary))


def test_a_failed_run_says_so(tmp_path: Path):
    text = figures(failed(tmp_path / "run.h5", {}))
    assert "failed: stopped at t = 0.1 s: step too small" in text
    assert "4 samples were written" in text


def test_json_holds_si_units_and_no_nan(record: Record, tmp_path: Path):
    found = json.loads(json.dumps(plain(summary_json(record)), allow_nan=False))
    assert found["status"] == "complete"
    assert found["summary"]["efficiency"] == 0.9868
    assert found["summary"]["friction_force_mean"] == [150.0, 310.0]
    assert found["pairs"] == [0, 1]
    undefined = failed(tmp_path / "other.h5", {"efficiency": float("nan"), "film": {"min": float("inf")}})
    found = json.loads(json.dumps(plain(summary_json(undefined)), allow_nan=False))
    assert found["summary"].pop("efficiency_withheld")
    assert found["summary"] == {"efficiency": None, "film": {"min": None}}
