"""Native explicit solver: Dormand-Prince 5(4) in mesh phase, restarted exactly at engagement.

Coefficients, dense output and step-size control after Hairer, Nørsett & Wanner, Solving Ordinary Differential
Equations I (2nd ed., 1993), code DOPRI5. The whole block of cycles runs inside one compiled function.
"""

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.equations import derivatives, engagement
from tribodyn.dynamics.parameters import SLIP, STATES, WORK_IN, WORK_PARAMETRIC, XI_RATE, Model
from tribodyn.native import kernel
from tribodyn.solve.engine import DONE, NOT_FINITE, STALLED, STEP_TOO_SMALL, TOO_MANY_STEPS

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
#: Fifth-order less embedded fourth-order weights.
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


def buffers(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Scratch for the kernels: the contacts' quantities, and nine states."""
    pairs = model.table.side.shape[0]
    return np.zeros((QUANTITIES + pairs, pairs)), np.zeros((9, STATES))


@kernel
def engage(before, phase_before, after, phase_after, y, model, work):
    """Jump of the state where the contacting pairs change, in place."""
    slip, xi_rate, work_in, parametric = engagement(before, phase_before, after, phase_after, y, model, work)
    y[SLIP] += slip
    y[XI_RATE] += xi_rate
    y[WORK_IN] += work_in
    y[WORK_PARAMETRIC] += parametric


@kernel
def march(model, y, first_cycle, cycles, restart, samples, rtol, atol, step, max_steps, out, work, buffer):
    """Integrate `cycles` mesh cycles from the state `y` at the end of the one before.

    Parameters
    ----------
    model : Model
    y : (STATES,) float64, changed in place to the state reached
    first_cycle : float
        Whole cycles done before.
    cycles, samples : int
        Cycles to do, samples in each.
    restart : bool
        Whether `y` stands before the engagement at phase 0 (False at the very start of a run).
    rtol : float
    atol : (STATES,)
    step : float
        First step to try, mesh cycles.
    max_steps : int
        Greatest number of steps in one mesh cycle.
    out : (cycles · samples, STATES)
        Receives the states at the samples.
    work, buffer : arrays
        Scratch, from `buffers`.

    Returns
    -------
    status, reached (cycles since first_cycle), step, steps, evaluations, samples written
    """
    table = model.table
    segments = table.in_contact.shape[0]
    k = buffer[:7]
    stage = buffer[7]
    new = buffer[8]
    steps = 0
    evaluations = 0
    written = 0
    last_error = 1e-4
    for cycle in range(cycles):
        whole = first_cycle + cycle
        steps_before = steps
        for segment in range(segments):
            start = table.boundary[segment]
            end = table.boundary[segment + 1]
            if segment > 0:
                engage(segment - 1, start, segment, start, y, model, work)
            elif restart or cycle > 0:
                engage(segments - 1, 1.0, 0, 0.0, y, model, work)
            phase = start
            derivatives(phase, whole, segment, y, model, work, k[0])
            evaluations += 1
            if written < (cycle + 1) * samples and (written - cycle * samples) / samples <= start:
                for i in range(STATES):
                    out[written, i] = y[i]
                written += 1
            step = min(step, end - start)
            while phase < end:
                if steps - steps_before >= max_steps:
                    return TOO_MANY_STEPS, cycle + phase, step, steps, evaluations, written
                last = phase + 1.0000001 * step >= end
                if last:
                    step = end - phase
                if step < 1e-13:
                    return STEP_TOO_SMALL, cycle + phase, step, steps, evaluations, written
                for s in range(1, 7):
                    for i in range(STATES):
                        total = 0.0
                        for j in range(s):
                            total += A[s, j] * k[j, i]
                        stage[i] = y[i] + step * total
                    derivatives(phase + C[s] * step, whole, segment, stage, model, work, k[s])
                evaluations += 6
                error = 0.0
                total = 0.0
                for i in range(STATES):
                    new[i] = stage[i]
                    difference = 0.0
                    for j in range(7):
                        difference += E[j] * k[j, i]
                    scale = atol[i] + rtol * max(abs(y[i]), abs(new[i]))
                    # the worst state decides: states at rest must not dilute the others' error
                    off = abs(step * difference) / scale
                    error = max(error, off)
                    total += off  # carries a NaN that max would lose
                if not np.isfinite(total):
                    if step < 1e-9:
                        return NOT_FINITE, cycle + phase, step, steps, evaluations, written
                    step *= 0.1
                    continue
                if error <= 1.0:
                    if model.mechanics.nominal_speed + new[SLIP] <= 0.0:
                        return STALLED, cycle + phase, step, steps, evaluations, written
                    next_phase = end if last else phase + step
                    while written < (cycle + 1) * samples:
                        at = (written - cycle * samples) / samples
                        if at >= end or at > next_phase:
                            break
                        theta = (at - phase) / step
                        for i in range(STATES):
                            rise = new[i] - y[i]
                            bend = step * k[0, i] - rise
                            high = 0.0
                            for j in range(7):
                                high += D[j] * k[j, i]
                            out[written, i] = y[i] + theta * (
                                rise
                                + (1.0 - theta)
                                * (
                                    bend
                                    + theta * (rise - step * k[6, i] - bend + (1.0 - theta) * step * high)
                                )
                            )
                        written += 1
                    phase = next_phase
                    for i in range(STATES):
                        y[i] = new[i]
                        k[0, i] = k[6, i]
                    steps += 1
                    used = max(error, 1e-10)
                    factor = 0.9 * used**-0.17 * last_error**0.04
                    if not last:
                        step *= min(5.0, max(0.2, factor))
                    last_error = max(error, 1e-4)
                else:
                    step *= max(0.2, 0.9 * error**-0.2)
    return DONE, float(cycles), step, steps, evaluations, written


@kernel
def rhs(phase, cycle, segment, y, model, work, dy):
    """The compiled right-hand side, for SciPy's solvers; returns the powers of `derivatives`."""
    return derivatives(phase, cycle, segment, y, model, work, dy)
