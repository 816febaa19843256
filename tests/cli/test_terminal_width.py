"""On a narrow terminal words go on to the next line, no line is too long, and no number is broken or cut."""

import re
import shutil
from collections import Counter
from pathlib import Path

import pytest

from tests.support.short_studies import short_case
from tests.support.verbs import ended, invoke
from tribodyn.studies import STUDIES
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.studies.protocol.study import Study

#: A number as it stands in a text; those in names, such as crc-23-47, are numbers too.
NUMBER = re.compile(r"\d[\d.,]*(?:e[+-]?\d+)?")
WIDE, NARROW = 1000, (80, 60)


@pytest.fixture(scope="module")
def studies(tmp_path_factory, short_runs) -> Path:
    """A short scenario and its record of every kind, and a sweep."""
    folder = tmp_path_factory.mktemp("studies")
    for kind in STUDIES:
        written = short_case(kind, folder).toml
        (folder / f"{kind}.toml").write_text(written, encoding="utf-8")
        shutil.copy(short_runs(kind).path, folder)
    swept = ["sweep", "gear-pair.toml", "--vary", "operating.pinion_speed=1000,12000rpm", "-o", "swept.h5"]
    invoke(*swept, "--transient", "2", folder=folder)
    return folder


def shown(words: list[str], width: int) -> str:
    terminal = {"FORCE_COLOR": "1", "TERM": "xterm", "COLUMNS": str(width)}
    found = ended(*words, env=terminal)
    assert found.exit_code in (0, 4), found.output
    return re.sub(r"\x1b\[[0-9;]*m", "", found.stdout)


def check_narrow(words: list[str]) -> None:
    numbers = Counter(NUMBER.findall(shown(words, WIDE)))
    for width in NARROW:
        narrow = shown(words, width)
        assert max(len(line) for line in narrow.splitlines()) <= width, words
        found = Counter(NUMBER.findall(narrow))
        # a name that is as long as a line may be broken; a heading that became a label may come again
        assert not {number for number in numbers if numbers[number] > found[number]}, words


@pytest.mark.parametrize("kind", list(STUDIES))
def test_summaries_and_checks(kind, studies, monkeypatch):
    monkeypatch.chdir(studies)
    checked = STUDIES[kind].check(load_scenario(f"{kind}.toml"))
    monkeypatch.setattr(Study, "check", lambda *_, **__: checked)  # once for all widths
    check_narrow(["show", f"{kind}.h5"])
    check_narrow(["check", f"{kind}.toml"])


def test_sweeps_and_comparisons(studies, monkeypatch):
    monkeypatch.chdir(studies)
    check_narrow(["show", "swept.h5"])
    check_narrow(["compare", "gear-pair.h5", "efficiency.h5"])
    for copy in ("b", "c", "d"):
        Path(f"{copy}.h5").write_bytes(Path("gear-pair.h5").read_bytes())
    check_narrow(["compare", "gear-pair.h5", "b.h5", "c.h5", "d.h5", "efficiency.h5"])


@pytest.mark.parametrize(
    "words", [["list"], ["gear", "liu-ni-crc-23-47"], ["validate", "efremenkov-2024"]], ids=" ".join
)
def test_lists_sheets_and_validations(words):
    check_narrow(words)


def test_figures_are_listed_for_sweeps_and_refused_for_what_has_none(studies, monkeypatch):
    monkeypatch.chdir(studies)
    assert "campbell" in shown(["list", "plots", "swept.h5"], WIDE)
    for words in (["list", "laws", "gear-pair.h5"], ["list", "plots", "gear-pair.toml"]):
        assert ended(*words).exit_code == 2


def test_papers_are_listed_with_their_titles():
    listed = shown(["list", "papers"], WIDE)
    assert re.search(r"^ liu-ni-2022 +Liu & Ni, Mechanics & Industry", listed, re.MULTILINE)
