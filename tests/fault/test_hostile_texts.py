"""Whatever texts a scenario, a record or a file's name has: figures and pages show them as texts."""

import html
import tomllib
from contextlib import suppress
from pathlib import Path
from xml.etree import ElementTree

import matplotlib as mpl
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text

import tribodyn as td
from tests.support.hostile_texts import HOSTILE, LONG, hostile_copy
from tests.support.short_studies import ShortRuns, shortened, written_template
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import ended
from tribodyn.post.style import house_style, literal, save
from tribodyn.record.reader import Record
from tribodyn.record.sweep_reader import SweepRecord
from tribodyn.studies import STUDIES
from tribodyn.studies.pages import (
    figure,
    names,
    report,
    summary_table,
    sweep_figure,
    sweep_names,
    sweep_report,
)

OLD = Path(__file__).parents[1] / "fixtures" / "records-0.1.0"
#: Kinds whose figures and pages `make test` draws: of samples over time, of a curve; the others in soak.
DRAWN = ("gear-pair", "irefc")


def drawn(figure: Figure) -> list[str]:
    """Draw a figure; the texts in it."""
    figure.dpi = 20
    with house_style():
        FigureCanvasAgg(figure).draw()
    return [text.get_text() for text in figure.findobj(Text) if isinstance(text, Text)]


@pytest.fixture
def hostile(short_runs: ShortRuns, tmp_path: Path):
    """A record of a kind in which all texts are the given one."""
    return lambda kind, text: hostile_copy(short_runs(kind).path, tmp_path, text)


@pytest.mark.parametrize("kind", all_in_soak(STUDIES, DRAWN))
def test_every_figure_and_page_of_a_kind(kind: str, hostile):
    path = hostile(kind, HOSTILE)
    with Record(path) as record, Record(path) as other:
        found = [text for name in ("overview", *names([record])) for text in drawn(figure(name, [record]))]
        assert kind.endswith("assessment") or literal(HOSTILE)[1:] in " ".join(found)
        for name in names([record, other])[::3]:
            with suppress(td.InputError):  # a figure of one record
                drawn(figure(name, [record, other]))
        assert summary_table(record).renderables
        is_text_only(report([record]))
    is_text_only(td.open(path)._repr_html_())


@pytest.mark.parametrize("kind", ["gear-pair", "irefc"])
def test_a_text_that_is_too_long(kind: str, hostile):
    with Record(hostile(kind, LONG)) as record:
        for name in ("overview", *names([record])[:2]):
            assert max(map(len, drawn(figure(name, [record])))) < 400


def test_every_figure_and_page_of_a_sweep(tmp_path: Path):
    path = hostile_copy(OLD / "sweep.h5", tmp_path, HOSTILE)
    with SweepRecord(path) as record, SweepRecord(path) as other:
        for records in ([record], [record, other]):
            found = [text for name in sweep_names(records) for text in drawn(sweep_figure(name, records))]
            assert literal(HOSTILE)[1:] in " ".join(found)
        is_text_only(sweep_report(record))
    is_text_only(td.open(path)._repr_html_())


def is_text_only(page: str) -> None:
    """Whether nothing in a page is an element that the text names."""
    assert "<b onload" not in page
    assert "</script><b" not in page
    assert html.escape("<b onload=a>") in page or r"\u003cb onload" in page


@pytest.mark.parametrize("ending", ["svg", "pdf"])
def test_a_file_for_print(ending: str, hostile, tmp_path: Path):
    with Record(hostile("backlash-oscillator", HOSTILE)) as record:
        picture = save(figure("overview", [record]), tmp_path / f"a.{ending}")
    if ending == "svg":
        said = "".join(ElementTree.parse(picture).getroot().itertext())
        assert literal(HOSTILE)[1:].replace(r"\$", "$") in said


@pytest.mark.parametrize(
    "text", [HOSTILE.replace("🦷漢", ""), "$", "$$", "\\$", r"\$a\$ \\$", "_", "", "a_b^c"]
)
def test_a_literal_text_is_drawn_as_it_is(text: str, tmp_path: Path):
    """The letters of an SVG are those of the text, also beside a formula."""
    with house_style(), mpl.rc_context():
        picture = Figure((3, 1))
        picture.text(0.0, 0.5, rf"$\mathbf{{(a)}}$ {literal(text)}")
        picture.text(0.0, 0.0, literal(text))
    root = ElementTree.parse(save(picture, tmp_path / "a.svg")).getroot()
    groups = [element for element in root.iter() if element.get("id", "").startswith("text_")]
    letters = ["".join("".join(group.itertext()).split()) for group in groups]
    shown = "".join(literal(text).replace(r"\$", "$").split())
    assert letters[:2] == [f"(a){shown}", shown][: len(groups)]


def test_a_run_of_a_scenario_with_such_a_title(tmp_path: Path):
    kind, title = "backlash-oscillator", r"a $\badmacro$ b"
    path = written_template(kind, tmp_path)
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(tomllib.loads(text)["title"], title.replace("\\", r"\\")), encoding="utf-8")
    found = ended("run", path, "-o", tmp_path / "a.h5", "--report", "--plot", *shortened(kind))
    assert (found.exit_code, found.stderr) == (0, "")
    assert title in found.stdout
    assert (tmp_path / "a-overview.png").stat().st_size > 1000


def test_a_drive_with_such_a_title(tmp_path: Path):
    words = ("gear", "liu-ni-involute-23-47", "-o", tmp_path, "--points", "10")
    found = ended(*words, "--set", r"drive.title=a $\badmacro$ 🦷 b")
    assert (found.exit_code, found.stderr) == (0, "")
