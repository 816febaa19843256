"""Efremenkov et al. (2024): every row of table and figures, from runs of the shipped scenarios."""

import pytest

from tribodyn.record.reader import Record
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.run import run
from tribodyn.validation import PAPERS
from tribodyn.validation.rows import PASS


@pytest.fixture(scope="module")
def rows(validated):
    return validated("efremenkov-2024")


def test_every_row_passes(rows):
    assert [row.id for row in rows.values() if row.verdict != PASS] == []


#: Figures of a separate prototype of the restored equations.
INDEPENDENT = {
    "efremenkov/efficiency": 0.93224,
    "efremenkov/ns-max-r2-30": 12.363,
    "efremenkov/ns-max-rb-1.2": 20.538,
    "efremenkov/ns-max-rb-2.8": 9.101,
    "efremenkov/vs-range": 0.001432,
}


@pytest.mark.parametrize("key", INDEPENDENT)
def test_figures_agree_with_an_independent_prototype(rows, key):
    assert rows[key].computed == pytest.approx(INDEPENDENT[key], rel=5e-4)


def test_every_row_holds_as_published_only_and_the_head_says_so(rows):
    assert PAPERS["efremenkov-2024"].choices.startswith("as published")
    assert all(row.hangs_on_choice for row in rows.values())
    assert rows["efremenkov/efficiency"].otherwise[0].computed == pytest.approx(0.039, abs=5e-4)


def test_the_corrected_efficiency_stands_beside_the_published_one(rows):
    assert "0.039 (1442 W of 1500 W lost)" in rows["efremenkov/efficiency"].note
    assert "0.9843" in rows["efremenkov/efficiency"].note


#: The table's columns N_SA and N_SB, W, of elements 2 … 13.
CAM = (0.1455, 0.1867, 0.1818, 0.1624, 0.1384, 0.1140, 0.0909, 0.0701, 0.0519, 0.0363, 0.0228, 0.0110)
CROWN = (0.0013, 0.0024, 0.0033, 0.0039, 0.0044, 0.0046, 0.0046, 0.0043, 0.0037, 0.0030, 0.0021, 0.0011)


def test_the_columns_of_cam_and_crown_belong_to_another_gear(tmp_path):
    """Both were made with r_b 2.8 mm and μ 1e-6 m, the cam's by the magnitude of its signed sum."""
    changes = {"drive.element_radius": "2.8 mm", "friction.rolling_arm": "1e-6 m"}
    result = run(load_scenario("irefc-as-published", changes), tmp_path / "columns.h5")
    with Record(result.path) as record:
        assert -record["power_cam"][0][1:13] == pytest.approx(CAM, abs=6e-5)
        assert record["power_crown"][0][1:13] == pytest.approx(CROWN, abs=6e-5)
