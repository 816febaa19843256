"""How rows are judged and counted: a direction is no number, a wide tolerance has its reason."""

import pytest

from tribodyn.validation import PAPERS
from tribodyn.validation.rows import WIDE, compare, counted, counts, published

NUMBER = {
    "id": "x",
    "quantity": "force",
    "unit": "N",
    "published": 100.0,
    "tolerance": 0.1,
    "tolerance_kind": "relative",
    "independent": None,
    "note": "",
}
CLAIM = NUMBER | {"published": True, "tolerance": None, "tolerance_kind": "claim"}
BELOW_ONE = NUMBER | {"published": 0.8, "tolerance": None, "tolerance_kind": "direction only (below 1)"}
EFFICIENCY = NUMBER | {"published": 0.98, "tolerance": 0.005, "tolerance_kind": "absolute"}
COLUMNS = NUMBER | {
    "published": [0.0, 2.0, -0.1],
    "tolerance": [1.0, 0.1, 0.004],
    "tolerance_kind": "absolute",
}


@pytest.mark.parametrize("paper", PAPERS)
def test_a_tolerance_wider_than_five_per_cent_has_its_reason(paper: str):
    for key, row in published(paper).items():
        compared = compare(row, None)
        wide = compared.tolerance_share is not None and compared.tolerance_share > WIDE * (1 + 1e-12)
        assert bool(compared.tolerance_reason) == wide, key


def test_a_tolerance_of_an_efficiency_is_a_share_of_its_loss():
    compared = compare(EFFICIENCY | {"part": "loss", "whole": 1.0, "tolerance_reason": "friction"}, 0.984)
    assert compared.tolerance_share == pytest.approx(0.25)
    assert compared.part_difference == pytest.approx(-0.2)
    assert compared.written("tolerance") == "0.005, 25 % of the loss: friction"
    assert compared.written("difference") == "0.004, -20 % of the loss"


def test_a_tolerance_of_a_table_row_is_the_widest_of_its_columns():
    assert compare(COLUMNS, None).tolerance_share == pytest.approx(0.05)


def test_what_holds_under_one_choice_only_is_said_and_counted():
    rows = [
        compare(NUMBER, 95.0, otherwise={"the default": 80.0}),
        compare(NUMBER, 95.0, otherwise={"the default": 94.0}),
        compare(NUMBER, 50.0, otherwise={"the default": 95.0}),
        compare(CLAIM, True, otherwise={"the default": False}),
        compare(BELOW_ONE, 0.5),
        compare(NUMBER | {"published": None, "independent": 1.0}, 1.0),
    ]
    assert [row.written("verdict") for row in rows] == [
        "pass, not under every choice",
        "pass",
        "fail",
        "pass, not under every choice",
        "direction",
        "pass",
    ]
    assert rows[0].written("otherwise") == "the default: 80, -20 %, fail"
    number = counts(rows)["number"]
    assert (number["rows"], number["pass"], number["fail"], number["not under every choice"]) == (3, 2, 1, 1)
    assert counted(rows) == (
        "3 numbers: 2 pass, 1 fail, 1 of them not under every choice; 1 claim: 1 pass, 1 of them not under "
        "every choice; 1 row by direction: 1 agree; 1 value beside another implementation: 1 pass"
    )
