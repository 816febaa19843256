"""The march of the native solvers through mesh cycles: engagement, choice of steps, samples.

One for all methods. A method is four functions and a buffer whose first two rows are the new state and its
error:

- `attempt(fresh, phase, step, whole, segment, end, y, rtol, atol, model, work, buffer)` fills them and
  returns how many right-hand sides that took; `fresh` says that nothing is known yet at `phase` and `y`.
- `sample(theta, step, y, buffer, out)` writes the state at the share `theta` of the step last attempted.
- `accept(buffer)` keeps what the next step can use of an accepted one; returns whether that one begins fresh.
- `adapted(step, error, last_error)` is the next step to try.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.equations import engagement
from tribodyn.dynamics.parameters import SLIP, STATES, WORK_IN, WORK_PARAMETRIC, XI_RATE
from tribodyn.kernels.native import kernel
from tribodyn.solve.dormand_prince import LEAST_REMEMBERED, LEAST_STEP, TOUCHING, weighed_error
from tribodyn.solve.engine import DONE, NOT_FINITE, STALLED, STEP_TOO_SMALL, TOO_MANY_STEPS

#: Rows of a method's buffer: the new state and its error; the method's own rows follow.
NEW, OFF, OWN = 0, 1, 2
#: Share of the nominal speed below which steps that vanish mean that the pinion comes to rest: rates with
#: respect to phase grow without bound there.
STANDSTILL = 1e-3
#: A step that still gives no finite numbers is given up below this.
LEAST_TO_RETRY = 1e-9


class Asked(NamedTuple):
    """What a march is to do.

    Attributes
    ----------
    first_cycle : float
        Whole cycles done before.
    cycles, samples : int
        Cycles to do, samples in each.
    restart : bool
        Whether the state stands before the engagement at phase 0 (False at the very start of a run).
    rtol : float
    atol : (STATES,)
    step : float
        First step to try, mesh cycles.
    max_steps : int
        Greatest number of steps in one mesh cycle.
    stops : (segments, most)
        Phases that steps end on, see `reversal.stops`.
    """

    first_cycle: float
    cycles: int
    samples: int
    restart: bool
    rtol: float
    atol: np.ndarray
    step: float
    max_steps: int
    stops: np.ndarray


@kernel
def engage(before, phase_before, after, phase_after, y, model, work):
    """Jump of the state where the contacting pairs change, in place."""
    slip, xi_rate, work_in, parametric = engagement(before, phase_before, after, phase_after, y, model, work)
    y[SLIP] += slip
    y[XI_RATE] += xi_rate
    y[WORK_IN] += work_in
    y[WORK_PARAMETRIC] += parametric


@kernel
def worst_error(y, buffer, atol, rtol):
    """Error of the step over the tolerance, of the worst state; not finite where anything is not."""
    error = 0.0
    total = 0.0
    for i in range(STATES):
        # the worst state decides: states at rest must not dilute the others' error
        off = weighed_error(buffer[OFF, i], y[i], buffer[NEW, i], atol[i], rtol)
        error = max(error, off)
        total += off  # carries a NaN that max would lose
    return error if np.isfinite(total) else total


@kernel
def march_with(attempt, sample, accept, adapted, model, y, asked, out, work, buffer):
    """Integrate mesh cycles from the state `y` at the end of the one before.

    Parameters
    ----------
    attempt, sample, accept, adapted : functions
        The method, see above.
    model : Model
    y : (STATES,) float64, changed in place to the state reached
    asked : Asked
    out : (cycles · samples, STATES)
        Receives the states at the samples.
    work, buffer : arrays
        Scratch, from the method's `buffers`.

    Returns
    -------
    status, reached (cycles since first_cycle), step, steps, evaluations, samples written
    """
    cycles, samples, max_steps, stops = asked.cycles, asked.samples, asked.max_steps, asked.stops
    rtol, atol, step = asked.rtol, asked.atol, asked.step
    table = model.table
    segments = table.in_contact.shape[0]
    speed = model.mechanics.nominal_speed
    steps = 0
    evaluations = 0
    written = 0
    last_error = LEAST_REMEMBERED
    for cycle in range(cycles):
        whole = asked.first_cycle + cycle
        steps_before = steps
        for segment in range(segments):
            phase = table.boundary[segment]
            end = table.boundary[segment + 1]
            if segment > 0 or asked.restart or cycle > 0:
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
                    status = STALLED if speed + y[SLIP] < STANDSTILL * speed else STEP_TOO_SMALL
                    return status, cycle + phase, step, steps, evaluations, written
                evaluations += attempt(
                    fresh, phase, step, whole, segment, end, y, rtol, atol, model, work, buffer
                )
                fresh = False
                error = worst_error(y, buffer, atol, rtol)
                if not np.isfinite(error):
                    if step < LEAST_TO_RETRY:
                        return NOT_FINITE, cycle + phase, step, steps, evaluations, written
                    step *= 0.1
                    continue
                if error > 1.0:
                    step = adapted(step, error, last_error)
                    continue
                if speed + buffer[NEW, SLIP] <= 0.0:
                    return STALLED, cycle + phase, step, steps, evaluations, written
                next_phase = limit if last else phase + step
                while written < (cycle + 1) * samples:
                    at = (written - cycle * samples) / samples
                    if at >= end or at > next_phase:
                        break
                    sample((at - phase) / step, step, y, buffer, out[written])
                    written += 1
                phase = next_phase
                for i in range(STATES):
                    y[i] = buffer[NEW, i]
                fresh = accept(buffer)
                steps += 1
                step = adapted(step, error, last_error)
                if last:
                    stop += 1
                    step = max(step, wished)  # a step cut short says nothing against the one wished for
                last_error = max(error, LEAST_REMEMBERED)
    return DONE, float(cycles), step, steps, evaluations, written
