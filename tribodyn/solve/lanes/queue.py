"""The queue of cases, the lanes that work on it, and how cases pass between the two.

Whatever differs by lane stands in rows of `WIDTH` floats, flags and counters too: the compiler reads a row as
one vector, and compares and selects without conversion. Counters stay far below 2^53, where floats are exact.
The rows are in three groups: step control, counters, flags.
"""

from typing import NamedTuple

from tribodyn.dynamics.recorded.extremes import LOWEST
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH, count
from tribodyn.kernels.native.parts import part
from tribodyn.numerics.elementary import where
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import Ensemble, Status
from tribodyn.solve.march.extreme_search import Search
from tribodyn.solve.march.step_control import FIRST_STEP, MINIMUM_ERROR

#: Step control: phase (mesh cycles, 0 … 1); end of the interval, a lane runs while its phase is below; next
#: stop, see `reversal`; the step, and what it was before it was cut to end there; the last error; phase of
#: the next sample, above 1 if none is left.
PHASE, END, LIMIT, STEP, UNCUT_STEP, LAST_ERROR, DUE = range(7)
#: Counters: number of the case, −1 for none; cycles that it has done; steps accepted, and those before this
#: mesh cycle; evaluations; numbers of the next stop in the interval and of the next sample in the cycle; how
#: often the step was tried again because friction turned too far.
CASE, CYCLE, STEPS, STEPS_BEFORE, EVALUATIONS, STOP, SAMPLE, TRIES = range(7, 15)
#: Flags, 0 or 1: no engagement opens the first cycle; the step was cut; the lane is selected (where it fails,
#: with its status).
FRESH, CUT, SELECTED = range(15, 18)
ROWS = 18
#: A phase that never comes.
NEVER = 2.0


class LaneBlock(NamedTuple):
    """Scratch of the lanes that one thread works with."""

    numbers: Float[Array, "number lane"]  # this and the next: those of the lanes' models, see `batch`
    addresses: Int[Array, "table lane"]
    rows: Float[Array, "row lane"]
    y: Float[Array, "state lane"]
    atol: Float[Array, "state lane"]
    buffer: Float[Array, "row state lane"]  # of the method
    work: Float[Array, "mesh quantity pair lane"]
    search: Search  # with the lanes as its last axis


class Queue(NamedTuple):
    """Cases of one shape in the order in which they are begun, shared by all threads."""

    numbers: Float[Array, "case number"]  # this and the next: the models, see `batch`
    addresses: Int[Array, "case table"]
    atol: Float[Array, "case state"]
    stops: Float[Array, "case interval stop"]  # phases that steps end on, see `reversal.stops`
    result: Ensemble  # its `state` holds the start before
    taken: Int[Array, "1"]  # cases begun
    done: Int[Array, "1"]  # mesh cycles done
    stop: Int[Array, "1"]  # not 0 to stop all threads


@part
def copy(source, target):
    """Copy one row of numbers."""
    for i in range(source.shape[0]):
        target[i] = source[i]


@part
def take_cases(block, queue, march, opens):
    """Fill the lanes that have no case, where a common period `opens`; False if none has one any more."""
    rows = block.rows
    running = False
    for lane in range(WIDTH):
        if opens and rows[CASE, lane] < 0.0 and queue.taken[0] < queue.result.state.shape[0]:
            case = count(queue.taken, 1)
            if case < queue.result.state.shape[0]:
                copy(queue.numbers[case], block.numbers[:, lane])
                copy(queue.addresses[case], block.addresses[:, lane])
                copy(queue.result.state[case], block.y[:, lane])
                copy(queue.atol[case], block.atol[:, lane])
                for row in range(ROWS):
                    rows[row, lane] = 0.0
                rows[CASE, lane] = case
                for i in range(block.search.extremes.measure.shape[0]):
                    block.search.extremes.measure[i, lane] = LOWEST
                rows[STEP, lane] = FIRST_STEP
                rows[LAST_ERROR, lane] = MINIMUM_ERROR
                rows[FRESH, lane] = 0.0 if march.started else 1.0
        if rows[CASE, lane] >= 0.0:
            running = True
            rows[STEPS_BEFORE, lane] = rows[STEPS, lane]
            inside = rows[CYCLE, lane] >= march.cycles - march.window and march.samples > 0
            rows[SAMPLE, lane] = 0.0
            rows[DUE, lane] = 0.0 if inside else NEVER
        else:
            rows[DUE, lane] = NEVER
    return running and queue.stop[0] == 0


@part
def close_cycle(block, queue, march):
    """Count the cycle, and hand in the cases that have done all of theirs."""
    rows = block.rows
    for lane in range(WIDTH):
        if rows[CASE, lane] >= 0.0:
            rows[CYCLE, lane] += 1.0
            count(queue.done, 1)
            if rows[CYCLE, lane] >= march.cycles:
                rows[PHASE, lane] = 0.0
                let_go(lane, Status.DONE.value, block, queue)


@part
def let_go(lane, status, block, queue):
    """Hand in a lane's case; the lane idles to the end of the cycle."""
    rows = block.rows
    case = int(rows[CASE, lane])
    copy(block.y[:, lane], queue.result.state[case])
    queue.result.status[case] = status
    queue.result.reached[case] = rows[CYCLE, lane] + rows[PHASE, lane]
    queue.result.steps[case] = int(rows[STEPS, lane])
    queue.result.evaluations[case] = int(rows[EVALUATIONS, lane])
    lane_extremes, extremes = block.search.extremes, queue.result.extremes
    if extremes.measure.shape[0] > 0:
        copy(lane_extremes.measure[:, lane], extremes.measure[case])
        copy(lane_extremes.cycles[:, lane], extremes.cycles[case])
        copy(lane_extremes.interval[:, lane], extremes.interval[case])
        for i in range(lane_extremes.measure.shape[0]):
            copy(lane_extremes.state[i, :, lane], extremes.state[case, i])
    rows[CASE, lane] = -1.0
    rows[PHASE, lane] = rows[END, lane]


@part
def fail(failure, block, queue, march):
    """Hand in the cases of those lanes as failed that have another `Status` than 0, which is DONE."""
    rows_of(block.rows)[SELECTED] = failure
    for lane in range(WIDTH):
        if block.rows[SELECTED, lane] > 0.0:
            count(queue.done, march.cycles - int(block.rows[CYCLE, lane]))
            let_go(lane, int(block.rows[SELECTED, lane]), block, queue)


@part
def keep_sample(lanes, state, block, queue, march):
    """Copy a state to the results of some lanes, and say when their next one is due."""
    rows = block.rows
    rows_of(rows)[SELECTED] = where(lanes, 1.0, 0.0)
    for lane in range(WIDTH):
        if rows[SELECTED, lane] > 0.0:
            number = int(rows[SAMPLE, lane])
            cycle = int(rows[CYCLE, lane]) - (march.cycles - march.window)
            kept = queue.result.samples[int(rows[CASE, lane]), cycle * march.samples + number]
            copy(state[:, lane], kept)
            number += 1
            rows[SAMPLE, lane] = number
            rows[DUE, lane] = number / march.samples if number < march.samples else NEVER
