"""Runs by time: the gears may stand, and turn back, which runs by the rotation of the reference cannot.

The state is that of a run by rotation: its lag t − c T, with T the time of a reference cycle at nominal
speed, says what cycle c the reference has come to at a time t. Tables of the teeth are functions of c; what
changes where a pair enters or leaves is found on the way, in either direction.
"""

from collections.abc import Iterator
from typing import Protocol

import numpy as np

from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.kernels.native import packed
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.integrator import REASONS, Status
from tribodyn.solve.march.by_time import begun_clock, march_by_time, time_buffer, time_control
from tribodyn.solve.march.crossing import TIME, cycles_at, nominal_time
from tribodyn.solve.methods import Runs, runs
from tribodyn.solve.right_hand_side import work_array
from tribodyn.solve.transient import SampledStates, Stop, TransientSettings

#: Samples between two writes.
SAMPLES = 2000


class Walk(Protocol):
    """A walk through time: state and counts so far."""

    y: Float[Array, " state"]
    steps: int
    evaluations: int

    @property
    def time(self) -> float:
        """Time it has come to, cycles of nominal speed."""
        ...

    def march(self, first: int, count: int) -> tuple[Status, str]:
        """Go on through so many samples, to the last of them; how it ended, and the solver's own words."""
        ...

    def taken(self) -> Float[Array, "sample state"]:
        """The samples of the last call."""
        ...


def transient_in_time(
    model: Model, state: Float[Array, " state"], settings: TransientSettings
) -> Iterator[SampledStates | Stop]:
    """Integrate from a state at time 0; as `transient.transient`, cycles and samples those of nominal speed.

    Samples are even in time, a complete run has one at its end. The model's variable is time.
    """
    walk: Walk
    if runs(settings.method) is Runs.NATIVE:
        walk = NativeWalk(model, state, settings)
    else:
        from tribodyn.solve.scipy_in_time import ScipyWalk  # SciPy's solvers take long to import

        walk = ScipyWalk(model, state, settings)
    total = settings.cycles * settings.samples + 1
    done = 0
    reason = ""
    while done < total and not reason:
        steps, evaluations = walk.steps, walk.evaluations
        status, message = walk.march(done, min(SAMPLES, total - done))
        taken = walk.taken()
        cost = walk.evaluations - evaluations, walk.steps - steps
        at = cycles_at((done + np.arange(len(taken))) / settings.samples, taken, model)
        yield SampledStates(at, taken, *cost)
        done += len(taken)
        if status != Status.DONE:
            reason = REASONS[status] + (f" ({message})" if message else "")
    reached = float(cycles_at(np.array([walk.time]), walk.y[None], model)[0])
    time = walk.time * float(nominal_time(model))
    yield Stop(walk.y, reached, walk.steps, walk.evaluations, reason, time)


class NativeWalk:
    """A walk by `march.by_time`."""

    def __init__(self, model: Model, state: Float[Array, " state"], settings: TransientSettings) -> None:
        self.y, self.samples = state.copy(), settings.samples
        self.steps = self.evaluations = 0
        self._control = time_control(model, state, settings.rtol, settings.max_steps)
        self._clock = begun_clock(model, state, self._control)
        self._model = packed(with_shared_code(model))
        self._scratch = work_array(model), time_buffer(model.layout)
        self._taken = np.empty((0, len(state)))

    @property
    def time(self) -> float:
        """See `Walk`."""
        return float(self._clock[TIME])

    def march(self, first: int, count: int) -> tuple[Status, str]:
        """See `Walk`."""
        out = np.empty((count, len(self.y)))
        status, steps, evaluations, written = march_by_time(
            first, float(self.samples), self._control, self._model, self.y, self._clock, *self._scratch, out
        )
        self.steps, self.evaluations = self.steps + steps, self.evaluations + evaluations
        self._taken = out[:written]
        return Status(status), ""

    def taken(self) -> Float[Array, "sample state"]:
        """See `Walk`."""
        return self._taken
