"""The shape of a package, read from its files: imports, circles, lengths, files that name a kind of study.

python -m tools.package_shape            # of this checkout
python -m tools.package_shape FOLDER     # of another one

Nothing is imported: files are parsed. An import inside a function counts like any other; one that only a type
checker sees (under ``if TYPE_CHECKING``) is marked. What a registry looks up by a string is no import here.
"""

import argparse
import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from statistics import median
from typing import NamedTuple

PACKAGE = "tribodyn"
#: What lies in the package's root itself; everything else has a folder.
ROOT_FILES = frozenset({"__init__.py", "__main__.py", "errors.py", "py.typed"})
#: A kind of study, named as a string or by a class that only its folder should define.
KIND_NAMES = re.compile(
    r"[\"'](irefc|load-contact|backlash-oscillator)[\"']"
    r"|\b(Rolling|LoadContact|BacklashOscillator|Efficiency)(Case|Scenario)\b"
)


class Import(NamedTuple):
    """One import: which module imports which, in which line, and whether a type checker alone sees it.

    `imported` is the full dotted name of a module of the package; other modules as they are written.
    """

    importer: str
    imported: str
    line: int
    typing_only: bool


def modules(package: Path) -> dict[str, Path]:
    """Return the file of every module of the package in folder `package`, by dotted name."""
    named = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        named[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return named


@cache
def imports(package: Path) -> tuple[Import, ...]:
    """Return every import in every file of the package in folder `package`."""
    known = modules(package)
    return tuple(one for name, path in known.items() for one in _imports_of(name, path, known))


def _imports_of(name: str, path: Path, known: dict[str, Path]) -> Iterator[Import]:
    here = name if path.name == "__init__.py" else name.rpartition(".")[0]
    waiting: list[tuple[ast.AST, bool]] = [(ast.parse(path.read_text(encoding="utf-8")), False)]
    while waiting:
        node, typing_only = waiting.pop()
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield Import(name, alias.name, node.lineno, typing_only)
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                above = here.split(".")[: len(here.split(".")) - node.level + 1]
                base = ".".join([*above, base]).strip(".")
            for target in {_module(base, alias.name, known) for alias in node.names}:
                yield Import(name, target, node.lineno, typing_only)
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            waiting += [(child, True) for child in node.body]
            waiting += [(child, typing_only) for child in node.orelse]
        else:
            waiting += [(child, typing_only) for child in ast.iter_child_nodes(node)]


def _module(base: str, attribute: str, known: dict[str, Path]) -> str:
    """``from base import attribute``: the attribute may itself be a module."""
    return f"{base}.{attribute}" if f"{base}.{attribute}" in known else base


def folder(module: str) -> str:
    """Return the folder of the package that a module lies in: ``tribodyn.solve.methods`` -> ``solve``."""
    return [*module.split("."), ""][1]


def by_file(package: Path, *, typing_too: bool = False) -> dict[str, set[str]]:
    """Return which module imports which others of the package."""
    known = modules(package)
    edges: dict[str, set[str]] = {name: set() for name in known}
    for one in imports(package):
        if one.imported in known and (typing_too or not one.typing_only):
            edges[one.importer].add(one.imported)
    return {name: targets - {name, package.name} for name, targets in edges.items()}


def by_folder(package: Path, *, typing_too: bool = False) -> dict[str, set[str]]:
    """Return which folder imports which others; a file of the package's root stands for itself."""
    edges: dict[str, set[str]] = {}
    for name, targets in by_file(package, typing_too=typing_too).items():
        edges.setdefault(folder(name), set()).update(map(folder, targets))
    return {name: targets - {name} for name, targets in edges.items()}


def circles(edges: dict[str, set[str]]) -> list[list[str]]:
    """Return the groups whose members all reach each other, by Tarjan's algorithm."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    rings = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for target in sorted(edges.get(node, ())):
            if target not in index:
                visit(target)
                low[node] = min(low[node], low[target])
            elif target in stack:
                low[node] = min(low[node], index[target])
        if low[node] == index[node]:
            place = stack.index(node)
            ring = stack[place:]
            del stack[place:]
            if len(ring) > 1:
                rings.append(sorted(ring))

    for node in sorted(edges):
        if node not in index:
            visit(node)
    return rings


def lines(path: Path) -> int:
    """Return the number of lines of a file."""
    return len(path.read_text(encoding="utf-8").splitlines())


def naming_kinds(package: Path) -> list[Path]:
    """Return the files outside `studies` and `validation` that name a kind of study."""
    return [
        path
        for name, path in modules(package).items()
        if folder(name) not in ("studies", "validation")
        and KIND_NAMES.search(path.read_text(encoding="utf-8"))
    ]


def shape(checkout: Path) -> dict[str, int | str]:
    """Return the figures of a checkout: title -> number, or number and names."""
    package = checkout / PACKAGE
    files = modules(package)
    lengths = {path: lines(path) for path in files.values()}
    longest = max(lengths, key=lambda path: lengths[path])
    loose = [path.name for path in package.glob("*.py") if path.name not in ROOT_FILES]
    tests = sorted((checkout / "tests").rglob("*.py"))
    return {
        "files of the package": len(files),
        "modules in the package's root, besides " + ", ".join(sorted(ROOT_FILES)): len(loose),
        "files outside studies/ and validation/ that name a kind": len(naming_kinds(package)),
        "import circles by file": len(circles(by_file(package))),
        "import circles by file, imports for type checkers included": len(
            circles(by_file(package, typing_too=True))
        ),
        "import circles by folder": len(circles(by_folder(package))),
        "lines of the median file": round(median(lengths.values())),
        "lines of the longest file": f"{lengths[longest]} ({longest.relative_to(checkout).as_posix()})",
        "lines of the package": sum(lengths.values()),
        "lines of the tests": sum(map(lines, tests)),
        "files of tests": len(tests),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("checkout", nargs="?", type=Path, default=Path(__file__).parents[1])
    checkout = parser.parse_args().checkout
    for title, figure in shape(checkout).items():
        print(f"{title}: {figure}")
    package = checkout / PACKAGE
    for ring in circles(by_file(package)) + circles(by_folder(package)):
        print(f"circle: {', '.join(ring)}")
    for path in naming_kinds(package):
        print(f"names a kind: {path.relative_to(checkout).as_posix()}")


if __name__ == "__main__":
    main()
