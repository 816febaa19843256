"""Native stiff method: the Rosenbrock pair RODAS4P in mesh phase, restarted exactly at engagement.

Displacements have velocities and nothing else as their rates, so they are eliminated: a matrix of half as
many rows as there are mechanical states is factorised. The works depend on the
mechanics only and follow without a matrix.

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

from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, law, maximum, minimum, truncate
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.extreme_search import contacts_at, open_segment, search_step
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Method, march_with, scratch_buffer
from tribodyn.solve.right_hand_side import rhs
from tribodyn.train.layout import TrainLayout

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

#: Longest step, mesh cycles. A stiff solution that just follows the mesh would let steps grow to a tenth of a
#: cycle; the samples between their ends are of third order only, and no error estimate sees them. Over this
#: length a third-order interpolant of what the geometry does in a cycle is exact to 1e-6 or better.
LONGEST_STEP = 1 / 64
#: First rows of the method's own in the buffer: stages, five vectors, the Jacobian and the matrix.
_U = SCRATCH
_RATE, _TRIAL, _SLOPE, _RIGHT, _ORDER = range(_U + STAGES, _U + STAGES + 5)
_JACOBIAN = _ORDER + 1


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


def buffer(layout: TrainLayout) -> Float[Array, "row state"]:
    """Scratch for the kernel: new state, error, stages, Jacobian, matrix."""
    return scratch_buffer(_JACOBIAN + layout.states + layout.half - SCRATCH, layout)


@kernel
def factorise(shift, jacobian, matrix, order, layout):
    """LU factors, with rows exchanged as `order` says, of the velocities' matrix: s I − D − K B/s.

    B, K and D are the blocks ∂q'/∂v, ∂v'/∂q and ∂v'/∂v of the Jacobian, and s = 1/(γ h).
    """
    half = layout.half
    for i in range(half):
        for j in range(half):
            total = -jacobian[half + i, half + j]
            for m in range(half):
                total -= jacobian[half + i, m] * jacobian[m, half + j] / shift
            matrix[i, j] = total
        matrix[i, i] += shift
    for j in range(half):
        best = j
        for i in range(j + 1, half):
            if absolute(matrix[i, j]) > absolute(matrix[best, j]):
                best = i
        order[j] = best
        for m in range(half):
            matrix[j, m], matrix[best, m] = matrix[best, m], matrix[j, m]
        for i in range(j + 1, half):
            matrix[i, j] /= matrix[j, j]
            for m in range(j + 1, half):
                matrix[i, m] -= matrix[i, j] * matrix[j, m]


@kernel
def resolve(shift, jacobian, matrix, order, right, solution, layout):
    """Solve (s I − J) solution = right for all states."""
    half, mechanical = layout.half, layout.mechanical
    for i in range(half):
        total = right[half + i]
        for m in range(half):
            total += jacobian[half + i, m] * right[m] / shift
        solution[half + i] = total
    for j in range(half):
        best = truncate(order[j])
        solution[half + j], solution[half + best] = solution[half + best], solution[half + j]
    for i in range(half):
        for m in range(i):
            solution[half + i] -= matrix[i, m] * solution[half + m]
    for k in range(half):
        i = half - 1 - k
        for m in range(i + 1, half):
            solution[half + i] -= matrix[i, m] * solution[half + m]
        solution[half + i] /= matrix[i, i]
    for i in range(half):
        total = right[i]
        for m in range(half, mechanical):
            total += jacobian[i, m] * solution[m]
        solution[i] = total / shift
    for i in range(mechanical, layout.states):
        total = right[i]
        for m in range(mechanical):
            total += jacobian[i, m] * solution[m]
        solution[i] = total / shift


@kernel
def stiffness(step, buffer, layout):
    """Step over the time constant, at the start of the step last attempted.

    From the sums of all rates of decay and of all squared frequencies: an upper bound, close where one
    motion is much stiffer than the others.
    """
    half, mechanical = layout.half, layout.mechanical
    jacobian = buffer[_JACOBIAN : _JACOBIAN + layout.states]
    decay, squared = 0.0, 0.0
    for i in range(half, mechanical):
        decay -= jacobian[i, i]
        for j in range(half):
            squared -= jacobian[i, j] * jacobian[j, i]
    return step * max(abs(decay), abs(squared) ** 0.5)


@kernel
def attempt(fresh, step, place, y, control, model, work, buffer):
    """See `marching.Method`; the Jacobian is of the step's start, and kept while the step is tried again."""
    stage, error = buffer[STATE], buffer[ERROR]
    rate, trial, slope = buffer[_RATE], buffer[_TRIAL], buffer[_SLOPE]
    right, order = buffer[_RIGHT], buffer[_ORDER]
    layout = model.options.layout
    matrix_at = _JACOBIAN + layout.states
    u, jacobian, matrix = buffer[_U : _U + STAGES], buffer[_JACOBIAN:matrix_at], buffer[matrix_at:]
    evaluations = STAGES - 1
    if fresh:
        rhs(place.phase, place.cycle, place.interval, y, model, work, rate)
        into = Differences(trial, jacobian, slope)
        evaluations += 1 + differentiate(place, y, rate, control.scale, model, work, into)
    shift = 1.0 / (GAMMA * step)
    factorise(shift, jacobian, matrix, order, layout)
    for s in range(STAGES):
        if s > 0:
            for i in range(layout.states):
                total = 0.0
                for j in range(s):
                    total += A[s, j] * u[j, i]
                stage[i] = y[i] + total
            rhs(place.phase + ALPHA[s] * step, place.cycle, place.interval, stage, model, work, trial)
        for i in range(layout.states):
            total = 0.0
            for j in range(s):
                total += C[s, j] * u[j, i]
            f = rate[i] if s == 0 else trial[i]
            right[i] = f + total / step + GAMMAS[s] * step * slope[i]
        resolve(shift, jacobian, matrix, order, right, u[s], layout)
    for i in range(layout.states):
        error[i] = u[STAGES - 1, i]
        stage[i] += error[i]
    return evaluations


@kernel
def sample(theta, step, y, buffer, out, layout):
    """See `marching.Method`."""
    for i in range(layout.states):
        first = 0.0
        second = 0.0
        for j in range(STAGES - 1):
            first += D[0, j] * buffer[_U + j, i]
            second += D[1, j] * buffer[_U + j, i]
        out[i] = dense_output(theta, y[i], buffer[STATE, i], first, second)


@kernel
def accept(buffer, layout):
    """See `marching.Method`: there is a new Jacobian for every step."""
    return True


@kernel
def adapted(step, error, last_error, buffer):
    """See `marching.Method`."""
    if error > 1.0:
        return step * shrinkage(error)
    return min(step * growth(error, last_error), LONGEST_STEP)


@kernel
def contacts(phase, interval, model, work, buffer):
    """See `marching.Method`."""
    contacts_at(phase, interval, buffer[STATE], model, work)


METHOD = Method(attempt, sample, accept, adapted, contacts, open_segment, search_step)


@kernel
def integrate(march, control, model, y, out, work, buffer, search):
    """Integrate mesh cycles, see `marching.march_with`; evaluations include those for the Jacobian."""
    return march_with(METHOD, march, control, model, y, out, work, buffer, search)
