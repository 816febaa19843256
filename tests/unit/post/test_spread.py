"""Scatter of a sweep's figures over samples, against NumPy's percentiles of the recorded values."""

import shutil

import h5py
import numpy as np
import pytest

from tribodyn.grid.engines import engine_of
from tribodyn.grid.grid import Grid
from tribodyn.grid.run import run, settings_of
from tribodyn.post.sweep_report import spread, sweep_as_json, sweep_rows
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.sweep_reader import SweepRecord


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    path = tmp_path_factory.mktemp("sweep") / "scatter.h5"
    options = ["mesh.deviation_sample=1:5:1", "operating.gear_torque=100,200N*m"]
    grid = Grid("efficiency-involute-18-36", options, {"drive.quality": 7})
    with engine_of("native", 1, None) as engine:
        run(grid, settings_of(grid), engine, path)
    with SweepRecord(path) as record:
        yield record


def test_percentiles_are_over_the_samples_alone(swept):
    found = spread(swept, "hertz_pressure_max")
    assert found is not None
    values = swept["hertz_pressure_max"]
    assert values.shape == (5, 2)
    assert np.ptp(values, axis=0).min() > 0
    assert found["median"] == pytest.approx(np.median(values, axis=0))
    assert found["p5"] == pytest.approx(np.percentile(values, 5, axis=0))
    assert found["p95"] == pytest.approx(np.percentile(values, 95, axis=0))
    assert set(sweep_as_json(swept)["spread"]) >= {"efficiency", "hertz_pressure_max", "film_min"}


def test_a_lower_bound_is_marked_where_it_stands(swept, tmp_path):
    """As an assessment's life without end: of the case alone, and of what is taken over all of them."""
    path = tmp_path / "bound.h5"
    shutil.copyfile(swept.path, path)
    name = "hertz_pressure_max"
    with h5py.File(path, "r+") as file:
        file.copy(name, f"{name}_unlimited")
        largest = np.unravel_index(np.argmax(file[name]), file[name].shape)
        file[f"{name}_unlimited"][...] = np.nan
        file[f"{name}_unlimited"][largest] = 1.0
    with SweepRecord(path) as record:
        ((_, least, _, most, *_),) = sweep_rows(record, [QUANTITIES[name]])
    with SweepRecord(swept.path) as record:
        ((_, before, _, unmarked, *_),) = sweep_rows(record, [QUANTITIES[name]])
    assert (least, most) == (before, f"≥ {unmarked}")
