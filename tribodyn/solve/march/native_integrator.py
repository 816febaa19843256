"""A native method behind the interface of integrators."""

from typing import Any

import numpy as np

from tribodyn.dynamics.parameters import STATES, Model
from tribodyn.kernels.native import packed
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.integrator import IntegratedCycles, March, Status
from tribodyn.solve.march.extreme_search import Search
from tribodyn.solve.march.marching import Control
from tribodyn.solve.march.reversal import stops
from tribodyn.solve.march.step_control import FIRST_STEP
from tribodyn.solve.right_hand_side import work_array
from tribodyn.solve.tolerances import StepTolerances


class NativeIntegrator:
    """Integrates with a compiled kernel; see `integrator.Integrator`.

    Parameters
    ----------
    method : module
        One of `methods` that is native: its `integrate` and `buffer`.
    samples : samples per mesh cycle
    """

    def __init__(self, method: Any, model: Model, samples: int, tolerances: StepTolerances):
        self._integrate = method.integrate
        self._buffer = method.buffer()
        self._work = work_array(model)
        self._model = packed(model)
        self._stops = stops(model)
        self.samples = samples
        self.tolerances = tolerances
        self.extremes = False
        self._pairs = int(model.table.side.shape[0])
        self.step = FIRST_STEP
        self.started = False

    def integrate(self, state: Float[Array, " state"], first_cycle: int, cycles: int) -> IntegratedCycles:
        """See `integrator.Integrator`."""
        y = state.copy()
        out = np.empty((cycles * self.samples, STATES))
        rtol, atol, max_steps = self.tolerances
        march = March(first_cycle, cycles, cycles, self.samples, self.started, rtol, max_steps, self.extremes)
        search = Search.begun(self._pairs)
        control = Control(self.step, atol, atol / rtol, self._stops)
        status, reached, self.step, steps, evaluations, written = self._integrate(
            march, control, self._model, y, out, self._work, self._buffer, search
        )
        self.started = True
        found = search.found() if self.extremes else None
        return IntegratedCycles(out[:written], y, Status(status), reached, steps, evaluations, "", found)
