"""Rows of the page of a search: figures before and after."""

from types import SimpleNamespace

import pytest

from tribodyn.studies.design import page


@pytest.mark.parametrize(
    ("before", "change"), [(0.5, "+50.0 %"), (None, "–"), (0.0, "–"), (float("nan"), "–"), (1.0, "-25.0 %")]
)
def test_change_of_a_figure(monkeypatch, before, change):
    """In per cent of what it was, where that is known and not zero."""
    monkeypatch.setattr(page, "line_of", lambda *_: SimpleNamespace(label="loss", unit="W"))
    monkeypatch.setattr(page, "shown", lambda _, value: f"{value:g}")
    row = page._row({}, "loss", before, 0.75)
    assert row == ("loss", "–" if before is None else f"{before:g}", "0.75", "W", change)
    monkeypatch.setattr(page, "line_of", lambda *_: None)
    assert page._row({}, "loss", before, 0.75) is None
