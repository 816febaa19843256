"""What may stand where a record is written: the lock of a process that writes it, and an older record.

One process at a time writes a record, by a lock of the operating system, which dies with its process. The
lock is on a file of its own beside the record, as the record's file is replaced now and then. Whoever is
killed leaves that file behind, and it bars nobody. It is not the library `filelock` (4.2), which says not who
writes, leaves its file beside every record, and takes a user's file of that name for a lock.

A record that is made again from the same scenario file replaces the older one, which is kept once.
"""

import errno
import importlib
import os
import re
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import h5py

from tribodyn.errors import InputError
from tribodyn.numerics.files.output_files import CAREFUL, unwritable
from tribodyn.record.schema import CODE, FORMAT, partial_path

#: What a file system says that has no locks: then there is none, as there was none before.
_NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP}
#: Windows locks bytes, and nobody may read them: one far behind the number of the process.
_FAR = 1 << 20
#: What it says of a link, a pipe that nobody reads, a folder.
_OTHERS = {errno.ELOOP, errno.ENXIO, errno.EISDIR}
#: A pipe is not waited for.
_AT_ONCE = getattr(os, "O_NONBLOCK", 0)
#: Maximum length of what a lock holds: the number of a process.
_DIGITS = 20


def lock_path(path: Path) -> Path:
    """Name of the lock of a record."""
    return path.with_name(f"{path.stem}.partial.lock")


class WritingLock:
    """Held from its making until `release`, or the end of the process.

    Raises InputError if another process holds it, OSError if the file of the lock cannot be made.
    """

    def __init__(self, path: Path) -> None:  # the record's final name
        self._path = lock_path(path)
        self._number: int | None = None
        while self._number is None:
            number = _opened(self._path)
            try:
                if not _lock(number):
                    raise _busy(path, number)
                _refuse_other(self._path, number)
                if _is(number, self._path):  # otherwise its last owner removed it just now
                    os.ftruncate(number, 0)
                    os.lseek(number, 0, os.SEEK_SET)  # behind what its last owner wrote it would leave zeros
                    os.write(number, str(os.getpid()).encode())
                    self._number = number
            finally:
                if self._number is None:
                    os.close(number)

    def release(self) -> None:
        """Let others write; the second call does nothing."""
        number, self._number = self._number, None
        if number is None:
            return
        if os.name == "nt":  # which removes no open file
            os.close(number)
        with suppress(OSError):
            self._path.unlink()
        if os.name != "nt":
            os.close(number)


@contextmanager
def locked(path: Path) -> Iterator[WritingLock]:
    """Take the lock of a record and tidy up, to begin it; the lock is released only if that fails."""
    lock = None
    try:
        lock = WritingLock(path)
        remove_orphans(path)
        yield lock
    except BaseException as error:
        if lock:
            lock.release()
        if isinstance(error, OSError):
            raise unwritable(path, error) from error
        raise


def refuse_if_written(path: Path) -> None:
    """Raise InputError if a process is writing the record of that name; touches nothing."""
    try:
        number = os.open(lock_path(path), os.O_RDWR | CAREFUL | _AT_ONCE)
    except OSError as error:
        if error.errno in _OTHERS:
            raise _no_lock(lock_path(path)) from error
        return
    try:
        if not _lock(number):
            raise _busy(path, number)
        _refuse_other(lock_path(path), number)
    finally:
        os.close(number)


def remove_orphans(path: Path) -> None:
    """Remove what dead processes left half written of the record of that name; to be called with its lock."""
    pattern = re.compile(re.escape(path.stem) + r"\.(\d+)\.tmp")
    with suppress(OSError):
        for name in os.listdir(path.parent):
            match = pattern.fullmatch(name)
            if match and not _alive(int(match[1])):
                path.with_name(name).unlink()


def scratch_path(path: Path) -> Path:
    """Where this process writes a record of that name before it is whole."""
    return path.with_name(f"{path.stem}.{os.getpid()}.tmp")


def _alive(process: int) -> bool:
    """Whether there is a process of that number; where that cannot be asked, it is taken to live."""
    if os.name == "nt":
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


def _opened(path: Path) -> int:
    """Open the file of a lock, or make it; never through a link."""
    while True:
        with suppress(FileExistsError):
            return os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | CAREFUL, 0o666)
        with suppress(FileNotFoundError):  # its owner removed it just now
            try:
                return os.open(path, os.O_RDWR | CAREFUL | _AT_ONCE)
            except OSError as error:
                if error.errno in _OTHERS:
                    raise _no_lock(path) from error
                raise


def _refuse_other(path: Path, number: int) -> None:
    """Raise InputError where a file under a lock's name is something else."""
    if stat.S_ISREG(os.fstat(number).st_mode):
        os.lseek(number, 0, os.SEEK_SET)
        content = os.read(number, _DIGITS + 1)
        if len(content) <= _DIGITS and (not content or content.isdigit()):
            return
    raise _no_lock(path)


def _no_lock(path: Path) -> InputError:
    return InputError("output", str(path), "stands where the lock of this record would", "move it away")


def _lock(number: int) -> bool:
    """Lock an open file until it is closed; whether that was possible."""
    try:
        if find_spec("fcntl"):
            import fcntl

            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        elif find_spec("msvcrt"):
            windows: Any = importlib.import_module("msvcrt")
            os.lseek(number, _FAR, os.SEEK_SET)
            windows.locking(number, windows.LK_NBLCK, 1)
            os.lseek(number, 0, os.SEEK_SET)
    except OSError as error:
        return error.errno in _NO_LOCKS
    return True


def _is(number: int, path: Path) -> bool:
    """Whether an open file is still the one of that name."""
    try:
        return os.path.samestat(os.fstat(number), path.stat())
    except OSError:
        return False


def _busy(path: Path, number: int) -> InputError:
    os.lseek(number, 0, os.SEEK_SET)
    owner = os.read(number, 20).decode(errors="replace").strip()
    who = f"process {owner}" if owner.isdecimal() else "another process"
    return InputError(
        "output", str(path), f"{who} is writing it", "wait for its end, or choose another name with --output"
    )


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
