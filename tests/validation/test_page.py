"""docs/validation.md, docs/rolling-elements.md and the README say what the program finds today."""

import re
from pathlib import Path

import pytest

from tools.validation_table import COUNTING, PAGES, PLAIN, VALIDATION, WORST_FIRST, counts, other, tolerance
from tribodyn.validation import PAPERS
from tribodyn.validation.published import last_digit, published
from tribodyn.validation.rows import Row, counted


def block(page: Path, name: str) -> str:
    return (
        page.read_text(encoding="utf-8").split(f"<!-- begin {name} -->")[1].split(f"<!-- end {name} -->")[0]
    )


def printed(paper: str) -> tuple[str, dict[str, list[str]]]:
    """Block of a paper, and its cells by row: published, ours, difference, tolerance, verdict, otherwise."""
    text = block(PAGES.get(paper, VALIDATION), paper)
    lines = re.findall(r"^\| `(.+?)`<br>.*?(?<!\\)\|(.*)\|$", text, re.MULTILINE)
    return text, {key: [cell.strip() for cell in cells.split("|")] for key, cells in lines}


def numbers(value) -> list[float]:
    if isinstance(value, str):
        return list(map(float, value.split()))
    return value if isinstance(value, list) else [value]


def is_within_its_tolerance(row: Row) -> bool:
    """Whether every number of a row is as near to the published one as its tolerance says."""
    given = zip(numbers(row.computed), numbers(row.published), numbers(row.tolerance), strict=True)
    relative = row.tolerance_kind == "relative"
    return all(abs(a - b) <= most * (abs(b) if relative else 1.0) for a, b, most in given)


SLOW = {"jia-2022": pytest.mark.soak}


TABLES = [name for name, paper in PAPERS.items() if not paper.source]


@pytest.mark.parametrize("paper", [pytest.param(paper, marks=SLOW.get(paper, ())) for paper in TABLES])
def test_the_rows_are_the_papers_and_the_table_of_the_page_is_up_to_date(paper: str, validated):
    """If this fails: python -m tools.validation_table PAPER --write, and read what it says."""
    rows = validated(paper)
    assert set(rows) == set(published(paper))
    for row in rows.values():
        passed = row.verdict == "pass" and row.tolerance_kind in ("relative", "absolute")
        assert not passed or row.tolerance is None or row.published is None or is_within_its_tolerance(row)
    text, page = printed(paper)
    plain = {key for key, row in rows.items() if row.standing in PLAIN}
    assert set(page) == set(rows) - plain
    assert [WORST_FIRST.index(rows[key].standing) for key in page] == sorted(
        WORST_FIRST.index(row.standing) for key, row in rows.items() if key not in plain
    )
    for key in plain:
        found = re.search(rf"`{re.escape(key)}`(?: (\S+) for (\S+?))?(?: \([^)]*\))?[;.]", text)
        assert found, key
        if found[1]:
            assert float(found[1]) == pytest.approx(rows[key].computed, rel=2e-4), key
    assert f"Computed {PAPERS[paper].choices}." in text
    assert f"In all: {counted(rows.values())}." in text
    for key, row in rows.items():
        if key in plain:
            continue
        printed_value, ours, _, tolerated, verdict, otherwise = page[key]
        assert (verdict, tolerated) == (row.written("verdict"), tolerance(row)), key
        assert [text.rpartition(", ")[2] for text in otherwise.split("<br>")] == [
            text.rpartition(", ")[2] for text in other(row).split("<br>")
        ], key
        if row.tolerance_kind == "claim":
            assert ours == ("holds" if row.computed else "does not hold"), key
            continue
        if row.computed is None:
            assert not ours
            continue
        if row.published is not None:
            assert numbers(printed_value) == pytest.approx(numbers(row.published), rel=1e-4), key
        assert numbers(ours) == pytest.approx(numbers(row.computed), rel=2e-4), key


@pytest.mark.parametrize("book", [name for name in PAPERS if name not in TABLES])
def test_the_page_has_the_source_of_a_book_and_the_rows_that_differ(book: str, validated):
    """If this fails: python -m tools.validation_table BOOK --write, and read what it says."""
    rows, text = validated(book), block(PAGES[book], book)
    source = PAPERS[book].source
    assert source is not None
    assert source.said() in text
    assert f"In all: {counted(rows.values())}." in text
    lines = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| `")]
    off = {key.partition("/")[2]: row for key, row in rows.items() if row.verdict != "pass"}
    assert {line[0].strip("`") for line in lines} == set(off)
    for name, _, published_text, ours, *_, reason in lines:
        row = off[name.strip("`")]
        assert (published_text, reason) == (row.printed, row.note), name
        if row.computed is not None:
            assert float(ours) == pytest.approx(row.computed, abs=0.2 * last_digit(row.printed)), name


@pytest.mark.parametrize("page", COUNTING, ids=lambda page: page.name)
def test_readme_and_page_count_as_the_tables_do(page: Path):
    assert block(page, "counts").strip() == counts()
