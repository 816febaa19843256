"""Notes of published rows speak to users; what is for maintainers stands apart and is not shown."""

import json
import re
from importlib.resources import files

from tribodyn.validation.rows import compare, published

FOR_MAINTAINERS = re.compile(r"docs/|prototype|tuned|tried|\bTODO\b|^same$")


def test_no_note_is_meant_for_maintainers():
    rows = json.loads(files("tribodyn.validation").joinpath("published.json").read_text(encoding="utf-8"))
    shown = {row["id"]: compare(row, None).note for row in rows}
    assert not {key: note for key, note in shown.items() if FOR_MAINTAINERS.search(note)}


def test_a_remark_for_maintainers_is_not_shown():
    row = published("veciana-2024")["veciana/16"]
    assert row["for_maintainers"]
    assert row["for_maintainers"] not in compare(row, 0.05).note
