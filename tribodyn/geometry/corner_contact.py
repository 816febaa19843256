"""A pair of teeth before the beginning and beyond the end of its path of contact: the tip's corner.

Unloaded teeth part there. Loaded ones let the body run ahead, and the corner of the mate's tip touches the
flank early or late, once the deflection exceeds the gap between them.

The corner is followed in the view of the body whose flank it touches (`path.seen_from`): before contact
begins that is the pinion, met by the gear's tip; after its end the gear, met by the pinion's. Where undercut
ends a flank before the tip reaches it, the corner there touches the mate's flank.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly, mate_of
from tribodyn.geometry.drive import Side, tip_radius
from tribodyn.geometry.path import Kinematics, PerContact, distance_at_radius, kinematics, radius
from tribodyn.geometry.tooth import polar, thickness_half_angle
from tribodyn.numerics.shapes import Array, Bool


class PairGeometry(NamedTuple):
    """One pair of teeth at given pinion angles; every field is shaped like the roll angle.

    On the path of contact these are the path's. Outside, direction and curvature are those at the end of the
    path, and the signed distance is the corner's distance from the pitch point, which makes the sliding
    velocity exact.
    """

    motion: Kinematics  # direction, arms, curvatures and speeds, `path.kinematics`
    #: distance between corner and flank along the flank's normal while nothing is loaded, m; 0 on the path
    gap: PerContact
    #: pinion_radius, gear_radius: where each flank is touched: distance from its own axis, m
    pinion_radius: PerContact
    gear_radius: PerContact
    #: pinion_place, gear_place: the same as the signed distance at which that point of the flank is on the
    #: path of contact, m; both are the contact's own on the path
    pinion_place: PerContact
    gear_place: PerContact


def part_of(geometry: PairGeometry, index: Any) -> PairGeometry:
    """The same at some of the pairs: every field at the index."""
    motion, *others = geometry
    return PairGeometry(motion._make(field[index] for field in motion), *(field[index] for field in others))


def pair_geometry(assembly: Assembly, roll: PerContact) -> PairGeometry:
    """Geometry of one pair at the pinion angles `roll` (rad from the pitch point), on and off the path."""
    path = assembly.path
    start, end = assembly.roll_limits
    r = path.signed_distance(np.clip(roll, start, end))
    motion = kinematics(path, r)
    reach = {
        "pinion": np.array(radius(path, r), dtype=float),
        "gear": np.array(radius(assembly.path_of("gear"), -r), dtype=float),
    }
    place = {"pinion": r.copy(), "gear": r.copy()}
    gap, moved = np.zeros_like(roll), np.zeros_like(roll)
    sides: tuple[tuple[Side, Bool[Array, "*contact"]], ...] = (("pinion", roll < start), ("gear", roll > end))
    for side, outside in sides:
        if np.any(outside):
            touched, first = side, assembly.lowest_contact(side)
            if assembly.shortened(side):  # the corner at which undercut ends its own flank touches the mate's
                touched, first = mate_of(side), -first
            distance, corner_gap, at, flank = _corner(assembly, touched, first, roll[outside])
            beyond = np.maximum(at - tip_radius(assembly.drive, touched), 0.0)  # no flank is there
            gap[outside], reach[touched][outside] = corner_gap + beyond, at
            place[touched][outside] = flank if touched == "pinion" else -flank
            moved[outside] = (-distance if side == "pinion" else distance) - r[outside]
    ratio = path.pinion_pitch_radius / path.gear_pitch_radius
    motion = motion._replace(
        signed_distance=motion.signed_distance + moved,
        pinion_friction_arm=motion.pinion_friction_arm + moved,
        gear_friction_arm=motion.gear_friction_arm - moved,
        pinion_speed=motion.pinion_speed + moved,
        gear_speed=motion.gear_speed - ratio * moved,
        entrainment=motion.entrainment + (1.0 - ratio) * moved / 2.0,
        sliding=motion.sliding + (1.0 + ratio) * moved,
    )
    return PairGeometry(motion, gap, reach["pinion"], reach["gear"], place["pinion"], place["gear"])


def _corner(
    assembly: Assembly, side: Side, first: Any, roll: PerContact
) -> tuple[PerContact, PerContact, PerContact, PerContact]:
    """Corner of the mate near this body's flank at the pinion's angles; on the path it touches at `first`.

    Its distance from the pitch point, the gap along the flank's normal, the radius on this body and the
    signed distance, in this body's view, at which the flank would be in contact at that radius; m.
    """
    path: Any = assembly.path_of(side)
    tooth = assembly.tooth(side)
    r_body, r_mate = path.pinion_pitch_radius, path.gear_pitch_radius
    turn = roll if side == "pinion" else -roll * assembly.path.pinion_pitch_radius / r_body
    alpha = path.pressure_angle(first)
    tip, angle = polar(first * np.cos(alpha), -first * np.sin(alpha), r_mate)
    mate = angle + (turn - path.rotation(first)) * r_body / r_mate
    x, y = tip * np.sin(mate), r_mate - tip * np.cos(mate)
    reach, angle = polar(x, y, r_body)
    corner = thickness_half_angle(tooth, r_body) + angle - turn
    flank = distance_at_radius(path, reach)
    arm = r_body * np.cos(path.pressure_angle(flank))
    return np.hypot(x, y), (corner - thickness_half_angle(tooth, reach)) * arm, reach, flank


def roll_at_gap(assembly: Assembly, gap: float | tuple[float, float]) -> tuple[float, float]:
    """Pinion angles (rad) before and beyond the path of contact at which the corner's gap is `gap` (m).

    Two gaps are those before and beyond; where one is not positive the angle is the path's end. No further
    than one pitch outside the path.
    """
    pitch = assembly.pitch_angle
    gaps = gap if isinstance(gap, tuple) else (gap, gap)
    angles = []
    for limit, outwards, smallest in zip(assembly.roll_limits, (-1.0, 1.0), gaps, strict=True):
        low, high = 0.0, pitch if smallest > 0.0 else 0.0
        # ten steps of 32 intervals at once, as exact as fifty of two
        for _ in range(10):
            tried = np.linspace(low, high, 33)[1:-1]
            wide = pair_geometry(assembly, limit + outwards * tried).gap > smallest
            first = int(np.argmax(wide)) if np.any(wide) else len(tried)
            ends = [low, *tried, high]
            low, high = float(ends[first]), float(ends[first + 1])
        angles.append(limit + outwards * high)
    return angles[0], angles[1]
