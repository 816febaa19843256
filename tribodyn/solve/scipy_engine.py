"""SciPy's solvers (Radau, BDF, LSODA, DOP853) on the compiled right-hand side, segment by segment."""

import warnings

import numpy as np
from scipy.integrate import solve_ivp

from tribodyn.dynamics.parameters import SLIP, STATES, Model
from tribodyn.kernels.native import laid_out
from tribodyn.solve.dopri5 import buffers, rhs
from tribodyn.solve.engine import DONE, GAVE_UP, NOT_FINITE, STALLED, TOO_MANY_STEPS, Block, Tolerances
from tribodyn.solve.marching import engage

METHODS = {"radau": "Radau", "bdf": "BDF", "lsoda": "LSODA", "dop853": "DOP853"}


class _Stop(Exception):
    def __init__(self, status: int, phase: float):
        self.status = status
        self.phase = phase


class ScipyEngine:
    """Integrates with `scipy.integrate.solve_ivp`, restarted at every engagement point.

    Parameters
    ----------
    method : {"radau", "bdf", "lsoda", "dop853"}
    model : Model
    samples : int
        Samples per mesh cycle.
    tolerances : Tolerances
    """

    def __init__(self, method: str, model: Model, samples: int, tolerances: Tolerances):
        self.method = METHODS[method]
        self.model = model
        self.samples = samples
        self.tolerances = tolerances
        self.started = False

    def block(self, state: np.ndarray, first_cycle: int, cycles: int) -> Block:
        """See `engine.Engine`."""
        model, table = self.model, self.model.table
        boundary = np.asarray(table.boundary)
        segments = len(boundary) - 1
        work, _ = buffers(model)
        place, rates = np.empty(STATES), np.empty(STATES)
        laid = [laid_out(one) for one in (place, model, work, rates)]
        y = state.copy()
        found: list[np.ndarray] = []
        steps = evaluations = 0
        phases = np.arange(self.samples) / self.samples
        for cycle in range(cycles):
            whole = float(first_cycle + cycle)
            limit = self.tolerances.max_steps * 10
            calls = 0
            for segment in range(segments):
                start, end = boundary[segment], boundary[segment + 1]
                if segment:
                    engage(segment - 1, start, segment, start, y, model, work)
                elif self.started:
                    engage(segments - 1, 1.0, 0, 0.0, y, model, work)
                self.started = True

                def fun(phase, y, whole=whole, segment=segment, limit=limit):
                    nonlocal calls
                    calls += 1
                    if calls > limit:
                        raise _Stop(TOO_MANY_STEPS, phase)
                    if model.mechanics.nominal_speed + y[SLIP] <= 0.0:
                        raise _Stop(STALLED, phase)
                    place[:] = y
                    rhs(phase, whole, segment, *laid)
                    if not np.all(np.isfinite(rates)):
                        raise _Stop(NOT_FINITE, phase)
                    return rates.copy()

                at = phases[(phases >= start) & (phases < end)]
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")  # LSODA's own words arrive in `message`
                    try:
                        solution = solve_ivp(
                            fun,
                            (start, end),
                            y,
                            method=self.method,
                            rtol=self.tolerances.rtol,
                            atol=self.tolerances.atol,
                            dense_output=True,
                        )
                    except _Stop as stop:
                        return self._end(
                            found, y, stop.status, cycle + stop.phase, steps, evaluations + calls
                        )
                steps += len(solution.t) - 1
                if solution.status != 0:
                    reached = solution.t[-1]
                    if reached > start:
                        found.append(solution.sol(at[at <= reached]).T)
                    evaluations += calls
                    return self._end(
                        found, y, GAVE_UP, cycle + reached, steps, evaluations, str(solution.message)
                    )
                if at.size:
                    found.append(solution.sol(at).T)
                y = solution.y[:, -1].copy()
            evaluations += calls
        return self._end(found, y, DONE, float(cycles), steps, evaluations)

    def _end(self, found, y, status, reached, steps, evaluations, message="") -> Block:
        samples = np.concatenate(found) if found else np.empty((0, STATES))
        return Block(samples, y, status, reached, steps, evaluations, message)
