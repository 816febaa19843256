"""Books: numbers of listings are judged by their last digit; what held fails where it no longer does."""

import pytest

from tests.support.verbs import ended
from tribodyn.validation import PAPERS
from tribodyn.validation.published import decimals, last_digit, published
from tribodyn.validation.rows import compare

BOOKS = [name for name, paper in PAPERS.items() if paper.source]
ROW = {
    "id": "x",
    "quantity": "force",
    "unit": "N",
    "published": 1.09,
    "printed": "1.09",
    "tolerance": 0.005,
    "tolerance_kind": "absolute",
    "independent": None,
    "note": "",
}


def test_the_last_printed_digit():
    assert [decimals(text) for text in ("1.09", "8.", "1.31e9")] == [2, 0, 2]
    assert [last_digit(text) for text in ("1.09", "8.", "1.31e9", "8.48e-5")] == pytest.approx(
        [0.01, 1.0, 1e7, 1e-7]
    )
    shown = compare(ROW, 1.0927)
    assert (shown.written("published"), shown.written("computed"), shown.verdict) == ("1.09", "1.093", "pass")


def test_what_held_fails_and_what_is_known_to_differ_is_reported():
    assert compare(ROW, 1.096).verdict == "fail"
    assert compare(ROW | {"off": True, "note": "another K_v"}, 1.096).verdict == "reported"
    claim = ROW | {"published": True, "printed": "", "tolerance": None, "tolerance_kind": "claim"}
    assert compare(claim, False).verdict == "fail"
    assert compare(claim | {"off": True}, False).verdict == "reported"


@pytest.mark.parametrize("book", BOOKS)
def test_rows_agree_or_have_their_reason(book: str, validated):
    rows = validated(book)
    assert set(rows) == set(published(book))
    for row in rows.values():
        assert row.verdict in ("pass", "reported"), row.id
        assert row.note or row.verdict == "pass", row.id
        assert row.computed is not None or row.note.startswith("not computed: "), row.id


def test_there_are_enough_rows_and_few_of_them_differ(validated):
    rows = [row for book in BOOKS for row in validated(book).values()]
    assert len(rows) >= 1000
    assert sum(row.verdict == "pass" for row in rows) >= 0.93 * len(rows)


def test_a_book_says_where_it_is_from():
    found = ended("validate", "iso-tr-6336-30")
    assert found.exit_code == 0
    assert "ISO/TR 6336-30: 2017 (ISO 6336:2006)" in found.stdout
    assert "licence: none named; MIT" in " ".join(found.stdout.split())
