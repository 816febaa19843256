"""Cases marched over a given number of mesh cycles, the last of them kept; what a case comes to."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tribodyn.dynamics.extremes import Extremes, extremes_of
from tribodyn.dynamics.parameters import LAG, STATES, WORKS, Model
from tribodyn.solve.branch.arclength import BranchEnd
from tribodyn.solve.ensemble import march
from tribodyn.solve.integrator import REASONS, Status
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.studies.gear_pair.sweep_layout import UNKNOWN

if TYPE_CHECKING:
    from tribodyn.solve.branch.gear_pairs import ContinuedBranch


class CaseWindow(NamedTuple):
    """A case's way through its window."""

    first_cycle: int  # whole mesh cycles done before
    #: (cycles · samples, STATES), over whole mesh cycles, the sample that closes the last not included
    states: np.ndarray
    #: start, end: (STATES,), states at both ends; the difference of their works is the window's
    start: np.ndarray
    end: np.ndarray
    extremes: Extremes | None = None  # of the motion between the samples


class Outcome(NamedTuple):
    """Outcome of a case."""

    window: CaseWindow | None  # None where the case failed
    #: (STATES,), after the engagement at phase 0, clock and audit at zero: where a neighbour continues
    state: np.ndarray
    section: np.ndarray  # (points, STATES), states at the start of mesh cycles, the last ones
    solution: str  # sort of motion, as `orbit.motions.Orbit.kind`; or "transient"
    cycles: int  # mesh cycles integrated
    message: str = ""  # why it failed, or a remark on its result
    #: period, stable, multiplier_max, residual: as `sweep_layout.CASES` has them
    period: int = 0
    stable: int = UNKNOWN
    multiplier_max: float = float("nan")
    residual: float = float("nan")
    ends: tuple[BranchEnd, ...] = ()  # of the branches that were left on the way from the neighbour
    continued: "tuple[ContinuedBranch, ...]" = ()  # those branches beyond their ends


def failed(state: np.ndarray, cycles: float, reason: str) -> Outcome:
    """The outcome of a case that could not go on."""
    return Outcome(None, state, np.empty((0, state.size)), "failed", int(cycles), reason)


def without_audit(state: np.ndarray) -> np.ndarray:
    """The state with its clock and its audit at zero."""
    state = state.copy()
    state[[LAG, *WORKS]] = 0.0
    return state


def marched(
    models: Sequence[Model],
    states: np.ndarray,
    *,
    cycles: int,
    window: int,
    points: int,
    samples: int,
    **solver: Any,
) -> list[Outcome]:
    """March every case from its state, after the engagement at phase 0.

    Parameters
    ----------
    states : (C, STATES)
    cycles, window, points : mesh cycles to march, those of them whose samples are kept, and those whose first
        state is
    samples : samples in a mesh cycle
    **solver : further arguments of `ensemble.march`
    """
    before = cycles - window
    sections = max(0, min(points, cycles) - window)
    led = march(models, states, cycles=before, window=sections, samples=1, **solver)
    good = np.flatnonzero(led.status == Status.DONE).tolist()
    ran = march(
        [models[i] for i in good],
        led.state[good],
        cycles=window,
        window=window,
        samples=samples,
        started=before > 0,
        first_cycle=before,
        extremes=True,
        **solver,
    )
    rows = {i: row for row, i in enumerate(good)}
    outcomes = []
    for i, model in enumerate(models):
        part, row = (ran, rows[i]) if i in rows else (led, i)
        reached = float(part.reached[row]) + (before if i in rows else 0)
        if part.status[row] != Status.DONE:
            reason = f"stopped after {reached:.4g} mesh cycles: {REASONS[Status(int(part.status[row]))]}"
            outcomes.append(failed(part.state[row], reached, reason))
            continue
        section = np.concatenate([led.samples[i], ran.samples[row, ::samples]]).reshape(-1, STATES)
        state = ran.state[row].copy()
        engage_next(state, model)
        extremes = extremes_of(ran.extremes, row)
        kept = CaseWindow(before, ran.samples[row], led.state[i], ran.state[row], extremes)
        outcomes.append(Outcome(kept, without_audit(state), section[-points:], "transient", int(reached)))
    return outcomes
