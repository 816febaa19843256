"""The notebooks of the documentation: their cells run in order, and what they end with can be shown."""

import ast
import re
from pathlib import Path
from typing import Any

import matplotlib
import pytest
from matplotlib import pyplot

from tests.support.passed_before import unless_passed
from tests.support.soak_parameters import all_in_soak

NOTEBOOKS = sorted((Path(__file__).parents[2] / "docs" / "notebooks").glob("*.md"))
#: What takes long in a notebook -> a shorter one that runs the same cells.
SHORTER = {
    "sweep-and-resonance": {
        "np.arange(140.0, 621.0, 20.0)": "np.arange(300.0, 581.0, 40.0)",
        "[0.04, 0.05, 0.06, 0.08, 0.1]": "[0.05, 0.1]",
    },
    "compare-tooth-forms": {"(3, 5, 10, 20, 40, 80)": "(3, 80)"},
    "reducer-from-data-sheet": {'"slices": 11': '"slices": 5', '"cycles": 14': '"cycles": 7'},
    "find-a-crack": {'drives = "1:16:1"': 'drives = "1:4:1"'},
}
#: Heading behind which a notebook is run in soak only: finite elements of four gears take half a minute, and
#: what an assessment says of a train is tested in `unit/studies/assessment`.
UP_TO = {"reducer-from-data-sheet": "## One page"}
#: Packages of the documentation that a notebook needs besides.
NEEDS = {"find-a-crack": "sklearn"}
#: Ways in which an object says how a notebook shall show it; what has none is shown by `repr`.
SHOWN_BY = ("_repr_html_", "_repr_svg_", "_repr_png_")


def stem(page: Path) -> str:
    return page.stem


def cells(text: str) -> list[tuple[int, str]]:
    """Line and source of the code cells, without the options that begin them."""
    found = re.finditer(r"^```\{code-cell\} ipython3\n((?::.*\n)*)((?:.*\n)*?)```$", text, re.MULTILINE)
    return [(text[: cell.start(2)].count("\n"), cell[2]) for cell in found]


def execute(source: str, where: str, line: int, names: dict[str, Any]) -> None:
    """Run a cell, and show what its last line gives, as a notebook does."""
    tree = ast.increment_lineno(ast.parse(source), line)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, where, "exec"), names)
    if not isinstance(last, ast.Expr):
        return
    shown = eval(compile(ast.Expression(last.value), where, "eval"), names)
    ways = [getattr(shown, way)() for way in SHOWN_BY if hasattr(shown, way)]
    assert shown is None or ways or repr(shown)


@pytest.mark.slow
@pytest.mark.parametrize("page", all_in_soak(NOTEBOOKS, lambda page: page.stem not in UP_TO), ids=stem)
def test_a_notebook_runs(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
):
    run_notebook(page, page.read_text(encoding="utf-8"), tmp_path, monkeypatch, request)


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page in NOTEBOOKS if page.stem in UP_TO], ids=stem)
def test_a_long_notebook_runs_up_to_a_heading(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
):
    text, heading, rest = page.read_text(encoding="utf-8").partition(UP_TO[page.stem])
    assert "```{code-cell}" in rest, heading
    run_notebook(page, text, tmp_path, monkeypatch, request)


def run_notebook(
    page: Path, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    """Run a notebook's text, shortened."""
    matplotlib.use("agg")
    if page.stem in NEEDS:
        pytest.importorskip(NEEDS[page.stem])
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {"__name__": "__main__"}
    for long, short in SHORTER.get(page.stem, {}).items():
        assert text.count(long) == 1, long
        text = text.replace(long, short)
    found = cells(text)
    assert len(found) == text.count("```{code-cell}") > 4
    try:
        with unless_passed(request, text):
            for line, source in found:
                execute(source, str(page), line, names)
            assert list(tmp_path.iterdir()) == []  # nothing is left in the reader's folder
    finally:
        pyplot.close("all")
