"""docs/validation.md, docs/rolling-elements.md and the README say what the program finds today."""

import re
from pathlib import Path

import pytest

from tools.validation_table import COUNTING, PAGES, VALIDATION, counts, other, tolerance
from tribodyn.validation import PAPERS, validate
from tribodyn.validation.rows import counted


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
        return [float(number) for number in value.split()]
    return value if isinstance(value, list) else [value]


@pytest.mark.parametrize(
    "paper", [pytest.param(name, marks=pytest.mark.soak) if name == "jia-2022" else name for name in PAPERS]
)
def test_the_table_of_the_page_is_up_to_date(paper: str, tmp_path: Path):
    """If this fails: python -m tools.validation_table PAPER --write, and read what it says."""
    rows = {row.id: row for row in validate(paper, folder=tmp_path)}
    text, page = printed(paper)
    assert set(page) == set(rows)
    assert f"Computed {PAPERS[paper].choices}." in text
    assert f"In all: {counted(rows.values())}." in text
    for key, row in rows.items():
        published, ours, _, tolerated, verdict, otherwise = page[key]
        assert (verdict, tolerated) == (row.written("verdict"), tolerance(row)), key
        assert otherwise.rpartition(", ")[2] == other(row, row.otherwise).rpartition(", ")[2], key
        if row.tolerance_kind == "claim":
            assert ours == ("holds" if row.computed else "does not hold"), key
            continue
        if row.published is not None:
            assert numbers(published) == pytest.approx(numbers(row.published), rel=1e-4), key
        assert numbers(ours) == pytest.approx(numbers(row.computed), rel=2e-4), key


@pytest.mark.parametrize("page", COUNTING, ids=lambda page: page.name)
def test_readme_and_page_count_as_the_tables_do(page: Path):
    assert block(page, "counts").strip() == counts()
