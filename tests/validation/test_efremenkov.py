"""Efremenkov et al. (2024): every row of table and figures, from runs of the shipped scenarios."""

import pytest

import tribodyn as td
from tribodyn.post.style import house_style
from tribodyn.validation import PAPERS, validate
from tribodyn.validation.papers.efremenkov import FIGURES
from tribodyn.validation.rows import PASS


@pytest.fixture(scope="module")
def rows(validated):
    return validated("efremenkov-2024")


def test_figures_show_the_papers_curves(tmp_path):
    """Slip changes its sign with r2 30 mm and shifts down with r_b; largest losses are 20.54 to 9.11 W."""
    validate("efremenkov-2024", folder=tmp_path)
    with house_style():
        drawn = {name: draw(tmp_path) for name, draw in FIGURES.items()}
    curves = {
        name: [line.get_ydata() for axes in one.axes for line in axes.lines] for name, one in drawn.items()
    }
    assert curves["figure-4"][2][0] == pytest.approx(-1.43, abs=0.01)
    assert curves["figure-4"][2][-1] == pytest.approx(0.716, abs=0.001)
    for name in ("figure-6", "figure-7"):
        assert len(curves[name]) == 5
        tops = [max(curve) for curve in curves[name]]
        assert tops == sorted(tops, reverse=True)
    computed, printed = curves["figure-8"]
    assert [computed[0], computed[-1]] == pytest.approx(list(printed), rel=2e-3)
    assert list(printed) == [20.54, 9.11]


def test_a_sweep_has_the_papers_figure_8():
    """Printed maxima of N_S over r_b."""
    swept = td.sweep("irefc-as-published", {"drive.element_radius": ["1.2 mm", "2.8 mm"]})
    assert swept["power_element_max"].to_numpy() == pytest.approx([20.54, 9.11], rel=2e-3)


OF_ANOTHER_GEAR = {
    f"efremenkov/{name}" for name in ("column-cam", "column-crown", "power-cam", "power-crown")
}


def test_every_row_passes_but_those_of_another_gear(rows):
    """Both columns and the two powers of the conclusions belong to a gear that the table does not have."""
    assert {row.id for row in rows.values() if row.verdict != PASS} == OF_ANOTHER_GEAR
    for key in OF_ANOTHER_GEAR:
        assert [(one.choice, one.verdict) for one in rows[key].otherwise] == [
            ("r_b 2.8 mm, rolling arm 1e-6 m", PASS)
        ]


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
    assert {key.partition("claim-")[2] for key, row in rows.items() if row.standing == "reproduced"} == {
        "slip-shifts-to-the-negative",
        "loss-falls-with-the-radius",
    }
    assert rows["efremenkov/efficiency"].otherwise[0].computed == pytest.approx(0.039, abs=5e-4)


def test_the_corrected_efficiency_stands_beside_the_published_one(rows):
    assert "0.039 (1442 W of 1500 W lost)" in rows["efremenkov/efficiency"].note
    assert "0.9843" in rows["efremenkov/efficiency"].note
