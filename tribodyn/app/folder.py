"""The folder that the page works in: what may be opened and saved there, and nothing else."""

import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path, PurePosixPath

from tribodyn.app.core.document import Document
from tribodyn.errors import InputError, quoted
from tribodyn.input.csv_files import read_curve
from tribodyn.numerics.files.output_files import write_output
from tribodyn.studies.handed_over import format_of, readers

#: Files that are listed, and folders below the one given in which they are looked for.
MOST_FILES, DEEPEST = 400, 2
#: Names of files that every system takes, and that no verb reads as an option.
_PORTABLE = re.compile(
    r"(?!(con|prn|aux|nul|com\d|lpt\d)\.)[^-.\s<>:\"|?*][^<>:\"|?*\x00-\x1f]{0,199}(?<![. ])\.\w+", re.I
)
#: Bytes of a file that is brought in from the browser.
MOST_BYTES = 16 * 2**20
#: Endings of tables that scenarios name.
_TABLES = (".csv", ".txt")
REMEDY = "name a file of the folder that the page was started in, or start it with --folder"


def scenario_endings() -> list[str]:
    """Endings of files that are opened as scenarios, those of other programs too."""
    return [".toml", *(ending for each in readers().values() for ending in each.endings if each.read)]


def measured_endings() -> list[str]:
    """Endings of files of which a measured gear may be put into a scenario."""
    return [ending for each in readers().values() for ending in each.endings if each.measure]


class WorkFolder:
    """A folder whose files the page may read and write.

    Parameters
    ----------
    root
        The folder; must be there.
    """

    def __init__(self, root: Path) -> None:
        if not root.is_dir():
            raise InputError("--folder", str(root), "no such folder", "name one that is there")
        self.root = root.resolve()

    def listed(self, endings: Iterable[str]) -> list[str]:
        """Names of files with these endings, relative to the folder, those of hidden folders left out."""
        endings = tuple(endings)
        found = [
            path
            for path in self._below(self.root, DEEPEST)
            if path.suffix.lower() in endings and path.name.isprintable()
        ]
        return sorted(path.relative_to(self.root).as_posix() for path in found)[:MOST_FILES]

    def file(self, name: str, endings: Iterable[str]) -> Path:
        """Path of a file that a page names; InputError unless it lies in the folder, links followed."""
        endings = tuple(endings)
        pure = PurePosixPath(name.strip().replace("\\", "/"))
        if not pure.name or pure.is_absolute() or ".." in pure.parts or ":" in name or "\0" in name:
            raise InputError("file", quoted(name), "no file of this folder", REMEDY)
        if pure.suffix.lower() not in endings:
            rule = f"ends in none of {', '.join(endings)}"
            raise InputError("file", quoted(name), rule, f'write "{pure.with_suffix(endings[0])}"')
        path = self.root / pure
        if not self.holds(path):
            raise InputError("file", quoted(name), "leads out of this folder", REMEDY)
        return path

    def new_file(self, name: str, ending: str) -> Path:
        """Path of a file to write; the ending is added where it is missing."""
        name = name.strip()
        path = self.file(name if name.lower().endswith(ending) or not name else name + ending, [ending])
        if not _PORTABLE.fullmatch(path.name):
            rule = "not a name that every system takes"
            raise InputError("file", quoted(path.name), rule, "write letters, digits, - and _")
        if not path.parent.is_dir():
            raise InputError("file", quoted(name), "its folder is not there", "choose one that is there")
        return path

    def bring(self, name: str, content: bytes) -> Path:
        """Write a file that comes from the browser, never over another one; return its path.

        A scenario that cannot be opened, or no measurement and no table, is not kept: InputError.
        """
        if len(content) > MOST_BYTES:
            rule = f"has more than {MOST_BYTES // 2**20} MiB"
            raise InputError("file", quoted(name), rule, "copy it into the folder")
        ending = self.file(name, [*scenario_endings(), *measured_endings()]).suffix
        path = self.new_file(name, ending.lower())
        if path.exists() or path.is_symlink():
            raise InputError("file", quoted(name), "is there already", "rename the file, and bring it again")
        write_output(path, content)
        try:
            _read(path)
        except InputError:
            path.unlink()
            raise
        return path

    def holds(self, path: Path) -> bool:
        """Whether a file lies in the folder, links followed."""
        try:
            return self.root in path.resolve().parents
        except (OSError, RuntimeError, ValueError):
            return False

    def named(self, path: Path) -> str:
        """How a path is shown: relative to the folder where it lies in it, else by its name."""
        with suppress(ValueError):
            return path.resolve().relative_to(self.root).as_posix()
        return path.name

    def _below(self, folder: Path, depth: int) -> Iterator[Path]:
        try:
            entries = sorted(folder.iterdir())
        except OSError:
            return
        for entry in entries:
            if entry.name.startswith("."):
                continue
            if entry.is_dir() and not entry.is_symlink():
                if depth:
                    yield from self._below(entry, depth - 1)
            elif self.holds(entry):
                yield entry


def _read(path: Path) -> None:
    """Read a file as what it may be: a scenario, a measured gear, a table that a scenario names."""
    if path.suffix.lower() in scenario_endings():
        Document.open(path)
        return
    measure = format_of(path).measure
    assert measure is not None, "as its ending says"
    try:
        measure(path)
    except InputError:
        if path.suffix.lower() not in _TABLES:
            raise
        with suppress(InputError):
            if any(column["values"] for column in read_curve(path, "file").values()):
                return
        raise
