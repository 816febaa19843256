"""What every integrator takes and returns, of one case or of a batch, and how it ended."""

from enum import IntEnum
from typing import NamedTuple, Protocol

import numpy as np

from tribodyn.dynamics.recorded.extremes import Extremes, no_extremes, put_extremes
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.train.layout import TrainLayout


class Status(IntEnum):
    """How an integration ended."""

    DONE = 0
    STEP_TOO_SMALL = 1
    TOO_MANY_STEPS = 2
    NOT_FINITE = 3
    STALLED = 4
    GAVE_UP = 5
    UNBOUNDED = 6


REASONS = {
    Status.STEP_TOO_SMALL: "the step size fell below 1e-13 mesh cycles",
    Status.TOO_MANY_STEPS: "the limit of steps in one mesh cycle was reached; raise solver.max_steps or, "
    "where it is explicit, choose a stiff solver.method",
    Status.NOT_FINITE: "the solution stopped being finite",
    Status.STALLED: "the pinion came to rest; integration in mesh phase needs it to turn forwards",
    Status.GAVE_UP: "the solver gave up",
    Status.UNBOUNDED: "the motion grew without bound: a gear, or the flanks against each other, moved by "
    'more than the centre distance; use less friction, friction.sliding = "dynamic", more damping of mesh '
    "and bearings or stiffer bearings, and mesh.backlash where the load turns over",
}

#: Steps allowed in one mesh cycle, as a scenario's `solver.max_steps` has it by default.
MAX_STEPS = 1_000_000


class March(NamedTuple):
    """What to do, the same for all cases of a batch."""

    first_cycle: int  # whole mesh cycles done before; with the phase and the lag they give the time
    cycles: int  # mesh cycles to do
    window: int  # last cycles of which samples are kept
    samples: int  # samples in a mesh cycle
    #: whether the states stand before the engagement at phase 0, as a march leaves them: not at the start of
    #: a run
    started: bool
    rtol: float
    #: steps, accepted ones, that one mesh cycle may take; a case that needs more fails. This is what
    #: `solver.max_steps` means whatever the method.
    max_steps: int
    extremes: bool = False  # whether extremes are sought, over the window


class IntegratedCycles(NamedTuple):
    """A run of whole mesh cycles."""

    #: states at phases k/samples_per_cycle, first one included, last one not; fewer on a failure
    samples: Float[Array, "sample state"]
    state: Float[Array, " state"]  # state at the end, before the next engagement
    status: Status
    reached: float  # mesh cycles done in this call
    #: steps, evaluations: accepted steps, and evaluations of the right-hand side
    steps: int
    evaluations: int
    message: str = ""  # the solver's own words, if any
    extremes: Extremes | None = None  # of the dense motion; None where they were not sought


class Integrator(Protocol):
    """Integrates whole mesh cycles, call after call.

    `started` says whether the next call opens with the engagement at phase 0: not at the start of a run;
    `extremes` whether extremes are sought.
    """

    started: bool
    extremes: bool

    def integrate(self, state: Float[Array, " state"], first_cycle: int, cycles: int) -> IntegratedCycles:
        """Integrate `cycles` cycles; `state` stands before the engagement that opens the first."""
        ...


class Ensemble(NamedTuple):
    """Results of C cases."""

    #: at the end, before the next engagement; of a failed case the last one that was accepted
    state: Float[Array, "case state"]
    #: states over the last `window` cycles at phases k/samples; NaN from where a case failed
    samples: Float[Array, "case sample state"]
    status: Int[Array, " case"]  # an `integrator.Status`
    reached: Float[Array, " case"]  # mesh cycles done by this call
    #: steps, evaluations: accepted steps, and evaluations of the right-hand side
    steps: Int[Array, " case"]
    evaluations: Int[Array, " case"]
    extremes: Extremes  # of the motion over the window; of no cases where they were not sought


def put(result: Ensemble, places: Int[Array, " some"], part: Ensemble) -> None:
    """Put the results of some cases into those of all."""
    for all_of_it, some in zip(result[:-1], part[:-1], strict=True):
        all_of_it[places] = some
    if len(part.extremes.measure):
        put_extremes(result.extremes, places, part.extremes)


def nothing_yet(
    layout: TrainLayout, states: Float[Array, "case state"], kept: int, extremes: bool = False
) -> Ensemble:
    """Results before anything is integrated, with room for `kept` samples per case, and maybe extremes."""
    count = len(states)
    return Ensemble(
        states.copy(),
        np.full((count, kept, states.shape[1]), np.nan),
        np.zeros(count, dtype=int),
        np.zeros(count),
        np.zeros(count, dtype=int),
        np.zeros(count, dtype=int),
        no_extremes(layout, count if extremes else 0),
    )
