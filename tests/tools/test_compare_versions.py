"""What two versions' results are compared by: numbers, NaN, shapes, types, words, reasons."""

import h5py
import numpy as np
import pytest

from tools.compare_versions.difference import Explained, compare, relative
from tools.compare_versions.results import read
from tools.compare_versions.tables import difference_table

LOADS = np.array([[1.0, np.nan], [-200.0, 50.0]])


def compared(old, new):
    return compare("a case", "a.h5", old, new)


def test_a_difference_is_relative_to_the_largest_magnitude():
    changed = LOADS + np.array([[1e-8, 0.0], [0.0, 0.0]])
    (difference,) = compared({"load": LOADS}, {"load": changed}).differences
    assert difference.relative == pytest.approx(1e-8 / 200.0, rel=1e-6)
    assert compared({"load": LOADS}, {"load": LOADS.copy()}).differences == []


def test_columns_of_different_units_are_related_to_themselves():
    old = np.array([[1e-6, 100.0], [2e-6, 200.0]])
    new = old + np.array([[0.0, 0.0], [1e-9, 0.0]])
    assert relative(old, new, by_column=True) == pytest.approx(1e-9 / 2.001e-6)
    (difference,) = compared({"displacement": old}, {"displacement": new}).differences
    assert difference.relative == relative(old, new, by_column=True)


@pytest.mark.parametrize(
    "new",
    [
        LOADS[:1],
        LOADS.astype(np.float32),
        np.nan_to_num(LOADS),
        np.where(np.isnan(LOADS), np.inf, LOADS),
        "text",
    ],
)
def test_shape_type_and_nan_are_compared(new):
    (difference,) = compared({"load": LOADS}, {"load": new}).differences
    assert difference.how
    _, unexplained = difference_table([compared({"load": LOADS}, {"load": new})], 1.0, [])
    assert unexplained == ["a case:load"]


def test_what_is_missing_needs_a_reason_and_what_is_new_none():
    results = [compared({"load": LOADS, "gone": LOADS}, {"load": 1.001 * LOADS, "more": LOADS})]
    table, unexplained = difference_table(results, 1e-10, [])
    assert unexplained == ["a case:load", "a case:gone"]
    assert "new: `more`" in table
    reasons = [Explained.parse("a *: a defect: mended"), Explained.parse("other: no")]
    table, unexplained = difference_table(results, 1e-10, reasons)
    assert unexplained == []
    assert "a defect: mended" in table
    assert difference_table(results, 1e-10, [Explained.parse("a case:load: why")])[1] == ["a case:gone"]
    with pytest.raises(SystemExit, match="reason"):
        Explained.parse("a case")


def test_a_folder_of_results_is_read(tmp_path):
    (tmp_path / "made.json").write_text('{"status": [0]}')
    (tmp_path / "stdout").write_text(
        '{"created": "now", "summary": {"mean": 2, "none": null, "wall_time": 3.0},'
        ' "rows": [{"id": "a", "values": [1.0, 2.0]}]}'
    )
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file["load"] = LOADS
        file["load"].attrs["units"] = "N"
        file["label"] = np.array([b"up", b"down"])
        file.create_group("summary").attrs["efficiency"] = 0.98
        file["summary"].attrs["wall_time"] = 1.0
    tables = read(tmp_path)
    assert set(tables["printed"]) == {
        "exit status",
        "summary/mean",
        "summary/none",
        "rows/a/id",
        "rows/a/values",
    }
    assert set(tables["a.h5"]) == {
        "load",
        "load@dims",
        "load@units",
        "label",
        "label@dims",
        "summary@efficiency",
    }
    assert tables["a.h5"]["label"] == "up\ndown"
    np.testing.assert_array_equal(tables["a.h5"]["load"], LOADS)
