"""Bearings of a system of shafts whose forces are evaluated in time: no matrix stands for them."""

from collections.abc import Collection, Iterable
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.bearing_forces import BALLS, ROLLERS
from tribodyn.train.elastic.beam import DIRECTIONS
from tribodyn.train.elastic.rolling_bearing import (
    SLICES,
    BallRow,
    BearingRows,
    BearingState,
    RollerRow,
    ball_constant,
    centres_apart,
    groove_radius,
    roller_constant,
    slices_of,
)


class InTime(NamedTuple):
    """A bearing whose force is evaluated in time."""

    number: int  # among all bearings
    rows: Float[Array, "5 coordinate"]  # what the coordinates move its rings against each other by
    state: BearingState  # under the mean loads
    moved: Float[Array, " coordinate"]  # displacement of the coordinates there


def tangent_of(bearings: Iterable[InTime]) -> Any:
    """Stiffness of bearings under the mean loads, by the coordinates; 0.0 of none."""
    return sum((one.rows.T @ one.state.stiffness @ one.rows for one in bearings), 0.0)


def push_in_time(bearings: Iterable[InTime], moved: Float[Array, " coordinate"]) -> Any:
    """Forces of coordinates on bearings about the mean loads, N or N m; 0.0 of none."""
    forces = (
        one.rows.T @ (one.state.force + one.state.stiffness @ one.rows @ (moved - one.moved))
        for one in bearings
    )
    return sum(forces, 0.0)


def kept_in_time(bearings: Iterable[tuple[Any, int, int]], others: Collection[int]) -> dict[int, float]:
    """Coordinates of nodes and seats that are kept for bearings beside others, and what each is times.

    Of every bearing its table, and the first coordinates of its node and its seat (−1: the ground). Tilts are
    kept times half the pitch diameter, in m.
    """
    kept: dict[int, float] = {}
    for bearing, *ends in bearings:
        for first in ends:
            for direction in range(DIRECTIONS) if first >= 0 else ():
                if first + direction not in others:
                    lever = rows_of_bearing(bearing.held)[0].pitch_diameter / 2.0
                    kept[first + direction] = 1.0 if direction < 3 else 1.0 / lever
    return kept


def rows_of_bearing(held: BallRow | RollerRow | BearingRows) -> tuple[BallRow | RollerRow, ...]:
    """All rows of a bearing."""
    return held.rows if isinstance(held, BearingRows) else (held,)


class RowInTime(NamedTuple):
    """Numbers of a row of rolling elements as `structure.BearingNumbers` has them."""

    type: int
    constant: float
    apart: float
    normal: tuple[float, float]
    around: Float[Array, " element"]
    point: Float[Array, "point 4"]


def row_in_time(row: BallRow | RollerRow) -> RowInTime:
    """What the forces in time of a row take; forces are those of `rolling_bearing.answer`.

    Points of a row that aligns itself are in the bearing's middle, which no tilt moves.
    """
    around = 2.0 * np.pi * np.arange(row.elements) / row.elements
    sine, cosine = np.sin(row.contact_angle), np.cos(row.contact_angle)
    normal = cosine, row.thrust * sine
    if isinstance(row, BallRow):
        apart = centres_apart(row)
        radius = 0.0 if row.aligning else groove_radius(row)
        rest = apart * cosine - row.clearance / 2.0, row.thrust * (apart * sine + row.preload)
        return RowInTime(
            BALLS, ball_constant(row), apart, normal, around, np.array([[radius, row.offset, *rest]])
        )
    place, drop = slices_of(row)
    point = np.zeros((SLICES, 4))
    point[:, 0], point[:, 1] = row.pitch_diameter / 2.0 - place * normal[1], row.offset + place * cosine
    point[:, 2] = abs(normal[1]) * row.preload - cosine * row.clearance / 2.0 - drop
    if row.aligning:
        assert np.isinf(row.centres)
        point[:, :2] = 0.0
    return RowInTime(ROLLERS, roller_constant(row) / SLICES, 0.0, normal, around, point)


def cage_share(row: BallRow | RollerRow) -> float:
    """Rotation of the cage over that of the inner ring, the outer one at rest, ½ (1 − D cos α/d_m)."""
    return 0.5 * (1.0 - row.diameter * float(np.cos(row.contact_angle)) / row.pitch_diameter)


class PassingElements(NamedTuple):
    """How often things happen in a bearing in a turn of its shaft, the outer ring at rest."""

    cage: float  # turns
    outer_pass: float  # elements that pass a place of the outer ring, or the load zone
    inner_pass: float  # of the inner ring
    element_spin: float  # turns of an element about its own axis


def passing_elements(row: BallRow | RollerRow) -> PassingElements:
    """What `cage_share` makes of the number of elements."""
    share, size = cage_share(row), row.pitch_diameter / row.diameter
    spin = 0.5 * size * (1.0 - (1.0 - 2.0 * share) ** 2)
    return PassingElements(share, row.elements * share, row.elements * (1.0 - share), spin)
