"""SciPy's solvers by time on the compiled right-hand side, interval by interval, step by step."""

import warnings
from typing import Any

import numpy as np
from scipy.optimize import brentq

from tribodyn.dynamics.energy import engagement
from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.kernels.native import packed
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.by_time import BEYOND
from tribodyn.solve.march.crossing import cycles_at, nominal_time
from tribodyn.solve.march.step_control import unbounded
from tribodyn.solve.right_hand_side import rhs, work_array
from tribodyn.solve.scipy_integrator import SOLVERS, rtol_of_all, stepped
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import TransientSettings
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import PARAMETRIC


class ScipyWalk:
    """A walk through time: state, samples and counts so far."""

    def __init__(self, model: Model, state: Float[Array, " state"], settings: TransientSettings) -> None:
        self.model, self.method = model, SOLVERS[settings.method]
        self.nominal_time = float(nominal_time(model))
        self.samples = settings.samples
        self.tolerances = tolerances_from(model, state, settings.rtol, settings.max_steps)
        self.time, self.y = 0.0, state.copy()  # in cycles of nominal speed
        whole, _, interval = interval_of(cycles_at(np.zeros(1), state[None], model), model.schedule)
        self.whole, self.interval = int(whole[0]), int(interval[0])
        self.steps = self.evaluations = 0
        self.work = work_array(model)
        self._samples: list[Float[Array, "sample state"]] = []
        states = model.layout.states
        self._place, self._rates = np.empty(states), np.empty(states)
        self._arguments = [*map(packed, (self._place, with_shared_code(model), self.work, self._rates))]
        self._solver: Any = None
        self._dense: Any = None  # states between the ends of the last step
        self._end = float(settings.cycles)

    def march(self, first: int, count: int) -> tuple[Status, str]:
        """See `in_time.Walk`."""
        at = np.arange(first, first + count) / self.samples
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # LSODA's own words arrive in its message
            while len(at := self._sampled(at)):
                if self.steps >= self.tolerances.max_steps * (1.0 + self.time):
                    return Status.TOO_MANY_STEPS, ""
                solver = self._solver or self._begin()
                if not np.all(np.isfinite(self._rates)):
                    return Status.NOT_FINITE, ""
                message = stepped(solver)
                if solver.status == "failed":
                    return Status.GAVE_UP, message
                self.steps += 1
                self._dense, end = solver.dense_output(), self._crossed(solver)
                self.time, self.y = end, self._dense(end) if end < solver.t else solver.y.copy()
                if not np.all(np.isfinite(self.y)):
                    return Status.NOT_FINITE, ""
                if unbounded(self.y, self.model):
                    return Status.UNBOUNDED, ""
                if end < solver.t or self._outside(self.y, end):
                    at = self._sampled(at)  # before the energy that appears or vanishes there
                    self._cross()
        return Status.DONE, ""

    def _sampled(self, at: Float[Array, " sample"]) -> Float[Array, " later"]:
        """Take samples at the times that the last step has come to; what is left of these."""
        count = int(np.searchsorted(at, self.time, side="right"))
        if count:
            self._samples.append(self._dense(at[:count]).T if self._dense else self.y[None].copy())
        return at[count:]

    def taken(self) -> Float[Array, "sample state"]:
        """See `in_time.Walk`."""
        samples, self._samples = self._samples, []
        return np.concatenate(samples) if samples else np.empty((0, len(self.y)))

    def _bounds(self) -> tuple[float, float]:
        """Cycles between which the interval lies."""
        schedule = self.model.schedule
        return self.whole + float(schedule.start[self.interval]), self.whole + float(
            schedule.end[self.interval]
        )

    def _outside(self, y: Float[Array, " state"], time: float) -> int:
        """1 beyond the end of the interval, −1 before its start, else 0."""
        low, high = self._bounds()
        cycle = time - y[self.model.layout.lag] / self.nominal_time
        return int(cycle > high + BEYOND) - int(cycle < low - BEYOND)

    def _crossed(self, solver: Any) -> float:
        """Time at which a step leaves the interval; its end if it does not."""
        way = self._outside(solver.y, solver.t)
        if not way:
            return float(solver.t)
        dense, bound, lag = solver.dense_output(), self._bounds()[way > 0], self.model.layout.lag

        def beyond(time: float) -> float:
            return way * (time - dense(time)[lag] / self.nominal_time - bound)

        if beyond(solver.t_old) >= 0.0:
            return float(solver.t)
        found: Any = brentq(beyond, solver.t_old, solver.t, xtol=1e-14)
        return float(found)

    def _cross(self) -> None:
        """Go over to the next interval or the one before, with the energy that appears or vanishes there."""
        low, high = self._bounds()
        cycle = self.time - self.y[self.model.layout.lag] / self.nominal_time
        forwards = abs(cycle - high) < abs(cycle - low)
        schedule, count = self.model.schedule, len(np.asarray(self.model.schedule.start))
        boundary = (self.interval + 1) % count if forwards else self.interval
        *_, parametric = engagement(boundary, self.y, self.model, self.work)
        self.y[self.model.layout.mechanical + PARAMETRIC] += float(parametric) * (1.0 if forwards else -1.0)
        before = float(schedule.start[self.interval])
        self.interval = (self.interval + (1 if forwards else -1)) % count
        after = float(schedule.start[self.interval])
        if forwards and after <= before:
            self.whole += 1
        elif not forwards and after >= before:
            self.whole -= 1
        self._solver = None

    def _begin(self) -> Any:
        """A solver from here, in this interval."""
        rtol, atol, _ = self.tolerances
        lag, cycle, interval = self.model.layout.lag, self.whole, self.interval

        def slope(time: float, y: Float[Array, " state"]) -> Float[Array, " state"]:
            self.evaluations += 1
            self._place[:] = y
            rhs(time - y[lag] / self.nominal_time - cycle, float(cycle), interval, *self._arguments)
            return self._rates.copy()

        slope(self.time, self.y)
        rtol = rtol_of_all(rtol, atol, self.y, self.model.layout)
        self._solver = self.method(slope, self.time, self.y, self._end, rtol=rtol, atol=atol)
        return self._solver
