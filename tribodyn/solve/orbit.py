"""Result of the search for a steady state of one system."""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Complex, Float


class Orbit(NamedTuple):
    """One system's steady state, or what can be said instead.

    Attributes
    ----------
    state : (N,)
        At the start of a period, on the steady orbit; the last one marched where there is none.
    last : (N,)
        Where marching ended: the start for a neighbouring system, on the orbit only if that was taken.
    period : int
        Periods of the excitation in one of the motion; 0 where none was found.
    residual : float
        Scaled change of the state over one period of the motion; of a motion that is not periodic the
        smallest over 1 … MAX_PERIOD periods.
    multipliers : (N,) complex
        Floquet multipliers over one period of the motion, largest first; NaN without a steady state.
    stable : bool
        No multiplier outside the unit circle.
    kind : str
        "period-1" … "period-4", "unstable", "not periodic", "failed".
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
    return Orbit(last, last, 0, np.inf, none, False, "failed", "marching", marched, reason)
