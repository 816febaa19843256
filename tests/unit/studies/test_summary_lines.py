"""Every line of every summary is defined, and the page of the summary says the same."""

from pathlib import Path

import pytest

from tools.summary_table import tables
from tribodyn.studies import STUDIES

PAGE = Path(__file__).parents[3] / "docs" / "summary.md"
OWN = [kind for kind in STUDIES if STUDIES[kind].package.startswith("tribodyn.")]


@pytest.mark.parametrize("kind", OWN)
def test_every_line_has_one_definition(kind):
    for lines in STUDIES[kind].lines().values():
        for line in lines:
            assert line.definition.endswith("."), line.name


def test_the_page_has_the_lines_as_they_are():
    text = PAGE.read_text(encoding="utf-8")
    inside = text.partition("<!-- begin summary lines -->")[2].partition("<!-- end summary lines -->")[0]
    assert inside.strip() == tables().strip(), "write the page anew: python -m tools.summary_table"
