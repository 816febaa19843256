"""Bearings of drawn shafts whose forces are evaluated in time, as a model has them."""

from collections.abc import Mapping
from itertools import accumulate

import numpy as np

from tribodyn.gears.drawn_system import DrawnSystem, ShaftData, places_of
from tribodyn.input.tables.drawn_bearings import BearingOfShaft, held_by
from tribodyn.numerics.elementary import RuntimeIndices
from tribodyn.train.bearing_forces import ENDS, IN_TIME, LINEAR, BearingForces
from tribodyn.train.elastic.in_time import (
    InTime,
    PassingElements,
    cage_share,
    passing_elements,
    row_in_time,
    rows_of_bearing,
)
from tribodyn.train.elastic.rolling_bearing import BallRow, BearingRows, RollerRow
from tribodyn.train.layout import TrainLayout
from tribodyn.train.structure import AXIAL, IN_SPACE, BearingNumbers


def bearings_in_time(
    system: DrawnSystem | None, layout: TrainLayout, new: Mapping[int, int]
) -> tuple[BearingForces, BearingNumbers]:
    """What is switched and numbers of the bearings in time; `new` as of `DrawnSystem.couplings`."""
    found = system.reduced.in_time if system is not None else ()
    if system is None or not found:
        return LINEAR, BearingNumbers()
    numbers = [new[body] for body in system.bodies]
    coordinates = np.array(places_of(numbers, layout, system.reduced.modes))
    owners = [(shaft, bearing) for shaft in system.shafts for bearing in shaft.drawing.bearing]
    rows = [
        (one, *owners[one.number], row)
        for one in found
        for row in rows_of_bearing(held_in_time(owners[one.number][1]))
    ]
    made = [row_in_time(row) for *_, row in rows]
    ends = [_ends(one, coordinates, row.located) for one, _, _, row in rows]
    numbers_of = [one.number for one, *_ in rows]
    # of several rows all of it with the first
    tangent = [one.state.stiffness * (n == numbers_of.index(one.number)) for n, (one, *_) in enumerate(rows)]
    settled = np.zeros(layout.half)
    settled[coordinates] = found[0].moved
    forces = IN_TIME._replace(
        number=len(rows),
        places=RuntimeIndices(place for places, _ in ends for place in places),
        bodies=RuntimeIndices(new[_nearest(shaft, bearing)] for _, shaft, bearing, _ in rows),
        types=RuntimeIndices(row.type for row in made),
        elements=RuntimeIndices(accumulate((len(row.around) for row in made), initial=0)),
        points=RuntimeIndices(accumulate((len(row.point) for row in made), initial=0)),
        bearings=RuntimeIndices(numbers_of),
    )
    return forces, BearingNumbers(
        moves=np.array([moves for _, moves in ends]),
        cage=np.array([shaft.sense * cage_share(row) for _, shaft, _, row in rows]),
        constant=np.array([row.constant for row in made]),
        apart=np.array([row.apart for row in made]),
        normal=np.array([row.normal for row in made]),
        around=np.concatenate([row.around for row in made]),
        point=np.concatenate([row.point for row in made]),
        tangent=np.array(tangent),
        settled=settled,
    )


def held_in_time(bearing: BearingOfShaft) -> BallRow | RollerRow | BearingRows:
    """A rolling bearing as the physics takes it."""
    held = held_by(bearing)
    assert isinstance(held, (BallRow, RollerRow, BearingRows))
    return held


def _ends(one: InTime, coordinates: np.ndarray, located: bool) -> tuple[list[int], list[float]]:
    """Places in the state of what moves both rings, and by how much; of what does not move 0 and 0."""
    places, moves = [0] * (ENDS * IN_SPACE), [0.0] * (ENDS * IN_SPACE)
    for direction, row in enumerate(one.rows):
        if direction == AXIAL and not located:
            continue
        for i in np.flatnonzero(row):
            at = direction + (IN_SPACE if row[i] < 0.0 else 0)
            places[at], moves[at] = int(coordinates[i]), float(row[i])
    return places, moves


def _nearest(shaft: ShaftData, bearing: BearingOfShaft) -> int:
    """The body of a shaft that is next to a bearing."""
    return min(shaft.points, key=lambda point: abs(point[1] - bearing.position))[0]


def cages_turn(system: DrawnSystem | None) -> bool:
    """Whether the force of a bearing is evaluated in time, so that nothing repeats with the meshes."""
    shafts = system.shafts if system is not None else ()
    return any(bearing.force == "in-time" for shaft in shafts for bearing in shaft.drawing.bearing)


def passing_of(system: DrawnSystem | None) -> dict[str, tuple[float, PassingElements]]:
    """Speed of the shaft (rad/s) and what passes in a turn of it, by the names of bearings in time."""
    if system is None:
        return {}
    owners = [(shaft, bearing) for shaft in system.shafts for bearing in shaft.drawing.bearing]
    rows = [
        (name, abs(shaft.speed), rows_of_bearing(held_in_time(bearing))[0])
        for name, (shaft, bearing) in zip(system.bearing_names, owners, strict=True)
        if bearing.force == "in-time"
    ]
    return {name: (speed, passing_elements(row)) for name, speed, row in rows}
