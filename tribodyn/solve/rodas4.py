"""Native stiff solver: the Rosenbrock pair RODAS4P in mesh phase, restarted exactly at engagement.

Displacements have velocities and nothing else as their rates, so they are eliminated: of the 14 mechanical
states a 7 by 7 matrix is factorised. The works depend on the mechanics only and follow without a matrix.
"""

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.parameters import MECHANICAL, SLIP, STATES, Model
from tribodyn.native import kernel
from tribodyn.solve.dopri5 import engage, rhs
from tribodyn.solve.dormand_prince import LEAST_REMEMBERED, LEAST_STEP, TOUCHING, weighed_error
from tribodyn.solve.engine import DONE, NOT_FINITE, STALLED, STEP_TOO_SMALL, TOO_MANY_STEPS
from tribodyn.solve.jacobian import differentiate
from tribodyn.solve.rosenbrock import (
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

#: Coordinates; state HALF + i is the velocity of state i.
HALF = MECHANICAL // 2
#: Share of the nominal speed below which steps that vanish mean that the pinion comes to rest: rates with
#: respect to phase grow without bound there.
STANDSTILL = 1e-3
_STAGE = STAGES
_RATE, _TRIAL, _SLOPE, _RIGHT, _ORDER = range(_STAGE + 1, _STAGE + 6)
_JACOBIAN = _ORDER + 1
_MATRIX = _JACOBIAN + STATES


def buffers(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Scratch for the kernel: the contacts' quantities; stages, states, Jacobian and matrix, a row each."""
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
def march(
    model, y, first_cycle, cycles, restart, samples, rtol, atol, step, max_steps, stops, out, work, buffer
):
    """Integrate `cycles` mesh cycles from the state `y` at the end of the one before.

    Parameters and return as for `dopri5.march`; evaluations include those for the Jacobian.
    """
    table = model.table
    segments = table.in_contact.shape[0]
    stage, rate, trial, slope = buffer[_STAGE], buffer[_RATE], buffer[_TRIAL], buffer[_SLOPE]
    right, order = buffer[_RIGHT], buffer[_ORDER]
    u, jacobian, matrix = buffer[:STAGES], buffer[_JACOBIAN:_MATRIX], buffer[_MATRIX:]
    steps = 0
    evaluations = 0
    written = 0
    last_error = LEAST_REMEMBERED
    for cycle in range(cycles):
        whole = first_cycle + cycle
        steps_before = steps
        for segment in range(segments):
            phase = table.boundary[segment]
            end = table.boundary[segment + 1]
            if segment > 0 or restart or cycle > 0:
                before = segment - 1 if segment > 0 else segments - 1
                engage(before, table.boundary[before + 1], segment, phase, y, model, work)
            if written < (cycle + 1) * samples and (written - cycle * samples) / samples <= phase:
                for i in range(STATES):
                    out[written, i] = y[i]
                written += 1
            moved = True
            stop = 0
            while phase < end:
                if steps - steps_before >= max_steps:
                    return TOO_MANY_STEPS, cycle + phase, step, steps, evaluations, written
                limit = stops[segment, stop]
                wished = step
                last = phase + TOUCHING * step >= limit
                if last:
                    step = limit - phase
                if step < LEAST_STEP:
                    speed = model.mechanics.nominal_speed
                    halted = speed + y[SLIP] < STANDSTILL * speed
                    status = STALLED if halted else STEP_TOO_SMALL
                    return status, cycle + phase, step, steps, evaluations, written
                if moved:
                    rhs(phase, whole, segment, y, model, work, rate)
                    for i in range(STATES):
                        stage[i] = atol[i] / rtol  # the size of the state
                    evaluations += 1 + differentiate(
                        phase, end, whole, segment, y, rate, stage, model, work, trial, jacobian, slope
                    )
                    moved = False
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
                        evaluations += 1
                    for i in range(STATES):
                        total = 0.0
                        for j in range(s):
                            total += C[s, j] * u[j, i]
                        f = rate[i] if s == 0 else trial[i]
                        right[i] = f + total / step + GAMMAS[s] * step * slope[i]
                    resolve(shift, jacobian, matrix, order, right, u[s])
                error = 0.0
                total = 0.0
                for i in range(STATES):
                    stage[i] += u[STAGES - 1, i]
                    off = weighed_error(u[STAGES - 1, i], y[i], stage[i], atol[i], rtol)
                    error = max(error, off)
                    total += off  # carries a NaN that max would lose
                if not np.isfinite(total):
                    if step < 1e-9:
                        return NOT_FINITE, cycle + phase, step, steps, evaluations, written
                    step *= 0.1
                    continue
                if error <= 1.0:
                    if model.mechanics.nominal_speed + stage[SLIP] <= 0.0:
                        return STALLED, cycle + phase, step, steps, evaluations, written
                    next_phase = limit if last else phase + step
                    while written < (cycle + 1) * samples:
                        at = (written - cycle * samples) / samples
                        if at >= end or at > next_phase:
                            break
                        theta = (at - phase) / step
                        for i in range(STATES):
                            first = 0.0
                            second = 0.0
                            for j in range(STAGES - 1):
                                first += D[0, j] * u[j, i]
                                second += D[1, j] * u[j, i]
                            out[written, i] = dense_output(theta, y[i], stage[i], first, second)
                        written += 1
                    phase = next_phase
                    for i in range(STATES):
                        y[i] = stage[i]
                    moved = True
                    steps += 1
                    step *= growth(error, last_error)
                    if last:
                        stop += 1
                        step = max(step, wished)
                    last_error = max(error, LEAST_REMEMBERED)
                else:
                    step *= shrinkage(error)
    return DONE, float(cycles), step, steps, evaluations, written
