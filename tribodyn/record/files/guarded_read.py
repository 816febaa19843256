"""A function of a file's path, called in a child process with a time limit: a hostile file may crash it.

The child is a copy of this process where that is safe: 0.02 s for every record that is read, where a new
process needs 0.2 s to import h5py. Otherwise, as in a notebook, whose threads a copy would not have, it is a
copy of a process that is kept for this: only the first call waits for imports. Where the system copies no
processes, that process calls the function itself.
"""

import atexit
import os
import sys
import threading
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

from tribodyn.numerics.processes import child

#: Seconds that a look through a file may take, also where other work keeps the processor busy.
TIME_LIMIT = 20.0
#: Seconds of the processor, and bytes of the file for each further one. A record of 1 GB takes milliseconds,
#: its data are not read; those of one that somebody has compressed are.
PROCESSOR_LIMIT, BYTES_A_SECOND = 1.5, 5e7
#: Seconds more where a process has to be started: a slow machine needs some time to import h5py.
START_LIMIT = 40.0
#: Characters of what is said of a file.
_LONGEST = 4096

Look = Callable[[Path], str]

CRASHED = "HDF5 crashes on it"


def through_a_child(look: Look, path: Path) -> str:
    """Call a function at module level of a path in a child process.

    Returns what it says is wrong with the file, "" where nothing is, or that it hung or crashed.
    """
    return forked(look, path) if child.copies_are_safe() else _kept(look).answer(path)


def forked(look: Look, path: Path) -> str:
    """Call it in a copy of this process."""
    try:
        processor = PROCESSOR_LIMIT + path.stat().st_size / BYTES_A_SECOND
        reply = child.in_a_copy(lambda: look(path)[:_LONGEST].encode(errors="replace"), TIME_LIMIT, processor)
    except TimeoutError as error:
        return f"reading it {error}"
    except ChildProcessError:
        return CRASHED
    return reply.decode()


def _hung(limit: float) -> str:
    return f"reading it did not end within {limit:g} s"


class _Kept:
    """A process that calls a function in copies of itself; it ends with this one."""

    def __init__(self, look: Look) -> None:
        self.owner = os.getpid()
        self._lock = threading.Lock()
        self._process = child.start(f"{__name__}:serve", look.__module__, look.__name__)
        atexit.register(self.end)  # it would end by itself, but with a warning of Python's

    def alive(self) -> bool:
        return self._process.poll() is None

    def end(self) -> None:
        """End it, if it is this process's own."""
        if self.owner == os.getpid():
            child.end(self._process)
            return
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()

    def answer(self, path: Path) -> str:
        """What the function says of a file."""
        limit = START_LIMIT + TIME_LIMIT
        with self._lock:
            try:
                child.tell(self._process, os.fsencode(path.absolute()).hex().encode() + b"\n")
                line = child.answer(self._process, limit, line=True)
            except BaseException as error:  # the answer to this would be taken for one to the next
                self.end()
                if isinstance(error, TimeoutError):
                    return _hung(limit)
                if isinstance(error, (OSError, ValueError)):  # it has ended
                    return CRASHED
                raise
            if not line.endswith(b"\n"):
                self.end()
                return CRASHED
        return bytes.fromhex(line.decode()).decode(errors="replace")


_processes: dict[Look, _Kept] = {}
_starting = threading.Lock()


def _kept(look: Look) -> _Kept:
    """The process that is kept for a function; another one if it ended or belongs to who forked this one."""
    with _starting:
        process = _processes.get(look)
        if process is None or process.owner != os.getpid() or not process.alive():
            if process is not None:
                process.end()
            process = _processes[look] = _Kept(look)
        return process


def serve(module: str, name: str) -> None:
    """Answer every path on standard input with what a function says of it; both are hexadecimal."""
    look: Look = getattr(import_module(module), name)
    call = forked if hasattr(os, "fork") else lambda look, path: look(path)[:_LONGEST]
    for line in sys.stdin.buffer:
        reply = call(look, Path(os.fsdecode(bytes.fromhex(line.decode()))))
        sys.stdout.buffer.write(reply.encode(errors="replace").hex().encode() + b"\n")
        sys.stdout.buffer.flush()
