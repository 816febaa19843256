"""Closed forms of ISO 21771 for involute pairs, to compare the package's own ways with."""

import math
from typing import Any

from tribodyn.geometry.drive import Drive, reference_radius, tip_radius
from tribodyn.geometry.families.involute import working_pressure_angle
from tribodyn.numerics.elementary import cos, sin, sqrt


def closed_form_contact_ratio(drive: Drive) -> Any:
    """Transverse contact ratio (ISO 21771): length of the line of action between the tip circles / p_b."""
    working = working_pressure_angle(drive)
    stretch = cos(drive.pressure_angle) / cos(working)
    length = 0.0
    for side in ("pinion", "gear"):
        pitch = reference_radius(drive, side) * stretch
        base = pitch * cos(working)
        length = length + sqrt(tip_radius(drive, side) ** 2 - base**2) - pitch * sin(working)
    return length / (math.pi * drive.module * cos(drive.pressure_angle))
