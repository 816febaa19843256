"""Spur gear pairs whose teeth differ in kind: sound, shifted, undercut."""

import numpy as np
import pytest

from tribodyn.geometry.drive import SIDES, Drive, GearBody, Side, body_of
from tribodyn.geometry.families import crc, involute


def body(teeth, shift=0.0):
    return GearBody(teeth, shift, 1.0, 1.25, 0.25, 0.02, 0.01)


LIU_NI = Drive(0.003, np.radians(22.81), body(23.0), body(47.0))
SHIFTED = Drive(0.004, np.radians(20.0), body(17.0, 0.45), body(41.0, -0.12))
STANDARD = Drive(0.003, np.radians(20.0), body(20.0), body(36.0))
# The pinion's teeth are undercut, slightly and heavily.
UNDERCUT = Drive(0.003, np.radians(20.0), body(18.0), body(36.0))
HEAVILY_UNDERCUT = Drive(0.003, np.radians(20.0), body(9.0), body(36.0))
SOUND = [(crc.FAMILY, LIU_NI), (involute.FAMILY, SHIFTED), (involute.FAMILY, STANDARD)]
DRIVES = [*SOUND, (involute.FAMILY, UNDERCUT), (involute.FAMILY, HEAVILY_UNDERCUT)]


def bodies(drives):
    return pytest.mark.parametrize(
        ("family", "drive", "side"), [(family, drive, side) for family, drive in drives for side in SIDES]
    )


def root_radius(drive: Drive, side: Side) -> float:
    """Radius of the root circle of a tooth of nominal thickness, m: m (z/2 + x − h_f*)."""
    body = body_of(drive, side)
    return drive.module * (body.teeth / 2 + body.profile_shift - body.dedendum)
