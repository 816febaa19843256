"""The rack cutter of a body: the straight-line tool whose flank, tip and rounding make its teeth.

Frame of the tool: x along the rolling line from the axis of one of its teeth, y across from the rolling line,
positive away from the body, so that the tool's tip lies at y = −depth and its root above the line.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Side, body_of
from tribodyn.geometry.path import PerContact, position
from tribodyn.geometry.tooth.tooth import Tooth, tangent_distance
from tribodyn.numerics.elementary import cos, sin
from tribodyn.numerics.shapes import Array, Float

#: Bottom clearance of the basic rack in modules, ISO 53 profiles A and B.
CLEARANCE = 0.25
_ROUNDING_POINTS = 16


class RackOutline(NamedTuple):
    """One pitch of a rack cutter: one tooth of the tool between the middles of its two gaps."""

    #: x, y: points (m) from x = −pitch/2 to pitch/2, symmetric about the tooth's axis x = 0
    x: Float[Array, " point"]
    y: Float[Array, " point"]
    pitch: float  # distance between neighbouring teeth, m
    #: tip_height, root_height: y of the tool's tip and root, m
    tip_height: float
    root_height: float


def rack_flank(tooth: Tooth, r: PerContact) -> tuple[PerContact, PerContact]:
    """Point (x, y) of the tool's left flank (m) that touches the body at the signed distance r (m)."""
    x, y = position(tooth.path, r)
    return x - tooth.path.pinion_pitch_radius * tooth.path.rotation(r) - tooth.corner_limit, y


def rack_outline(assembly: Assembly, side: Side, flank_points: int = 60) -> RackOutline:
    """One pitch of the rack cutter that makes one body of a drive of plain numbers.

    The flank is the one that generates: from the rounded tip to where it leaves the body's tip. Above, where
    it cuts nothing, it goes on along its tangent to the tool's root, a bottom clearance above the body's tip
    circle, or to the middle of the gap if that comes first.
    """
    drive, tooth = assembly.drive, assembly.tooth(side)
    pitch_radius = float(tooth.path.pinion_pitch_radius)
    pitch = 2 * np.pi * pitch_radius / float(body_of(drive, side).teeth)
    depth = pitch_radius - float(tooth.root_radius)
    # An undercut tooth's own flank begins above the point where the tool's flank ends.
    end = float(tangent_distance(tooth.path, depth, tooth.corner_radius))
    flank_x, flank_y = rack_flank(tooth, np.linspace(float(tooth.tip_distance), end, flank_points))
    normal = np.linspace(float(tooth.path.pressure_angle(end)), np.pi / 2, _ROUNDING_POINTS)[1:]
    rounding_x = tooth.corner_x - tooth.corner_limit - tooth.corner_radius * cos(normal)
    rounding_y = tooth.corner_y - tooth.corner_radius * sin(normal)

    angle = float(tooth.path.pressure_angle(tooth.tip_distance))
    root = float(tooth.tip_radius) - pitch_radius + CLEARANCE * float(drive.module)
    room = float(flank_x[0]) + pitch / 2
    root = min(root, float(flank_y[0]) + room / np.tan(angle))
    root_x = max(-pitch / 2, float(flank_x[0]) - np.tan(angle) * (root - float(flank_y[0])))

    half_x = np.concatenate([[-pitch / 2, root_x], flank_x, rounding_x])
    half_y = np.concatenate([[root, root], flank_y, rounding_y])
    x, y = np.concatenate([half_x, -half_x[::-1]]), np.concatenate([half_y, half_y[::-1]])
    # A root or a tip that has shrunk to a point would repeat it.
    kept = np.concatenate([[True], np.hypot(np.diff(x), np.diff(y)) > 1e-12 * pitch])
    return RackOutline(x[kept], y[kept], pitch, -depth, root)
