"""What is asked of a sweep whose cases give the signals of their sensors: a data set."""

from typing import NamedTuple

from tribodyn.errors import InputError

#: Turns of the reference body before a signal begins: the run in, after which a start at rest is forgotten.
RUN_IN = 3.0


class SignalRequest(NamedTuple):
    """Signals in place of steady states."""

    duration: float  # s, of every signal
    run_in: float = RUN_IN  # turns of the reference body before it
    seed: int = 0  # of the moments at which signals begin, and of the sensors' noise


def no_signals(about: str) -> InputError:
    """What a study without sensors says."""
    return InputError("--signals", None, f"{about}: its cases have no sensors", "omit it")
