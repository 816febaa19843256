"""Native stiff method: the Rosenbrock pair RODAS4P in mesh phase, restarted exactly at engagement.

Displacements have velocities and nothing else as their rates, so they are eliminated: of the 14 mechanical
states a 7 by 7 matrix is factorised. The works depend on the mechanics only and follow without a matrix.

RODAS4P 4(3) has six stages with one matrix, is stiffly accurate and L-stable. Of its kind it keeps its order
where a stiff system follows a given motion, as teeth do that are dragged slowly through the mesh.
G. Steinebach, Order-reduction of ROW-methods for DAEs and method of lines applications, preprint 1741, TH
Darmstadt (1995);
coefficients as in the code RODAS (its third set) of Hairer & Wanner, Solving Ordinary Differential Equations
II (2nd ed., 1996).

Stage i solves (I/(γh) − J) U_i = f(φ + α_i h, y + Σ a_ij U_j) + Σ c_ij U_j/h + γ_i h ∂f/∂φ, and
y_1 = y + Σ m_j U_j with the last stage as the error.
"""

import numpy as np

from tribodyn.dynamics.parameters import MECHANICAL, STATES
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, law, maximum, minimum, truncate
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.extreme_search import contacts_at, open_segment, search_step
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Method, march_with, scratch_buffer
from tribodyn.solve.right_hand_side import rhs

STAGES = 6
GAMMA = 0.25
A = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [3.0, 0.0, 0.0, 0.0, 0.0],
        [1.831036793486759, 0.4955183967433795, 0.0, 0.0, 0.0],
        [2.304376582692669, -0.05249275245743001, -1.176798761832782, 0.0, 0.0],
        [-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401, 0.0],
        [-7.170454962423024, -4.741636671481785, -16.31002631330971, -1.062004044111401, 1.0],
    ]
)
C = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [-12.0, 0.0, 0.0, 0.0, 0.0],
        [-8.791795173947035, -2.207865586973518, 0.0, 0.0, 0.0],
        [10.81793056857153, 6.780270611428266, 19.5348594464241, 0.0, 0.0],
        [34.19095006749676, 15.49671153725963, 54.7476087596413, 14.16005392148534, 0.0],
        [34.62605830930532, 15.30084976114473, 56.99955578662667, 18.40807009793095, -5.714285714285717],
    ]
)
#: α, where a stage stands in its step, and γ_i, its weight of ∂f/∂φ.
ALPHA = np.array([0.0, 0.75, 0.21, 0.63, 1.0, 1.0])
GAMMAS = np.array([0.25, -0.5, -0.023504, -0.0362, 0.0, 0.0])
#: Weights of the dense output's two higher terms.
D = np.array(
    [
        [25.09876703708589, 11.62013104361867, 28.49148307714626, -5.664021568594133, 0.0],
        [1.638054557396973, -0.7373619806678748, 8.47791821923899, 15.9925314877952, -1.882352941176471],
    ]
)

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


@law
def growth(error, last_error):
    """Factor on the step after an accepted one: PI control on this error and the last, 0.2 … 6."""
    factor = 0.8 * maximum(error, 1e-10) ** -0.21 * last_error**0.05
    return minimum(6.0, maximum(0.2, factor))


@law
def shrinkage(error):
    """Factor on the step after a rejected one, error > 1."""
    return maximum(0.1, 0.9 * error**-0.25)


@law
def dense_output(theta, before, after, first, second):
    """State at the share `theta` of a step, third order; `first` and `second` are the rows of Σ D U."""
    return (1.0 - theta) * before + theta * (after + (1.0 - theta) * (first + theta * second))


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
