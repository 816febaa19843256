"""The native march by time: the gears may stand, and turn back. Dormand & Prince's pair, see `dopri5`.

The state is that of a march by rotation: its lag t − c T, with T the time of a reference cycle at nominal
speed, says what cycle c the reference has come to at a time t. Steps aim at the ends of the intervals between
which the set of contacting pairs changes; where one is passed, in either direction, is found on the dense
output. With the nominal sliding velocity the phases where friction reverses are such ends too, `reversal`;
with dynamic sliding steps end where friction turns, see `step_control`.

`y` and `clock` together are all that a march goes on with. Times are in reference cycles of nominal speed.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.energy import engagement
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, Model
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import absolute, law, maximum, minimum, sqrt, truncate
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.integrator import Status
from tribodyn.solve.march import step_control as rules
from tribodyn.solve.march.crossing import (
    CLOCK_ROWS,
    FRESH,
    FROM_BOUND,
    INTERVAL,
    LAST_ERROR,
    SHARE,
    STEP,
    STEPS,
    STOP,
    TAKEN,
    TIME,
    WAY,
    WHOLE,
    cycles_at,
    find_crossing,
    nominal_time,
    phase_at,
    speed_share,
)
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, scratch_buffer
from tribodyn.solve.march.reversal import stops
from tribodyn.solve.methods.dopri5 import (
    STAGES,
    C,
    dense_output,
    embedded_difference,
    growth,
    shrinkage,
    stage_state,
)
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.train.layout import TrainLayout
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import PARAMETRIC

#: Distance from the end of an interval, in reference cycles, within which a state is there; and its growth
#: with the time, which rounding makes.
BEYOND, ROUNDING = 1e-11, 4e-16


class TimeControl(NamedTuple):
    """What the step control of a march by time needs."""

    rtol: float
    max_steps: int  # in one reference cycle of nominal speed, on average since the start
    atol: Float[Array, " state"]  # absolute tolerances
    stops: Float[Array, "interval stop"]  # phases that steps end on, see `reversal.stops`


def time_control(model: Model, y: Float[Array, " state"], rtol: float, max_steps: int) -> TimeControl:
    """Control of a march that starts from a state."""
    tolerances = tolerances_from(model, y, rtol, max_steps)
    return TimeControl(rtol, max_steps, tolerances.atol, stops(model))


def begun_clock(model: Model, y: Float[Array, " state"], control: TimeControl) -> Float[Array, " row"]:
    """The clock of a march from a state at time 0."""
    clock = np.zeros(CLOCK_ROWS)
    cycles = cycles_at(np.zeros(1), y[None], model)
    whole, phase, interval = (float(part[0]) for part in interval_of(cycles, model.schedule))
    clock[WHOLE], clock[INTERVAL] = whole, interval
    clock[STOP] = np.searchsorted(control.stops[int(interval), :-1], phase, side="right")
    clock[STEP], clock[LAST_ERROR], clock[FRESH] = rules.FIRST_STEP, rules.MINIMUM_ERROR, 1.0
    return clock


def time_buffer(layout: TrainLayout) -> Float[Array, "row state"]:
    """Scratch of a march by time: a step's new state, its error and the stages."""
    return scratch_buffer(STAGES, layout)


@law
def lower_bound(interval, stop, control, model):
    """Phase that the next steps must not pass backwards."""
    return control.stops[interval, stop - 1] if stop > 0 else model.schedule.start[interval]


@law
def distance_to(distance, near):
    """Distance that a step goes at most: to a bound, or from one a little way beyond it."""
    return distance if distance > near else maximum(FROM_BOUND, near)


@law
def time_to(distance, rate, acceleration):
    """Time in which a distance ≥ 0 is passed at a rate and its acceleration; `rules.UNLIMITED`: it is not."""
    squared = rate * rate + 2.0 * acceleration * distance
    if squared < 0.0:
        return rules.UNLIMITED
    divisor = rate + sqrt(squared)
    return minimum(2.0 * distance / divisor, rules.UNLIMITED) if divisor > 0.0 else rules.UNLIMITED


@kernel
def begin(model, y, clock, work, buffer):
    """Evaluate the derivatives where a step begins; returns whether they are finite."""
    layout = model.options.layout
    interval, whole = truncate(clock[INTERVAL]), clock[WHOLE]
    phase = phase_at(clock[TIME], y[layout.lag], whole, model)
    if model.options.sliding == SLIDING_DYNAMIC:
        rules.begin_turning(phase, interval, y, model, work)
    for i in range(layout.states):
        buffer[STATE, i] = y[i]
    evaluate(0, 1, 0.0, model, y, clock, work, buffer)
    clock[FRESH] = 0.0
    total = 0.0
    for i in range(layout.states):
        total += absolute(buffer[SCRATCH, i])
    return total < rules.INFINITE


@kernel
def evaluate(first, end, step, model, y, clock, work, buffer):
    """Evaluate stages of a step in order; the last one is the new state, and `work` is then of its end."""
    layout = model.options.layout
    stage, k = buffer[STATE], buffer[SCRATCH:]
    interval, whole = truncate(clock[INTERVAL]), clock[WHOLE]
    for s in range(first, end):
        if s > 0:
            stage_state(s, step, y, k, stage, layout)
        phase = phase_at(clock[TIME] + C[s] * step, stage[layout.lag], whole, model)
        derivatives(phase, whole, interval, stage, model, work, k[s])


@kernel
def take_step(end, control, model, y, clock, work, buffer):
    """Take a step towards a time: `clock` says how much of it counts, and `finish_step` goes there.

    A step of no length is one over the end of the interval. Returns a `Status` and the right-hand sides.
    """
    layout = model.options.layout
    interval, stop, time = truncate(clock[INTERVAL]), truncate(clock[STOP]), clock[TIME]
    if clock[STEPS] >= control.max_steps * (1.0 + time):
        return int(rules.TOO_MANY_STEPS), 0
    evaluations, slip = 0, layout.half + layout.lag
    if clock[FRESH] > 0.0:
        evaluations += 1
        if not begin(model, y, clock, work, buffer):
            return int(rules.NOT_FINITE), evaluations
    low, high = lower_bound(interval, stop, control, model), control.stops[interval, stop]
    near = BEYOND + ROUNDING * time
    phase = phase_at(time, y[layout.lag], clock[WHOLE], model)
    rate = speed_share(y[slip], model)
    acceleration = buffer[SCRATCH, slip] / model.operation.nominal_speed
    clock[STEPS] += 1.0
    for side in range(2):
        way, distance = 1.0 - 2.0 * side, high - phase if side == 0 else phase - low
        if distance <= near and way * rate * clock[STEP] > maximum(FROM_BOUND, near):
            clock[TAKEN], clock[SHARE], clock[WAY] = 0.0, 0.0, way
            return Status.DONE.value, evaluations
    to_bound = minimum(
        time_to(distance_to(high - phase, near), rate, acceleration),
        time_to(distance_to(phase - low, near), -rate, -acceleration),
    )
    turning = model.options.sliding == SLIDING_DYNAMIC and rules.resolves_turns(control.atol, model)
    step, tries = clock[STEP], 0.0
    while True:
        uncut_step = step
        limit = minimum(end - time, maximum(to_bound, near))
        cut, step = rules.cut_at_stop(0.0, step, limit)
        if step < rules.MINIMUM_STEP and step < end - time:
            return int(rules.STEP_TOO_SMALL), evaluations
        evaluate(1, STAGES, step, model, y, clock, work, buffer)
        evaluations += STAGES - 1
        new, k = buffer[STATE], buffer[SCRATCH:]
        for i in range(layout.states):
            buffer[ERROR, i] = step * embedded_difference(k, i)
        worst, total = rules.collected_errors(buffer[ERROR], y, new, control.atol, control.rtol, layout)
        error = rules.step_error(worst, total)
        if error != error or error >= rules.INFINITE:
            if step < rules.MINIMUM_RETRY:
                return int(rules.NOT_FINITE), evaluations
            step *= rules.RETRY
            continue
        if error > 1.0:
            step *= shrinkage(error)
            continue
        if rules.unbounded(new, model):
            return int(rules.UNBOUNDED), evaluations
        if turning:
            too_far, shorter = rules.turn_of_friction(step, interval, model, work)
            if too_far and tries < rules.MOST_TRIES:
                step, tries = shorter, tries + 1.0
                continue
            rules.keep_turned(True, step, interval, model, work)
        break
    clock[TAKEN] = step
    find_crossing(low, high, near, model, y, clock, buffer)
    wanted = rules.next_step(step * growth(error, clock[LAST_ERROR]), cut, uncut_step)
    if turning:
        wanted = minimum(wanted, rules.longest_step(interval, model, work))
    clock[STEP], clock[LAST_ERROR] = wanted, maximum(error, rules.MINIMUM_ERROR)
    return Status.DONE.value, evaluations


@kernel
def finish_step(end, control, model, y, clock, work, buffer):
    """Go to where a step ends, and over the end of the interval there."""
    layout = model.options.layout
    share, step, k = clock[SHARE], clock[TAKEN], buffer[SCRATCH:]
    if share >= 1.0:
        for i in range(layout.states):
            y[i] = buffer[STATE, i]
            buffer[SCRATCH, i] = buffer[SCRATCH + STAGES - 1, i]
    elif step > 0.0:
        for i in range(layout.states):
            y[i] = dense_output(share, step, y[i], buffer[STATE, i], k, i)
        clock[FRESH] = 1.0
    time = clock[TIME] + share * step
    clock[TIME] = end if end - time < rules.MINIMUM_STEP else time
    if clock[WAY] != 0.0:
        cross(control, model, y, clock, work)


@kernel
def cross(control, model, y, clock, work):
    """Go over to the next stop, or interval with the energy that appears or vanishes there; or back."""
    schedule, count = model.schedule, model.schedule.start.shape[0]
    interval, stop = truncate(clock[INTERVAL]), truncate(clock[STOP])
    forwards = clock[WAY] > 0.0
    if forwards and control.stops[interval, stop] < schedule.end[interval]:
        clock[STOP] += 1.0
        return
    if not forwards and stop > 0:
        clock[STOP] -= 1.0
        return
    following = (interval + 1) % count if forwards else (interval + count - 1) % count
    _, _, parametric = engagement(following if forwards else interval, y, model, work)
    y[model.options.layout.mechanical + PARAMETRIC] += clock[WAY] * parametric
    stop = 0
    if forwards:
        if schedule.start[following] <= schedule.start[interval]:
            clock[WHOLE] += 1.0
    else:
        if schedule.start[following] >= schedule.start[interval]:
            clock[WHOLE] -= 1.0
        while control.stops[following, stop] < schedule.end[following]:
            stop += 1
    clock[INTERVAL], clock[STOP], clock[FRESH] = 1.0 * following, 1.0 * stop, 1.0


@kernel
def advance(until, control, model, y, clock, work, buffer):
    """March to a time (s); inputs may be other than before. Returns `Status`, steps, right-hand sides."""
    end = until / nominal_time(model)
    steps, evaluations = 0, 0
    clock[FRESH] = 1.0
    while clock[TIME] < end:
        status, taken = take_step(end, control, model, y, clock, work, buffer)
        evaluations += taken
        if status > 0:
            return status, steps, evaluations
        steps += 1
        finish_step(end, control, model, y, clock, work, buffer)
    return Status.DONE.value, steps, evaluations


@kernel
def march_by_time(first, rate, control, model, y, clock, work, buffer, out):
    """March through samples and to the last one; `rate` are those per cycle, `first` the number of the first.

    `out` (sample, state) receives them. Returns `Status`, steps, right-hand sides, samples written.
    """
    layout, count = model.options.layout, out.shape[0]
    end = (first + count - 1) / rate
    steps, evaluations, written = 0, 0, 0
    clock[FRESH] = 1.0
    while written < count:
        if (first + written) / rate <= clock[TIME]:
            for i in range(layout.states):
                out[written, i] = y[i]
            written += 1
            continue
        status, taken = take_step(end, control, model, y, clock, work, buffer)
        evaluations += taken
        if status > 0:
            return status, steps, evaluations, written
        steps += 1
        step = clock[TAKEN]
        while step > 0.0 and written < count:
            share = ((first + written) / rate - clock[TIME]) / step
            if share > clock[SHARE]:
                break
            for i in range(layout.states):
                out[written, i] = dense_output(share, step, y[i], buffer[STATE, i], buffer[SCRATCH:], i)
            written += 1
        finish_step(end, control, model, y, clock, work, buffer)
    return Status.DONE.value, steps, evaluations, written
