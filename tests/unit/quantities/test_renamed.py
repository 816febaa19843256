"""The transmission error is one number by one name, and older records are read under the names of today."""

from pathlib import Path

import h5py
import numpy as np
import pytest

import tribodyn as td
from tests.support import synthetic_record
from tribodyn.record.opened import summary_of_today
from tribodyn.record.reader import open_record
from tribodyn.studies import study_of
from tribodyn.studies.protocol.evaluated import evaluated

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


def test_an_older_record_is_read_under_the_names_of_today(tmp_path: Path):
    paths = [synthetic_record.write(tmp_path / name, cycles=2, per_cycle=20) for name in ("a.h5", "b.h5")]
    older(paths[1])
    with open_record(paths[0]) as new, open_record(paths[1]) as old:
        assert sorted(old) == sorted(new)
        np.testing.assert_equal(old.summary, new.summary)
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
