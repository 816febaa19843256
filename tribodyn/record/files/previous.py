"""A record that is made again from the same scenario file: it replaces the older one, which is kept once."""

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

import h5py

from tribodyn.errors import InputError
from tribodyn.record.files.writing_lock import remove_orphans, scratch_path
from tribodyn.record.schema import CODE, FORMAT, partial_path

#: Attribute of a record that was given no name: the scenario's file, relative to the record's folder.
SCENARIO_FILE = "scenario_file"


class Origin(NamedTuple):
    """What a record is made from: the kind that its root names, and the scenario's file."""

    kind: str = ""
    file: str = ""  # as `SCENARIO_FILE`; empty: the record was given a name, and replaces none

    def made(self, path: Path) -> bool:
        """Whether a file, which is no link, is a record of that kind from that scenario file."""
        attributes = _attributes(path) if self.file and not path.is_symlink() else {}
        return attributes.get("kind") == self.kind and attributes.get(SCENARIO_FILE) == self.file

    def left(self, path: Path) -> bool:
        """Whether an earlier run from that file left `path` unfinished, and no later call goes on with it."""
        return self.made(path) and CODE not in _attributes(path)


def refuse_existing(path: Path, force: bool, origin: Origin = Origin()) -> None:
    """Raise InputError if the record or what an unfinished run left is there and is not to be replaced.

    With `force` what tribodyn wrote is replaced; without it what was made from the same `origin`.
    """
    if force:
        for file in (path, partial_path(path)):
            if os.path.lexists(file) and _attributes(file).get("format") != FORMAT:
                rule = "is not a record of tribodyn, or damaged: --force does not replace it"
                raise InputError("output", str(file), rule, "remove it, or choose another name")
        return
    if os.path.exists(path):
        _refuse_record(path, origin)
    if os.path.exists(remains := partial_path(path)) and not origin.left(remains):
        rule = f"{remains.name} holds what an unfinished run left"
        raise InputError("output", str(path), rule, "move it away, or --force to replace it")


def _refuse_record(path: Path, origin: Origin) -> None:
    remedy = "choose another name, or --force to replace it"
    if not origin.made(path):
        other = ", and is not known to be made from this scenario file" if origin.file else ""
        raise InputError("output", str(path), f"the file exists{other}", remedy)
    if not os.access(path, os.W_OK):
        raise InputError("output", str(path), "the file exists and is write-protected", remedy)
    if os.path.lexists(older := previous_path(path)) and not origin.made(older):
        rule = "is in the way of the older record, and is none of this scenario file"
        raise InputError("output", str(older), rule, "move it away, or --output to choose another name")


def previous_path(path: Path) -> Path:
    """Where the record that another of the same scenario file replaces is kept."""
    return path.with_name(f"{path.stem}.previous.h5")


def keep_previous(path: Path, origin: Origin) -> None:
    """Give a record of that origin, which is about to be replaced, its second name; it keeps its first.

    To be called with the record's lock. Does nothing where the record or its older one has another origin.
    """
    older = previous_path(path)
    if not origin.made(path) or (os.path.lexists(older) and not origin.made(older)):
        return
    remove_orphans(older)
    scratch = scratch_path(older)
    try:
        os.link(path, scratch)
    except OSError:  # a file system without hard links: for a moment it has the second name only
        os.replace(path, older)
        return
    try:
        os.replace(scratch, older)
    finally:  # a rename onto another name of the same file leaves both
        scratch.unlink(missing_ok=True)


def watched(path: Path) -> Callable[[], list[Path]]:
    """Look at a record before a run; what is returned says after it under which name that record was kept."""
    before = path.stat() if path.is_file() else None

    def kept() -> list[Path]:
        older = previous_path(path)
        return [older] if before and older.is_file() and os.path.samestat(before, older.stat()) else []

    return kept


def _attributes(path: Path) -> dict[str, str]:
    """Texts of a record's root; none of what is no record, or cannot be read.

    A link counts as what it leads to, one that leads nowhere as none.
    """
    names = ("format", "kind", SCENARIO_FILE, CODE)
    with suppress(OSError, RuntimeError, ValueError, KeyError, InputError):
        if path.is_file():  # h5py would wait for a pipe
            with h5py.File(path, "r") as file:  # few attributes: the file is to be replaced, not read
                return {name: str(file.attrs[name]) for name in names if name in file.attrs}
    return {}
