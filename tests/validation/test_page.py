"""docs/validation.md says what the program finds today."""

import re
from pathlib import Path

import pytest

from tribodyn.validation import validate

PAGE = (Path(__file__).parents[2] / "docs" / "validation.md").read_text(encoding="utf-8")


def printed(paper: str) -> dict[str, list[str]]:
    """Cells by row: published, ours, difference, tolerance, verdict."""
    block = PAGE.split(f"<!-- begin {paper} -->")[1].split(f"<!-- end {paper} -->")[0]
    lines = re.findall(r"^\| `(.+?)`<br>[^|]*\|(.*)\|$", block, re.MULTILINE)
    return {key: [cell.strip() for cell in cells.split("|")] for key, cells in lines}


@pytest.mark.parametrize(
    "paper", ["liu-ni-2022", "diez-ibarbia", pytest.param("jia-2022", marks=pytest.mark.soak)]
)
def test_the_table_of_the_page_is_up_to_date(paper: str, tmp_path: Path):
    """If this fails: tools/validation_table.py PAPER --into docs/validation.md, and read what it says."""
    rows = {row.id: row for row in validate(paper, folder=tmp_path)}
    page = printed(paper)
    assert set(page) == set(rows)
    for key, row in rows.items():
        published, ours, _, _, verdict = page[key]
        assert verdict == row.verdict, key
        if row.tolerance_kind == "claim":
            assert ours == ("holds" if row.computed else "does not hold"), key
        else:
            if row.published is not None:
                assert float(published) == pytest.approx(row.published, rel=1e-4), key
            assert float(ours) == pytest.approx(row.computed, rel=2e-4), key
