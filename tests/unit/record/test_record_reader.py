"""What reads a record: xarray, h5py, and our reader, which refuses what is none."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from tests.support.record_samples import block, gear_pair_writer, geometry
from tribodyn.errors import InputError
from tribodyn.gears.motion.recorded import SAMPLES
from tribodyn.record.reader import Record


@pytest.fixture
def record_path(tmp_path: Path) -> Path:
    with gear_pair_writer(tmp_path / "run.h5", 30, outlines=geometry()) as record:
        record.write(0, block(0, 30))
        return record.finish({"efficiency": 0.98})


def test_no_string_of_variable_length_is_a_dataset(record_path: Path):
    """Octave's `load` gives up at the first such dataset."""
    kinds = []
    with h5py.File(record_path) as file:
        file.visititems(lambda name, item: kinds.append(getattr(item, "dtype", np.dtype(float)).kind))
    assert "O" not in kinds


def test_the_oldest_file_format_is_used(record_path: Path):
    """Version 0 of the superblock: readable by every HDF5 library, and without a mark of who has it open."""
    assert record_path.read_bytes()[8] == 0


def damaged(path: Path, how: str) -> None:
    if how == "cut short":
        path.write_bytes(path.read_bytes()[:5000])
    elif how == "not HDF5":
        path.write_text("time,load\n0,1\n")
    elif how == "empty":
        path.write_bytes(b"")
    elif how == "another program's":
        with h5py.File(path, "w") as file:
            file["x"] = 1.0
    elif how == "dataset missing":
        with h5py.File(path, "r+") as file:
            del file["normal_load"]
    elif how == "group missing":
        with h5py.File(path, "r+") as file:
            del file["summary"]
    elif how == "dataset too short":
        with h5py.File(path, "r+") as file:
            del file["normal_load"]
            file["normal_load"] = np.zeros((3, 2))
            for axis, scale in enumerate(("time", "pair")):
                file["normal_load"].dims[axis].attach_scale(file[scale])
    elif how == "scale detached":
        with h5py.File(path, "r+") as file:
            file["normal_load"].dims[0].detach_scale(file["time"])
    elif how == "group in a dataset's place":
        with h5py.File(path, "r+") as file:
            del file["normal_load"]
            file.create_group("normal_load")
    elif how == "overwritten with noise":
        noise = np.random.default_rng(1).bytes(3000)
        content = path.read_bytes()
        path.write_bytes(content[:96] + noise + content[3096:])
    elif how == "of a newer format":
        with h5py.File(path, "r+") as file:
            file.attrs["format_version"] = 99
    elif how == "of unknown status":
        with h5py.File(path, "r+") as file:
            file.attrs["status"] = "perhaps"
    else:
        path.unlink()


@pytest.mark.parametrize(
    ("how", "message"),
    [
        ("cut short", "damaged"),
        ("not HDF5", "not an HDF5 file"),
        ("empty", "not an HDF5 file"),
        ("another program's", "not a record"),
        ("dataset missing", "damaged"),
        ("group missing", "damaged"),
        ("dataset too short", "normal_load is too short"),
        ("scale detached", "normal_load lacks the scale"),
        ("group in a dataset's place", "normal_load is no dataset"),
        ("overwritten with noise", "damaged"),
        ("of a newer format", "version 99"),
        ("of unknown status", "damaged"),
        ("gone", "no such file"),
    ],
)
def test_what_is_no_record_is_refused(record_path: Path, how: str, message: str):
    damaged(record_path, how)
    with pytest.raises(InputError, match=message) as error:
        Record(record_path)
    assert error.value.key == "record"
    assert error.value.value == str(record_path)


def test_a_damaged_scenario_is_reported_where_it_is_read(tmp_path: Path):
    with gear_pair_writer(tmp_path / "run.h5", 1, scenario_toml="title = ") as record:
        record.write(0, block(0, 1))
        path = record.finish({})
    with Record(path) as record:
        assert record.kind == "gear-pair"
        with pytest.raises(InputError, match="the record is damaged") as error:
            _ = record.scenario
    assert error.value.key == "record"


def test_an_unknown_dataset_is_refused_with_what_there_is(record_path: Path):
    with Record(record_path) as record, pytest.raises(InputError, match="normal_load"):
        record["load"]


def test_a_record_of_an_earlier_release_may_lack_later_datasets(record_path: Path):
    with h5py.File(record_path, "r+") as file:
        for attribute in ("axis", "datasets"):  # which 0.1.0 does not write
            del file.attrs[attribute]
        del file["drive_torque"], file["reference_angle"]
    with Record(record_path) as record:
        assert "drive_torque" not in record
        assert set(record) == {"time", *SAMPLES} - {"drive_torque"}
        assert record.axis == "time"
        with pytest.raises(InputError, match="no such dataset"):
            record["drive_torque"]
