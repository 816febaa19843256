"""Native explicit solver: Dormand-Prince 5(4) in mesh phase, restarted exactly at engagement.

The whole block of cycles runs inside one compiled function.
"""

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import STATES, Model
from tribodyn.kernels.native import kernel
from tribodyn.solve.dormand_prince import (
    STAGES,
    C,
    dense_output,
    embedded_difference,
    growth,
    shrinkage,
    stage_state,
)
from tribodyn.solve.marching import NEW, OFF, OWN, march_with


def buffers(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Scratch for the kernels: the contacts' quantities; the new state, its error and the stages."""
    pairs = model.table.side.shape[0]
    return np.zeros((QUANTITIES + pairs, pairs)), np.zeros((OWN + STAGES, STATES))


@kernel
def attempt(fresh, phase, step, whole, segment, end, y, rtol, atol, model, work, buffer):
    """See `marching`."""
    stage, k = buffer[NEW], buffer[OWN:]
    if fresh:
        for i in range(STATES):
            stage[i] = y[i]
    for s in range(0 if fresh else 1, STAGES):
        if s > 0:
            stage_state(s, step, y, k, stage)
        derivatives(phase + C[s] * step, whole, segment, stage, model, work, k[s])
    for i in range(STATES):
        buffer[OFF, i] = step * embedded_difference(k, i)
    return STAGES if fresh else STAGES - 1


@kernel
def sample(theta, step, y, buffer, out):
    """See `marching`."""
    for i in range(STATES):
        out[i] = dense_output(theta, step, y[i], buffer[NEW, i], buffer[OWN:], i)


@kernel
def accept(buffer):
    """See `marching`: the last stage is the next step's first."""
    for i in range(STATES):
        buffer[OWN, i] = buffer[OWN + STAGES - 1, i]
    return False


@kernel
def adapted(step, error, last_error):
    """See `marching`."""
    return step * (growth(error, last_error) if error <= 1.0 else shrinkage(error))


@kernel
def march(model, y, asked, out, work, buffer):
    """Integrate mesh cycles, see `marching.march_with`."""
    return march_with(attempt, sample, accept, adapted, model, y, asked, out, work, buffer)


@kernel
def rhs(phase, cycle, segment, y, model, work, dy):
    """The compiled right-hand side, for SciPy's solvers; returns the powers of `derivatives`."""
    return derivatives(phase, cycle, segment, y, model, work, dy)
