"""One process at a time writes a record; a lock of the operating system, which dies with its process.

The lock is on a file of its own beside the record, as the record's file is replaced now and then. Whoever is
killed leaves that file behind, and it bars nobody.
"""

import contextlib
import errno
import importlib
import os
from pathlib import Path
from typing import Any

from tribodyn.errors import InputError

#: What a file system says that has no locks: then there is none, as there was none before.
_NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP}
#: Windows locks bytes, and nobody may read them: one far behind the number of the process.
_FAR = 1 << 20


def lock_path(path: Path) -> Path:
    """Name of the lock of a record."""
    return path.with_name(f"{path.stem}.partial.lock")


class WritingLock:
    """Held from its making until `release`, or the end of the process.

    Parameters
    ----------
    path : Path
        The record's final name.

    Raises
    ------
    InputError
        If another process holds it.
    OSError
        If the file of the lock cannot be made.
    """

    def __init__(self, path: Path) -> None:
        self._path = lock_path(path)
        self._number: int | None = None
        while self._number is None:
            number = os.open(self._path, os.O_RDWR | os.O_CREAT, 0o666)
            try:
                if not _taken(number):
                    raise _busy(path, number)
                if _is(number, self._path):  # otherwise its last owner removed it just now
                    os.ftruncate(number, 0)
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


def refuse_if_written(path: Path) -> None:
    """Raise InputError if a process is writing the record of that name; touches nothing."""
    try:
        number = os.open(lock_path(path), os.O_RDWR)
    except OSError:
        return
    try:
        if not _taken(number):
            raise _busy(path, number)
    finally:
        os.close(number)


def _taken(number: int) -> bool:
    """Lock an open file until it is closed; whether that was possible."""
    try:
        if os.name == "nt":
            windows: Any = importlib.import_module("msvcrt")
            os.lseek(number, _FAR, os.SEEK_SET)
            windows.locking(number, windows.LK_NBLCK, 1)
            os.lseek(number, 0, os.SEEK_SET)
        else:
            import fcntl

            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
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
