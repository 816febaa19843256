"""Native stiff solver: the Rosenbrock pair RODAS4P in mesh phase, restarted exactly at engagement.

Displacements have velocities and nothing else as their rates, so they are eliminated: of the 14 mechanical
states a 7 by 7 matrix is factorised. The works depend on the mechanics only and follow without a matrix.
"""

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.parameters import MECHANICAL, STATES, Model
from tribodyn.kernels.native import kernel
from tribodyn.solve.dopri5 import rhs
from tribodyn.solve.jacobian import differentiate
from tribodyn.solve.marching import NEW, OFF, OWN, march_with
from tribodyn.solve.rosenbrock import ALPHA, GAMMA, GAMMAS, STAGES, A, C, D, dense_output, growth, shrinkage

#: Coordinates; state HALF + i is the velocity of state i.
HALF = MECHANICAL // 2
#: Longest step, mesh cycles. A stiff solution that just follows the mesh would let steps grow to a tenth of a
#: cycle; the samples between their ends are of third order only, and no error estimate sees them. Over this
#: length a third-order interpolant of what the geometry does in a cycle is exact to 1e-6 or better.
LONGEST_STEP = 1 / 64
_U = OWN
_RATE, _TRIAL, _SLOPE, _RIGHT, _ORDER = range(_U + STAGES, _U + STAGES + 5)
_JACOBIAN = _ORDER + 1
_MATRIX = _JACOBIAN + STATES


def buffers(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Scratch for the kernel: the contacts' quantities; new state, error, stages, Jacobian, matrix."""
    pairs = model.table.side.shape[0]
    return np.zeros((QUANTITIES + pairs, pairs)), np.zeros((_MATRIX + HALF, STATES))


@kernel
def factorise(shift, jacobian, matrix, order):
    """LU factors, with rows exchanged as `order` tells, of the velocities' matrix: s I − D − K B/s.

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
            if abs(matrix[i, j]) > abs(matrix[best, j]):
                best = i
        order[j] = best
        for m in range(HALF):
            matrix[j, m], matrix[best, m] = matrix[best, m], matrix[j, m]
        for i in range(j + 1, HALF):
            matrix[i, j] /= matrix[j, j]
            for m in range(j + 1, HALF):
                matrix[i, m] -= matrix[i, j] * matrix[j, m]


@kernel
def resolve(shift, jacobian, matrix, order, right, found):
    """Solve (s I − J) found = right for all states."""
    for i in range(HALF):
        total = right[HALF + i]
        for m in range(HALF):
            total += jacobian[HALF + i, m] * right[m] / shift
        found[HALF + i] = total
    for j in range(HALF):
        best = int(order[j])
        found[HALF + j], found[HALF + best] = found[HALF + best], found[HALF + j]
    for i in range(HALF):
        for m in range(i):
            found[HALF + i] -= matrix[i, m] * found[HALF + m]
    for k in range(HALF):
        i = HALF - 1 - k
        for m in range(i + 1, HALF):
            found[HALF + i] -= matrix[i, m] * found[HALF + m]
        found[HALF + i] /= matrix[i, i]
    for i in range(HALF):
        total = right[i]
        for m in range(HALF, MECHANICAL):
            total += jacobian[i, m] * found[m]
        found[i] = total / shift
    for i in range(MECHANICAL, STATES):
        total = right[i]
        for m in range(MECHANICAL):
            total += jacobian[i, m] * found[m]
        found[i] = total / shift


@kernel
def attempt(fresh, phase, step, whole, segment, end, y, rtol, atol, model, work, buffer):
    """See `marching`; the Jacobian is of the step's start, and kept while the step is tried again."""
    stage, off = buffer[NEW], buffer[OFF]
    rate, trial, slope = buffer[_RATE], buffer[_TRIAL], buffer[_SLOPE]
    right, order = buffer[_RIGHT], buffer[_ORDER]
    u, jacobian, matrix = buffer[_U : _U + STAGES], buffer[_JACOBIAN:_MATRIX], buffer[_MATRIX:]
    evaluations = STAGES - 1
    if fresh:
        rhs(phase, whole, segment, y, model, work, rate)
        for i in range(STATES):
            stage[i] = atol[i] / rtol  # the size of the state
        evaluations += 1 + differentiate(
            phase, end, whole, segment, y, rate, stage, model, work, trial, jacobian, slope
        )
    shift = 1.0 / (GAMMA * step)
    factorise(shift, jacobian, matrix, order)
    for s in range(STAGES):
        if s > 0:
            for i in range(STATES):
                total = 0.0
                for j in range(s):
                    total += A[s, j] * u[j, i]
                stage[i] = y[i] + total
            rhs(phase + ALPHA[s] * step, whole, segment, stage, model, work, trial)
        for i in range(STATES):
            total = 0.0
            for j in range(s):
                total += C[s, j] * u[j, i]
            f = rate[i] if s == 0 else trial[i]
            right[i] = f + total / step + GAMMAS[s] * step * slope[i]
        resolve(shift, jacobian, matrix, order, right, u[s])
    for i in range(STATES):
        off[i] = u[STAGES - 1, i]
        stage[i] += off[i]
    return evaluations


@kernel
def sample(theta, step, y, buffer, out):
    """See `marching`."""
    for i in range(STATES):
        first = 0.0
        second = 0.0
        for j in range(STAGES - 1):
            first += D[0, j] * buffer[_U + j, i]
            second += D[1, j] * buffer[_U + j, i]
        out[i] = dense_output(theta, y[i], buffer[NEW, i], first, second)


@kernel
def accept(buffer):
    """See `marching`: there is a new Jacobian for every step."""
    return True


@kernel
def adapted(step, error, last_error):
    """See `marching`."""
    if error > 1.0:
        return step * shrinkage(error)
    return min(step * growth(error, last_error), LONGEST_STEP)


@kernel
def march(model, y, asked, out, work, buffer):
    """Integrate mesh cycles, see `marching.march_with`; evaluations include those for the Jacobian."""
    return march_with(attempt, sample, accept, adapted, model, y, asked, out, work, buffer)
