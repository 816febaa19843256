"""Finding and reading what a scenario is made of: TOML files, the model files they name.

A scenario may come from a stranger: files and tables have bounds, and so has what stands in them (`bounds`).
"""

import codecs
import os
import re
import tomllib
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any, NoReturn

from tribodyn.errors import (
    InputError,
    harmless,
    names_with,
    near_name,
    printable_path,
    quoted,
)
from tribodyn.input.bounds import TooMuch, parsed

#: Bytes of a file; a scenario that holds the points of its tables is larger than they are as CSV.
MOST_TOML, MOST_CSV = 16 * 2**20, 4 * 2**20
#: Names that a message offers in place of an unknown one.
_MOST_NEAR = 3
#: What an HDF5 file begins with.
_HDF5 = b"\x89HDF\r\n\x1a\n"

_PACKAGE = Path(__file__).resolve().parents[1]
#: Folders of `Reference`s that name a whole scenario, and a drive.
SCENARIOS, DRIVES = "scenarios", "drives"


def shipped(folder: str) -> Path:
    """Return the shipped folder "models" or "scenarios": in the wheel, or at the root of a checkout."""
    inside = _PACKAGE / "data" / folder
    return inside if inside.is_dir() else _PACKAGE.parent / folder


def is_shipped(path: Path) -> bool:
    """Whether a path is of a shipped scenario, which is not written."""
    return shipped(SCENARIOS).resolve() in path.resolve().parents


def is_file(path: Path) -> bool:
    """Whether a file is there; a name that no file can have is none."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def names(folder: Path) -> list[str]:
    """Return the names that may be used for the TOML files of a folder, sorted."""
    return sorted(path.stem for path in folder.glob("*.toml"))


def find_scenario(name: str) -> Path:
    """Return the file of a scenario that is given by path or by the name of a shipped one."""
    path = Path(name)
    if is_file(path):
        _refuse_record(path)
        return path
    if path.suffix == ".toml":
        _missing("scenario", name, path, "a folder" if path.is_dir() else "no such file")
    return _named("scenario", name, "scenario", [shipped(SCENARIOS)])


def _refuse_record(path: Path) -> None:
    """Refuse a record where a scenario is due."""
    with suppress(OSError), path.open("rb") as file:
        if file.read(len(_HDF5)) == _HDF5:
            shown = f"tribodyn show {path}, or plot or report"
            raise InputError("scenario", quoted(str(path)), "a record, not a scenario", f"use {shown}")


def file_name(path: Path, folder: Path) -> str:
    """How a record in a folder names the scenario's file: relative to it, a shipped one by its name.

    Bytes that are no text are escaped.
    """
    path, folder = path.resolve(), folder.resolve()
    if path.parent == shipped(SCENARIOS).resolve():
        return f"shipped: {path.stem}"
    with suppress(ValueError):  # on another drive of Windows
        return harmless(Path(os.path.relpath(path, folder)).as_posix())
    return harmless(path.as_posix())


def _missing(key: str, name: str, path: Path, rule: str) -> NoReturn:
    """Refuse a path at which there is no file, and name one of its folder that is spelled much the same."""
    near = near_name(path.stem, [one for one in names(path.parent) if one != path.stem])
    remedy = f'did you mean "{Path(name).with_name(near + ".toml")}"?' if near else "check the path"
    raise InputError(key, quoted(name), rule, remedy)


def find_drive_or_scenario(name: str) -> Path:
    """Return the file of a drive or of a scenario that is given by path or by the name of a shipped one."""
    if name.endswith(".toml") or is_file(Path(name)):
        return find_scenario(name)
    return _named("model", name, "drive or scenario", [shipped("models") / DRIVES, shipped(SCENARIOS)])


def find_model(name: str, kind: str, key: str, referring: Path) -> Path:
    """Return the file of a model that `referring` names at a key: a path relative to it (.toml), or a name.

    `kind` is the model's folder of `models/`: "drives", "materials", …; or `SCENARIOS`.
    """
    if name.endswith(".toml"):
        path = referring.parent / name
        return path if is_file(path) else _missing(key, name, path, f"no such file: {printable_path(path)}")
    if kind == SCENARIOS:
        return _named(key, name, "scenario", [referring.resolve().parent, shipped(SCENARIOS)])
    above = referring.resolve().parent.parent
    # beside a scenario's folder there is models/, beside a model's own folder the other kinds
    folders = [above / "models" / kind, above / kind, shipped("models") / kind]
    return _named(key, name, f"file in models/{kind}", folders)


def _named(key: str, name: str, what: str, folders: Iterable[Path]) -> Path:
    """Return the TOML file of that name in the first of the folders that has it."""
    for folder in folders:
        if is_file(folder / f"{name}.toml"):
            return folder / f"{name}.toml"
    looked = list(dict.fromkeys(folder.resolve() for folder in folders))
    available = sorted({available for folder in looked for available in names(folder)})
    near = names_with(name, available)[:_MOST_NEAR] or list(filter(None, [near_name(name, available)]))
    remedy = f"did you mean {' or '.join(map(quoted, near))}? " if near else ""
    there = ", ".join(available) or "nothing"
    places = " and ".join(map(str, looked))
    raise InputError(key, quoted(name), f"no such {what}; looked in {places}", f"{remedy}there is: {there}")


def laid_out_like(path: Path, text: str) -> bytes:
    """A text with the byte-order mark and the ends of lines of a file; as it is where that is not there."""
    content = b""
    with suppress(OSError):
        content = path.read_bytes()
    mark = codecs.BOM_UTF8 if content.startswith(codecs.BOM_UTF8) else b""
    return mark + (text.replace("\n", "\r\n") if b"\r\n" in content else text).encode(
        "utf-8", "backslashreplace"
    )


def read_text(path: Path, most: int, *, of_spreadsheet: bool = False) -> str:
    """Return the text of a file; one that is unreadable, or of more than `most` bytes, is bad input.

    That `of_spreadsheet` may be in UTF-16 too, which its byte-order mark tells.
    """
    try:
        with path.open("rb") as file:
            content = file.read(most + 1)
        if len(content) > most:
            raise InputError("file", None, f"larger than {most >> 20} MiB", "shorten it", str(path))
        wide = of_spreadsheet and content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
        return content.decode("utf-16" if wide else "utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        place = f"byte {error.start}"
        raise InputError(place, None, "not UTF-8 text", "save it as UTF-8", str(path)) from None
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError("file", rule=f"cannot be read: {reason}", file=str(path)) from None


def read_toml(path: Path) -> dict[str, Any]:
    """Return the data of a TOML file; a syntax error names its line."""
    return toml_of(read_text(path, MOST_TOML), path)


def toml_of(text: str, path: Path) -> dict[str, Any]:
    """Return the data of the text of a TOML file, as `read_toml` does."""
    try:
        return parsed(text)
    except TooMuch as error:
        raise InputError("file", rule=str(error), remedy="a scenario needs none", file=str(path)) from None
    except tomllib.TOMLDecodeError as error:
        what, _, place = str(error).partition(" (at ")
        line, lines = re.match(r"line (\d+)", place), text.splitlines()
        number = int(line[1]) if line else len(lines)
        refused = lines[number - 1].strip() if 0 < number <= len(lines) else ""
        rule = f"not TOML: {what[0].lower()}{what[1:]}" + (f" in {quoted(refused)}" if refused else "")
        raise InputError(f"line {number}", None, rule, _toml_remedy(refused), str(path)) from None


def _toml_remedy(line: str) -> str:
    """What to write instead of a line that is not TOML."""
    if re.search(r'"[^"]*\\', line):
        return r"write / for \ in a path, or single quotes round it: 'C:\data\load.csv'"
    if re.search(r"=\s*[+-]?\d+,\d+\s*(#|$)", line):
        return "write a decimal point: 0.5"
    return 'write key = value, with quotes round text and quantities: module = "3 mm"'
