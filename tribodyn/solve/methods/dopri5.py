"""Native explicit method: Dormand-Prince 5(4) in mesh phase, restarted exactly at engagement.

All cycles of a call run inside one compiled function.
"""

from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import STATES
from tribodyn.kernels.native import kernel
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.dormand_prince import (
    STAGES,
    C,
    dense_output,
    embedded_difference,
    growth,
    shrinkage,
    stage_state,
)
from tribodyn.solve.march.extreme_search import open_segment, search_step
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Method, march_with, scratch_buffer


def buffer() -> Float[Array, "row state"]:
    """Scratch for the kernel: the new state, its error and the stages."""
    return scratch_buffer(STAGES)


@kernel
def attempt(fresh, step, place, y, control, model, work, buffer):
    """See `marching.Method`."""
    stage, k = buffer[STATE], buffer[SCRATCH:]
    if fresh:
        for i in range(STATES):
            stage[i] = y[i]
    for s in range(0 if fresh else 1, STAGES):
        if s > 0:
            stage_state(s, step, y, k, stage)
        derivatives(place.phase + C[s] * step, place.cycle, place.segment, stage, model, work, k[s])
    for i in range(STATES):
        buffer[ERROR, i] = step * embedded_difference(k, i)
    return STAGES if fresh else STAGES - 1


@kernel
def sample(theta, step, y, buffer, out):
    """See `marching.Method`."""
    for i in range(STATES):
        out[i] = dense_output(theta, step, y[i], buffer[STATE, i], buffer[SCRATCH:], i)


@kernel
def accept(buffer):
    """See `marching.Method`: the last stage is the next step's first."""
    for i in range(STATES):
        buffer[SCRATCH, i] = buffer[SCRATCH + STAGES - 1, i]
    return False


@kernel
def adapted(step, error, last_error, buffer):
    """See `marching.Method`."""
    return step * (growth(error, last_error) if error <= 1.0 else shrinkage(error))


@kernel
def contacts(phase, segment, model, work, buffer):
    """See `marching.Method`: the last stage stood there."""


METHOD = Method(attempt, sample, accept, adapted, contacts, open_segment, search_step)


@kernel
def integrate(march, control, model, y, out, work, buffer, search):
    """Integrate mesh cycles, see `marching.march_with`."""
    return march_with(METHOD, march, control, model, y, out, work, buffer, search)
