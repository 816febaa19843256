"""The queue of cases, the block of lanes that works on it, and how cases pass between the two."""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.parameters import STATES
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH, count
from tribodyn.kernels.native.parts import part
from tribodyn.numerics.elementary import where
from tribodyn.solve.dormand_prince import FIRST_STEP, LEAST_REMEMBERED, STAGES
from tribodyn.solve.engine import DONE
from tribodyn.solve.lane_packing import Packed

# Rows of what the integrator knows of every lane.
PHASE = 0  # mesh cycles, 0 … 1
END = 1  # of the segment; a lane runs while its phase is below
STEP = 2
LAST_ERROR = 3
CYCLE = 4  # done by this lane's case
STEPS = 5  # accepted
STEPS_BEFORE = 6  # this mesh cycle
EVALUATIONS = 7
CASE = 8  # −1: none
FRESH = 9  # 1: no engagement opens the first cycle
DUE = 10  # phase of the next sample to keep; above 1 if none is left in this cycle
SAMPLE = 11  # number of that sample in the cycle
FLAG = 12  # what a lane is singled out for
STOP = 13  # number of the next phase that a step must end on, see `reversal`
LIMIT = 14  # that phase
WISHED = 15  # the step, had it not been cut to end there
LAST = 16  # 1: the step was cut
ROWS = 17
#: A phase that never comes.
NEVER = 2.0


class Block(NamedTuple):
    """Scratch of one block of lanes.

    Attributes
    ----------
    numbers, addresses : of the lanes' models, see `packing`
    rows : (ROWS, WIDTH)
    y, new, sample, atol : (STATES, WIDTH)
    k : (STAGES, STATES, WIDTH)
    work : (quantities, pairs, WIDTH)
    """

    numbers: np.ndarray
    addresses: np.ndarray
    rows: np.ndarray
    y: np.ndarray
    new: np.ndarray
    sample: np.ndarray
    atol: np.ndarray
    k: np.ndarray
    work: np.ndarray


class Queue(NamedTuple):
    """The cases of one kind in the order in which they are begun, shared by all threads.

    Attributes
    ----------
    numbers, addresses : (C, F) float64 and (C, T) int64
        The models, see `packing`.
    atol : (C, STATES)
    stops : (C, segments, most)
        Phases that steps end on, see `reversal.stops`.
    state : (C, STATES), samples : (C, kept, STATES), status : (C,) int64, reached : (C,)
    steps, evaluations : (C,) int64
        Results; `state` holds the start before.
    taken, done, stop : (1,) int64
        Cases begun; mesh cycles done; not 0 to stop all threads.
    """

    numbers: np.ndarray
    addresses: np.ndarray
    atol: np.ndarray
    stops: np.ndarray
    state: np.ndarray
    samples: np.ndarray
    status: np.ndarray
    reached: np.ndarray
    steps: np.ndarray
    evaluations: np.ndarray
    taken: np.ndarray
    done: np.ndarray
    stop: np.ndarray


def make_block(packed: Packed, numbers: np.ndarray, addresses: np.ndarray) -> Block:
    """Empty lanes."""
    pairs = packed.kind.pairs
    block = Block(
        numbers,
        addresses,
        *(
            np.zeros((*shape, WIDTH))
            for shape in (
                (ROWS,),
                (STATES,),
                (STATES,),
                (STATES,),
                (STATES,),
                (STAGES, STATES),
                (QUANTITIES + pairs, pairs),
            )
        ),
    )
    block.rows[CASE] = -1.0
    return block


@part
def copy(source, target):
    """Copy one row of numbers."""
    for i in range(source.shape[0]):
        target[i] = source[i]


@part
def take_cases(block, queue, settings):
    """Fill the lanes that have no case; False if none has one any more."""
    rows = block.rows
    running = False
    for lane in range(WIDTH):
        if rows[CASE, lane] < 0.0 and queue.taken[0] < queue.state.shape[0]:
            case = count(queue.taken, 1)
            if case < queue.state.shape[0]:
                copy(queue.numbers[case], block.numbers[:, lane])
                copy(queue.addresses[case], block.addresses[:, lane])
                copy(queue.state[case], block.y[:, lane])
                copy(queue.atol[case], block.atol[:, lane])
                for row in range(ROWS):
                    rows[row, lane] = 0.0
                rows[CASE, lane] = case
                rows[STEP, lane] = FIRST_STEP
                rows[LAST_ERROR, lane] = LEAST_REMEMBERED
                rows[FRESH, lane] = 0.0 if settings.started else 1.0
        if rows[CASE, lane] >= 0.0:
            running = True
            rows[STEPS_BEFORE, lane] = rows[STEPS, lane]
            inside = rows[CYCLE, lane] >= settings.cycles - settings.window and settings.samples > 0
            rows[SAMPLE, lane] = 0.0
            rows[DUE, lane] = 0.0 if inside else NEVER
        else:
            rows[DUE, lane] = NEVER
    return running and queue.stop[0] == 0


@part
def close_cycle(block, queue, settings):
    """Count the cycle, and let go of the cases that have done all of theirs."""
    rows = block.rows
    for lane in range(WIDTH):
        if rows[CASE, lane] >= 0.0:
            rows[CYCLE, lane] += 1.0
            count(queue.done, 1)
            if rows[CYCLE, lane] >= settings.cycles:
                rows[PHASE, lane] = 0.0
                let_go(lane, DONE, block, queue)


@part
def let_go(lane, status, block, queue):
    """Hand in a lane's case; the lane idles to the end of the cycle."""
    rows = block.rows
    case = int(rows[CASE, lane])
    copy(block.y[:, lane], queue.state[case])
    queue.status[case] = status
    queue.reached[case] = rows[CYCLE, lane] + rows[PHASE, lane]
    queue.steps[case] = int(rows[STEPS, lane])
    queue.evaluations[case] = int(rows[EVALUATIONS, lane])
    rows[CASE, lane] = -1.0
    rows[PHASE, lane] = rows[END, lane]


@part
def fail(lanes, status, block, queue, settings):
    """Hand in the cases of some lanes as failed."""
    rows_of(block.rows)[FLAG] = where(lanes, 1.0, 0.0)
    for lane in range(WIDTH):
        if block.rows[FLAG, lane] > 0.0:
            count(queue.done, settings.cycles - int(block.rows[CYCLE, lane]))
            let_go(lane, status, block, queue)


@part
def keep_sample(lanes, sample, block, queue, settings):
    """Copy the state in `sample` to the results of some lanes, and say when their next one is due."""
    rows = block.rows
    rows_of(rows)[FLAG] = where(lanes, 1.0, 0.0)
    for lane in range(WIDTH):
        if rows[FLAG, lane] > 0.0:
            number = int(rows[SAMPLE, lane])
            cycle = int(rows[CYCLE, lane]) - (settings.cycles - settings.window)
            kept = queue.samples[int(rows[CASE, lane]), cycle * settings.samples + number]
            copy(sample[:, lane], kept)
            number += 1
            rows[SAMPLE, lane] = number
            rows[DUE, lane] = number / settings.samples if number < settings.samples else NEVER
