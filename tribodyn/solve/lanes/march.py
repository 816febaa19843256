"""Dormand-Prince 5(4) for a vector of cases side by side, one case per lane.

Every lane has its own phase, step and error control; the lanes meet only at the ends of intervals, where they
wait for the last. A lane that is done, or that failed, takes the queue's next case where the next common
period begins.
No lane's arithmetic reads another lane, so a case's bits are the same whatever the other lanes hold.
"""

from tribodyn.dynamics.parameters import SLIDING_DYNAMIC
from tribodyn.dynamics.recorded.extremes import Extremes
from tribodyn.kernels.lanes import functions  # noqa: F401  (its import gives the laws their functions over lanes)
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH, any_of
from tribodyn.kernels.native import kernel
from tribodyn.kernels.native.parts import part
from tribodyn.numerics.elementary import maximum, minimum, where
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
from tribodyn.solve.march import extreme_search
from tribodyn.solve.march import step_control as rules
from tribodyn.solve.march.extreme_search import Search
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Place
from tribodyn.solve.methods import dopri5
from tribodyn.solve.right_hand_side import engage, interval_at

METHOD = dopri5.METHOD


@kernel
def march_lanes(model, block, queue, march):
    """Integrate cases of the queue, `WIDTH` at a time, until none is left."""
    rows, y, buffer, work = rows_of(block.rows), rows_of(block.y), rows_of(block.buffer), rows_of(block.work)
    period = model.schedule.first.shape[0] - 1
    cycle = 0
    while take_cases(block, queue, march, cycle == 0):
        opening = interval_at(march.first_cycle + cycle, model)
        closing = interval_at(march.first_cycle + cycle + 1, model)
        if closing <= opening:  # the last cycle of the common period
            closing = model.schedule.start.shape[0]
        for interval in range(opening, closing):
            open_interval(interval, model, block, queue, march)
            fresh = True
            while any_of(rows[PHASE] < rows[END]):
                choose_step(model, block, queue, march)
                place = Place(rows[PHASE], rows[CYCLE] + march.first_cycle, interval, rows[END])
                taken = dopri5.attempt(fresh, rows[STEP], place, y, march, model, work, buffer)
                judge(taken, interval, model, block, queue, march)
                fresh = False
        close_cycle(block, queue, march)
        cycle = (cycle + 1) % period if any_of(rows[CASE] >= 0.0) else 0


@part
def search_of(block):
    """The search for extremes, over the lanes."""
    search, lanes = block.search, block.search.extremes
    extremes = Extremes(
        rows_of(lanes.measure), rows_of(lanes.cycles), rows_of(lanes.interval), rows_of(lanes.state)
    )
    return Search(rows_of(search.measures), rows_of(search.state), extremes)


@part
def seeking(lanes, block, march):
    """Those of some lanes whose case is in its window."""
    rows = rows_of(block.rows)
    return lanes & (rows[CASE] >= 0.0) & (rows[CYCLE] >= march.cycles - march.window)


@part
def open_interval(interval, model, block, queue, march):
    """Put all lanes at the interval's start, behind the change of contacting pairs; keep a sample if due."""
    rows, y, work = rows_of(block.rows), rows_of(block.y), rows_of(block.work)
    start, end = model.schedule.start[interval], model.schedule.end[interval]
    has_case = rows[CASE] >= 0.0
    rows[PHASE] = where(has_case, start, end)
    rows[END] = end
    engage(interval, has_case & (rows[FRESH] == 0.0), y, model, work, y)
    rows[FRESH] = where(has_case, 0.0, rows[FRESH])
    if model.options.sliding == SLIDING_DYNAMIC:
        rules.begin_turning(rows[PHASE], interval, y, model, work)
    for lane in range(WIDTH):
        block.rows[STOP, lane] = 0.0
        if block.rows[CASE, lane] >= 0.0:
            block.rows[LIMIT, lane] = queue.stops[int(block.rows[CASE, lane]), interval, 0]
    due = has_case & (rows[DUE] <= start)
    if any_of(due):
        keep_sample(due, block.y, block, queue, march)
    if march.extremes:
        lanes = seeking(has_case, block, march)
        if any_of(lanes):
            place = Place(start, rows[CYCLE] + march.first_cycle, interval, end)
            extreme_search.open_segment(lanes, place, y, model, work, search_of(block))


@part
def choose_step(model, block, queue, march):
    """Let a step that comes near the next stop end on it, and give up where no step is possible any more."""
    rows = rows_of(block.rows)
    layout = model.options.layout
    nominal_speed, slip = model.operation.nominal_speed, layout.half + layout.lag
    running = rows[PHASE] < rows[END]
    rows[UNCUT_STEP] = rows[STEP]
    cut, step = rules.cut_at_stop(rows[PHASE], rows[STEP], rows[LIMIT])
    rows[CUT] = where(running & cut, 1.0, 0.0)
    rows[STEP] = where(running, step, rows[STEP])
    taken, speed = rows[STEPS] - rows[STEPS_BEFORE], nominal_speed + rows_of(block.y)[slip]
    failure = rules.refusal(taken, march.max_steps, rows[STEP], speed, nominal_speed)
    failed = running & (failure > 0.0)
    if any_of(failed):
        fail(where(failed, failure, 0.0), block, queue, march)


@part
def judge(evaluations, interval, model, block, queue, march):
    """Accept or reject the step of every lane that is not yet at the end of the interval, each for itself."""
    rows, y, buffer, atol, work = (
        rows_of(block.rows),
        rows_of(block.y),
        rows_of(block.buffer),
        rows_of(block.atol),
        rows_of(block.work),
    )
    layout = model.options.layout
    new = buffer[STATE]
    phase, step = rows[PHASE], rows[STEP]
    running = phase < rows[END]
    cut = rows[CUT] > 0.0
    rows[EVALUATIONS] = rows[EVALUATIONS] + where(running, 1.0 * evaluations, 0.0)
    worst, total = rules.collected_errors(buffer[ERROR], y, new, atol, march.rtol, layout)
    error = rules.step_error(worst, total)
    accepted, undefined, failure = rules.step_outcome(error, step, new, model)
    failed = running & (failure > 0.0)
    if any_of(failed):
        fail(where(failed, failure, 0.0), block, queue, march)
    running = running & ~failed
    accepted = accepted & running
    turned, shorter = accepted & ~accepted, step
    if model.options.sliding == SLIDING_DYNAMIC:
        too_far, shorter = rules.turn_of_friction(step, interval, model, work)
        fine = rules.resolves_turns(atol, model)
        turned = accepted & too_far & fine & (rows[TRIES] < rules.MOST_TRIES)
        accepted = accepted & ~turned
        rows[TRIES] = where(turned, rows[TRIES] + 1.0, where(accepted, 0.0, rows[TRIES]))
        rules.keep_turned(accepted, step, interval, model, work)
    reached = where(cut, rows[LIMIT], phase + step)
    due = accepted & (rows[DUE] <= reached) & (rows[DUE] < rows[END])
    while any_of(due):
        dopri5.sample((rows[DUE] - phase) / step, step, y, buffer, rows_of(block.search.state), layout)
        keep_sample(due, block.search.state, block, queue, march)
        due = accepted & (rows[DUE] <= reached) & (rows[DUE] < rows[END])
    if march.extremes:
        lanes = seeking(accepted, block, march)
        if any_of(lanes):
            place = Place(phase, rows[CYCLE] + march.first_cycle, interval, reached)
            search = search_of(block)
            extreme_search.search_step(METHOD, lanes, place, step, y, model, work, buffer, search)
    grown = step * dopri5.growth(error, rows[LAST_ERROR])
    grown = rules.next_step(grown, cut, rows[UNCUT_STEP])
    if model.options.sliding == SLIDING_DYNAMIC:
        longest = rules.longest_step(interval, model, work)
        grown = where(rules.resolves_turns(atol, model), minimum(grown, longest), grown)
    rejected = where(turned, shorter, step * where(undefined, rules.RETRY, dopri5.shrinkage(error)))
    rows[STEP] = where(running, where(accepted, grown, rejected), step)
    rows[LAST_ERROR] = where(accepted, maximum(error, rules.MINIMUM_ERROR), rows[LAST_ERROR])
    rows[PHASE] = where(accepted, reached, rows[PHASE])
    rows[STEPS] = rows[STEPS] + where(accepted, 1.0, 0.0)
    for i in range(layout.states):
        y[i] = where(accepted, new[i], y[i])
        last = buffer[SCRATCH + dopri5.STAGES - 1, i]  # of a step accepted the next one's first stage
        buffer[SCRATCH, i] = where(accepted, last, buffer[SCRATCH, i])
    stopped = accepted & cut & (reached < rows[END])
    if any_of(stopped):
        rows[SELECTED] = where(stopped, 1.0, 0.0)
        for lane in range(WIDTH):
            if block.rows[SELECTED, lane] > 0.0:
                stop = int(block.rows[STOP, lane]) + 1
                block.rows[STOP, lane] = stop
                block.rows[LIMIT, lane] = queue.stops[int(block.rows[CASE, lane]), interval, stop]
