"""Signals that end a verb: each as Ctrl-C does, so that records are concluded and locks removed."""

import os
import signal
import stat
import sys
from contextlib import suppress
from typing import NoReturn, TextIO

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
