"""How every verb ends: the exit status, and one line for what went wrong."""

import functools
import os
import sys
from collections.abc import Callable
from typing import ParamSpec

import typer

from tribodyn.errors import InputError, SimulationError

DONE = 0
BUG = 1
BAD_INPUT = 2
SIMULATION_FAILED = 3
OUTSIDE_TOLERANCE = 4
INTERRUPTED = 130

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
        except (InputError, SimulationError) as error:
            complain(str(error))
            raise typer.Exit(BAD_INPUT if isinstance(error, InputError) else SIMULATION_FAILED) from None
        except KeyboardInterrupt:
            complain("interrupted; what was recorded so far is kept in the .partial.h5 file")
            raise typer.Exit(INTERRUPTED) from None
        except BrokenPipeError:
            # the reader of a pipe has gone; keep Python from complaining when it flushes at exit
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            raise typer.Exit(DONE) from None
        except (typer.Exit, typer.Abort):
            raise
        except Exception as error:
            if os.environ.get("TRIBODYN_TRACEBACK"):
                raise
            what = " ".join(f"{type(error).__name__}: {error}".split())
            complain(
                f"a bug in tribodyn: {what}; set TRIBODYN_TRACEBACK=1 to see the traceback, and report it"
            )
            raise typer.Exit(BUG) from None

    return guarded


def complain(message: str) -> None:
    """Write a message to stderr."""
    sys.stderr.write(message + "\n")
