"""Dormand-Prince 5(4) for a vector of cases side by side, one case a lane.

Every lane has its own phase, step and error control; the lanes of a block meet only at the ends of segments,
where they wait for the last. A lane that is done, or that failed, takes the queue's next case at the end of
the cycle. No lane's arithmetic reads another lane, so a case's bits are the same in any company.
"""

import numpy as np

from tribodyn.dynamics.equations import derivatives, engagement
from tribodyn.dynamics.parameters import SLIP, STATES, WORK_IN, WORK_PARAMETRIC, XI_RATE
from tribodyn.kernels.lanes import functions  # noqa: F401  (its import gives the laws their functions over lanes)
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH, any_of
from tribodyn.kernels.native import kernel
from tribodyn.kernels.native.parts import part
from tribodyn.numerics.elementary import maximum, where
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
from tribodyn.solve.engine import NOT_FINITE, STALLED, STEP_TOO_SMALL, TOO_MANY_STEPS
from tribodyn.solve.lane_queue import (
    CASE,
    CYCLE,
    DUE,
    END,
    EVALUATIONS,
    FLAG,
    FRESH,
    LAST,
    LAST_ERROR,
    LIMIT,
    PHASE,
    STEP,
    STEPS,
    STEPS_BEFORE,
    STOP,
    WISHED,
    close_cycle,
    fail,
    keep_sample,
    take_cases,
)
from tribodyn.solve.marching import LEAST_TO_RETRY


@kernel
def march_lanes(model, block, queue, settings):
    """Integrate cases of the queue, `WIDTH` at a time, until none is left."""
    rows, y, new, k = rows_of(block.rows), rows_of(block.y), rows_of(block.new), rows_of(block.k)
    segments = model.table.in_contact.shape[0]
    while take_cases(block, queue, settings):
        for segment in range(segments):
            open_segment(segment, segments, model, block, queue, settings)
            first = 0
            while any_of(rows[PHASE] < rows[END]):
                choose_step(block, queue, settings)
                for s in range(first, STAGES):
                    if s == 0:
                        copy_rows(y, new)
                    else:
                        stage_state(s, rows[STEP], y, k, new)
                    derivatives(
                        rows[PHASE] + C[s] * rows[STEP],
                        rows[CYCLE] + settings.first_cycle,
                        segment,
                        new,
                        model,
                        rows_of(block.work),
                        k[s],
                    )
                judge(STAGES - first, segment, model, block, queue, settings)
                first = 1
        close_cycle(block, queue, settings)


@part
def copy_rows(source, target):
    """Copy a state of all lanes."""
    for i in range(STATES):
        target[i] = source[i]


@part
def open_segment(segment, segments, model, block, queue, settings):
    """Put all lanes at the segment's start, behind the change of contacting pairs; keep a sample if due."""
    rows, y = rows_of(block.rows), rows_of(block.y)
    boundary = model.table.boundary
    start, end = boundary[segment], boundary[segment + 1]
    has_case = rows[CASE] >= 0.0
    rows[PHASE] = where(has_case, start, end)
    rows[END] = end
    jumps = has_case & (rows[FRESH] == 0.0)
    before = segment - 1 if segment > 0 else segments - 1
    slip, xi_rate, work_in, parametric = engagement(
        before, boundary[before + 1], segment, start, y, model, rows_of(block.work)
    )
    y[SLIP] = y[SLIP] + where(jumps, slip, 0.0)
    y[XI_RATE] = y[XI_RATE] + where(jumps, xi_rate, 0.0)
    y[WORK_IN] = y[WORK_IN] + where(jumps, work_in, 0.0)
    y[WORK_PARAMETRIC] = y[WORK_PARAMETRIC] + where(jumps, parametric, 0.0)
    rows[FRESH] = where(has_case, 0.0, rows[FRESH])
    for lane in range(WIDTH):
        block.rows[STOP, lane] = 0.0
        if block.rows[CASE, lane] >= 0.0:
            block.rows[LIMIT, lane] = queue.stops[int(block.rows[CASE, lane]), segment, 0]
    due = has_case & (rows[DUE] <= start)
    if any_of(due):
        keep_sample(due, block.y, block, queue, settings)


@part
def choose_step(block, queue, settings):
    """Let a step that comes near the next stop end on it, and give up where no step is possible any more."""
    rows = rows_of(block.rows)
    phase, step = rows[PHASE], rows[STEP]
    running = phase < rows[END]
    last = running & (phase + TOUCHING * step >= rows[LIMIT])
    rows[WISHED] = step
    rows[LAST] = where(last, 1.0, 0.0)
    rows[STEP] = where(last, rows[LIMIT] - phase, step)
    over = running & (rows[STEPS] - rows[STEPS_BEFORE] >= settings.max_steps)
    small = running & ~over & (rows[STEP] < LEAST_STEP)
    if any_of(over | small):
        fail(over, TOO_MANY_STEPS, block, queue, settings)
        fail(small, STEP_TOO_SMALL, block, queue, settings)


@part
def judge(evaluations, segment, model, block, queue, settings):
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
    last = rows[LAST] > 0.0
    rows[EVALUATIONS] = rows[EVALUATIONS] + where(running, 1.0 * evaluations, 0.0)
    error, total = 0.0 * step, 0.0 * step
    for i in range(STATES):
        # the worst state decides: states at rest must not dilute the others' error
        off = weighed_error(step * embedded_difference(k, i), y[i], new[i], atol[i], settings.rtol)
        error = maximum(error, off)
        total = total + off
    finite = total < np.inf
    accepted = running & finite & (error <= 1.0)
    stalled = accepted & (model.mechanics.nominal_speed + new[SLIP] <= 0.0)
    lost = running & ~finite & (step < LEAST_TO_RETRY)
    if any_of(stalled | lost):
        fail(stalled, STALLED, block, queue, settings)
        fail(lost, NOT_FINITE, block, queue, settings)
        running, accepted = running & ~(stalled | lost), accepted & ~stalled
    reached = where(last, rows[LIMIT], phase + step)
    keep_dense(phase, step, reached, accepted, block, queue, settings)
    grown = step * growth(error, rows[LAST_ERROR])
    # a step cut short says nothing against the one wished for
    grown = where(last, maximum(grown, rows[WISHED]), grown)
    other = step * where(finite, shrinkage(error), 0.1)
    rows[STEP] = where(running, where(accepted, grown, other), step)
    rows[LAST_ERROR] = where(accepted, maximum(error, LEAST_REMEMBERED), rows[LAST_ERROR])
    rows[PHASE] = where(accepted, reached, rows[PHASE])
    rows[STEPS] = rows[STEPS] + where(accepted, 1.0, 0.0)
    for i in range(STATES):
        y[i] = where(accepted, new[i], y[i])
        k[0, i] = where(accepted, k[STAGES - 1, i], k[0, i])
    stopped = accepted & last & (reached < rows[END])
    if any_of(stopped):
        rows[FLAG] = where(stopped, 1.0, 0.0)
        for lane in range(WIDTH):
            if block.rows[FLAG, lane] > 0.0:
                stop = int(block.rows[STOP, lane]) + 1
                block.rows[STOP, lane] = stop
                block.rows[LIMIT, lane] = queue.stops[int(block.rows[CASE, lane]), segment, stop]


@part
def keep_dense(phase, step, reached, accepted, block, queue, settings):
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
        keep_sample(due, block.sample, block, queue, settings)
        due = accepted & (rows[DUE] <= reached) & (rows[DUE] < rows[END])
