"""How every verb ends: the exit status, and one line for what went wrong."""

import functools
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import NoReturn, ParamSpec

import typer

from tribodyn.cli.signals import message_of, silence, status_of
from tribodyn.errors import NO_ROOM, InputError, OutputError, SimulationError, harmless

DONE = 0
BUG = 1
BAD_INPUT = 2
SIMULATION_FAILED = 3
OUTSIDE_TOLERANCE = 4

Arguments = ParamSpec("Arguments")


def verb(function: Callable[Arguments, None]) -> Callable[Arguments, None]:
    """Turn every way that a verb can end badly into a message on stderr and an exit status; no traceback.

    With ``TRIBODYN_TRACEBACK=1`` in the environment an unexpected error shows its traceback instead.
    """

    @functools.wraps(function)
    def guarded(*args: Arguments.args, **kwargs: Arguments.kwargs) -> None:
        try:
            function(*args, **kwargs)
            sys.stdout.flush()
        except (InputError, SimulationError, OutputError) as error:
            complain(str(error))
            raise typer.Exit(BAD_INPUT if isinstance(error, InputError) else SIMULATION_FAILED) from None
        except KeyboardInterrupt as error:
            complain(message_of(error))
            raise typer.Exit(status_of(error)) from None
        except BrokenPipeError:
            # the reader of a pipe has gone
            silence(sys.stdout)
            raise typer.Exit(DONE) from None
        except (typer.Exit, typer.Abort):
            raise
        except OSError as error:
            if error.errno not in NO_ROOM:
                _report_bug(error)
            complain(f"{error.filename or 'the output'}: cannot be written: {error.strerror}")
            silence(sys.stdout)
            raise typer.Exit(SIMULATION_FAILED) from None
        except Exception as error:
            _report_bug(error)

    return guarded


def _report_bug(error: Exception) -> NoReturn:
    """Say that this should not have happened; with TRIBODYN_TRACEBACK=1, where."""
    if os.environ.get("TRIBODYN_TRACEBACK"):
        raise error
    what = " ".join(f"{type(error).__name__}: {error}".split())
    complain(f"a bug in tribodyn: {what}; set TRIBODYN_TRACEBACK=1 to see the traceback, and report it")
    raise typer.Exit(BUG) from None


def complain(message: str) -> None:
    """Write a message to stderr, without what a terminal would obey."""
    with suppress(OSError):  # nobody reads it; the exit status says it too
        sys.stderr.write(harmless(message) + "\n")
