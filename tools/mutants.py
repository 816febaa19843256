"""Change the physics at random, one operator or constant at a time, and see whether the quick tests notice.

python -m tools.mutants --count 20 --seed 1                  # of this checkout
python -m tools.mutants --count 100 --seed 2 --out done.jsonl  # keeps what is done, and goes on from there
python -m tools.mutants --at solve/march/marching.py:136           # every change of a line
python -m tools.mutants --again done.jsonl                   # the changes that survived an earlier run
python -m tools.mutants --count 100 --near --part 0 2        # the nearest tests only; every second change
python -m tools.mutants --again done.jsonl --all             # the survivors, with every test of `make test`

Each change is made in a copy of the tracked files. First run the test files that import the changed module or
have its name, then all others that depend on it, each time up to the first failure. Machine code and finite
elements are kept in a cache of the copy; their keys hold the sources, so that no change is hidden by them.
The time limit is one of processor time: a busy machine makes no survivor. The tests run in forks of a process
that has imported the libraries.
"""

import argparse
import ast
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

from tools.marked_block import ROOT as HERE
from tools.marked_block import parser_of
from tools.package_shape import imports, modules

PACKAGE = "tribodyn"
PHYSICS = ("geometry", "compliance", "mesh", "tribology", "dynamics", "solve", "studies")
#: Files that hold no physics; what time and memory are estimated at is right within a factor.
WITHOUT = re.compile(r"(figures|pictures?|report|layout|scenario|rules|check|estimate|mesh_memory)\.py$")
#: Replacements of operators.
BINARY = {ast.Add: "-", ast.Sub: "+", ast.Mult: "/", ast.Div: "*", ast.Pow: "*", ast.FloorDiv: "*"}
COMPARED = {ast.Lt: ">=", ast.LtE: ">", ast.Gt: "<=", ast.GtE: "<", ast.Eq: "!=", ast.NotEq: "=="}
SYMBOL = re.compile(rb"\*\*|//|<=|>=|==|!=|[-+*/<>]|\band\b|\bor\b")
#: Factor on a constant; an integer grows by one, and zero becomes one.
FACTOR = 1.1
#: Processor time of the tests of one change, s.
LIMIT = 600
OPTIONS = "-q -x -p no:cacheprovider --benchmark-disable".split()
QUICK = ["--quick", "-m", "not bench and not slow"]
ALL = ["-m", "not bench and not soak"]
#: Reads a line of JSON for each run of pytest, answers with its exit status. It ends at the end of its input,
#: and with it the run that is under way.
SERVER = """
import gc, json, os, resource, select, signal, sys
import h5py, jax, llvmlite.binding, matplotlib.backends.backend_agg, matplotlib.figure, numba
import pint, pydantic, pytest, rich.console, scipy.integrate, scipy.interpolate, scipy.optimize
import scipy.sparse.linalg, skfem, typer

gc.freeze()
for line in sys.stdin:
    request = json.loads(line)
    child = os.fork()
    if child == 0:
        resource.setrlimit(resource.RLIMIT_CPU, (request["limit"], request["limit"]))
        out = os.open(request["out"], os.O_WRONLY | os.O_TRUNC)
        for number in (1, 2):
            os.dup2(out, number)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        status = pytest.main(request["words"])
        sys.stdout.flush()
        os._exit(status)
    number = 0
    while not number:
        if select.select([0], [], [], 0.02)[0]:
            os.killpg(0, signal.SIGKILL)
        number, ended = os.waitpid(child, os.WNOHANG)
    print(os.waitstatus_to_exitcode(ended), flush=True)
"""


class Change(NamedTuple):
    """A replacement of bytes `start` … `end` of a file of the package, which begin in a line."""

    file: str
    line: int
    start: int
    end: int
    new: str

    def made(self, source: bytes) -> bytes:
        """The changed source."""
        return source[: self.start] + self.new.encode() + source[self.end :]

    def shown(self, source: bytes) -> str:
        """The changed line, before and after."""
        lines = (text.split(b"\n")[self.line - 1].decode() for text in (source, self.made(source)))
        return f"{self.file}:{self.line}\n" + "\n".join(map("".join, zip("-+", lines, strict=True)))


def changes(package: Path, folders: Sequence[str] = PHYSICS) -> list[Change]:
    """Every change that can be made in some folders or files of the package."""
    places = [package / folder for folder in folders]
    files = [
        file for place in places for file in ([place] if place.is_file() else sorted(place.rglob("*.py")))
    ]
    return [
        change
        for file in files
        if not WITHOUT.search(file.name)
        for change in _changes_of(file.relative_to(package).as_posix(), file.read_bytes())
    ]


def _changes_of(file: str, source: bytes) -> Iterator[Change]:
    begins = [0]
    for line in source.split(b"\n"):
        begins.append(begins[-1] + len(line) + 1)

    def place(node: ast.expr) -> tuple[int, int]:
        end = begins[(node.end_lineno or 1) - 1] + (node.end_col_offset or 0)
        return begins[node.lineno - 1] + node.col_offset, end

    def between(before: ast.expr, after: ast.expr, new: str) -> Iterator[Change]:
        low, high = place(before)[1], place(after)[0]
        gap = re.sub(rb"#[^\n]*", lambda found: b" " * len(found[0]), source[low:high])
        if found := SYMBOL.search(gap):
            yield change(low + found.start(), low + found.end(), new)

    def change(start: int, end: int, new: str) -> Change:
        return Change(file, source.count(b"\n", 0, start) + 1, start, end, new)

    for node in _expressions(ast.parse(source)):
        if isinstance(node, ast.BinOp) and type(node.op) in BINARY:
            yield from between(node.left, node.right, BINARY[type(node.op)])
        elif isinstance(node, ast.Compare):
            for before, operator, after in zip(
                [node.left, *node.comparators], node.ops, node.comparators, strict=False
            ):
                if type(operator) in COMPARED:
                    yield from between(before, after, COMPARED[type(operator)])
        elif isinstance(node, ast.BoolOp):
            other = "or" if isinstance(node.op, ast.And) else "and"
            for before, after in zip(node.values, node.values[1:], strict=False):
                yield from between(before, after, other)
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.Not):
            start = place(node)[0]
            yield change(start, start + (1 if isinstance(node.op, ast.USub) else 3), "")
        elif isinstance(node, ast.Constant) and isinstance(number := node.value, int | float):
            if isinstance(number, bool):
                continue
            grown = number + 1 if isinstance(number, int) else number * FACTOR or 1.0
            yield change(*place(node), repr(grown))


def _expressions(tree: ast.AST) -> Iterator[ast.expr]:
    """All expressions but annotations, decorators and messages."""
    for name, value in ast.iter_fields(tree):
        if name in ("annotation", "returns", "decorator_list") or isinstance(tree, ast.Raise | ast.JoinedStr):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test):
                continue
            if isinstance(child, ast.AST):
                if isinstance(child, ast.expr):
                    yield child
                yield from _expressions(child)


@cache
def _reached(package: Path) -> dict[str, frozenset[str]]:
    """Modules that each module of the package imports, directly or not, or looks up by a name."""
    files = modules(package)
    direct: dict[str, set[str]] = {name: set() for name in files}
    for found in imports(package):
        if not found.typing_only and found.imported in direct:
            direct[found.importer].add(found.imported)
    for name, file in files.items():
        text = file.read_text(encoding="utf-8")
        direct[name] |= set(re.findall(rf'"({PACKAGE}(?:\.\w+)+)', text)) & direct.keys()
        if "import_module(" in text or "package=__name__" in text:  # of its own folder
            direct[name] |= {other for other in files if other.startswith(f"{name}.")}
    reached = {}
    for name in direct:
        found, waiting = {name}, [name]
        while waiting:
            new = direct[waiting.pop()] - found
            found |= new
            waiting += new
        reached[name] = frozenset(found)
    return reached


@cache
def _imported(file: Path, tests: Path) -> frozenset[str]:
    """Modules that a test file imports itself, by what it takes from tests/support and conftest.py too."""
    text = file.read_text(encoding="utf-8")
    found = set(re.findall(rf"(?:from|import)\s+({PACKAGE}[\w.]*)", text))
    for module, names in re.findall(rf"from ({PACKAGE}[\w.]*) import (\([^)]*\)|.*)", text):
        found |= {f"{module}.{name.split()[0]}" for name in names.strip("()").split(",") if name.strip()}
    for name in re.findall(r"from tests\.support\.(\w+) import", text):
        found |= _imported(tests / "support" / f"{name}.py", tests)
    if re.search(r"\b(prepared|forked)\(", text) and file.name != "conftest.py":
        found |= _imported(tests / "conftest.py", tests)
    return frozenset(found)


def tests_of(module: str, package: Path, tests: Path) -> list[list[str]]:
    """Test files to run for a module: those that name it, and the others that depend on it.

    Of either the unit tests come first, which compile less.
    """
    reached = _reached(package)
    near, far = [], []
    mirrored = tests / "unit" / Path(*module.split(".")[1:-1])
    for file in sorted(tests.rglob("test_*.py")):
        if file.relative_to(tests).parts[0] in ("bench", "soak", "tools"):
            continue
        own = _imported(file, tests)
        named = file.is_relative_to(mirrored) and module.rpartition(".")[2] in file.stem
        if named or module in own:
            near.append(file)
        elif any(module in reached.get(imported, ()) for imported in own):
            far.append(file)
    return [
        [str(file) for file in files if (file.relative_to(tests).parts[0] == "unit") is unit]
        for files in (near, far)
        for unit in (True, False)
    ]


class Tests:
    """The tests of a copy of the checkout, with a limit of processor time, s.

    A test that fails without a change as well, or does not fail again with it, is left out from then on.
    """

    def __init__(self, root: Path, limit: int) -> None:
        self.root, self.limit = root, limit
        self.sound: set[str] = set()
        self.failing: set[str] = set()
        self.out = root / "out.txt"
        self.out.touch()
        own = {
            "PYTHONPATH": str(root),
            "PYTHONDONTWRITEBYTECODE": "1",
            "TRIBODYN_CACHE": str(root / ".cache"),
            "OPENBLAS_NUM_THREADS": "1",
        }
        how = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True, "start_new_session": True}
        command = [sys.executable, "-c", SERVER]
        self.server = subprocess.Popen(command, cwd=root, env=os.environ | own, **how)

    def noticed(self, change: Change, near: bool = False, every: bool = False) -> str:
        """Make a change and run its tests, or the nearest; what noticed it, or nothing where none did.

        Of the quick tests, or of every one that `make test` runs.
        """
        file = self.root / PACKAGE / change.file
        source = file.read_bytes()
        module = ".".join((PACKAGE, *Path(change.file).with_suffix("").parts)).removesuffix(".__init__")
        stages = tests_of(module, self.root / PACKAGE, self.root / "tests")
        waiting = [files for files in stages[: 2 if near else 4] if files]
        while waiting:
            try:
                file.write_bytes(change.made(source))
                failed = self._first_failing(waiting[0], every)
                again = self._first_failing([failed], every) if "::" in failed else failed
            finally:
                file.write_bytes(source)
            if not failed:
                waiting.pop(0)
            elif "::" not in failed or (again and self._sound(failed, every)):
                return failed
            else:
                self.failing.add(failed)
        return ""

    def _sound(self, test: str, every: bool) -> bool:
        """Whether a test passes without a change."""
        if test not in self.sound and not self._first_failing([test], every):
            self.sound.add(test)
        return test in self.sound

    def _first_failing(self, files: list[str], every: bool) -> str:
        left_out = [f"--deselect={name}" for name in sorted(self.failing)]
        words = [*OPTIONS, *(ALL if every else QUICK), *left_out, *files]
        request = {"words": words, "limit": self.limit, "out": str(self.out)}
        assert self.server.stdin is not None
        assert self.server.stdout is not None
        self.server.stdin.write(json.dumps(request) + "\n")
        self.server.stdin.flush()
        status = int(self.server.stdout.readline())
        if status in (0, 5):  # all passed, or none was quick
            return ""
        printed = self.out.read_text(encoding="utf-8", errors="replace")
        failed = re.findall(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", printed, re.MULTILINE)
        return failed[0] if failed else f"exit status {status}"


def copied(folder: Path) -> Path:
    """Copy the tracked files, with what is kept of machine code and finite elements."""
    listed = subprocess.run(["git", "ls-files"], cwd=HERE, capture_output=True, text=True, check=True)
    for name in listed.stdout.splitlines():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        if (HERE / name).is_file():
            shutil.copy2(HERE / name, folder / name)
    kept = os.environ.get("TRIBODYN_CACHE")
    if kept and Path(kept).is_dir():
        shutil.copytree(kept, folder / ".cache")
    return folder


def _chosen(arguments: argparse.Namespace) -> list[Change]:
    if arguments.again:
        lines = Path(arguments.again).read_text(encoding="utf-8").splitlines()
        return [Change(*row["change"]) for row in map(json.loads, lines) if not row["noticed"]]
    known = changes(HERE / PACKAGE, arguments.folders)
    if arguments.at:
        file, _, line = arguments.at.partition(":")
        return [change for change in known if (change.file, change.line) == (file, int(line))]
    return random.Random(arguments.seed).sample(known, min(arguments.count, len(known)))


def main() -> None:
    """Read the arguments, go through the changes, and print what survived."""
    parser = parser_of(__doc__)
    parser.add_argument("--count", type=int, default=20, help="random changes")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folders", nargs="+", default=PHYSICS, help="or files, below the package")
    parser.add_argument("--at", metavar="FILE:LINE", help="every change of this line of the package instead")
    parser.add_argument("--again", metavar="FILE", help="the survivors in a file of results instead")
    parser.add_argument("--near", action="store_true", help="only tests of files that name the module")
    parser.add_argument(
        "--all", action="store_true", help="every test of `make test`, not the quick ones alone"
    )
    parser.add_argument("--part", type=int, nargs=2, default=(0, 1), help="number and count of a share")
    parser.add_argument("--out", metavar="FILE", help="file of results, a line each, to go on from")
    parser.add_argument("--limit", type=int, default=LIMIT, help="processor time of one change, s")
    arguments = parser.parse_args()
    out = Path(arguments.out) if arguments.out else None
    done = {}
    if out and out.is_file():
        rows = map(json.loads, out.read_text(encoding="utf-8").splitlines())
        done = {Change(*row["change"]): row["noticed"] for row in rows}
    part, parts = arguments.part
    chosen = _chosen(arguments)[part::parts]
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))
    with (
        tempfile.TemporaryDirectory(prefix="mutants-") as folder,
        (tests := Tests(root := copied(Path(folder)), arguments.limit)).server,
    ):
        for number, change in enumerate(chosen, 1):
            if change not in done:
                done[change] = tests.noticed(change, arguments.near, arguments.all)
                if out:
                    with out.open("a", encoding="utf-8") as stream:
                        stream.write(json.dumps({"change": change, "noticed": done[change]}) + "\n")
            outcome = f"noticed by {done[change]}" if done[change] else "SURVIVED"
            shown = change.shown((root / PACKAGE / change.file).read_bytes())
            print(f"{number}/{len(chosen)} {outcome}\n{shown}", flush=True)
    alive = [change for change in chosen if not done[change]]
    print(f"{len(chosen) - len(alive)} of {len(chosen)} changes noticed")
    if tests.failing:
        print(f"left out, as they fail without a change or not each time: {', '.join(sorted(tests.failing))}")


if __name__ == "__main__":
    main()
