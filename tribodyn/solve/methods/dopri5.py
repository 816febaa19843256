"""Native explicit method: the Runge-Kutta pair of Dormand & Prince 5(4) in mesh phase.

After Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (2nd ed., 1993), code DOPRI5. Its
formulas are laws, so that the kernel for one case and that for many side by side (`lanes`) share them.
"""

import numpy as np

from tribodyn.dynamics.equations import derivatives
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import law, maximum, minimum
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.extreme_search import open_segment, search_step
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Method, march_with, scratch_buffer
from tribodyn.train.layout import TrainLayout

A = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
C = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
#: Fifth-order minus embedded fourth-order weights.
E = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
#: Weights of the dense output's highest term.
D = np.array(
    [
        -12715105075 / 11282082432,
        0.0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)
STAGES = 7


@law
def stage_state(s, step, y, k, stage, layout):
    """State at which stage s = 1 … 6 is evaluated; the last one is the new state.

    Written out, so that the compiler takes many states at once; the works are summed at the last stage only,
    as nothing depends on them.
    """
    if s == 1:
        for i in range(layout.mechanical):
            stage[i] = y[i] + step * (A[1, 0] * k[0, i])
    elif s == 2:
        for i in range(layout.mechanical):
            stage[i] = y[i] + step * (A[2, 0] * k[0, i] + A[2, 1] * k[1, i])
    elif s == 3:
        for i in range(layout.mechanical):
            stage[i] = y[i] + step * (A[3, 0] * k[0, i] + A[3, 1] * k[1, i] + A[3, 2] * k[2, i])
    elif s == 4:
        for i in range(layout.mechanical):
            total = A[4, 0] * k[0, i] + A[4, 1] * k[1, i] + A[4, 2] * k[2, i] + A[4, 3] * k[3, i]
            stage[i] = y[i] + step * total
    elif s == 5:
        for i in range(layout.mechanical):
            total = A[5, 0] * k[0, i] + A[5, 1] * k[1, i] + A[5, 2] * k[2, i] + A[5, 3] * k[3, i]
            stage[i] = y[i] + step * (total + A[5, 4] * k[4, i])
    else:
        for i in range(layout.states):
            total = A[6, 0] * k[0, i] + A[6, 2] * k[2, i] + A[6, 3] * k[3, i] + A[6, 4] * k[4, i]
            stage[i] = y[i] + step * (total + A[6, 5] * k[5, i])


@law
def embedded_difference(k, i):
    """Difference of the two methods over the step, for state i."""
    return E[0] * k[0, i] + E[2] * k[2, i] + E[3] * k[3, i] + E[4] * k[4, i] + E[5] * k[5, i] + E[6] * k[6, i]


@law
def growth(error, last_error):
    """Factor on the step after an accepted one: PI control on this error and the last, 0.2 … 5."""
    factor = 0.8 * maximum(error, 1e-10) ** -0.17 * last_error**0.04
    return minimum(5.0, maximum(0.2, factor))


@law
def shrinkage(error):
    """Factor on the step after a rejected one, error > 1."""
    return maximum(0.2, 0.9 * error**-0.2)


@law
def dense_output(theta, step, before, after, k, i):
    """State i at the share `theta` of a step, fourth order."""
    high = D[0] * k[0, i] + D[2] * k[2, i] + D[3] * k[3, i] + D[4] * k[4, i] + D[5] * k[5, i] + D[6] * k[6, i]
    rise = after - before
    bend = step * k[0, i] - rise
    return before + theta * (
        rise + (1.0 - theta) * (bend + theta * (rise - step * k[6, i] - bend + (1.0 - theta) * step * high))
    )


def buffer(layout: TrainLayout) -> Float[Array, "row state"]:
    """Scratch for the kernel: the new state, its error and the stages."""
    return scratch_buffer(STAGES, layout)


@kernel
def attempt(fresh, step, place, y, control, model, work, buffer):
    """See `marching.Method`."""
    stage, k, layout = buffer[STATE], buffer[SCRATCH:], model.options.layout
    if fresh:
        for i in range(layout.states):
            stage[i] = y[i]
    for s in range(0 if fresh else 1, STAGES):
        if s > 0:
            stage_state(s, step, y, k, stage, layout)
        derivatives(place.phase + C[s] * step, place.cycle, place.interval, stage, model, work, k[s])
    for i in range(layout.states):
        buffer[ERROR, i] = step * embedded_difference(k, i)
    return STAGES if fresh else STAGES - 1


@kernel
def sample(theta, step, y, buffer, out, layout):
    """See `marching.Method`."""
    for i in range(layout.states):
        out[i] = dense_output(theta, step, y[i], buffer[STATE, i], buffer[SCRATCH:], i)


@kernel
def accept(buffer, layout):
    """See `marching.Method`: the last stage is the next step's first."""
    for i in range(layout.states):
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
