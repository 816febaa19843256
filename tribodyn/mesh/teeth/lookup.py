"""What single teeth have of their own in a mesh, as a slot looks it up.

Every tooth of either gear refers to a row of a table over the roll of a pair, one for each of its flanks;
teeth that are alike share a row. Which teeth a slot holds follows from the numbers of those that entered
last, which the schedule has for every interval. Between the nodes the table is C¹.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.elementary import last_axis_of_four, law, maximum, minimum, truncate
from tribodyn.numerics.shapes import Array, Float

#: Channels of a `ToothTable`. One of teeth that only lack material has no others.
GAP, COMPLIANCE, FRICTION, CHANNELS = range(4)


class ToothTable(NamedTuple):
    """Teeth of one gear, as cubics over the cells: gap (m), compliance (m/N), factor on friction less 1."""

    row: Float[Array, " place"]  # of `channel`; by the tooth, driving sides first
    channel: Float[Array, "row cell slice channel 4"]


class Teeth(NamedTuple):
    """Teeth of both gears of a mesh, and where its slots find theirs; empty where all teeth are alike."""

    driver: ToothTable = ToothTable(np.zeros(0), np.zeros((0, 0, 0, 0, 4)))
    driven: ToothTable = ToothTable(np.zeros(0), np.zeros((0, 0, 0, 0, 4)))
    start: Float[Array, "segment slot"] = np.zeros((0, 0))  # place over the roll at phase 0, cells
    rate: Float[Array, " slot"] = np.zeros(0)  # cells per mesh cycle
    #: driver_place, driven_place: place in `ToothTable.row` where the number of the tooth that entered last
    #: is 0
    driver_place: Float[Array, "segment slot"] = np.zeros((0, 0))
    driven_place: Float[Array, "segment slot"] = np.zeros((0, 0))


ALIKE = Teeth()


class OwnPlace(NamedTuple):
    """Where a slot's teeth are looked up."""

    driver: Any  # row; whole
    driven: Any
    cell: Any  # whole
    slice: Any  # whole
    u: Any  # position in the cell, 0 … 1
    cells_per_radian: Any  # cells per rotation of the driver


@law
def differ(mesh):
    """Whether teeth of a mesh have anything of their own."""
    return mesh.teeth.rate.shape[0] > 0


@law
def deflect_apart(mesh):
    """Whether teeth of a mesh differ in compliance or friction too."""
    return mesh.teeth.driver.channel.shape[3] > 1


@law
def own_place(i, place, mesh):
    """`OwnPlace` of slot i, of a mesh whose teeth differ."""
    teeth = mesh.teeth
    cells = teeth.driver.channel.shape[1]
    position = teeth.start[place.segment, i] + teeth.rate[i] * place.phase
    position = minimum(maximum(position, 0.0), cells - 1e-9)
    cell = truncate(position)
    one = truncate(teeth.driver_place[place.segment, i] + place.driver_tooth)
    two = truncate(teeth.driven_place[place.segment, i] + place.driven_tooth)
    return OwnPlace(
        truncate(teeth.driver.row[one]),
        truncate(teeth.driven.row[two]),
        cell,
        i % teeth.driver.channel.shape[2],
        position - cell,
        teeth.rate[i] / mesh.table.pitch_angle,
    )


@law
def own_and_slope(tooth, channel, mesh):
    """What both teeth add to a channel, and its derivative by the driver's rotation."""
    value, slope = _value_and_slope(tooth.driver, tooth, channel, mesh.teeth.driver)
    second, steep = _value_and_slope(tooth.driven, tooth, channel, mesh.teeth.driven)
    return value + second, (slope + steep) * tooth.cells_per_radian


@law
def _value_and_slope(row, tooth, channel, teeth):
    c0, c1, c2, c3 = last_axis_of_four(teeth.channel, row, tooth.cell, tooth.slice, channel)
    u = tooth.u
    return c0 + u * (c1 + u * (c2 + u * c3)), c1 + u * (2.0 * c2 + 3.0 * u * c3)
