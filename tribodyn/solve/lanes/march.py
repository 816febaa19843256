"""Dormand-Prince 5(4) for a vector of cases side by side, one case per lane.

Every lane has its own phase, step and error control; the lanes meet only at the ends of segments, where they
wait for the last. A lane that is done, or that failed, takes the queue's next case at the end of the cycle.
No lane's arithmetic reads another lane, so a case's bits are the same whatever the other lanes hold.
"""

from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, SLIP, STATES, XI_RATE
from tribodyn.kernels.lanes import functions  # noqa: F401  (its import gives the laws their functions over lanes)
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH, any_of
from tribodyn.kernels.native import kernel
from tribodyn.kernels.native.parts import part
from tribodyn.numerics.elementary import maximum, minimum, where
from tribodyn.solve.integrator import Status
from tribodyn.solve.lanes.extremes import open_lanes, search_lanes, seeking
from tribodyn.solve.lanes.queue import (
    CASE,
    CUT,
    CYCLE,
    DUE,
    END,
    EVALUATIONS,
    FRESH,
    LAST_ERROR,
    LIMIT,
    PHASE,
    SELECTED,
    STEP,
    STEPS,
    STEPS_BEFORE,
    STOP,
    TRIES,
    UNCUT_STEP,
    close_cycle,
    fail,
    keep_sample,
    take_cases,
)
from tribodyn.solve.march.step_control import (
    MINIMUM_ERROR,
    MOST_TRIES,
    RELATIVE,
    RETRY,
    begin_turning,
    collected,
    cut_at_stop,
    keep_turned,
    longest_step,
    next_step,
    refused,
    resolves_turns,
    step_error,
    step_outcome,
    turn_of,
    unbounded,
    weighed_error,
)
from tribodyn.solve.methods.dopri5 import (
    STAGES,
    C,
    dense_output,
    embedded_difference,
    growth,
    shrinkage,
    stage_state,
)
from tribodyn.solve.right_hand_side import engage


@kernel
def march_lanes(model, block, queue, march):
    """Integrate cases of the queue, `WIDTH` at a time, until none is left."""
    rows, y, new, k = rows_of(block.rows), rows_of(block.y), rows_of(block.new), rows_of(block.k)
    segments = model.table.in_contact.shape[0]
    while take_cases(block, queue, march):
        for segment in range(segments):
            open_segment(segment, model, block, queue, march)
            first = 0
            while any_of(rows[PHASE] < rows[END]):
                choose_step(model, block, queue, march)
                for s in range(first, STAGES):
                    if s == 0:
                        copy_rows(y, new)
                    else:
                        stage_state(s, rows[STEP], y, k, new)
                    derivatives(
                        rows[PHASE] + C[s] * rows[STEP],
                        rows[CYCLE] + march.first_cycle,
                        segment,
                        new,
                        model,
                        rows_of(block.work),
                        k[s],
                    )
                judge(STAGES - first, segment, model, block, queue, march)
                first = 1
        close_cycle(block, queue, march)


@part
def copy_rows(source, target):
    """Copy a state of all lanes."""
    for i in range(STATES):
        target[i] = source[i]


@part
def open_segment(segment, model, block, queue, march):
    """Put all lanes at the segment's start, behind the change of contacting pairs; keep a sample if due."""
    rows, y = rows_of(block.rows), rows_of(block.y)
    start, end = model.table.boundary[segment], model.table.boundary[segment + 1]
    has_case = rows[CASE] >= 0.0
    rows[PHASE] = where(has_case, start, end)
    rows[END] = end
    engage(segment, has_case & (rows[FRESH] == 0.0), y, model, rows_of(block.work), y)
    rows[FRESH] = where(has_case, 0.0, rows[FRESH])
    if model.options.sliding == SLIDING_DYNAMIC:
        begin_turning(rows[PHASE], segment, y, model, rows_of(block.work))
    for lane in range(WIDTH):
        block.rows[STOP, lane] = 0.0
        if block.rows[CASE, lane] >= 0.0:
            block.rows[LIMIT, lane] = queue.stops[int(block.rows[CASE, lane]), segment, 0]
    due = has_case & (rows[DUE] <= start)
    if any_of(due):
        keep_sample(due, block.y, block, queue, march)
    if march.extremes:
        lanes = seeking(has_case, block, march)
        if any_of(lanes):
            open_lanes(start, segment, lanes, model, block, march)


@part
def choose_step(model, block, queue, march):
    """Let a step that comes near the next stop end on it, and give up where no step is possible any more."""
    rows = rows_of(block.rows)
    nominal_speed = model.mechanics.nominal_speed
    running = rows[PHASE] < rows[END]
    rows[UNCUT_STEP] = rows[STEP]
    cut, step = cut_at_stop(rows[PHASE], rows[STEP], rows[LIMIT])
    rows[CUT] = where(running & cut, 1.0, 0.0)
    rows[STEP] = where(running, step, rows[STEP])
    too_many, vanishing, at_rest = refused(
        rows[STEPS] - rows[STEPS_BEFORE],
        march.max_steps,
        rows[STEP],
        nominal_speed + rows_of(block.y)[SLIP],
        nominal_speed,
    )
    failure = where(too_many, Status.TOO_MANY_STEPS.value, where(vanishing, Status.STEP_TOO_SMALL.value, 0.0))
    failure = where(at_rest & ~too_many, Status.STALLED.value, failure)
    failed = running & (failure > 0.0)
    if any_of(failed):
        fail(where(failed, failure, 0.0), block, queue, march)


@part
def judge(evaluations, segment, model, block, queue, march):
    """Accept or reject the step of every lane that is not yet at the end of the segment, each for itself."""
    rows, y, new, k, atol = (
        rows_of(block.rows),
        rows_of(block.y),
        rows_of(block.new),
        rows_of(block.k),
        rows_of(block.atol),
    )
    phase, step = rows[PHASE], rows[STEP]
    running = phase < rows[END]
    cut = rows[CUT] > 0.0
    rows[EVALUATIONS] = rows[EVALUATIONS] + where(running, 1.0 * evaluations, 0.0)
    worst, total = 0.0 * step, 0.0 * step
    for i in range(STATES):
        rtol = march.rtol * RELATIVE[i]
        weighed = weighed_error(step * embedded_difference(k, i), y[i], new[i], atol[i], rtol)
        worst, total = collected(worst, total, weighed)
    error = step_error(worst, total)
    accepted, undefined, lost, stalled = step_outcome(error, step, model.mechanics.nominal_speed + new[SLIP])
    stalled, lost = running & stalled, running & lost
    accepted = running & accepted & ~stalled
    runaway = accepted & unbounded(new, model.table)
    accepted = accepted & ~runaway
    ended = stalled | lost | runaway
    if any_of(ended):
        failure = where(lost, Status.NOT_FINITE.value, where(runaway, Status.UNBOUNDED.value, 0.0))
        fail(where(stalled, Status.STALLED.value, failure), block, queue, march)
        running = running & ~ended
    turned, shorter = accepted & ~accepted, step
    if model.options.sliding == SLIDING_DYNAMIC:
        too_far, shorter = turn_of(step, segment, model, rows_of(block.work))
        fine = resolves_turns(atol[XI_RATE], model)
        turned = accepted & too_far & fine & (rows[TRIES] < MOST_TRIES)
        accepted = accepted & ~turned
        rows[TRIES] = where(turned, rows[TRIES] + 1.0, where(accepted, 0.0, rows[TRIES]))
        keep_turned(accepted, step, segment, model, rows_of(block.work))
    reached = where(cut, rows[LIMIT], phase + step)
    keep_dense(phase, step, reached, accepted, block, queue, march)
    if march.extremes:
        lanes = seeking(accepted, block, march)
        if any_of(lanes):
            search_lanes(lanes, phase, step, reached, segment, model, block, march)
    grown = next_step(step * growth(error, rows[LAST_ERROR]), cut, rows[UNCUT_STEP])
    if model.options.sliding == SLIDING_DYNAMIC:
        longest = longest_step(segment, model, rows_of(block.work))
        grown = where(resolves_turns(atol[XI_RATE], model), minimum(grown, longest), grown)
    rejected = where(turned, shorter, step * where(undefined, RETRY, shrinkage(error)))
    rows[STEP] = where(running, where(accepted, grown, rejected), step)
    rows[LAST_ERROR] = where(accepted, maximum(error, MINIMUM_ERROR), rows[LAST_ERROR])
    rows[PHASE] = where(accepted, reached, rows[PHASE])
    rows[STEPS] = rows[STEPS] + where(accepted, 1.0, 0.0)
    for i in range(STATES):
        y[i] = where(accepted, new[i], y[i])
        k[0, i] = where(accepted, k[STAGES - 1, i], k[0, i])
    stopped = accepted & cut & (reached < rows[END])
    if any_of(stopped):
        rows[SELECTED] = where(stopped, 1.0, 0.0)
        for lane in range(WIDTH):
            if block.rows[SELECTED, lane] > 0.0:
                stop = int(block.rows[STOP, lane]) + 1
                block.rows[STOP, lane] = stop
                block.rows[LIMIT, lane] = queue.stops[int(block.rows[CASE, lane]), segment, stop]


@part
def keep_dense(phase, step, reached, accepted, block, queue, march):
    """Keep the samples that fall into the steps just accepted."""
    rows, y, new, k, sample = (
        rows_of(block.rows),
        rows_of(block.y),
        rows_of(block.new),
        rows_of(block.k),
        rows_of(block.sample),
    )
    due = accepted & (rows[DUE] <= reached) & (rows[DUE] < rows[END])
    while any_of(due):
        theta = (rows[DUE] - phase) / step
        for i in range(STATES):
            sample[i] = dense_output(theta, step, y[i], new[i], k, i)
        keep_sample(due, block.sample, block, queue, march)
        due = accepted & (rows[DUE] <= reached) & (rows[DUE] < rows[END])
