"""Which source files a module depends on, from its imports, and a digest of them: what a cached result is of.

Imports inside functions count, those for a type checker alone do not. Only modules of the same distribution
as the first ones and of this package are followed; of other libraries the version says enough. The
packages that a module of another distribution lies in count, since its import runs them; those of this one do
nothing but list names, so that one counts only where something is imported from it, and the outermost, which
has the version, never.
"""

import hashlib
import os
import re
import sys
import time
from functools import cache
from glob import escape, glob
from importlib.util import find_spec
from pathlib import Path

_OWN = __name__.partition(".")[0]
_ROOT = Path(__file__).parents[2]
#: When this process began to load the package, s since the epoch.
_BEGUN = time.time()
#: Folders and files of this package that no result comes from.
_SHOWING = ("__init__.py", "cli", "drawing", "interface", "post", "validation")
#: ``from module import names`` and ``import module``, wherever they stand in the text: one in a docstring
#: counts too, which only makes the digest depend on more.
_FROM = re.compile(r"^[ \t]*from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|[^\n]*)", re.MULTILINE)
_IMPORT = re.compile(r"^[ \t]*import[ \t]+([\w. \t,]+)", re.MULTILINE)
_FOR_TYPES = re.compile(r"^if (?:typing\.)?TYPE_CHECKING:\n(?:[ \t]+[^\n]*\n|\n)+", re.MULTILINE)
_COMMENT = re.compile(r"#[^\n]*")
_NAME = re.compile(r"(\w+)(?:[ \t]+as[ \t]+\w+)?")
#: What no result depends on: lines of comments, and docstrings, which begin a file or stand below a colon.
_REMARK = re.compile(rb"\n[ \t]*#[^\n]*")
_DOCSTRING = re.compile(rb':\n\s*r?"""[^"\\]*(?:(?:\\.|"(?!""))[^"\\]*)*"""[ \t]*\n', re.DOTALL)


def modules_behind(*names: str) -> dict[str, Path]:
    """Files of modules, imported or not, and of all that they import in turn, by name, where there is one."""
    followed = {name.partition(".")[0] for name in names} | {_OWN}
    files: dict[str, Path] = {}
    waiting = [part for name in names for part in _with_packages(name)]
    while waiting:
        name = waiting.pop()
        if name in files or name == _OWN or name.partition(".")[0] not in followed:
            continue
        file = _file_of(name)
        if file is not None:
            files[name] = file
            waiting += _imports(name, file)
    return dict(sorted(files.items()))


def digest_of(*names: str) -> bytes:
    """SHA-256 over the sources of modules and of all that they import, docstrings and comments left out."""
    digest = hashlib.sha256()
    for name, file in modules_behind(*names).items():
        digest.update(name.encode() + b"\0" + _digest(name, file))
    return digest.digest()


@cache
def computing_digest() -> str:
    """Digest of all code that results come from; what was computed by other code is not taken for its own.

    That is this package but for what asks and shows, and installed packages that add laws, families, studies
    or methods to it, with the data in their folders. Those are imported by name, so that all of them count,
    in use or not.
    """
    from importlib.metadata import entry_points

    digest = hashlib.sha256()
    for file in sorted(glob("**/*.py", root_dir=_ROOT, recursive=True)):
        if not file.startswith(_SHOWING):
            parts = Path(file).with_suffix("").parts
            name = ".".join((_OWN, *parts)).removesuffix(".__init__")
            digest.update(name.encode() + b"\0" + _digest(name, _ROOT / file))
    offered = entry_points()
    groups = [group for group in offered.groups if group.startswith(f"{_OWN}.")]
    added = {entry.module for group in groups for entry in offered.select(group=group)}
    digest.update(digest_of(*sorted(added)))
    for package in sorted({name.partition(".")[0] for name in added}):
        for file in _data_of(package):
            digest.update(f"{package} {file.name} {file.stat().st_size}".encode() + b"\0")
            with open(file, "rb") as stream:
                digest.update(hashlib.file_digest(stream, "sha256").digest())
    return digest.hexdigest()


def _data_of(package: str) -> list[Path]:
    """Files in a package's folder that are neither sources nor made of them."""
    main = _file_of(package)
    if main is None or main.name != "__init__.py":
        return []
    files = (Path(file) for file in sorted(glob(f"{escape(str(main.parent))}/**/*", recursive=True)))
    return [file for file in files if file.is_file() and file.suffix not in (".py", ".pyc")]


@cache
def _digest(name: str, file: Path) -> bytes:
    """Digest of a module's code as this process runs it.

    Of a file that was edited after this process had loaded it that is not known: no other process has such a
    digest, so that none takes what this one computes for the work of the edited code.
    """
    digest = hashlib.sha256(code_of(_text(file)))
    # one dated in the future is as old as its date allows to say
    edited = _BEGUN < file.stat().st_mtime <= time.time()
    if edited and getattr(sys.modules.get(name), "__file__", None) == str(file):
        digest.update(f"{os.getpid()} {_BEGUN}".encode())
    return digest.digest()


def code_of(text: bytes) -> bytes:
    """Text of a source file without what no result depends on."""
    return _DOCSTRING.sub(b":\n", _REMARK.sub(b"", b":\n" + text))


def _with_packages(name: str) -> list[str]:
    """A module's name after those of the packages that it lies in, of which this one's do not count."""
    parts = name.split(".")
    if parts[0] == _OWN:
        return [name]
    return [".".join(parts[: i + 1]) for i in range(len(parts))]


@cache
def _file_of(name: str) -> Path | None:
    """Source of a module; None for what is none, as an attribute of one."""
    if place := getattr(sys.modules.get(name), "__file__", None):
        return Path(place) if place.endswith(".py") and Path(place).is_file() else None
    package, _, last = name.rpartition(".")
    if not package:
        spec = find_spec(name)
        return Path(spec.origin) if spec and spec.origin and spec.origin.endswith(".py") else None
    above = _file_of(package)
    if above is None or above.name != "__init__.py":
        return None
    for file in (above.with_name(f"{last}.py"), above.parent / last / "__init__.py"):
        if file.is_file():
            return file
    return None


@cache
def _text(file: Path) -> bytes:
    return file.read_bytes()


@cache
def _imports(name: str, file: Path) -> tuple[str, ...]:
    """Names that a module's text imports, with the packages that they lie in; some may be no modules."""
    package = name if file.name == "__init__.py" else name.rpartition(".")[0]
    text = _FOR_TYPES.sub("", _COMMENT.sub("", _text(file).decode()))
    imported: list[str] = []
    for match in _FROM.finditer(text):
        base, names = match.groups()
        if base.startswith("."):
            dots = len(base) - len(base.lstrip("."))
            above = package.split(".")[: len(package.split(".")) - dots + 1]
            base = ".".join([*above, *filter(None, [base.lstrip(".")])])
        imported += [base, *(f"{base}.{part}" for part in _NAME.findall(names))]
    for match in _IMPORT.finditer(text):
        imported += [listed.split()[0] for listed in match[1].split(",") if listed.split()]
    return tuple(dict.fromkeys(part for module in imported for part in _with_packages(module)))
