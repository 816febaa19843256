"""A function of a file's path, called by a child process, which may hang or die of what it finds.

The child is a copy of this process where that is safe. Otherwise, as in a notebook, whose threads a copy
would not have, it is a copy of a process that is kept for this: only the first call waits for imports.
"""

import atexit
import os
import select
import signal
import subprocess
import sys
import threading
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

#: Seconds that a look through a file may take; a record of 1 GB takes milliseconds, its data are not read.
TIME_LIMIT = 20.0
#: Seconds more where a process has to be started: a slow machine needs some time to import h5py.
START_LIMIT = 40.0

Look = Callable[[Path], str]


def through_a_child(look: Look, path: Path) -> str:
    """Call a function of a path in a child process.

    Parameters
    ----------
    look : callable
        At module level; says what is wrong with a file, "" where nothing is.
    path : Path

    Returns
    -------
    str
        What it says, or that it hung or crashed.
    """
    if not hasattr(os, "fork"):
        return _by_a_new_process(look, path)
    # no thread of Python's may hold a lock that a copy needs
    return forked(look, path) if threading.active_count() == 1 else _kept(look).answer(path)


def forked(look: Look, path: Path) -> str:
    """Call it in a copy of this process."""
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that others' threads do not come along is known
        child = os.fork()
    if child == 0:
        _call(look, path, writing)
    os.close(writing)
    try:
        ready, _, _ = select.select([reading], [], [], TIME_LIMIT)
        said = _all_of(reading) if ready else b""
        if not ready:
            os.kill(child, signal.SIGKILL)
    finally:
        os.close(reading)
        _, status = os.waitpid(child, 0)
    if not ready:
        return _hung(TIME_LIMIT)
    return said.decode(errors="replace") if status == 0 else CRASHED


CRASHED = "HDF5 crashes on it"


def _hung(limit: float) -> str:
    return f"reading it did not end within {limit:g} s"


def _call(look: Look, path: Path, writing: int) -> NoReturn:
    """Write what is said of the file and end, without what a process does at its end."""
    status = 1
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # a crash is said by the parent
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.write(writing, look(path).encode(errors="replace")[:4096])
        status = 0
    finally:
        os._exit(status)


def _all_of(reading: int) -> bytes:
    parts = []
    while part := os.read(reading, 4096):
        parts.append(part)
    return b"".join(parts)


class _Kept:
    """A process that calls a function in copies of itself; it ends with this one."""

    def __init__(self, look: Look) -> None:
        self.owner = os.getpid()
        self._lock = threading.Lock()
        program = f"from {look.__module__} import {look.__name__} as look\n"
        program += f"from {__name__} import serve\nserve(look)"
        self._process = subprocess.Popen(
            [sys.executable, "-c", program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            bufsize=0,
            start_new_session=True,  # Ctrl-C is for the process that asks
            env={**os.environ, "PYTHONPATH": os.pathsep.join(part for part in sys.path if part)},
        )

    def alive(self) -> bool:
        return self._process.poll() is None

    def end(self) -> None:
        """End it, if it is this process's own."""
        if self.owner == os.getpid():
            self._process.kill()
            self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()

    def answer(self, path: Path) -> str:
        """What the function says of a file."""
        asked, answers = self._process.stdin, self._process.stdout
        assert asked is not None
        assert answers is not None
        with self._lock:
            try:
                asked.write(os.fsencode(path.absolute()).hex().encode() + b"\n")
                ready, _, _ = select.select([answers], [], [], START_LIMIT + TIME_LIMIT)
                line = answers.readline() if ready else b""
            except BaseException as error:  # the answer to this would be taken for one to the next
                self.end()
                if isinstance(error, (OSError, ValueError)):  # it has ended
                    return CRASHED
                raise
            if not line.endswith(b"\n"):
                self.end()
                return CRASHED if ready else _hung(START_LIMIT + TIME_LIMIT)
        return bytes.fromhex(line.decode()).decode(errors="replace")


_processes: dict[Look, _Kept] = {}
_starting = threading.Lock()


def _kept(look: Look) -> _Kept:
    """The process that is kept for a function; another one if it ended or belongs to who forked this one."""
    with _starting:
        known = _processes.get(look)
        if known is None or known.owner != os.getpid() or not known.alive():
            if known is not None:
                known.end()
            known = _processes[look] = _Kept(look)
        return known


@atexit.register
def end_all() -> None:
    """End the processes that are kept; they would end by themselves, but with a warning of Python's."""
    while _processes:
        _processes.popitem()[1].end()


def serve(look: Look) -> None:
    """Answer every path on standard input with what the function says of it; both are hexadecimal."""
    for line in sys.stdin.buffer:
        said = forked(look, Path(os.fsdecode(bytes.fromhex(line.decode()))))
        sys.stdout.buffer.write(said.encode(errors="replace").hex().encode() + b"\n")
        sys.stdout.buffer.flush()


def _by_a_new_process(look: Look, path: Path) -> str:
    """Call it in a process of its own, where processes cannot be copied."""
    program = f"import sys; from pathlib import Path; from {look.__module__} import {look.__name__} as look\n"
    program += "sys.stdout.buffer.write(look(Path(sys.argv[1])).encode(errors='replace'))"
    limit = START_LIMIT + TIME_LIMIT
    try:
        command = [sys.executable, "-c", program, str(path)]
        ended = subprocess.run(command, capture_output=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return _hung(limit)
    return ended.stdout.decode(errors="replace") if ended.returncode == 0 else CRASHED
