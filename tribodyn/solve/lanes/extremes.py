"""Extremes between samples, sought in all lanes at once; see `extreme_search`, whose rules these are.

A lane takes part while its case is in its window; what it finds depends on no other lane.
"""

from tribodyn.dynamics.contact_forces import normal_contacts
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.extremes import (
    END,
    EXTREME,
    LOWEST,
    MIDDLE,
    RATE,
    START,
    TRIAL,
    alike,
    begin_surfaces,
    extreme_of,
    measure,
    measure_end,
    measure_inside,
    vertex,
)
from tribodyn.dynamics.parameters import STATES
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import any_of
from tribodyn.kernels.native.parts import part
from tribodyn.numerics.elementary import where
from tribodyn.solve.lanes.queue import CASE, CYCLE
from tribodyn.solve.march.extreme_search import begin_rates, promising, rate_of, worthwhile
from tribodyn.solve.methods.dopri5 import dense_output

#: A row that no measure stands in.
NONE = 1e9


@part
def seeking(lanes, block, march):
    """Those of some lanes whose case is in its window."""
    rows = rows_of(block.rows)
    return lanes & (rows[CASE] >= 0.0) & (rows[CYCLE] >= march.cycles - march.window)


@part
def open_lanes(start, segment, lanes, model, block, march):
    """Measure the states at the start of a segment."""
    measures, y, work = rows_of(block.measures), rows_of(block.y), rows_of(block.work)
    extreme = rows_of(block.extreme)
    for i in range(block.measures.shape[1]):
        for row in range(RATE):
            measures[row, i] = LOWEST
        measures[EXTREME, i] = extreme[extreme_of(i)]
    begin_rates(measures, extreme, block.measures.shape[1])
    cell, u, cells_per_radian = locate(start, segment, model.table)
    normal_contacts(segment, cell, u, cells_per_radian, y, model, work)
    measure(start, segment, y, model, work, measures[START])
    begin_surfaces(start, segment, model, measures)
    keep_lanes(lanes, START, start, segment, y, block, march)


@part
def keep_lanes(lanes, row, phase, segment, y, block, march):
    """Replace, in some lanes, the extremes that a row of measures, those of a state, surpasses."""
    measures, extreme = rows_of(block.measures), rows_of(block.extreme)
    cycles, segments, states = rows_of(block.cycles), rows_of(block.segments), rows_of(block.states)
    for i in range(block.measures.shape[1]):
        which = extreme_of(i)
        value = measures[row, i]
        better = lanes & (value > extreme[which])
        if any_of(better):
            extreme[which] = where(better, value, extreme[which])
            at = rows_of(block.rows)[CYCLE] + march.first_cycle + phase
            cycles[which] = where(better, at, cycles[which])
            segments[which] = where(better, 1.0 * segment, segments[which])
            for j in range(STATES):
                states[which, j] = where(better, y[j], states[which, j])
            for other in alike(i, block.measures.shape[1]):
                measures[EXTREME, other] = extreme[which]


@part
def search_lanes(lanes, phase, step, reached, segment, model, block, march):
    """Seek extremes over the steps just accepted in some lanes."""
    measures = rows_of(block.measures)
    new, work = rows_of(block.new), rows_of(block.work)
    measure_end(~lanes, reached, step, segment, new, model, work, measures)
    better, inside = step < 0.0, step < 0.0
    for i in range(block.measures.shape[1]):
        start, end, extreme = measures[START, i], measures[END, i], measures[EXTREME, i]
        better = better | (end > extreme)
        inside = inside | promising(start, end, measures[RATE, i] * step, extreme)
    better, inside = lanes & better, lanes & inside
    if any_of(better):
        keep_lanes(better, END, reached, segment, new, block, march)
    if any_of(inside):
        look_inside_lanes(inside, phase, step, segment, model, block, march)
    per_step = 1.0 / step
    for i in range(block.measures.shape[1]):
        rate = rate_of(measures[START, i], measures[END, i], per_step)
        measures[RATE, i] = where(lanes, rate, measures[RATE, i])
        measures[START, i] = where(lanes, measures[END, i], measures[START, i])


@part
def look_inside_lanes(lanes, phase, step, segment, model, block, march):
    """Measure the middles of steps, and one after the other the places where measures are highest."""
    measures, extreme = rows_of(block.measures), rows_of(block.extreme)
    chosen, row, share, done = lanes, MIDDLE, 0.5 + 0.0 * step, 0.0 * step - 1.0
    while any_of(chosen):
        look_at(chosen, row, share, phase, step, segment, model, block, march)
        row = TRIAL
        following, share = 0.0 * step + NONE, 0.0 * step
        for i in range(block.measures.shape[1]):
            at, value = vertex(measures[START, i], measures[MIDDLE, i], measures[END, i])
            wanted = lanes & (at > 0.0) & worthwhile(value, extreme[extreme_of(i)])
            wanted = wanted & (done < i) & (following == NONE)
            following = where(wanted, 1.0 * i, following)
            share = where(wanted, at, share)
        chosen = following < NONE
        done = following


@part
def look_at(lanes, row, share, phase, step, segment, model, block, march):
    """Measure at a share of each lane's step, on its dense output."""
    y, new, k, sample = rows_of(block.y), rows_of(block.new), rows_of(block.k), rows_of(block.sample)
    measures, work = rows_of(block.measures), rows_of(block.work)
    for i in range(STATES):
        sample[i] = dense_output(share, step, y[i], new[i], k, i)
    at = phase + share * step
    cell, u, cells_per_radian = locate(at, segment, model.table)
    normal_contacts(segment, cell, u, cells_per_radian, sample, model, work)
    measure_inside(~lanes, row, at, segment, sample, model, work, measures)
    keep_lanes(lanes, row, at, segment, sample, block, march)
