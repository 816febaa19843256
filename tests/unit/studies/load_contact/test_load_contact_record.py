"""Records over phase, pair and slice: what comes back, by our reader, xarray and h5py; partial maps."""

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
import xarray

from tests.support import synthetic_load_contact
from tests.support.synthetic_load_contact import samples
from tribodyn.errors import InputError
from tribodyn.record.reader import open_record
from tribodyn.record.writer import RecordWriter
from tribodyn.studies.load_contact import layout as load_contact


def writer(path: Path, samples: int, scales: dict[str, Any]) -> RecordWriter:
    return RecordWriter(
        path,
        layout=load_contact.LAYOUT,
        kind="load-contact",
        scenario_toml="",
        sha256="",
        samples=samples,
        scales=scales,
    )


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return synthetic_load_contact.write(tmp_path / "study.h5")


def test_every_dataset_comes_back(path: Path):
    expected = samples(24, 9)
    with open_record(path) as record:
        assert record.kind == "load-contact"
        assert record.axis == "phase"
        assert set(record) == set(expected)
        for name in record:
            np.testing.assert_array_equal(record[name], expected[name], err_msg=name)
        assert record.pairs == (-1, 0, 1)
        assert list(record["body"]) == ["pinion", "gear"]
        np.testing.assert_array_equal(record["torque"], [100.0, 200.0, 300.0])
        assert record["map_transmission_error"].shape == (3, 24)
        assert record.units("line_load") == "N/m"
        assert "time" not in record


def test_xarray_reads_it_with_units_and_coordinates(path: Path):
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        assert data.line_load.dims == ("phase", "pair", "slice")
        assert data.root_tension.dims == ("phase", "body", "pair", "slice")
        assert data.map_transmission_error.dims == ("torque", "phase")
        assert data.slice.attrs["units"] == "m"
        assert all("units" in variable.attrs for variable in data.variables.values())
        pinion = data.root_tension.sel(body="pinion", pair=1).max("slice")
        np.testing.assert_array_equal(pinion, samples(24, 9)["root_tension"][:, 0, 2].max(-1))
        assert float(data.map_peak_to_peak.sel(torque=300.0)) > 0
    for group in ("mesh_cycle", "geometry", "summary"):
        xarray.open_dataset(path, engine="h5netcdf", group=group).close()


def test_h5py_reads_it_with_units_and_scales(path: Path):
    with h5py.File(path) as file:
        for name, variable in (load_contact.SAMPLES | load_contact.MAP).items():
            assert file[name].attrs["units"] == variable.units
            assert file[name].attrs["long_name"] == variable.long_name
            assert [dim[0].name.strip("/") for dim in file[name].dims] == list(variable.dims)


def test_a_study_of_one_torque_has_no_map(tmp_path: Path):
    with open_record(synthetic_load_contact.write(tmp_path / "study.h5", torques=())) as record:
        assert "torque" not in record
        assert "map_peak_to_peak" not in record
        with pytest.raises(InputError, match="no such dataset"):
            record["map_peak_to_peak"]


def test_a_failed_map_keeps_what_it_has(tmp_path: Path):
    values = samples(8, 3)
    scales = {"pair": [-1, 0, 1], "slice": [-1.0, 0.0, 1.0], "body": ["pinion", "gear"], "torque": [1.0, 2.0]}
    with writer(tmp_path / "study.h5", 8, scales) as record:
        record.write(0, values)
        record.put(0, {"map_transmission_error": np.arange(8.0), "map_peak_to_peak": 7.0})
        with pytest.raises(ValueError, match="map_transmission_error: shape"):
            record.put(1, {"map_transmission_error": np.arange(7.0)})
        path = record.fail("at the second torque")
    with open_record(path) as failed:
        assert failed.status == "failed"
        np.testing.assert_array_equal(failed["line_load"], values["line_load"])
        np.testing.assert_array_equal(failed["map_transmission_error"][0], np.arange(8.0))
        assert np.isnan(failed["map_transmission_error"][1]).all()
        np.testing.assert_array_equal(failed["map_peak_to_peak"], [7.0, np.nan])


def test_a_study_that_fails_at_once_leaves_a_readable_record(tmp_path: Path):
    scales = {"pair": np.zeros(0, int), "slice": np.zeros(0), "body": ["pinion", "gear"]}
    with writer(tmp_path / "study.h5", 0, scales) as record:
        path = record.fail("no state of contact is found")
    with open_record(path) as failed:
        assert failed.samples == 0
        assert failed["line_load"].shape == (0, 0, 0)
