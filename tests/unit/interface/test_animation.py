"""The teeth rolling in a notebook: a page of its own inside the cell."""

import html
import json
import re
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.interface.result import Run
from tribodyn.post.page import document


@pytest.fixture(scope="module")
def crc() -> Run:
    return td.run("efficiency-crc-23-47")


def test_a_frame_holds_the_page_and_asks_nothing_of_other_places(crc):
    animation = crc.animate()
    frame = animation._repr_html_()
    (page,) = re.findall(r'<iframe srcdoc="([^"]*)"', frame)
    assert html.unescape(page) == animation.html
    assert 'sandbox="allow-scripts"' in frame
    assert len(animation.html) < 5e5  # without the library of the figures
    assert "default-src 'none'" in animation.html
    (data,) = re.findall(r'id="data">(.*?)</script>', animation.html, re.DOTALL)
    (record,) = json.loads(data)["records"]
    assert record["teeth"]["pairs"] == 2
    assert {"normal_load", "hertz_pressure"} <= {series["name"] for series in record["series"]}
    assert "animation" in repr(animation)


def test_several_runs_can_be_chosen_from(crc):
    both = crc.animate(td.run("efficiency-involute-18-36"))
    (data,) = re.findall(r'id="data">(.*?)</script>', both.html, re.DOTALL)
    assert len(json.loads(data)["records"]) == 2


def test_what_has_no_teeth_is_refused():
    with pytest.raises(td.InputError, match="no gears that turn"):
        td.run("backlash-oscillator", {"frequency": [0.5]}).animate()


@pytest.mark.slow
@pytest.mark.skipif(
    document.browser() is None, reason="no browser: install Chromium (apt-get install chromium)"
)
def test_a_browser_shows_it(crc, tmp_path: Path):
    """Ready, at the place that was asked for, with the loads there; its frame too."""
    page = tmp_path / "animation.html"
    page.write_text(crc.animate().html, encoding="utf-8")
    shown = document.run_browser("--dump-dom", f"{page.as_uri()}#at=3").stdout
    assert 'data-ready="yes"' in shown
    assert 'data-at="3"' in shown
    assert re.search(r"<td>normal load, pair 1</td><td>[\d.]+ N</td>", shown)
    assert 'class="teeth-alone"' in shown
