"""Notes of published rows speak to users; what is for maintainers stands apart and is not shown."""

import re

from tribodyn.validation import PAPERS
from tribodyn.validation.published import published
from tribodyn.validation.rows import compare

FOR_MAINTAINERS = re.compile(r"docs/|prototype|tuned|tried|\bTODO\b|^same$")


def test_no_note_is_meant_for_maintainers():
    papers = [name for name, paper in PAPERS.items() if not paper.source]
    shown = {key: compare(row, None).note for name in papers for key, row in published(name).items()}
    assert not {key: note for key, note in shown.items() if FOR_MAINTAINERS.search(note)}


def test_a_remark_for_maintainers_is_not_shown():
    row = published("veciana-2024")["veciana/16"]
    assert row["for_maintainers"]
    assert row["for_maintainers"] not in compare(row, 0.05).note
