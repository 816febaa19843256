"""Records of version 0.1.0 still open: datasets, units, summaries, and pictures of them."""

import json
import tomllib
from pathlib import Path

import h5py
import numpy as np
import pytest
from typer.testing import CliRunner

from tribodyn.cli.app import app
from tribodyn.record.opened import summary_of_today
from tribodyn.record.sweep_reader import open_any

RECORDS = Path(__file__).parents[2] / "fixtures/records-0.1.0"
#: Record -> one of its figures.
FIGURES = {
    "gear-pair": "film",
    "efficiency": "efficiency",
    "load-contact": "load-sharing",
    "backlash-oscillator": "response",
    "sweep": "response",
}
#: Record -> a value of its summary, as `tribodyn show` of 0.1.0 printed it.
PRINTED = {
    "gear-pair": ("contact_ratio", 1.21165533681917),
    "efficiency": ("efficiency_hoehn", 0.9834193016104049),
    "load-contact": ("gear_torque", 20.0),
    "backlash-oscillator": ("rms_max", 0.20225840221782074),
}


def text(values: np.ndarray) -> np.ndarray:
    return np.char.decode(values, "utf-8") if values.dtype.kind == "S" else values


def datasets(file: h5py.File) -> dict[str, h5py.Dataset]:
    return {
        name: item
        for name, item in file.items()
        if isinstance(item, h5py.Dataset) and name != "samples_written"
    }


def test_there_is_one_of_each():
    assert {path.stem for path in RECORDS.glob("*.h5")} == set(FIGURES)


@pytest.mark.parametrize("name", FIGURES)
def test_every_dataset_reads_as_it_was_written(name):
    path = RECORDS / f"{name}.h5"
    with h5py.File(path) as file, open_any(path) as record:
        for key, dataset in datasets(file).items():
            assert key in record, key
            np.testing.assert_array_equal(record[key], text(dataset[()]), err_msg=key)
            assert record.units(key) == dataset.attrs["units"]
            assert record.long_name(key) == dataset.attrs["long_name"]


@pytest.mark.parametrize("name", FIGURES)
def test_the_summary_reads_as_it_was_written(name):
    path = RECORDS / f"{name}.h5"
    with h5py.File(path) as file, open_any(path) as record:
        written = summary_of_today(file["summary"].attrs, file)
        assert set(record.summary) == set(written)
        for key, value in written.items():
            np.testing.assert_array_equal(record.summary[key], value, err_msg=key)


@pytest.mark.parametrize("name", FIGURES)
def test_the_record_s_kind_is_its_scenario_s(name):
    """An efficiency record of 0.1.0 says "gear-pair" in its attributes."""
    path = RECORDS / f"{name}.h5"
    with h5py.File(path) as file, open_any(path) as record:
        scenario = tomllib.loads(file.attrs["scenario"])
        assert record.scenario == scenario
        assert record.status == "complete"
        if name == "sweep":  # of whatever kind
            assert scenario["kind"] == "gear-pair"
        else:
            assert scenario["kind"] == name
            assert record.kind == scenario["kind"]


@pytest.mark.parametrize(("name", "figure"), PRINTED.items())
def test_its_figures_are_printed(name, figure):
    key, value = figure
    shown = CliRunner().invoke(app, ["show", str(RECORDS / f"{name}.h5"), "--json"])
    assert shown.exit_code == 0, shown.output
    assert json.loads(shown.output)["summary"][key] == value
