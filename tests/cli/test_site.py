"""The documentation site: its contents, generated pages, and places in the source that pages name."""

import ast
import math
import re
import shlex
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from typer.main import get_command

import tribodyn
from tools.command_line_page import PAGE, page
from tools.shipped_table import PAGES, counts
from tribodyn.cli.app import app
from tribodyn.geometry.families import FAMILIES
from tribodyn.input.sources import names, shipped
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"


def contents() -> list[str]:
    """Pages of the site's table of contents, as docs/conf.py names them."""
    for statement in ast.parse((DOCS / "conf.py").read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.Assign) and ast.unparse(statement.targets[0]) == "CONTENTS":
            return [page for pages in ast.literal_eval(statement.value).values() for page in pages]
    raise AssertionError("docs/conf.py names no contents")


def test_the_table_of_contents_holds_every_page_once():
    pages = [str(path.relative_to(DOCS).with_suffix("")) for path in DOCS.rglob("*.md")]
    pages = [page for page in pages if page != "index" and not page.startswith("_build")]
    for page_ in pages:
        assert contents().count(page_) == 1, page_
    assert set(contents()) <= set(pages)


def test_the_first_page_leads_to_every_other():
    leads = set(re.findall(r"\]\(([\w/-]+)\.md\)", (DOCS / "index.md").read_text(encoding="utf-8")))
    assert set(contents()) <= leads


def test_every_page_has_one_title_of_its_own():
    titles = {}
    for page_ in [ROOT / "README.md", *(DOCS / f"{name}.md" for name in ["index", *contents()])]:
        prose = re.sub(r"^```.*?^```$", "", page_.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
        titles[page_.relative_to(ROOT)] = re.findall(r"^# (.*)$", prose, re.MULTILINE)
    assert {page_: found for page_, found in titles.items() if len(found) != 1} == {}
    names = [found[0] for page_, found in titles.items() if page_.name != "README.md"]
    assert sorted(names) == sorted(set(names))


def test_the_page_of_the_command_line_is_current():
    assert page() in PAGE.read_text(encoding="utf-8"), "python -m tools.command_line_page --write"


def test_the_counts_of_what_is_shipped_are_current():
    for page_ in PAGES:
        assert counts() in page_.read_text(encoding="utf-8"), "python -m tools.shipped_table --write"
    files = len(list((ROOT / "scenarios").glob("*.toml")))
    assert f"| scenarios | {files} |" in counts()


def test_the_readme_describes_the_drive_of_the_demo():
    name = re.search(r"tribodyn run (\S+) .*--output demo/", (ROOT / "Makefile").read_text(encoding="utf-8"))
    assert name is not None
    case = tribodyn.scenario(name[1]).pair
    teeth = f"{case.drive.pinion.teeth:.0f} and {case.drive.gear.teeth:.0f} teeth"
    power = (
        case.operating.gear_torque
        * case.operating.pinion_speed
        * case.drive.pinion.teeth
        / case.drive.gear.teeth
    )
    duty = f"{power * 1e-3:.0f} kW at {case.operating.pinion_speed * 30 / math.pi:.0f} rpm"
    assert f"pair, {teeth}, {duty}:" in (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_page_of_laws_names_every_law_and_what_it_names_exists():
    text = (DOCS / "laws.md").read_text(encoding="utf-8")
    for name in (*FAMILIES, *FILM_LAWS, *FRICTION_LAWS):
        assert f"`{name}`" in text, name
    theory = "".join((DOCS / f"{page_}.md").read_text(encoding="utf-8") for page_ in ("theory", "trains"))
    for place in re.findall(r"`((?:tribodyn|tests)/[^`]*)`", text + theory):
        assert (ROOT / place).exists(), place
    for name, place in re.findall(r"`(\w+)`(?: and `\w+`)? in `([^`]*\.py)`", theory):
        source = (ROOT / place).read_text(encoding="utf-8")
        assert re.search(rf"^(def|class) {name}\(", source, re.MULTILINE), name


def test_the_reference_of_the_package_has_every_public_name_with_an_example():
    text = (DOCS / "api.md").read_text(encoding="utf-8")
    for name in set(tribodyn.__all__) - {"__version__"}:
        called = "." if isinstance(getattr(tribodyn, name), ModuleType) else "("
        assert re.search(rf":: td\.{name}(::|\.)", text) if called == "." else f":: td::{name}\n" in text, (
            name
        )
        if not isinstance(getattr(tribodyn, name), type):
            section = text.partition(f"## td.{name}\n")[2].partition("\n## ")[0]
            assert f"td.{name}{called}" in section.partition("```python\n")[2].partition("```")[0], name


def test_commands_of_the_gallery_parse_and_name_shipped_scenarios():
    """They are run elsewhere: all scenarios, and all figures of a record."""
    text = (DOCS / "gallery.md").read_text(encoding="utf-8")
    commands = re.findall(r"^tribodyn (.*)$", text, re.MULTILINE)
    assert len(commands) > 8
    for command in commands:
        verb, *words = shlex.split(command)
        get_command(app).get_command(None, verb).make_context(verb, [*words])  # type: ignore[attr-defined]
        if verb in ("run", "sweep"):
            assert words[0] in names(shipped("scenarios"))


@pytest.mark.soak
def test_the_site_builds_without_a_warning_and_asks_no_other_host(tmp_path):
    pytest.importorskip("myst_nb")
    words = ["-m", "sphinx", "--fail-on-warning", "--keep-going", "-q", "-b", "html", DOCS, tmp_path / "site"]
    built = subprocess.run([sys.executable, *map(str, words)], capture_output=True, text=True)
    assert built.returncode == 0, built.stderr
    pages = {path.name: path.read_text(encoding="utf-8") for path in (tmp_path / "site").rglob("*.html")}
    assert "<math" in pages["physics.html"]
    for name, text in pages.items():
        assert not re.findall(r'<(?:script|link|img|iframe)[^>]*(?:src|href)="(?:https?:)?//[^"]*', text), (
            name
        )
        assert text.count("<h1") == (name != "search.html"), name
    styles = "".join(path.read_text(encoding="utf-8") for path in (tmp_path / "site").rglob("*.css"))
    assert not re.findall(r"(?:@import|url\()[ \"']*(?:https?:)?//", styles)
