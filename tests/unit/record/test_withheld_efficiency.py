"""Efficiencies that cannot be are withheld wherever they would be shown, with the reason."""

import json
import shutil

import h5py
import numpy as np
import pytest

from tests.support.record_samples import block, gear_pair_writer, geometry, printed
from tribodyn.cli.printing import plain
from tribodyn.quantities.catalogue import QUANTITIES
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.record.sweep_schema import DONE, SweepLayout, VariedKey
from tribodyn.record.sweep_writer import SweepHead, SweepWriter
from tribodyn.record.withheld_efficiency import (
    is_efficiency,
    reason_to_withhold,
    samples_withheld,
    warnings,
    warnings_in,
    withheld,
)
from tribodyn.studies.pages import summary_json, summary_table, sweep_table


@pytest.mark.parametrize(
    ("value", "said"),
    [(1.0001, "above 1"), (-1e-6, "below 0"), (np.nan, "no power"), (np.inf, "no power"), (1e9, "above 1")],
)
def test_what_cannot_be_has_a_reason(value, said):
    assert said in reason_to_withhold(value)
    figures = withheld({"efficiency": value, "power_in_mean": 2.0})
    assert figures["efficiency"] is None
    assert said in figures["efficiency_withheld"]
    assert figures["power_in_mean"] == 2.0


@pytest.mark.parametrize("value", [0.0, 0.5, 1.0, 1.0 + 1e-15, -1e-15])
def test_what_can_be_stays(value):
    assert withheld({"efficiency": value}) == {"efficiency": value}


def test_every_efficiency_is_one_by_its_name():
    assert all(map(is_efficiency, ("efficiency", "efficiency_hoehn", "efficiency_by_energy")))
    assert not any(map(is_efficiency, ("loss_factor", "power_in_mean", "efficiency_withheld")))
    nested = withheld({"shift": {"efficiency_x": 2.0}, "efficiency": "as text", "loss": 3.0})
    assert nested["shift"]["efficiency_x"] is None
    assert (nested["efficiency"], nested["loss"]) == ("as text", 3.0)
    assert warnings(nested) == [
        "withheld: shift/efficiency_x, above 1: more power would come out than is put in"
    ]


def test_samples_outside_are_nan_and_others_stay():
    values = np.array([0.99, 1.01, -3.0, 0.0, np.nan, 1.0])
    np.testing.assert_array_equal(
        samples_withheld("efficiency", values), [0.99, np.nan, np.nan, 0.0, np.nan, 1.0]
    )
    assert samples_withheld("power_in", values) is values


def test_a_record_has_the_reason_and_no_figure(tmp_path):
    with gear_pair_writer(tmp_path / "run.h5", 9, outlines=geometry()) as writer:
        first = block(0, 9)
        first["efficiency"] = np.linspace(0.9, 1.3, 9)
        writer.write(0, first)
        writer.finish({"efficiency": 1.2058, "mesh_frequency": 3.0})
    with h5py.File(tmp_path / "run.h5") as file:
        assert "efficiency" not in file["summary"].attrs
        assert "above 1" in file["summary"].attrs["efficiency_withheld"]
        assert np.nanmax(file["efficiency"][...]) <= 1.0
        assert np.isnan(file["efficiency"][-1])
    with Record(tmp_path / "run.h5") as record:
        assert record.summary["efficiency"] is None


def test_a_figure_that_an_older_version_wrote_is_not_shown(short_runs, tmp_path):
    """Its summary has an efficiency of 120.58 %."""
    path = shutil.copy(short_runs("gear-pair").path, tmp_path)
    with h5py.File(path, "r+") as file:
        file["summary"].attrs["efficiency"] = 1.2058
    wrong = Record(path)
    text = printed(summary_table(wrong))
    assert "120." not in text
    assert any("Efficiency" in line and "withheld" in line for line in text.splitlines())
    assert "Withheld: efficiency, above 1" in text
    found = json.loads(json.dumps(plain(summary_json(wrong)), allow_nan=False))
    assert found["summary"]["efficiency"] is None
    assert "above 1" in found["summary"]["efficiency_withheld"]


def test_a_sweep_withholds_it_case_by_case(tmp_path):
    scale = VariedKey("speed", "operating.pinion_speed", "rad/s", (1.0, 2.0, 3.0))
    layout = SweepLayout({"efficiency": QUANTITIES["efficiency"].variable()})
    with SweepWriter(
        tmp_path / "sweep.h5", SweepHead('kind = "efficiency"', "0", (scale,), "", (), layout)
    ) as writer:
        rows = layout.empty_rows(3)
        rows["efficiency"][:] = 0.99, 1.2058, -0.2
        rows["message"][1] = "a remark"
        rows["status"][:] = DONE
        writer.write(np.arange(3), rows)
        writer.finish({"wall_time": 0.0})
    with SweepRecord(tmp_path / "sweep.h5") as record:
        np.testing.assert_array_equal(record["efficiency"], [0.99, np.nan, np.nan])
        assert record["message"][0] == ""
        assert record["message"][1].startswith("a remark; warning: efficiency is withheld, above 1")
        assert sorted(record.warnings().values()) == [1, 1]
        text = printed(sweep_table(record))
    assert "120" not in text
    assert "Warning: 1 of 3 cases: efficiency is withheld, above 1" in text


def test_warnings_that_the_room_of_a_record_cut_count_as_what_they_are():
    fed, lost = "friction feeds the vibration", "frames lose power"
    messages = [
        f"warning: {fed}",
        "period 8; warning: friction…",
        "warning: fri…",
        f"warning: {lost}",
        "period 2",
    ]
    assert warnings_in(messages) == {fed: 3, lost: 1}
    assert warnings_in(["warning: fri…"]) == {"fri…": 1}
