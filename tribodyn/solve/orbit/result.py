"""Result of the search for a steady state of one system."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float

#: Kinds of motion beside `periodic`: without a period that is sought, what only shooting finds, and none.
LONGER_PERIOD = "longer period"
QUASI_PERIODIC = "quasi-periodic"
CHAOTIC = "chaotic"
NOT_PERIODIC = "not periodic"
UNSTABLE = "unstable"
FAILED = "failed"


def periodic(period: int) -> str:
    """The kind of a stable motion that repeats after some periods of the excitation."""
    return f"period-{period}"


class Orbit(NamedTuple):
    """One system's steady state, or what can be said instead.

    Attributes
    ----------
    state : (N,)
        On the motion that `kind` names, at the start of a period of the excitation.
    last : (N,)
        Where marching ended: the start for a neighbouring system.
    period : int
        Periods of the excitation in one of the motion; 0 where none was found.
    residual : float
        Scaled change of the state over one period of the motion; of a motion that is not periodic the
        smallest over 1 … `recurrence.MAX_PERIOD` periods.
    multipliers : (N,) complex
        Floquet multipliers over one period of the motion, largest first; NaN without a steady state.
    stable : bool
        No multiplier outside the unit circle.
    kind : str
        "period-1" … "period-8"; "longer period"; "quasi-periodic", "chaotic", or "not periodic" where it is
        undecided which;
        "failed"; "unstable" only where shooting alone was asked for.
    method : str
        "marching" or "shooting": what closed the orbit to the tolerance.
    marched : int
        Periods marched.
    message : str
    """

    state: Float[Array, " state"]
    last: Float[Array, " state"]
    period: int
    residual: float
    multipliers: Complex[Array, " state"]
    stable: bool
    kind: str
    method: str
    marched: int
    message: str


def failed_orbit(state: Float[Array, " state"], marched: int, reason: str) -> Orbit:
    """No steady state, for a reason."""
    none = np.full(len(state), np.nan, dtype=complex)
    last = state.copy()
    return Orbit(last, last, 0, np.inf, none, False, FAILED, "marching", marched, reason)
