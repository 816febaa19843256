"""No page of any kind is wider than the screen or the sheet of paper that it is read on."""

import re
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.support.pages import PAPER, WIDTHS, measured, needs_browser
from tests.support.soak_parameters import all_in_soak
from tribodyn.record.sweep_reader import open_any
from tribodyn.studies import STUDIES
from tribodyn.studies.pages import write_report

SWEEP = Path(__file__).parents[3] / "fixtures" / "records-0.1.0" / "sweep.h5"
#: What has a page: every kind of study, several records side by side, a sweep.
PAGES = (*(kind for kind in STUDIES if STUDIES[kind].package.startswith("tribodyn.")), "several", "sweep")


#: Those of `make test`: over time, over teeth, a table of verdicts, several records, a sweep.
SOME = ("gear-pair", "load-contact", "assessment", "several", "sweep")


@pytest.fixture(scope="module")
def widths(request, short_runs, tmp_path_factory) -> dict[str, dict[str, list]]:
    """Page -> what was measured, of those that are asked for."""
    folder = tmp_path_factory.mktemp("widths")
    own = [item for item in request.session.items if item.path == request.path]
    asked = {item.callspec.params["name"] for item in own}
    names, pages = [name for name in PAGES if name in asked], []
    for name in names:
        own = {"several": ["gear-pair", "gear-pair"], "sweep": []}.get(name, [name])
        with ExitStack() as opened:
            paths = [short_runs(kind).path for kind in own] or [SWEEP]
            records = [opened.enter_context(open_any(path)) for path in paths]
            pages.append(write_report(records, folder / f"{name}.html"))
    return dict(zip(names, measured(pages, folder), strict=True))


@needs_browser
@pytest.mark.parametrize("name", all_in_soak(PAGES, SOME))
def test_a_page_is_as_wide_as_the_screen(name, widths):
    expected = {f"{theme} {width}": width for theme in ("light", "dark") for width in WIDTHS}
    expected[f"print {PAPER}"] = PAPER
    assert {place: found[0] for place, found in widths[name].items()} == expected


@needs_browser
@pytest.mark.parametrize("name", all_in_soak(PAGES, SOME))
def test_themes_differ_and_paper_is_light(name, widths):
    bright = {place: tuple(map(brightness, found[1:])) for place, found in widths[name].items()}
    for place, (ink, ground) in bright.items():
        dark = place.startswith("dark")
        assert ground < 60 if dark else ground > 230, place
        assert ink > 200 if dark else ink < 60, place


def brightness(color: str) -> float:
    """Mean of red, green and blue, 0 to 255."""
    numbers = [float(number) for number in re.findall(r"[0-9.]+", color)[:3]]
    return sum(numbers) / 3
