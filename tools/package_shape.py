"""The shape of a package, read from its files: imports, circles, lengths.

python -m tools.package_shape            # of this checkout
python -m tools.package_shape FOLDER     # of another one

Nothing is imported: files are parsed. An import inside a function counts like any other; one that only a type
checker sees (under ``if TYPE_CHECKING``) is marked. What a registry looks up by a string is no import here.
"""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from statistics import median
from typing import NamedTuple

import numpy as np
from scipy.sparse.csgraph import connected_components

from tools.marked_block import ROOT, parser_of

PACKAGE = "tribodyn"
#: What lies in the package's root itself; everything else has a folder.
ROOT_FILES = frozenset({"__init__.py", "__main__.py", "errors.py", "py.typed"})


class Import(NamedTuple):
    """An import: which module imports which, in which line, and whether a type checker alone sees it.

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
    return tuple(found for name, path in known.items() for found in _imports_of(name, path, known))


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
    for found in imports(package):
        if found.imported in known and (typing_too or not found.typing_only):
            edges[found.importer].add(found.imported)
    return {name: targets - {name, package.name} for name, targets in edges.items()}


def by_folder(package: Path, *, typing_too: bool = False) -> dict[str, set[str]]:
    """Return which folder imports which others; a file of the package's root stands for itself."""
    edges: dict[str, set[str]] = {}
    for name, targets in by_file(package, typing_too=typing_too).items():
        edges.setdefault(folder(name), set()).update(map(folder, targets))
    return {name: targets - {name} for name, targets in edges.items()}


def circles(edges: dict[str, set[str]]) -> list[list[str]]:
    """Return the groups whose members all reach each other."""
    nodes = sorted({*edges, *(target for targets in edges.values() for target in targets)})
    number = {node: place for place, node in enumerate(nodes)}
    reaches = np.zeros((len(nodes), len(nodes)), dtype=bool)
    for node, targets in edges.items():
        reaches[number[node], [number[target] for target in targets]] = True
    _, group = connected_components(reaches, connection="strong")
    rings: dict[int, list[str]] = {}
    for node in nodes:
        rings.setdefault(group[number[node]], []).append(node)
    return [ring for ring in rings.values() if len(ring) > 1]


def lines(path: Path) -> int:
    """Return the number of lines of a file."""
    return len(path.read_text(encoding="utf-8").splitlines())


def shape(checkout: Path) -> dict[str, int | str]:
    """Return the numbers of a checkout: title -> number, or number and names."""
    package = checkout / PACKAGE
    files = modules(package)
    lengths = {path: lines(path) for path in files.values()}
    longest = max(lengths, key=lambda path: lengths[path])
    loose = [path.name for path in package.glob("*.py") if path.name not in ROOT_FILES]
    tests = sorted((checkout / "tests").rglob("*.py"))
    return {
        "files of the package": len(files),
        "modules in the package's root, besides " + ", ".join(sorted(ROOT_FILES)): len(loose),
        "import circles by file": len(circles(by_file(package))),
        "the same, imports for type checkers included": len(circles(by_file(package, typing_too=True))),
        "import circles by folder": len(circles(by_folder(package))),
        "lines of the median file": round(median(lengths.values())),
        "lines of the longest file": f"{lengths[longest]} ({longest.relative_to(checkout).as_posix()})",
        "lines of the package": sum(lengths.values()),
        "lines of the tests": sum(map(lines, tests)),
        "files of tests": len(tests),
    }


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("checkout", nargs="?", type=Path, default=ROOT)
    checkout = parser.parse_args().checkout
    for title, number in shape(checkout).items():
        print(f"{title}: {number}")
    package = checkout / PACKAGE
    for ring in circles(by_file(package)) + circles(by_folder(package)):
        print(f"circle: {', '.join(ring)}")


if __name__ == "__main__":
    main()
