"""How every verb ends: the exit status, one line for what went wrong, and what signals do.

Each signal ends a verb as Ctrl-C does, so that records are concluded and locks removed.
"""

import functools
import os
import signal
import stat
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any, NoReturn, TextIO

from tribodyn.errors import (
    NO_ROOM,
    TOO_MANY_FILES,
    InputError,
    OutputError,
    SimulationError,
    harmless,
    no_descriptors,
)

DONE = 0
BUG = 1
BAD_INPUT = 2
SIMULATION_FAILED = 3
OUTSIDE_TOLERANCE = 4
INTERRUPTED = 130
TERMINATED = 143


class Terminated(KeyboardInterrupt):
    """The system asks the process to end: treated as an interruption by the user, records are concluded."""


def end_when_asked() -> None:
    """Let SIGTERM end a verb as Ctrl-C does, and SIGHUP: the terminal is closed, or the connection lost."""
    signals = [signal.SIGTERM]
    hangup = getattr(signal, "SIGHUP", None)  # none on Windows
    if hangup is not None and signal.getsignal(hangup) is not signal.SIG_IGN:  # as under nohup
        signals.append(hangup)

    def terminate(_number: int, _frame: object) -> NoReturn:
        for number in signals:  # once is enough: what follows is the conclusion of the record
            signal.signal(number, signal.SIG_IGN)
        for stream in (sys.stdout, sys.stderr):
            if _has_gone(stream):
                silence(stream)
        raise Terminated("terminated by a signal")

    for number in signals:
        signal.signal(number, terminate)


def status_of(error: KeyboardInterrupt) -> int:
    """Exit status of a verb that was interrupted or terminated."""
    return TERMINATED if isinstance(error, Terminated) else INTERRUPTED


def message_of(error: KeyboardInterrupt) -> str:
    """What ended a verb, what it keeps and how to go on."""
    return "; ".join([str(error) or "interrupted", *getattr(error, "__notes__", ())])


def _has_gone(stream: TextIO) -> bool:
    """Whether a stream is a terminal that has been closed: to write to it fails."""
    with suppress(OSError, ValueError, AttributeError):
        return stat.S_ISCHR(os.fstat(stream.fileno()).st_mode) and not stream.isatty()
    return False


def silence(stream: TextIO) -> None:
    """Let what is still written to a stream vanish, also when Python flushes it at exit."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def verb(function: Callable[..., None]) -> Callable[..., None]:
    """Turn every way that a verb can end badly into a message on stderr and an exit status; no traceback.

    With ``TRIBODYN_TRACEBACK=1`` in the environment an unexpected error shows its traceback instead.
    """
    from typer import Abort, Exit  # here, so that `main` minds signals before all that typer imports

    @functools.wraps(function)
    def guarded(*args: Any, **kwargs: Any) -> None:
        try:
            function(*args, **kwargs)
            sys.stdout.flush()
        except (InputError, SimulationError, OutputError) as error:
            end(BAD_INPUT if isinstance(error, InputError) else SIMULATION_FAILED, str(error))
        except KeyboardInterrupt as error:
            end(status_of(error), message_of(error))
        except BrokenPipeError:
            # the reader of a pipe has gone
            silence(sys.stdout)
            raise Exit(DONE) from None
        except (Exit, Abort):
            raise
        except OSError as error:
            if error.errno not in NO_ROOM:
                if not _has_folder():
                    end(BAD_INPUT, "the current folder has been removed: change to another one")
                _report_bug(error)
            silence(sys.stdout)
            end(SIMULATION_FAILED, f"{error.filename or 'the output'}: cannot be written: {error.strerror}")
        except Exception as error:
            _report_bug(error)

    return guarded


def _has_folder() -> bool:
    """Whether the current folder is still there."""
    try:
        return os.path.isdir(os.getcwd())
    except OSError:
        return False


def _report_bug(error: Exception) -> NoReturn:
    """Say that this is a bug, unless files are at their limit; with TRIBODYN_TRACEBACK=1, where."""
    if os.environ.get("TRIBODYN_TRACEBACK"):
        raise error
    if no_descriptors(error):
        end(BAD_INPUT, "; ".join(TOO_MANY_FILES))
    what = " ".join(f"{type(error).__name__}: {error}".split())
    end(BUG, f"a bug in tribodyn: {what}; set TRIBODYN_TRACEBACK=1 to see the traceback, and report it")


def end(status: int, message: str) -> NoReturn:
    """End a verb with a message on stderr and an exit status."""
    from typer import Exit

    complain(message)
    raise Exit(status) from None


def complain(message: str) -> None:
    """Write a message to stderr, without what a terminal would obey."""
    with suppress(OSError):  # nobody reads it; the exit status says it too
        sys.stderr.write(harmless(message) + "\n")
