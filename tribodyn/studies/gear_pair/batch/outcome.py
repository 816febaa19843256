"""Outcome of a case: its way through the window, its Poincaré section, the sort of motion."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from tribodyn.dynamics.extremes import Extremes
from tribodyn.dynamics.parameters import LAG, WORKS
from tribodyn.solve.branch.end import BranchEnd
from tribodyn.solve.integrator import REASONS, Status
from tribodyn.studies.gear_pair.sweep_layout import UNKNOWN

if TYPE_CHECKING:
    from tribodyn.solve.branch.followed import Continued


class Passage(NamedTuple):
    """A case's way through its window.

    Attributes
    ----------
    first_cycle : int
        Whole mesh cycles done before.
    window : (cycles · samples, STATES)
        States over whole mesh cycles, the sample that closes the last not included.
    start, end : (STATES,)
        States at both ends; the difference of their works is the window's.
    extremes : Extremes or None
        Of the motion between the samples.
    """

    first_cycle: int
    window: np.ndarray
    start: np.ndarray
    end: np.ndarray
    extremes: Extremes | None = None


class Outcome(NamedTuple):
    """Outcome of a case.

    Attributes
    ----------
    passage : Passage or None
        None where the case failed.
    state : (STATES,)
        After the engagement at phase 0, clock and audit at zero: where a neighbour continues.
    section : (points, STATES)
        States at the start of mesh cycles, the last ones.
    solution : str
        Sort of motion, as `orbit.Orbit.kind`; or "transient".
    cycles : int
        Mesh cycles integrated.
    message : str
        Why it failed, or a remark on its result.
    period, stable, multiplier_max, residual
        As `sweep_layout.CASES` has them.
    ends : tuple of BranchEnd
        Of the branches that were left on the way from the neighbour.
    continued : tuple of Continued
        Those branches beyond their ends.
    """

    passage: Passage | None
    state: np.ndarray
    section: np.ndarray
    solution: str
    cycles: int
    message: str = ""
    period: int = 0
    stable: int = UNKNOWN
    multiplier_max: float = float("nan")
    residual: float = float("nan")
    ends: tuple[BranchEnd, ...] = ()
    continued: "tuple[Continued, ...]" = ()


def failed(state: np.ndarray, cycles: float, reason: str) -> Outcome:
    """The outcome of a case that could not go on."""
    return Outcome(None, state, np.empty((0, state.size)), "failed", int(cycles), reason)


def stopped(status: int, reached: float) -> str:
    """Why an integration stopped, and after how many mesh cycles."""
    return f"stopped after {reached:.4g} mesh cycles: {REASONS[Status(status)]}"


def continued(state: np.ndarray) -> np.ndarray:
    """The state with its clock and its audit at zero."""
    state = state.copy()
    state[[LAG, *WORKS]] = 0.0
    return state
