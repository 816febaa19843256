"""`tribodyn validate`: a row for every published number, and an exit status that says whether they hold."""

import json
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from typer.testing import CliRunner

import tribodyn.validation
from tribodyn.cli.app import app
from tribodyn.validation.rows import Otherwise, Row

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
    printed = json.loads(CliRunner().invoke(app, ["validate", "a", "--json"]).stdout)
    rows = printed["rows"]
    keys = {"id", "published", "computed", "difference", "tolerance", "tolerance_reason", "verdict", "note"}
    assert [keys <= row.keys() for row in rows] == [True, True]
    assert [row["published"] for row in rows] == [100.0, True]
    assert printed["counts"]["number"]["rows"] == 2
    assert rows[0]["otherwise"] is None


def test_the_same_under_another_choice_stands_beside(monkeypatch: pytest.MonkeyPatch):
    default = Otherwise("the default", 79.0, -0.21, "fail")
    rows = [ROW._replace(tolerance=0.2, tolerance_share=0.2, tolerance_reason="why", otherwise=default)]
    monkeypatch.setattr(tribodyn.validation, "validate", lambda *_: rows)
    printed = json.loads(CliRunner().invoke(app, ["validate", "a", "--json"]).stdout)
    assert printed["rows"][0]["otherwise"] == default._asdict()
    assert printed["rows"][0]["hangs_on_choice"] is True
    table = " ".join(CliRunner().invoke(app, ["validate", "a"]).stdout.split())
    for text in ("under this choice only", "the default: 79", "20 %: why"):
        assert text in table


def test_the_head_says_under_which_choices_a_paper_is_computed(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(tribodyn.validation, "validate", lambda *_: ROWS)
    ended = CliRunner().invoke(app, ["validate", "efremenkov-2024"])
    assert ended.stdout.startswith("efremenkov-2024: as published")
    assert "2 numbers: 1 pass, 1 reported" in ended.stdout
    assert (
        "as published"
        in json.loads(CliRunner().invoke(app, ["validate", "efremenkov-2024", "--json"]).stdout)["choices"]
    )


def test_pictures_are_drawn_and_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    drawn = tmp_path / "pictures" / "diez-ibarbia-figure-06.png"
    monkeypatch.setattr(tribodyn.validation, "validate", lambda *_: ROWS)
    monkeypatch.setattr(tribodyn.validation, "draw", lambda paper, plots, *_, **__: [plots / drawn.name])
    ended = CliRunner().invoke(app, ["validate", "diez-ibarbia", "--json", "--plots", str(drawn.parent)])
    assert ended.exit_code == 0
    assert json.loads(ended.stdout)["pictures"] == [str(drawn)]


def test_a_paper_without_figures_says_so_before_it_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.delitem(tribodyn.validation.FIGURES, "diez-ibarbia")
    ended = CliRunner().invoke(app, ["validate", "diez-ibarbia", "--plots", str(tmp_path / "pictures")])
    assert ended.exit_code == 2
    assert "none of them is drawn here" in ended.stderr
    assert not (tmp_path / "pictures").exists()


def test_every_figure_of_a_paper_is_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    done = []
    names = tribodyn.validation.figure_names("diez-ibarbia")
    monkeypatch.setattr(
        "tribodyn.validation.figures.diez_ibarbia.FIGURES", dict.fromkeys(names, lambda _: Figure())
    )
    pictures = tribodyn.validation.draw("diez-ibarbia", tmp_path, tmp_path, done.append)
    assert [picture.name for picture in pictures] == [f"diez-ibarbia-{name}.png" for name in names]
    assert all(picture.exists() for picture in pictures)
    assert done[-1] == 1.0


@pytest.mark.parametrize("paper", tribodyn.validation.FIGURES)
def test_figures_have_names_of_their_own(paper: str):
    names = tribodyn.validation.figure_names(paper)
    assert len(names) > 5
    assert len(set(names)) == len(names)
