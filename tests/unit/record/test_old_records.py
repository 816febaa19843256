"""Older records still open, under the names of today: datasets, units, summaries, and pictures of them."""

import json
import shutil
import tomllib
from pathlib import Path

import h5py
import numpy as np
import pytest

import tribodyn as td
from tests.support.verbs import invoke
from tribodyn.record.open_record import summary_of_today
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import open_any
from tribodyn.studies import study_of
from tribodyn.studies.protocol.evaluated import evaluated
from tribodyn.studies.protocol.load import load_data

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


def test_an_angle_has_both_of_its_names():
    """Before version 2 of the format a record had one of both."""
    with Record(RECORDS / "gear-pair.h5") as record, h5py.File(record.path) as file:
        assert record.attrs["format_version"] == 1
        assert "reference_angle" not in file
        np.testing.assert_array_equal(record["reference_angle"], file["pinion_angle"])
        assert record.long_name("reference_angle") == "rotation of the pinion"
        assert "reference_angle" not in list(record)


@pytest.mark.parametrize("path", sorted(RECORDS.parent.glob("*/*.h5")), ids=lambda path: path.stem)
def test_their_scenarios_are_read(path: Path):
    """By the names that they have, whatever today's are."""
    with h5py.File(path) as file:
        load_data(tomllib.loads(file.attrs["scenario"]), path.stem)


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
    assert json.loads(invoke("show", RECORDS / f"{name}.h5", "--json"))["summary"][key] == value


KEYS = {"solver.cycles": 40, "output.samples_per_cycle": 60}
NAMES = ("transmission_error_peak_to_peak", "transmission_error_rms", "transmission_error_mean")


def older(path: Path) -> None:
    """Give a record the names of version 0.53."""
    with h5py.File(path, "r+") as file:
        file.move("transmission_error_normal", "transmission_error")
        listed = str(file.attrs["datasets"])
        file.attrs["datasets"] = listed.replace("transmission_error_normal", "transmission_error")
        summary = file["summary"].attrs
        for part in ("mean", "peak_to_peak"):
            summary[f"transmission_error_rotational_{part}"] = summary[f"transmission_error_{part}"]
            summary[f"transmission_error_{part}"] = summary[f"transmission_error_normal_{part}"]
            del summary[f"transmission_error_normal_{part}"]
        for name in [name for name in summary if name.startswith("extremes/")]:
            del summary[name]


def test_an_older_record_is_read_under_the_names_of_today(short_runs, tmp_path: Path):
    today = short_runs("gear-pair").path
    path = Path(shutil.copy(today, tmp_path))
    older(path)
    with Record(today) as new, Record(path) as old:
        assert sorted(old) == sorted(new)
        today = {name: value for name, value in new.summary.items() if name != "extremes"}
        np.testing.assert_equal(old.summary, today)
        for name in ("transmission_error_normal", "transmission_error"):
            assert name in old
            assert name in new
            np.testing.assert_array_equal(old[name], new[name])
            assert old.dims_of(name) == new.dims_of(name) == ("time", "pair")
            assert old.units(name) == "m"


def test_speeds_at_which_contact_is_lost_are_no_frequencies():
    older = {"dynamic_factor_max_speed": 3.0, "contact_loss_from": 1.0, "contact_loss_to": 2.0}
    today = {"dynamic_factor_max_speed": 3.0, "contact_loss_speed_from": 1.0, "contact_loss_speed_to": 2.0}
    assert summary_of_today(older, ()) == summary_of_today(today, ()) == today
    assert summary_of_today({"contact_loss_from": 0.6}, ()) == {"contact_loss_from": 0.6}
    of_train = {"dynamic_factor_max_input_speed": 3.0, "contact_loss_input_speed_from": 1.0}
    assert summary_of_today(of_train, ()) == {name: today[name] for name in list(today)[:2]}


@pytest.mark.slow
def test_run_sweep_and_search_give_one_number_by_one_name(tmp_path: Path):
    """A settled run of many cycles, the steady state of a sweep, and what a search evaluates."""
    run = td.run("crc-23-47", KEYS | {"solver.cycles": 400}, output=tmp_path / "run.h5")
    (sought,) = evaluated(study_of({}), [td.scenario("crc-23-47", KEYS)])
    assert isinstance(sought, dict)
    swept = td.sweep("crc-23-47", {"operating.gear_torque": ["500 N*m"]}, KEYS)
    for name in NAMES:
        assert sought[name] == float(swept[name].squeeze())
        assert run.summary[name] == pytest.approx(sought[name], rel=1e-3), name
