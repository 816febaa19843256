"""How rows are judged and counted: one rule for tolerances, a direction is no number, what held fails."""

from typing import Any

import pytest

from tribodyn.validation import PAPERS
from tribodyn.validation.published import WIDE, published
from tribodyn.validation.rows import compare, counted, counts

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
RISE = NUMBER | {
    "published": 1.2,
    "tolerance": 0.01,
    "tolerance_kind": "absolute",
    "part": "rise",
    "whole": 1.0,
}
EFFICIENCY = NUMBER | {"published": 0.98, "tolerance": 0.005, "tolerance_kind": "absolute"}
COLUMNS = NUMBER | {
    "published": [0.0, 2.0, -0.1],
    "tolerance": [1.0, 0.1, 0.004],
    "tolerance_kind": "absolute",
}
RULED = [name for name, paper in PAPERS.items() if not paper.source]


def each(value: Any) -> list[Any]:
    return value if isinstance(value, list) else [value]


@pytest.mark.parametrize("paper", RULED)
def test_no_tolerance_is_wider_than_the_rule(paper: str):
    """5 % of the value or of the part of it that matters, or half a unit of its last digit."""
    for key, row in published(paper).items():
        assert row["where"], key
        if row["tolerance_kind"] == "claim":
            continue
        values = each(row["independent"] if row["published"] is None else row["published"])
        for value, most in zip(values, each(row["tolerance"]), strict=True):
            limit = most * abs(value) if row["tolerance_kind"] == "relative" else most
            share = WIDE * abs(value - row.get("whole", 0.0))
            assert limit <= share * (1 + 1e-9) or row["tolerance_reason"] or value == 0.0, key


@pytest.mark.parametrize("paper", PAPERS)
def test_a_tolerance_wider_than_five_per_cent_has_its_reason(paper: str):
    for key, row in published(paper).items():
        compared = compare(row, None)
        wide = compared.tolerance_share is not None and compared.tolerance_share > WIDE * (1 + 1e-9)
        assert bool(compared.tolerance_reason) == wide, key


@pytest.mark.parametrize(
    ("paper", "key", "tolerance"),
    [
        ("liu-ni-2022", "liu-ni/friction-pair1-crc", 0.05),  # of 576 N
        ("liu-ni-2022", "liu-ni/efficiency-involute", 0.05 * 0.017),  # of the loss
        ("liu-ni-2022", "liu-ni/contact-ratio-crc", 0.01),
        ("veciana-2024", "veciana/16", 0.005),  # half a unit of the last digit of 0.01
        ("jia-2022", "jia/crown-8-8-0", 0.05 * 0.1201),  # of the rise above 1
    ],
)
def test_the_rule_gives(paper: str, key: str, tolerance: float):
    assert published(paper)[key]["tolerance"] == pytest.approx(tolerance, rel=1e-5)


def test_a_tolerance_of_an_efficiency_is_a_share_of_its_loss():
    compared = compare(EFFICIENCY | {"part": "loss", "whole": 1.0, "tolerance_reason": "friction"}, 0.984)
    assert compared.tolerance_share == pytest.approx(0.25)
    assert compared.part_difference == pytest.approx(-0.2)
    assert compared.written("tolerance") == "0.005, 25 % of the loss: friction"
    assert compared.written("difference") == "0.004, -20 % of the loss"


def test_a_tolerance_of_a_table_row_is_the_widest_of_its_columns():
    assert compare(COLUMNS, None).tolerance_share == pytest.approx(0.05)


@pytest.mark.parametrize(
    ("value", "verdict"),
    [(1.205, "pass"), (1.3, "direction"), (1.001, "direction"), (0.99, "fail"), (1.0, "fail")],
)
def test_a_direction_fails_on_the_other_side(value: float, verdict: str):
    assert compare(RISE | {"off": "direction"}, value).verdict == verdict


def test_several_columns_go_one_way_only_together():
    columns = RISE | {"published": [1.2, 1.4], "tolerance": [0.01, 0.02], "off": "direction"}
    found = compare(columns, [1.25, 1.38])
    assert (found.verdict, found.part_difference) == ("direction", pytest.approx(0.25))
    assert compare(columns, [1.25, 0.98]).verdict == "fail"


def test_what_is_not_computed_fails_unless_it_is_known():
    assert compare(NUMBER, None).verdict == "fail"
    assert compare(NUMBER | {"off": True}, None).verdict == "reported"


def test_every_standing_is_said_and_counted():
    rows = [
        compare(NUMBER, 95.0, otherwise={"the default": 80.0}),
        compare(NUMBER, 95.0, otherwise={"the default": 94.0}),
        compare(NUMBER, 50.0, otherwise={"the default": 95.0}),
        compare(NUMBER | {"off": True}, 50.0, otherwise={"the default": 95.0}),
        compare(NUMBER | {"off": True}, 50.0),
        compare(CLAIM, True, otherwise={"the default": False, "a reading": True}),
        compare(RISE | {"off": "direction"}, 1.5),
        compare(NUMBER | {"published": None, "independent": 1.0}, 1.0),
    ]
    assert [row.written("verdict") for row in rows] == [
        "pass, not under every choice",
        "pass",
        "fail",
        "reported",
        "reported",
        "pass, not under every choice",
        "direction",
        "pass",
    ]
    assert rows[0].written("otherwise") == "the default: 80, -20 %, fail"
    assert rows[5].written("otherwise") == "the default: false, fail; a reading: true, pass"
    assert sum(counts(rows).values()) == 2 * len(rows)
    assert counted(rows) == (
        "8 rows: 1 reproduced; 2 reproduced, not under every choice; 1 under another choice; "
        "1 direction only; 1 reported; 1 fail; 1 beside another implementation"
    )
