"""Where friction reverses: phases that steps must end on, so that none passes over the reversal.

The friction of a pair changes sign about its pitch point, over less than a step of the vibration.
With the nominal sliding velocity the place is known beforehand, as engagement is; there the force is C1 only.
With the sliding of the bodies as they move it is found on the way, see `step_control`, and steps end nowhere
else. A step across it evaluates the reversal in some of its stages or in none, and its error estimate misses
it: on the CRC drive that made the error of the transmission error 30 times what it is without friction.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, Model
from tribodyn.mesh.cycle import CHANNELS, Polynomials
from tribodyn.numerics.shapes import Array, Float

#: Distances from the pitch point, over the width of reversal: its ends; the pitch point, where the friction
#: coefficient has a kink in the sliding speed; and places beside it, as a fluid of high viscosity reaches its
#: limiting shear stress within a small part of the width (Masjedi & Khonsari's law).
SHARES = (-1.0, -0.2, -0.04, 0.0, 0.04, 0.2, 1.0)

_DISTANCE = CHANNELS.index("signed_distance")


def passages(table: Polynomials, segment: int, distance: float) -> list[float]:
    """Phases at which a pair in contact is at a signed distance from the pitch point (m), in one segment."""
    start, end = (float(x) for x in np.asarray(table.boundary)[segment : segment + 2])
    coefficients = np.asarray(table.channel)[segment, :, :, _DISTANCE]
    phases = []
    for slot in np.flatnonzero(np.asarray(table.in_contact)[segment]):
        nodes = np.append(coefficients[:, slot, 0], np.sum(coefficients[-1, slot])) - distance
        for cell in np.flatnonzero((nodes[:-1] < 0.0) != (nodes[1:] < 0.0)):
            c = coefficients[cell, slot]
            u = nodes[cell] / (nodes[cell] - nodes[cell + 1])
            for _ in range(4):  # Newton's steps from the chord of a smooth, fine table
                value = c[0] - distance + u * (c[1] + u * (c[2] + u * c[3]))
                u -= value / (c[1] + u * (2.0 * c[2] + 3.0 * u * c[3]))
            phases.append(start + (cell + min(max(u, 0.0), 1.0)) / len(coefficients) * (end - start))
    return phases


def stops(model: Model) -> Float[Array, "interval stop"]:
    """Phases that steps end on, ascending, each interval's end last and repeated to fill up.

    For every pair of every mesh: the places of `SHARES`, with the nominal sliding velocity.
    """
    shares = () if model.options.sliding == SLIDING_DYNAMIC else SHARES
    schedule = model.schedule
    start, end, segment = (np.asarray(part) for part in (schedule.start, schedule.end, schedule.segment))
    width = float(model.operation.reversal_width)
    crossings: dict[tuple[int, int], list[float]] = {}
    columns = []
    for m, mesh in enumerate(model.meshes):
        offset, rate = np.asarray(schedule.offset)[:, m], np.asarray(schedule.rate)[m]
        of_mesh: list[np.ndarray] = []
        for there in np.unique(segment[:, m]).tolist():
            key = id(mesh.table), int(there)
            if key not in crossings:
                crossings[key] = [
                    phase for share in shares for phase in passages(mesh.table, key[1], share * width)
                ]
            rows = segment[:, m] == there
            of_mesh += [np.full(len(start), np.inf) for _ in crossings[key][len(of_mesh) :]]
            for column, phase in zip(of_mesh, crossings[key], strict=False):
                column[rows] = (phase - offset[rows]) / rate
        columns += of_mesh
    phases = np.sort(np.array(columns).reshape(-1, len(start)), axis=0)
    near = 1e-9 * (end - start)
    last, kept = start, []
    for column in phases:  # those of slices in step are one
        passed = (last + near < column) & (column < end - near)
        last = np.where(passed, column, last)
        kept.append(np.where(passed, column, np.inf))
    ascending = np.sort(np.array(kept).reshape(-1, len(start)), axis=0)
    most = int(np.max(np.sum(np.isfinite(ascending), axis=0), initial=0))
    ending = np.append(ascending[:most], end[None], axis=0)
    # of one order in memory, whatever the drive: kernels are compiled for it
    return np.ascontiguousarray(np.where(np.isfinite(ending), ending, end).T)


def stops_of_many(models: Sequence[Model]) -> Float[Array, "case interval stop"]:
    """`stops` of many cases; computed once for all that have them in common.

    Those of fewer intervals than others have rows behind their last one that nobody reads.
    """
    numbers: dict[tuple[Any, ...], int] = {}
    different: list[np.ndarray] = []
    rows = []
    for model in models:
        tables = tuple(id(mesh.table) for mesh in model.meshes)
        key = (tables, id(model.schedule), float(model.operation.reversal_width), model.options.sliding)
        if key not in numbers:
            numbers[key] = len(different)
            different.append(stops(model))
        rows.append(numbers[key])
    intervals, count = (max(stop.shape[axis] for stop in different) for axis in (0, 1))
    unread = [((0, intervals - len(stop)), (0, 0)) for stop in different]
    return np.array(
        [np.pad(filled_up(stop, count), rest, "edge") for stop, rest in zip(different, unread, strict=True)]
    )[rows]


def filled_up(stops: Float[Array, "*case interval given"], count: int) -> Float[Array, "*case interval stop"]:
    """Stops, so many in every interval: its last one, the interval's end, is repeated."""
    behind = count - stops.shape[-1]
    return np.concatenate([stops, np.repeat(stops[..., -1:], behind, axis=-1)], axis=-1)
