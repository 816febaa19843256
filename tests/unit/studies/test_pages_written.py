"""Which page a record has, and which files a page may be written into."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from tribodyn.errors import InputError
from tribodyn.numerics.output_files import MARKS
from tribodyn.post.page import page as written_by
from tribodyn.studies.pages import page as pages


def record_of(kind: str) -> Any:
    return SimpleNamespace(kind=kind, path=Path(f"{kind}.h5"))


def study_of(record: Any) -> Any:
    return SimpleNamespace(
        quantities=record.kind[:4],
        own_page=lambda: (lambda one: f"own page of {one.kind}") if record.kind == "design" else None,
        lines=lambda: f"lines of {record.kind}",
        sentences=lambda one: f"sentences of {one.kind}",
        panels=lambda: "panels",
        maps=lambda one: "maps",
        profiles=lambda one: "profiles",
    )


@pytest.fixture(autouse=True)
def shared(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pages, "study_of_record", study_of)
    monkeypatch.setattr(pages, "sheet", lambda record: f"sheet of {record.kind}")
    monkeypatch.setattr(written_by, "page", lambda records, told, figures: (len(records), told, figures))


def test_the_page_of_one_record_or_of_several():
    made: Any = pages.report([record_of("gear-pair"), record_of("gear-still")])
    count, told, figures = made
    assert (count, figures) == (2, True)
    assert [one.lines for one in told] == ["lines of gear-pair", "lines of gear-still"]
    assert [one.tables for one in told] == ["sheet of gear-pair", "sheet of gear-still"]
    made = pages.report([record_of("gear-pair")], figures=False)
    _, (told,), figures = made
    assert (told.tables, figures) == ((), False)
    assert pages.report([record_of("design")]) == "own page of design"
    assert pages.report([record_of("design")], figures=False)[0] == 1
    assert pages.report([record_of("design"), record_of("design")])[0] == 2
    with pytest.raises(InputError, match="of kind irefc, the first of design"):
        pages.report([record_of("design"), record_of("irefc")])
    with pytest.raises(InputError, match="nothing to report"):
        pages.report([])


def test_where_a_page_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Over pages of its own only, whatever they are called."""
    text = f"<html>{MARKS['.html'].decode()}</html>"
    monkeypatch.setattr(pages, "Record", SimpleNamespace)
    monkeypatch.setattr(pages, "SweepRecord", str)
    monkeypatch.setattr(pages, "report", lambda records: text)
    monkeypatch.setattr(pages, "sweep_report", lambda record: f"sweep {record} {text}")
    record = record_of("gear-pair")
    for name in ("a.html", "b.HTM", "a.html"):
        assert pages.write_report([record], tmp_path / name).read_text(encoding="utf-8") == text
    assert pages.write_report(["of"], tmp_path / "a.html").read_text(encoding="utf-8").startswith("sweep of")  # pyright: ignore[reportArgumentType]
    with pytest.raises(InputError, match="is a file that ends in"):
        pages.write_report([record], tmp_path / "a.txt")
    (tmp_path / "other.html").write_text(" " * 1000 + text, encoding="utf-8")
    with pytest.raises(InputError, match="tribodyn did not make it"):
        pages.write_report([record], tmp_path / "other.html")

    class Sweep(str):
        __slots__ = ()
        path = "sweep.h5"

    for some in ([Sweep("x"), record], [Sweep("x"), Sweep("y")]):
        with pytest.raises(InputError, match="a page of its own"):
            pages.write_report(some, tmp_path / "c.html")  # pyright: ignore[reportArgumentType]
    with pytest.raises(InputError, match="cannot be written: No such file"):
        pages.write_report([record], tmp_path / "none" / "c.html")
