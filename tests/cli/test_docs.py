"""Every page of the documentation: commands run, scenarios load, Python runs, links lead somewhere.

Blocks differ by the words after the fence: ``toml scenario`` is a whole scenario, ``toml fragment``
is put over the shipped CRC scenario, ``csv NAME``, ``python NAME`` and ``toml NAME`` are files that others
on the page refer to, ``console`` holds shell commands, of which those of tribodyn run on shorter studies.
"""

import ast
import os
import re
import shlex
import subprocess
import sys
import tomllib
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib
import pytest
from matplotlib import pyplot
from typer.main import get_command

import tribodyn as td
from tests.support.loss_maps import write_map
from tests.support.passed_before import unless_passed
from tests.support.short_studies import shorter
from tests.support.soak_parameters import all_in_soak
from tests.support.verbs import invoke, sets
from tribodyn.cli.app import app
from tribodyn.input.sources import find_scenario, names, shipped
from tribodyn.studies.protocol.load import load_every, load_scenario

ROOT = Path(__file__).parents[2]
PAGES = [
    ROOT / "README.md",
    *sorted((ROOT / "docs").glob("*.md")),
    *sorted((ROOT / "docs").glob("how-to/*.md")),
]
RECORD = "crc-23-47"
#: Calls of which another page has an example that takes less, or a test beside them; by page. Run in soak.
ALIKE = {
    "helical.md": ("td.gradient(",),
    "identify.md": ("td.identify(",),
    "python.md": ("td.differentiable(", "second.hertz_pressure"),
    "api.md": ("td.identify(", "td.gradient(", "td.differentiable(", "td.explore("),
    "design.md": ("td.design(",),
    "fmu.md": ("fmpy.simulate_fmu(",),
    "housing.md": ("td.plate_housing(",),
    "map.md": ("td.map(",),
    "wear.md": ('td.run("wear-18-36"',),
}
#: Pages whose commands take long, or are those of other tests: `make test` reads their words only.
LONG = {
    *("cad.md", "drive-cycle.md", "efficiency.md", "fmu.md", "gear-sheet.md", "load-contact.md", "map.md"),
    *("measured-flanks.md", "rexs.md", "scenario.md", "shafts.md", "trains.md"),
}


#: A run with the page's family; its limit, the involute; a path that ends before the teeth.
LINEAR = """
import tribodyn as td
print(1 - td.run("linear-23-47.toml").summary["efficiency"])
drive = "drive.shape.length"
print(td.drive("linear-23-47.toml", {drive: "1e8 mm"}).contact_ratio)
print(td.drive("liu-ni-involute-23-47").contact_ratio)
try:
    td.drive("linear-23-47.toml", {drive: "10 mm"})
except td.InputError as mistake:
    print(mistake)
"""


class Block(NamedTuple):
    page: Path
    line: int
    language: str
    info: str
    text: str

    def __str__(self) -> str:
        return f"{self.page.name}:{self.line}"


def blocks(language: str, info: str | None = None) -> list[Block]:
    found = []
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        for match in re.finditer(r"^```(\w+) ?(.*)\n((?:.*\n)*?)```$", text, re.MULTILINE):
            block = Block(page, text[: match.start()].count("\n") + 1, *match.groups())
            if block.language == language and info in (None, block.info):
                found.append(block)
    return found


@pytest.fixture(scope="module")
def record(tmp_path_factory) -> bytes:
    """A short record, for the examples that read one."""
    path = tmp_path_factory.mktemp("record") / f"{RECORD}.h5"
    invoke("run", RECORD, "-o", path, "--set", "solver.cycles=2", "--no-plot")
    return path.read_bytes()


@pytest.fixture
def folder(tmp_path: Path, record: bytes, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where an example runs: a folder with a short record in it, and the record of a map."""
    (tmp_path / f"{RECORD}.h5").write_bytes(record)
    write_map(tmp_path / "map.h5")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write_tables(page: Path, folder: Path) -> None:
    """Write the files that a page shows and refers to."""
    for file in (*blocks("csv"), *(block for block in blocks("toml") if block.info.endswith(".toml"))):
        if file.page == page:
            (folder / file.info).write_text(file.text, encoding="utf-8")


def commands(block: Block) -> list[list[str]]:
    lines = block.text.replace("\\\n", " ").splitlines()
    words = [shlex.split(line.removeprefix("$ ").partition(" > ")[0], comments=True) for line in lines]
    return [line[1:] for line in words if line[:1] == ["tribodyn"]]


PAGES_WITH_COMMANDS = sorted({block.page for block in blocks("console") if block.page.name != "README.md"})


def is_run_elsewhere(words: list[str], page: Path) -> bool:
    """Whether a command runs a shipped scenario as it is, whose record no other command of the page reads.

    `test_shipped_scenarios.py` runs all of them.
    """
    named = {
        word for block in blocks("console") if block.page == page for line in commands(block) for word in line
    }
    return len(words) == 2 and words[1] in names_of_scenarios() and f"{words[1]}.h5" not in named


@cache
def names_of_scenarios() -> frozenset[str]:
    return frozenset(names(shipped("scenarios")))


@pytest.mark.parametrize(
    "page", all_in_soak(PAGES_WITH_COMMANDS, lambda page: page.name not in LONG), ids=lambda page: page.name
)
def test_commands_run(page: Path, folder: Path, request: pytest.FixtureRequest):
    with unless_passed(request, page.read_text(encoding="utf-8")):
        run_commands(page, folder)


@pytest.mark.parametrize("page", sorted(LONG))
def test_commands_are_understood(page: str, folder: Path):
    """Verbs, options and their values, where `make soak` runs them."""
    found = [words for block in blocks("console") if block.page.name == page for words in commands(block)]
    for words in found:
        understood(words)
    assert found


def understood(words: list[str]) -> None:
    command = get_command(app).get_command(None, words[0])  # type: ignore[attr-defined]
    command.make_context(words[0], words[1:])


def run_commands(page: Path, folder: Path) -> None:
    """In the order of the page, in one folder; validations, sweeps and assessments are tested elsewhere."""
    write_tables(page, folder)
    for block in blocks("console"):
        if block.page != page:
            continue
        for words in commands(block):
            if words[0] in ("validate", "sweep", "assess"):
                understood(words)
                continue
            if words[0] == "run" and is_run_elsewhere(words, page):
                assert load_scenario(words[1]).title
                continue
            if words[0] == "run":
                kind = next(iter(load_every(words[1]).cases.values())).study.kind
                picture = () if "--plot" in words else ("--no-plot",)  # every scenario's is tested elsewhere
                words = [*words, *sets(*shorter(words[1], kind)), *picture, "--force"]
            invoke(*words)


def test_the_readme_works_pasted_in_order_into_one_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
):
    monkeypatch.chdir(tmp_path)
    readme = ROOT / "README.md"
    with unless_passed(request, readme.read_text(encoding="utf-8")):
        run_all_of(readme)


def run_all_of(readme: Path) -> None:
    """Commands, then Python, nothing replaced and nothing there before; sweep and validation as above."""
    for block in blocks("console"):
        for words in commands(block) if block.page == readme else ():
            if words[0] not in ("validate", "sweep"):
                invoke(*words)
    matplotlib.use("agg")
    for block in blocks("python"):
        if block.page == readme:
            exec(compile(block.text, str(block), "exec"), {"__name__": "__main__"})
    pyplot.close("all")


@pytest.mark.parametrize("block", blocks("toml", "scenario"), ids=str)
def test_scenarios_load(block: Block, folder: Path):
    (folder / "page.toml").write_text(block.text, encoding="utf-8")
    assert load_scenario(folder / "page.toml").title


@pytest.mark.parametrize("block", blocks("toml", "fragment"), ids=str)
def test_fragments_load(block: Block, folder: Path):
    write_tables(block.page, folder)
    base = find_scenario("crc-23-47").read_text(encoding="utf-8")
    (folder / "page.toml").write_text(base, encoding="utf-8")
    assert load_scenario(folder / "page.toml", flat(tomllib.loads(block.text))).title


def flat(table: dict[str, Any], above: str = "") -> dict[str, Any]:
    """Dotted keys; what is written out as a whole, or a model with changes, replaces the other."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, dict) and above + key not in ("drive", "lubricant") and "like" not in value:
            found |= flat(value, f"{above}{key}.")
        else:
            found[above + key] = value
    return found


def test_every_toml_block_is_one_or_the_other():
    known = ("scenario", "fragment")
    others = [block for block in blocks("toml") if block.info not in known]
    assert not [str(block) for block in others if not block.info.endswith(".toml")]


@pytest.mark.parametrize(
    "block",
    all_in_soak(
        [block for block in blocks("python", "") if block.page.name != "README.md"],
        lambda block: not any(call in block.text for call in ALIKE.get(block.page.name, ())),
    ),
    ids=str,
)
def test_python_runs(block: Block, folder: Path, request: pytest.FixtureRequest):
    matplotlib.use("agg")
    write_tables(block.page, folder)
    try:
        with unless_passed(request, block.page.read_text(encoding="utf-8")):
            exec(compile(block.text, str(block), "exec"), {"__name__": "__main__"})
    finally:
        pyplot.close("all")


@pytest.mark.parametrize("block", blocks("python", ""), ids=str)
def test_names_of_the_interface_are_there(block: Block):
    """Where `make soak` runs the Python of a page, too."""
    tree = ast.parse(block.text)
    used = {
        node.attr
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "td"
    }
    assert not {name for name in used if not hasattr(td, name)}


def test_the_family_of_the_page_on_extending_works_as_a_package(tmp_path: Path):
    """What pip writes of the package's pyproject.toml stands beside its module: nothing is installed."""
    for block in [*blocks("python"), *blocks("toml")]:
        if block.page.name == "extending.md" and "." in block.info:
            (tmp_path / block.info).write_text(block.text, encoding="utf-8")
    project = tomllib.loads((tmp_path / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    written = tmp_path / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
    written.mkdir()
    (written / "METADATA").write_text(f"Name: {project['name']}\nVersion: {project['version']}\n")
    groups = project["entry-points"].items()
    lines = [line for group, names in groups for line in (f"[{group}]", *map(" = ".join, names.items()))]
    (written / "entry_points.txt").write_text("\n".join(lines))

    def python(program: str) -> str:
        words = [sys.executable, "-c", program]
        paths = os.pathsep.join((str(tmp_path), str(ROOT)))
        ran = subprocess.run(
            words, cwd=tmp_path, env=os.environ | {"PYTHONPATH": paths}, capture_output=True, text=True
        )
        assert ran.returncode == 0, ran.stderr
        return ran.stdout

    loss, almost, involute, refusal = python(LINEAR).splitlines()
    assert 0.005 < float(loss) < 0.05
    assert float(almost) == pytest.approx(float(involute), rel=1e-6)  # its limit, by another file's formulas
    assert "drive.shape.length = 10 mm" in refusal
    assert "use a longer one" in refusal


def anchors(page: Path) -> set[str]:
    """Anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize(
    "page", [*PAGES, *(ROOT / "docs").glob("notebooks/*.md")], ids=lambda page: page.name
)
def test_links_lead_somewhere(page: Path):
    for target in re.findall(r"\]\((?!https?://)([^)\s]+)\)", page.read_text(encoding="utf-8")):
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        assert file.exists(), f"{page.name}: {target}"
        assert not anchor or anchor in anchors(file), f"{page.name}: {target}"
