"""Native explicit solver: Dormand-Prince 5(4) in mesh phase, restarted exactly at engagement.

The whole block of cycles runs inside one compiled function.
"""

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.equations import derivatives, engagement
from tribodyn.dynamics.parameters import (
    SLIP,
    STATES,
    WORK_IN,
    WORK_PARAMETRIC,
    XI_RATE,
    Model,
)
from tribodyn.native import kernel
from tribodyn.solve.dormand_prince import (
    LEAST_REMEMBERED,
    LEAST_STEP,
    STAGES,
    TOUCHING,
    C,
    dense_output,
    embedded_difference,
    growth,
    shrinkage,
    stage_state,
    weighed_error,
)
from tribodyn.solve.engine import DONE, NOT_FINITE, STALLED, STEP_TOO_SMALL, TOO_MANY_STEPS


def buffers(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Scratch for the kernels: the contacts' quantities, the stages and one state."""
    pairs = model.table.side.shape[0]
    return np.zeros((QUANTITIES + pairs, pairs)), np.zeros((STAGES + 1, STATES))


@kernel
def engage(before, phase_before, after, phase_after, y, model, work):
    """Jump of the state where the contacting pairs change, in place."""
    slip, xi_rate, work_in, parametric = engagement(before, phase_before, after, phase_after, y, model, work)
    y[SLIP] += slip
    y[XI_RATE] += xi_rate
    y[WORK_IN] += work_in
    y[WORK_PARAMETRIC] += parametric


@kernel
def march(
    model, y, first_cycle, cycles, restart, samples, rtol, atol, step, max_steps, stops, out, work, buffer
):
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
    stops : (segments, most)
        Phases that steps end on, see `reversal.stops`.
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
            fresh = True
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
                    return STEP_TOO_SMALL, cycle + phase, step, steps, evaluations, written
                if fresh:
                    for i in range(STATES):
                        stage[i] = y[i]
                for s in range(0 if fresh else 1, STAGES):
                    if s > 0:
                        stage_state(s, step, y, k, stage)
                    derivatives(phase + C[s] * step, whole, segment, stage, model, work, k[s])
                    evaluations += 1
                fresh = False
                error = 0.0
                total = 0.0
                for i in range(STATES):
                    difference = embedded_difference(k, i)
                    # the worst state decides: states at rest must not dilute the others' error
                    off = weighed_error(step * difference, y[i], stage[i], atol[i], rtol)
                    error = max(error, off)
                    total += off  # carries a NaN that max would lose
                if not np.isfinite(total):
                    if step < 1e-9:
                        return NOT_FINITE, cycle + phase, step, steps, evaluations, written
                    step *= 0.1
                    fresh = True
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
                            out[written, i] = dense_output(theta, step, y[i], stage[i], k, i)
                        written += 1
                    phase = next_phase
                    for i in range(STATES):
                        y[i] = stage[i]
                        k[0, i] = k[6, i]
                    steps += 1
                    step *= growth(error, last_error)
                    if last:
                        stop += 1
                        step = max(step, wished)  # a step cut short says nothing against the one wished for
                    last_error = max(error, LEAST_REMEMBERED)
                else:
                    step *= shrinkage(error)
    return DONE, float(cycles), step, steps, evaluations, written


@kernel
def rhs(phase, cycle, segment, y, model, work, dy):
    """The compiled right-hand side, for SciPy's solvers; returns the powers of `derivatives`."""
    return derivatives(phase, cycle, segment, y, model, work, dy)
