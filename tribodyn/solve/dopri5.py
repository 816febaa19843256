"""Native explicit solver: Dormand-Prince 5(4) in mesh phase, restarted exactly at engagement.

The whole block of cycles runs inside one compiled function.
"""

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.equations import derivatives, engagement
from tribodyn.dynamics.parameters import SLIP, STATES, WORK_IN, WORK_PARAMETRIC, XI_RATE, Model
from tribodyn.native import kernel
from tribodyn.solve.dormand_prince import (
    LEAST_REMEMBERED,
    LEAST_STEP,
    STAGES,
    TOUCHING,
    A,
    C,
    D,
    E,
    dense_output,
    growth,
    shrinkage,
    weighed_error,
)
from tribodyn.solve.engine import DONE, NOT_FINITE, STALLED, STEP_TOO_SMALL, TOO_MANY_STEPS


def buffers(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Scratch for the kernels: the contacts' quantities, and nine states."""
    pairs = model.table.side.shape[0]
    return np.zeros((QUANTITIES + pairs, pairs)), np.zeros((STAGES + 2, STATES))


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
    k = buffer[:STAGES]
    stage = buffer[STAGES]
    new = buffer[STAGES + 1]
    steps = 0
    evaluations = 0
    written = 0
    last_error = LEAST_REMEMBERED
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
                last = phase + TOUCHING * step >= end
                if last:
                    step = end - phase
                if step < LEAST_STEP:
                    return STEP_TOO_SMALL, cycle + phase, step, steps, evaluations, written
                for s in range(1, STAGES):
                    for i in range(STATES):
                        total = 0.0
                        for j in range(s):
                            total += A[s, j] * k[j, i]
                        stage[i] = y[i] + step * total
                    derivatives(phase + C[s] * step, whole, segment, stage, model, work, k[s])
                evaluations += STAGES - 1
                error = 0.0
                total = 0.0
                for i in range(STATES):
                    new[i] = stage[i]
                    difference = 0.0
                    for j in range(STAGES):
                        difference += E[j] * k[j, i]
                    # the worst state decides: states at rest must not dilute the others' error
                    off = weighed_error(step * difference, y[i], new[i], atol[i], rtol)
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
                            high = 0.0
                            for j in range(STAGES):
                                high += D[j] * k[j, i]
                            out[written, i] = dense_output(theta, step, y[i], new[i], k[0, i], k[6, i], high)
                        written += 1
                    phase = next_phase
                    for i in range(STATES):
                        y[i] = new[i]
                        k[0, i] = k[6, i]
                    steps += 1
                    if not last:
                        step *= growth(error, last_error)
                    last_error = max(error, LEAST_REMEMBERED)
                else:
                    step *= shrinkage(error)
    return DONE, float(cycles), step, steps, evaluations, written


@kernel
def rhs(phase, cycle, segment, y, model, work, dy):
    """The compiled right-hand side, for SciPy's solvers; returns the powers of `derivatives`."""
    return derivatives(phase, cycle, segment, y, model, work, dy)
