"""`tribodyn validate`: a row for every published number, and an exit status that says whether they hold."""

import json

import pytest
from typer.testing import CliRunner

import tribodyn.validation
from tribodyn.cli.app import app
from tribodyn.validation.rows import Row

ROW = Row("a/load", "normal load", "N", 100.0, 101.0, 0.01, 0.02, "relative", "pass", "a note")
ROWS = [ROW, ROW._replace(id="a/claim", published=True, computed=False, difference=None, verdict="reported")]


@pytest.mark.parametrize(("verdict", "status"), [("pass", 0), ("reported", 0), ("fail", 4)])
def test_the_exit_status_says_whether_a_row_fails(verdict: str, status: int, monkeypatch: pytest.MonkeyPatch):
    rows = [*ROWS, ROW._replace(id="a/film", verdict=verdict)]
    monkeypatch.setattr(tribodyn.validation, "validate", lambda *_: rows)
    ended = CliRunner().invoke(app, ["validate", "a"])
    assert ended.exit_code == status
    assert ended.stderr == ("a: outside tolerance: a/film\n" if status else "")
    assert "a note" in ended.stdout
    assert "1 %" in ended.stdout


def test_json_holds_every_row(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(tribodyn.validation, "validate", lambda *_: ROWS)
    rows = json.loads(CliRunner().invoke(app, ["validate", "a", "--json"]).stdout)["rows"]
    keys = {"id", "published", "computed", "difference", "tolerance", "verdict", "note"}
    assert [keys <= row.keys() for row in rows] == [True, True]
    assert [row["published"] for row in rows] == [100.0, True]
