"""One process at a time writes a record; a lock of the operating system, which dies with its process.

The lock is on a file of its own beside the record, as the record's file is replaced now and then. Whoever is
killed leaves that file behind, and it bars nobody. It is not the library `filelock` (4.2), which says not who
writes, leaves its file beside every record, and takes a user's file of that name for a lock.
"""

import contextlib
import errno
import importlib
import os
import re
import stat
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from tribodyn.errors import InputError
from tribodyn.numerics.files.output_files import CAREFUL, unwritable

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
        with contextlib.suppress(OSError):
            self._path.unlink()
        if os.name != "nt":
            os.close(number)


@contextlib.contextmanager
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
    with contextlib.suppress(OSError):
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
        with contextlib.suppress(FileExistsError):
            return os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | CAREFUL, 0o666)
        with contextlib.suppress(FileNotFoundError):  # its owner removed it just now
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
