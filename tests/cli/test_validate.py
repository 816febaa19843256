"""`tribodyn validate`: a row for every published number, and an exit status that says whether they hold."""

import json
import re
from pathlib import Path

import pytest

import tribodyn.validation
from tests.support.verbs import complaint, ended, invoke
from tribodyn.validation import PAPERS
from tribodyn.validation.rows import Row

PAPER = "efremenkov-2024"
ROW = Row("a/film", "film thickness", "um", 100.0, 101.0, 0.01, 0.02, "relative", "pass", "a note")


@pytest.mark.parametrize(("verdict", "status"), [("pass", 0), ("reported", 0), ("fail", 4)])
def test_the_exit_status_says_whether_a_row_fails(verdict: str, status: int, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(tribodyn.validation, "validate", lambda *_: [ROW._replace(verdict=verdict)])
    found = ended("validate", PAPER)
    assert found.exit_code == status
    assert found.stderr == (f"{PAPER}: outside tolerance: a/film\n" if status else "")
    assert "a note" in found.stdout
    assert "1 %" in found.stdout


def test_table_and_json_hold_every_row():
    shown, printed = invoke("validate", PAPER), invoke("validate", PAPER, "--json")
    assert shown.startswith(f"{PAPER}: as published")
    data = json.loads(printed)
    assert "as published" in data["choices"]
    keys = {"id", "published", "computed", "difference", "tolerance", "tolerance_reason", "verdict", "note"}
    assert all(keys <= row.keys() for row in data["rows"])
    assert [row["id"] for row in data["rows"]] == [row.id for row in tribodyn.validation.validate(PAPER)]
    table = " ".join(shown.split())
    (row,) = [row for row in data["rows"] if row["id"] == "efremenkov/efficiency"]
    assert row["hangs_on_choice"]
    assert "not under every choice" in table
    assert row["otherwise"][0]["choice"] in table


def test_a_paper_without_figures_says_so_before_it_runs(tmp_path: Path):
    without = next(name for name, paper in PAPERS.items() if paper.figures is None)
    said = complaint("validate", without, "--plots", tmp_path / "pictures")
    assert "none of them is drawn here" in said
    assert not (tmp_path / "pictures").exists()


@pytest.mark.parametrize("paper", [name for name, paper in PAPERS.items() if paper.figures])
def test_pictures_are_named_after_the_papers_figures(paper: str):
    """Several of one figure have a part of their own at the end."""
    names = tribodyn.validation.figures_of(paper)
    assert len(names) >= 5
    assert len(set(names)) == len(names)
    assert [name for name in names if not re.fullmatch(r"figure-[1-9]\d?(-[a-z-]+)?", name)] == []
