"""Dormand-Prince 8(5,3) as a method of the native march, for derivatives; between steps it has no samples."""

from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import MECHANICAL, STATES
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, largest_slope, maximum, plain
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.dormand_prince_8 import E3, E5, SECOND, STAGES, A, C, confidence, growth, shrinkage
from tribodyn.solve.march.extreme_search import ignore_segment, ignore_step
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Method, scratch_buffer


def buffer() -> Float[Array, "row state"]:
    """Scratch for the kernel: the new state, its error and the stages."""
    return scratch_buffer(STAGES + 1)


@kernel
def attempt(fresh, step, place, y, control, model, work, buffer):
    """See `marching.Method`; the rates at the new state are the next step's first."""
    stage, k = buffer[STATE], buffer[SCRATCH:]
    if fresh:
        for i in range(STATES):
            stage[i] = y[i]
    for s in range(0 if fresh else 1, STAGES + 1):
        if s > 0:
            # nothing depends on the works before the new state
            for i in range(STATES if s == STAGES else MECHANICAL):
                total = A[s, 0] * k[0, i]
                for j in range(SECOND[s], s):
                    total = total + A[s, j] * k[j, i]
                stage[i] = y[i] + step * total
        derivatives(place.phase + C[s] * step, place.cycle, place.segment, stage, model, work, k[s])
    for i in range(STATES):
        fifth, third = 0.0 * y[i], 0.0 * y[i]
        for j in range(STAGES):
            fifth = fifth + E5[j] * k[j, i]
            third = third + E3[j] * k[j, i]
        of_fifth = maximum(absolute(plain(fifth)), largest_slope(fifth))
        of_third = maximum(absolute(plain(third)), largest_slope(third))
        buffer[ERROR, i] = step * confidence(of_fifth, of_third) * fifth
    return STAGES + 1 if fresh else STAGES


@kernel
def sample(theta, step, y, buffer, out):
    """See `marching.Method`: a chord, as only states at the start of a mesh cycle are asked for."""
    for i in range(STATES):
        out[i] = y[i] + theta * (buffer[STATE, i] - y[i])


@kernel
def accept(buffer):
    """See `marching.Method`: the last rates are the next step's first."""
    for i in range(STATES):
        buffer[SCRATCH, i] = buffer[SCRATCH + STAGES, i]
    return False


@kernel
def adapted(step, error, last_error, buffer):
    """See `marching.Method`."""
    return step * (growth(error) if error <= 1.0 else shrinkage(error))


@kernel
def contacts(phase, segment, model, work, buffer):
    """See `marching.Method`: nobody asks."""


METHOD = Method(attempt, sample, accept, adapted, contacts, ignore_segment, ignore_step)
