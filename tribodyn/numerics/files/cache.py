"""Where results that cost time are kept between processes.

Compiled kernels, finite elements and solved contacts are kept alike. A file begins with a line that has the
digest of its folder, name and content: what is damaged, changed or under another's name counts as not there
and is made anew, once, while other processes wait.

Machine code is loaded from the cache, so that whoever can write there can run code as the user. Nothing is
read from a folder or a file that somebody else owns or can write: the folder is then not used at all, and a
warning says so once.
"""

import hashlib
import importlib.util
import json
import math
import os
import stat
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from tribodyn.numerics.files.output_files import CAREFUL, open_new, replacing
from tribodyn.numerics.files.sources import digest_of

if TYPE_CHECKING:
    import numpy as np

T = TypeVar("T")

#: Begins the first line of a file; the digest follows.
_MARK = b"tribodyn-cache-1 "
#: Length of that line.
_HEAD = len(_MARK) + 2 * hashlib.sha256().digest_size + 1
#: Maximum size of a file of the cache, bytes; a file that is larger is none of ours. The largest are those
#: of gears under loads along wide teeth, some 20 MB.
MAXIMUM_SIZE = 2**29
#: Seconds for which a process waits for another that makes the same; a kernel takes ten of them, or thirty.
LONGEST_WAIT = 120.0
#: Permissions by which others could write.
_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH
#: Owner that the kernel shows for users it cannot name in a container.
_UNNAMED = 65534


def cache_folder() -> Path:
    """`TRIBODYN_CACHE`, or the user's cache folder: compiled kernels, XLA's code, solved gears."""
    if setting := os.environ.get("TRIBODYN_CACHE"):
        return Path(setting).absolute()
    from platformdirs import user_cache_path

    return user_cache_path("tribodyn")


def trusted_folder(name: str) -> Path | None:
    """A folder of the cache that the user alone can write; made where it is not there.

    None where there is none: it cannot be made, or others can write it. That is reported once in a process.
    """
    return _trusted(cache_folder(), name)


@cache
def _trusted(whole: Path, name: str) -> Path | None:
    folder = whole / name
    try:
        os.makedirs(whole.parent, exist_ok=True)
        for part in (whole, folder):
            with suppress(FileExistsError):
                os.mkdir(part, 0o700)
        reason = _why_not(whole, folder)
    except OSError:  # where nothing can be kept, everything is computed anew
        return None
    if reason:
        _warn(f"{reason}: nothing is kept there or read from there")
        return None
    return folder


@cache
def _warn(message: str) -> None:
    warnings.warn(message, RuntimeWarning, stacklevel=2)


def _why_not(whole: Path, folder: Path) -> str:
    """Why a folder of the cache cannot be trusted; empty where it can."""
    if not hasattr(os, "geteuid"):  # Windows, where the user's own folders are closed to others
        return ""
    for part in (whole, folder):
        status = part.stat()
        if not stat.S_ISDIR(status.st_mode):
            return f"the cache {part} is no folder"
        if status.st_uid != os.geteuid():
            return f"the cache {part} belongs to another user"
        if status.st_mode & _OTHERS_WRITE:
            return (
                f"others can write to the cache {part} (remove it, or chmod -R go-w if its content is yours)"
            )
    for above in {*whole.parents, *whole.resolve().parents}:
        status = above.stat()
        foreign = status.st_uid not in (0, os.geteuid(), _UNNAMED)
        shared = status.st_mode & stat.S_IWOTH and not status.st_mode & stat.S_ISVTX
        if foreign or shared:
            return f"others can replace the cache {whole}: {above} is theirs to write"
    return ""


def kept_or_made(
    folder: str, name: str, read: Callable[[bytes], T | None], make: Callable[[], tuple[T, bytes | None]]
) -> T:
    """Return what the cache holds, or make it and keep it there, while other processes wait for it.

    The file's name is a digest of everything that its content depends on. `read` gives what the content
    stands for; None, or a ValueError, KeyError or TypeError where this process cannot use it. `make` gives
    the thing and its content, None if it is not to be kept.
    """

    def known() -> T | None:
        content = read_kept(folder, name)
        with suppress(ValueError, KeyError, TypeError):  # whole, but of another layout
            return None if content is None else read(content)
        return None

    if (cached := known()) is not None:
        return cached
    with alone(folder, name):
        if (cached := known()) is not None:  # another process has kept it meanwhile
            return cached
        value, content = make()
        if content is not None:
            trusted = trusted_folder(folder)
            # what killed processes left of the file; whoever still writes it does without
            for remains in trusted.glob(f"{escape(name)}.*.tmp") if trusted else ():
                with suppress(OSError):
                    remains.unlink()
            keep(folder, name, content)
    return value


def arrays_kept_or_made(
    folder: str, name: str, make: Callable[[], Mapping[str, "np.ndarray | float"]]
) -> Mapping[str, "np.ndarray"]:
    """Return arrays by name as `kept_or_made`, the same bits whether they were kept or are made now.

    They are of float64; numbers become arrays of no axes.
    """
    import numpy as np

    def read(content: bytes) -> Mapping[str, "np.ndarray"]:
        place = content.index(b"\n") + 1
        arrays = {}
        for name, shape in json.loads(content[:place]).items():
            arrays[name] = np.frombuffer(content, "<f8", math.prod(shape), place).reshape(shape).copy()
            place += arrays[name].nbytes
        return arrays

    def made() -> tuple[Mapping[str, "np.ndarray"], bytes]:
        arrays = {name: np.asarray(value, dtype="<f8") for name, value in make().items()}
        head = json.dumps({name: value.shape for name, value in arrays.items()})
        return arrays, b"".join([head.encode(), b"\n", *(value.tobytes() for value in arrays.values())])

    return kept_or_made(folder, name, read, made)


@cache
def _of_sources(modules: tuple[str, ...]) -> bytes:
    return digest_of(*modules)


def digest_of_numbers(modules: tuple[str, ...], numbers: Iterable[Any]) -> str:
    """Digest of numbers and of the sources of modules that compute with them, for `arrays_kept_or_made`.

    The numbers are rounded to 12 digits: their last bits differ between processors.
    """
    import numpy as np

    digest = hashlib.sha256(_of_sources(modules))
    for values in numbers:
        digest.update(np.char.mod("%.11e", np.atleast_1d(np.asarray(values, dtype=float))).tobytes())
    return digest.hexdigest()[:32]


def _head(folder: str, name: str, content: bytes) -> bytes:
    digest = hashlib.sha256(f"{folder}/{name}\n".encode())
    digest.update(content)
    return _MARK + digest.hexdigest().encode() + b"\n"


def read_kept(folder: str, name: str) -> bytes | None:
    """Content of a file of the cache; None where it is not there, or not the user's own as it was kept."""
    trusted = trusted_folder(folder)
    if trusted is None:
        return None
    try:
        # no link is followed and no pipe waited for
        number = os.open(trusted / name, os.O_RDONLY | CAREFUL | getattr(os, "O_NONBLOCK", 0))
    except OSError:
        return None
    try:
        status = os.fstat(number)
        if not stat.S_ISREG(status.st_mode) or status.st_size > MAXIMUM_SIZE:
            return None
        if hasattr(os, "geteuid") and (status.st_uid != os.geteuid() or status.st_mode & _OTHERS_WRITE):
            return None
        with open(number, "rb", closefd=False) as stream:
            head, content = stream.read(_HEAD), stream.read(status.st_size)
    except (OSError, MemoryError):
        return None
    finally:
        os.close(number)
    return content if head == _head(folder, name, content) else None


def keep(folder: str, name: str, content: bytes) -> None:
    """Keep a file in the cache, or do without where that is not possible: the cache is a convenience.

    It is on the disk before it has its name.
    """
    trusted = trusted_folder(folder)
    if trusted is None:
        return
    with suppress(OSError), replacing(trusted / name) as scratch:
        with open_new(scratch, 0o600) as stream:
            stream.write(_head(folder, name, content))
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())


@contextmanager
def alone(folder: str, name: str) -> Iterator[None]:
    """Work on a file of the cache while no other process does: what one makes, the others need not.

    Waits for at most `LONGEST_WAIT`. Where the system has no locks, or none for this folder, nobody waits.
    The lock is on a byte of one file per folder; the library `filelock` would leave a file for every name.
    """
    trusted = trusted_folder("locks")
    number = _lock_file(trusted / folder) if trusted is not None else None
    if number is None:
        yield
        return
    import fcntl

    # a byte of the lock's file for every name, and none of them is written
    place = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big")
    end = time.monotonic() + LONGEST_WAIT
    try:
        while time.monotonic() < end:
            try:
                fcntl.lockf(number, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, place)
                break
            except (BlockingIOError, PermissionError):
                time.sleep(0.02)
            except OSError:
                break
        yield
    finally:
        os.close(number)  # and with it goes the lock


def _lock_file(path: Path) -> int | None:
    """Open a file for locks; None where there can be none."""
    if importlib.util.find_spec("fcntl") is None:
        return None
    flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
    try:
        return os.open(path, flags, 0o600)
    except OSError:
        return None


@cache
def use_compilation_cache() -> None:
    """Let JAX keep the programs that XLA compiles, unless no folder can be trusted."""
    import jax

    if folder := trusted_folder("xla"):
        jax.config.update("jax_compilation_cache_dir", str(folder))
        jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.2)
