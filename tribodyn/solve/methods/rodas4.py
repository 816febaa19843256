"""Native stiff method: the Rosenbrock pair RODAS4P in mesh phase, restarted exactly at engagement.

Displacements have velocities and nothing else as their rates, so they are eliminated: of the 14 mechanical
states a 7 by 7 matrix is factorised. The works depend on the mechanics only and follow without a matrix.
"""

from tribodyn.dynamics.parameters import MECHANICAL, STATES
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, truncate
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.extreme_search import contacts_at, open_segment, search_step
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Method, march_with, scratch_buffer
from tribodyn.solve.march.rosenbrock import (
    ALPHA,
    GAMMA,
    GAMMAS,
    STAGES,
    A,
    C,
    D,
    dense_output,
    growth,
    shrinkage,
)
from tribodyn.solve.right_hand_side import rhs

#: Coordinates; state HALF + i is the velocity of state i.
HALF = MECHANICAL // 2
#: Longest step, mesh cycles. A stiff solution that just follows the mesh would let steps grow to a tenth of a
#: cycle; the samples between their ends are of third order only, and no error estimate sees them. Over this
#: length a third-order interpolant of what the geometry does in a cycle is exact to 1e-6 or better.
LONGEST_STEP = 1 / 64
#: First rows of the method's own in the buffer: stages, five vectors, the Jacobian and the matrix.
_U = SCRATCH
_RATE, _TRIAL, _SLOPE, _RIGHT, _ORDER = range(_U + STAGES, _U + STAGES + 5)
_JACOBIAN = _ORDER + 1
_MATRIX = _JACOBIAN + STATES


def buffer() -> Float[Array, "row state"]:
    """Scratch for the kernel: new state, error, stages, Jacobian, matrix."""
    return scratch_buffer(_MATRIX + HALF - SCRATCH)


@kernel
def factorise(shift, jacobian, matrix, order):
    """LU factors, with rows exchanged as `order` says, of the velocities' matrix: s I − D − K B/s.

    B, K and D are the blocks ∂q'/∂v, ∂v'/∂q and ∂v'/∂v of the Jacobian, and s = 1/(γ h).
    """
    for i in range(HALF):
        for j in range(HALF):
            total = -jacobian[HALF + i, HALF + j]
            for m in range(HALF):
                total -= jacobian[HALF + i, m] * jacobian[m, HALF + j] / shift
            matrix[i, j] = total
        matrix[i, i] += shift
    for j in range(HALF):
        best = j
        for i in range(j + 1, HALF):
            if absolute(matrix[i, j]) > absolute(matrix[best, j]):
                best = i
        order[j] = best
        for m in range(HALF):
            matrix[j, m], matrix[best, m] = matrix[best, m], matrix[j, m]
        for i in range(j + 1, HALF):
            matrix[i, j] /= matrix[j, j]
            for m in range(j + 1, HALF):
                matrix[i, m] -= matrix[i, j] * matrix[j, m]


@kernel
def resolve(shift, jacobian, matrix, order, right, solution):
    """Solve (s I − J) solution = right for all states."""
    for i in range(HALF):
        total = right[HALF + i]
        for m in range(HALF):
            total += jacobian[HALF + i, m] * right[m] / shift
        solution[HALF + i] = total
    for j in range(HALF):
        best = truncate(order[j])
        solution[HALF + j], solution[HALF + best] = solution[HALF + best], solution[HALF + j]
    for i in range(HALF):
        for m in range(i):
            solution[HALF + i] -= matrix[i, m] * solution[HALF + m]
    for k in range(HALF):
        i = HALF - 1 - k
        for m in range(i + 1, HALF):
            solution[HALF + i] -= matrix[i, m] * solution[HALF + m]
        solution[HALF + i] /= matrix[i, i]
    for i in range(HALF):
        total = right[i]
        for m in range(HALF, MECHANICAL):
            total += jacobian[i, m] * solution[m]
        solution[i] = total / shift
    for i in range(MECHANICAL, STATES):
        total = right[i]
        for m in range(MECHANICAL):
            total += jacobian[i, m] * solution[m]
        solution[i] = total / shift


@kernel
def stiffness(step, buffer):
    """Step over the time constant, at the start of the step last attempted.

    From the sums of all rates of decay and of all squared frequencies: an upper bound, close where one
    motion is much stiffer than the others.
    """
    jacobian = buffer[_JACOBIAN:_MATRIX]
    decay, squared = 0.0, 0.0
    for i in range(HALF, MECHANICAL):
        decay -= jacobian[i, i]
        for j in range(HALF):
            squared -= jacobian[i, j] * jacobian[j, i]
    return step * max(abs(decay), abs(squared) ** 0.5)


@kernel
def attempt(fresh, step, place, y, control, model, work, buffer):
    """See `marching.Method`; the Jacobian is of the step's start, and kept while the step is tried again."""
    stage, error = buffer[STATE], buffer[ERROR]
    rate, trial, slope = buffer[_RATE], buffer[_TRIAL], buffer[_SLOPE]
    right, order = buffer[_RIGHT], buffer[_ORDER]
    u, jacobian, matrix = buffer[_U : _U + STAGES], buffer[_JACOBIAN:_MATRIX], buffer[_MATRIX:]
    evaluations = STAGES - 1
    if fresh:
        rhs(place.phase, place.cycle, place.segment, y, model, work, rate)
        into = Differences(trial, jacobian, slope)
        evaluations += 1 + differentiate(place, y, rate, control.scale, model, work, into)
    shift = 1.0 / (GAMMA * step)
    factorise(shift, jacobian, matrix, order)
    for s in range(STAGES):
        if s > 0:
            for i in range(STATES):
                total = 0.0
                for j in range(s):
                    total += A[s, j] * u[j, i]
                stage[i] = y[i] + total
            rhs(place.phase + ALPHA[s] * step, place.cycle, place.segment, stage, model, work, trial)
        for i in range(STATES):
            total = 0.0
            for j in range(s):
                total += C[s, j] * u[j, i]
            f = rate[i] if s == 0 else trial[i]
            right[i] = f + total / step + GAMMAS[s] * step * slope[i]
        resolve(shift, jacobian, matrix, order, right, u[s])
    for i in range(STATES):
        error[i] = u[STAGES - 1, i]
        stage[i] += error[i]
    return evaluations


@kernel
def sample(theta, step, y, buffer, out):
    """See `marching.Method`."""
    for i in range(STATES):
        first = 0.0
        second = 0.0
        for j in range(STAGES - 1):
            first += D[0, j] * buffer[_U + j, i]
            second += D[1, j] * buffer[_U + j, i]
        out[i] = dense_output(theta, y[i], buffer[STATE, i], first, second)


@kernel
def accept(buffer):
    """See `marching.Method`: there is a new Jacobian for every step."""
    return True


@kernel
def adapted(step, error, last_error, buffer):
    """See `marching.Method`."""
    if error > 1.0:
        return step * shrinkage(error)
    return min(step * growth(error, last_error), LONGEST_STEP)


@kernel
def contacts(phase, segment, model, work, buffer):
    """See `marching.Method`."""
    contacts_at(phase, segment, buffer[STATE], model, work)


METHOD = Method(attempt, sample, accept, adapted, contacts, open_segment, search_step)


@kernel
def integrate(march, control, model, y, out, work, buffer, search):
    """Integrate mesh cycles, see `marching.march_with`; evaluations include those for the Jacobian."""
    return march_with(METHOD, march, control, model, y, out, work, buffer, search)
