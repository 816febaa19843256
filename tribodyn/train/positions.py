"""Where the axes of a train stand, in the plane across them, and whether its gears have room.

Right-handed x, y, seen from +z; the reference body's axis is the origin. Bodies that a coupling joins share
an axis. Azimuths are counter-clockwise from x.
"""

from collections.abc import Sequence
from math import atan2, cos, hypot, nan, sin
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.joints import joined
from tribodyn.train.structure import ACROSS, ALONG_Z, IN_SPACE, LEAN_ACROSS, LEAN_ALONG, MOVES, TOWARDS

#: Product of a direction's cosines below which it is along an axis.
_ROUNDING = 1e-15


class Distance(NamedTuple):
    """A mesh as it holds two axes apart."""

    key: str  # where it stands in the scenario, dotted
    ends: tuple[int, int]  # bodies
    distance: float  # between their axes, m
    azimuth: float | None  # of the second axis as seen from the first, rad; None: not given
    tolerance: float  # by how much a loop that it closes may miss, m


class Centres(NamedTuple):
    """Axes of a train."""

    centres: Float[Array, "body 2"]  # m
    azimuths: tuple[float, ...]  # of each mesh, from its first to its second axis, rad


class Disc(NamedTuple):
    """A gear, as it needs room."""

    name: str
    key: str
    body: int
    plane: int  # gears in the same plane must not touch unless they mesh
    tip_radius: float  # m; negative of an internal gear
    remedy: str = "change an azimuth, or stand them in different planes: plane = 2"


def places(count: int, meshes: Sequence[Distance], couplings: Sequence[tuple[int, int]]) -> Centres:
    """Place the axes of `count` bodies, body 0 at the origin.

    A mesh without an azimuth that closes a loop has the one that follows; another one goes along x, away from
    body 0. Raises InputError where a loop does not close, by more than its mesh's tolerance.
    """
    axes = joined(count, couplings)  # the axis of every body
    centre = {axes[0]: (0.0, 0.0)}
    with_azimuth = [mesh.azimuth is not None for mesh in meshes]
    while _place_one(meshes, with_azimuth, axes, centre):
        pass
    azimuths = tuple(_azimuth(mesh, *(centre[axes[end]] for end in mesh.ends)) for mesh in meshes)
    return Centres(np.array([centre[axes[body]] for body in range(count)]), azimuths)


def _place_one(
    meshes: Sequence[Distance], with_azimuth: Sequence[bool], axes: Sequence[int], centre: dict[int, tuple]
) -> bool:
    """Place one more axis, by a mesh with an azimuth where there is one; False: there is none to place."""
    for wanted in (True, False):
        for mesh, has in zip(meshes, with_azimuth, strict=True):
            one, two = (axes[end] for end in mesh.ends)
            if has is not wanted or (one in centre) == (two in centre):
                continue
            x, y = centre[one if one in centre else two]
            azimuth = mesh.azimuth or 0.0
            step = mesh.distance if one in centre or mesh.azimuth is None else -mesh.distance
            centre[two if one in centre else one] = (x + step * cos(azimuth), y + step * sin(azimuth))
            return True
    return False


def _azimuth(mesh: Distance, first: tuple[float, float], second: tuple[float, float]) -> float:
    """Azimuth of a mesh between two axes; InputError where these are not where it needs them."""
    x, y = second[0] - first[0], second[1] - first[1]
    apart = hypot(x, y)
    if mesh.azimuth is None:
        missed = abs(apart - mesh.distance)
    else:
        missed = hypot(x - mesh.distance * cos(mesh.azimuth), y - mesh.distance * sin(mesh.azimuth))
    if missed > mesh.tolerance:
        needed = f"its gears stand {1e3 * mesh.distance:.6g} mm apart"
        rule = f"closes a loop that does not close, by {1e3 * missed:.3g} mm: {needed}"
        turned = np.degrees(atan2(y, x)) if apart else nan
        remedy = (
            f"the other meshes leave {1e3 * apart:.6g} mm at {turned:.6g} deg; change azimuths or distances"
        )
        raise InputError(mesh.key, None, rule, remedy)
    return atan2(y, x) if mesh.azimuth is None else mesh.azimuth


def frame_of(azimuth: float, sense: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Directions along and across of a mesh whose driver turns in a sense, +1 counter-clockwise.

    Across is from the driver's axis to the driven one's, at this azimuth (rad); along is the motion at the
    pitch point.
    """
    x, y = cos(azimuth), sin(azimuth)
    if abs(x * y) < _ROUNDING:  # along an axis
        x, y = float(round(x)), float(round(y))
    return (-sense * y, sense * x), (x, y)


def moves_of(
    frame: tuple[tuple[float, float], tuple[float, float]],
    radii: tuple[float, float],
    places: tuple[float, float] = (0.0, 0.0),
) -> Float[Array, "end move direction"]:
    """How x, y, z and tilts of driver and driven body move a mesh: the projection rows P.

    A point at (ξ, η, z) from a body's centre moves by ψ × (ξ, η, z) = (ψ_y z, −ψ_x z, ψ_x η − ψ_y ξ). `frame`
    are the directions along the pitch tangent and across; `places` the z of the faces' middles from the
    bodies' centres, m.
    """
    moves = np.zeros((2, MOVES, IN_SPACE))
    (along_x, along_y), (across_x, across_y) = frame
    tilts = np.array([[0.0, 0.0, 0.0, -along_y, along_x], [0.0, 0.0, 0.0, -across_y, across_x]])
    for end, sign in enumerate((1.0, -1.0)):
        move = moves[end]
        move[TOWARDS] = sign * (np.array([along_x, along_y, 0.0, 0.0, 0.0]) + places[end] * tilts[0])
        move[ACROSS] = sign * (np.array([across_x, across_y, 0.0, 0.0, 0.0]) + places[end] * tilts[1])
        move[ALONG_Z] = np.array([0.0, 0.0, sign, 0.0, 0.0]) - radii[end] * tilts[1]
        move[LEAN_ALONG], move[LEAN_ACROSS] = sign * tilts
    return moves


def check_room(
    gears: Sequence[Disc], centres: Float[Array, "body 2"], meshing: Sequence[tuple[int, int]]
) -> None:
    """Raise InputError where tip circles of gears in one plane overlap that do not mesh with each other."""
    pairs = {frozenset(pair) for pair in meshing}
    for later, gear in enumerate(gears):
        for earlier, other in enumerate(gears[:later]):
            if gear.plane != other.plane or frozenset((earlier, later)) in pairs:
                continue
            apart = float(np.hypot(*(centres[gear.body] - centres[other.body])))
            reach = gear.tip_radius + other.tip_radius
            overlap = reach + (apart if min(gear.tip_radius, other.tip_radius) < 0.0 else -apart)
            if overlap > 0.0:
                by = f"{1e3 * overlap:.3g} mm"
                rule = f"its tip circle overlaps that of {other.name} by {by}, and they do not mesh"
                raise InputError(gear.key, None, rule, gear.remedy)
