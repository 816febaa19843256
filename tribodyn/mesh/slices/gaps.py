"""Gaps between unloaded slices along the face: transmission error, backlash, modifications, misalignment."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.flank_gap import oblique_gap
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.corner_contact import PairGeometry
from tribodyn.geometry.helix import normal_slope, roll_shift
from tribodyn.geometry.modification import UNMODIFIED, back_flanks, turned_round, uneven_teeth
from tribodyn.geometry.path import Kinematics, kinematics
from tribodyn.mesh import table
from tribodyn.numerics.elementary import namespace, sqrt
from tribodyn.numerics.shapes import Array, Float

#: Points and weights, on −½ … ½ of the part of a slice that touches, of the mean gap along it.
_AT, _WEIGHT = (0.5 * each for each in np.polynomial.legendre.leggauss(4))


class TouchingPart(NamedTuple):
    """The parts of slices that touch, (S, N, Q)."""

    roll: Any  # pinion angle in the middle of the part, rad
    place: Any  # z there, m from the middle of the face
    share: Any  # length over the slice's


def slice_gap(
    assembly: Assembly, mesh: table.MeshData, at: table.Slots, motion: Kinematics, slope: Any, back: range
) -> Float[Array, "segment node slot"]:
    """Gap between the unmodified, unloaded slices along the true normal, m.

    A given transmission error is along the true normal; the backlash is that at the pitch point.
    """
    gap = table.unloaded_gap(assembly, mesh, at, motion.pressure_angle)
    if back:
        # conjugate back flanks touch after the same rotation: the distance goes like the arm cos α cos β_n
        pitch_point = normal_slope(slope, assembly.path.pressure_angle(0.0 * assembly.r_start))
        leaning = normal_slope(slope, motion.pressure_angle)
        turned = sqrt((1.0 + pitch_point**2) / (1.0 + leaning**2))
        gap = namespace(gap, turned).where(at.side > 0, gap, gap * turned)
    return gap


class SeenPart(NamedTuple):
    """Where flanks of driving (`side` 1) or back pairs touch at one of the points of a mean along slices."""

    side: int
    slots: Any
    weight: float
    geometry: PairGeometry
    place: Any  # z, m


def seen_parts(
    assembly: Assembly, extent: TouchingPart, distance: Callable[[Any], Any], slots: tuple[int, int]
) -> list[SeenPart]:
    """Where slices touch at all points of the mean along them; plain numbers only.

    `distance` gives r (m) of roll angles; `slots`: how many are of driving flanks, and of a pair.
    """
    hand, (fronts, slices) = _hand(assembly), slots
    width = float(assembly.common_width) / slices
    seen = []
    for side, part in ((1, np.s_[..., :fronts]), (-1, np.s_[..., fronts:])):
        roll, place, share = (field[part] for field in extent)
        for at, weight in zip(_AT, _WEIGHT, strict=True):
            offset = at * share * width
            r = distance(roll - side * hand * roll_shift(assembly, offset))
            geometry = PairGeometry(kinematics(assembly.path, r), np.zeros_like(r), r, r, r, r)
            seen.append(SeenPart(side, part, weight, geometry, place + offset))
    return seen


def modified_gap(
    assembly: Assembly, mesh: table.MeshData, seen: Callable[[], list[SeenPart]], slope: Any, shape: Any
) -> Any:
    """Mean along each slice of what is taken off the flanks, and of misalignment, m along the true normal.

    With the mean over the part that touches, the loads of slices add up to what the line of contact carries,
    wherever its ends and the kinks of reliefs are in a slice. Plain numbers only where there is something.
    Raises InputError where teeth differ.
    """
    if mesh.modifications == UNMODIFIED:
        return 0.0
    for broken in uneven_teeth(mesh.modifications):
        raise broken
    # the table is of a right-hand pinion: a left-hand one looked at from its other end face
    front = mesh.modifications if _hand(assembly) > 0 else turned_round(mesh.modifications)
    behind = back_flanks(front, float(assembly.path.pressure_angle(0.0)))
    total = np.zeros(shape)
    for side, slots, weight, geometry, place in seen():
        flanks = front if side > 0 else behind
        total[slots] += weight * oblique_gap(assembly, flanks, geometry, place, slope, side)
    return total


def _hand(assembly: Assembly) -> int:
    return 1 if assembly.drive.helix_angle >= 0.0 else -1
