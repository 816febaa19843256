"""SciPy's solvers on the compiled right-hand side, segment by segment, step by step."""

import warnings
from typing import Any

import numpy as np
from scipy.integrate import BDF, DOP853, LSODA, Radau

from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.kernels.native import packed
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.integrator import IntegratedCycles, Status
from tribodyn.solve.march.step_control import STANDSTILL, unbounded
from tribodyn.solve.right_hand_side import engage, rhs, work_array
from tribodyn.solve.tolerances import StepTolerances
from tribodyn.train.layout import TrainLayout, displacements
from tribodyn.train.schedule import intervals, sample_phases

#: SciPy's class of each method.
SOLVERS: dict[str, Any] = {"radau": Radau, "bdf": BDF, "lsoda": LSODA, "dop853": DOP853}
#: Smallest relative tolerance that SciPy's solvers take without a word.
SMALLEST_RTOL = 3e-14
#: Share of the nominal speed at which the pinion has come to rest for these solvers.
SLOWEST = 1e-4


def rtol_of_all(
    rtol: float, atol: Float[Array, " state"], y: Float[Array, " state"], layout: TrainLayout
) -> float:
    """One relative tolerance for all states, under which displacements keep to their absolute ones.

    SciPy's implicit solvers take no other; see `step_control.RELATIVE`.
    """
    places = displacements(layout)
    return max(min(rtol, float(np.min(atol[places] / np.maximum(np.abs(y[places]), 1e-300)))), SMALLEST_RTOL)


class _Ended(Exception):
    """The integration cannot go on from a phase."""

    def __init__(self, status: Status, phase: float, message: str = ""):
        self.status = status
        self.phase = phase
        self.message = message


class ScipyIntegrator:
    """Integrates with a solver of SciPy, made anew at every engagement; see `integrator.Integrator`."""

    def __init__(self, method: str, model: Model, samples: int, tolerances: StepTolerances):
        self.method = SOLVERS[method]
        self.model = model
        self.phases = sample_phases(model.schedule, samples)
        self.tolerances = tolerances
        self.started = False

    def integrate(self, state: Float[Array, " state"], first_cycle: int, cycles: int) -> IntegratedCycles:
        """See `integrator.Integrator`."""
        walk = _Walk(self, state)
        for cycle in range(first_cycle, first_cycle + cycles):
            walk.steps_before = walk.steps
            schedule = self.model.schedule
            for interval in intervals(schedule, cycle):
                start, end = float(schedule.start[interval]), float(schedule.end[interval])
                if start > 0.0 or self.started:
                    engage(interval, True, walk.y, self.model, walk.work, walk.y)
                self.started = True
                try:
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore")  # LSODA's own words arrive in its message
                        walk.over(float(cycle), interval, start, end)
                except _Ended as ended:
                    return walk.result(ended.status, cycle - first_cycle + ended.phase, ended.message)
        return walk.result(Status.DONE, float(cycles))


def stepped(solver: Any) -> str:
    """Let a solver take a step; returns its words where it fails, also over a Jacobian that is not finite."""
    try:
        return solver.step() or ""
    except (ValueError, np.linalg.LinAlgError) as error:
        solver.status = "failed"
        return str(error)


class _Walk:
    """A walk through segments: state, samples and counts so far."""

    def __init__(self, integrator: ScipyIntegrator, state: Float[Array, " state"]):
        self.integrator = integrator
        self.y = state.copy()
        self.work = work_array(integrator.model)
        self.samples: list[Float[Array, "sample state"]] = []
        self.steps = self.steps_before = self.evaluations = 0
        states = integrator.model.layout.states
        self._place, self._rates = np.empty(states), np.empty(states)
        model = with_shared_code(integrator.model)
        self._arguments = [*map(packed, (self._place, model, self.work, self._rates))]

    def over(self, cycle: float, interval: int, start: float, end: float) -> None:
        """Integrate over an interval; raises `_Ended` where that cannot be done."""
        rtol, atol, max_steps = self.integrator.tolerances
        model = self.integrator.model
        nominal_speed, slip = model.operation.nominal_speed, model.layout.half + model.layout.lag
        slowest = (SLOWEST - 1.0) * nominal_speed

        def slope(phase: float, y: Float[Array, " state"]) -> Float[Array, " state"]:
            """Very steep where the reference does not turn: a stage on trial may go there, no accepted step.

            Not without numbers, which LSODA takes for a step without error, and BDF for a damaged Jacobian.
            """
            self.evaluations += 1
            self._place[:] = y
            self._place[slip] = max(self._place[slip], slowest)
            rhs(phase, cycle, interval, *self._arguments)
            return self._rates.copy()

        def end_where_nothing_goes_on(phase: float, y: Float[Array, " state"], failed: bool) -> None:
            share = 1.0 + y[slip] / nominal_speed
            if share <= SLOWEST or (failed and share < STANDSTILL):
                raise _Ended(Status.STALLED, phase)
            if not np.all(np.isfinite(y)):
                raise _Ended(Status.NOT_FINITE, phase)
            if unbounded(y, model):
                raise _Ended(Status.UNBOUNDED, phase)

        at = self.integrator.phases[interval]
        end_where_nothing_goes_on(start, self.y, False)
        if not np.all(np.isfinite(slope(start, self.y))):
            raise _Ended(Status.NOT_FINITE, start)
        rtol = rtol_of_all(rtol, atol, self.y, model.layout)
        solver = self.integrator.method(slope, start, self.y, end, rtol=rtol, atol=atol)
        try:
            while solver.status == "running":
                if self.steps - self.steps_before >= max_steps:
                    raise _Ended(Status.TOO_MANY_STEPS, solver.t)
                message = stepped(solver)
                end_where_nothing_goes_on(solver.t, solver.y, solver.status == "failed")
                if solver.status == "failed":
                    raise _Ended(Status.GAVE_UP, solver.t, message)
                self.steps += 1
                count = int(np.searchsorted(at, solver.t, side="right"))
                if count:
                    self.samples.append(solver.dense_output()(at[:count]).T)
                    at = at[count:]
        finally:
            self.y = solver.y.copy()

    def result(self, status: Status, reached: float, message: str = "") -> IntegratedCycles:
        """What became of it."""
        samples = np.concatenate(self.samples) if self.samples else np.empty((0, len(self.y)))
        return IntegratedCycles(samples, self.y, status, reached, self.steps, self.evaluations, message)
