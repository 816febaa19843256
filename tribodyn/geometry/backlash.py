"""Backlash of a pair: what its teeth, as thick as they are cut, leave open at its centre distance."""

from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.tooth.tooth import thickness_half_angle
from tribodyn.numerics.elementary import cos


def circumferential_backlash(assembly: Assembly) -> Any:
    """Arc j_wt of the working pitch circle by which a gear can turn, m: pitch less both tooth thicknesses."""
    radius = assembly.path.pinion_pitch_radius
    pitch = 2 * np.pi * radius / assembly.drive.pinion.teeth
    thicknesses = 0.0
    for side in SIDES:
        radius = assembly.path_of(side).pinion_pitch_radius
        thicknesses = thicknesses + 2 * radius * thickness_half_angle(assembly.tooth(side), radius)
    return pitch - thicknesses


def normal_backlash(assembly: Assembly) -> Any:
    """Distance j_bn between the back flanks along their normal at the pitch point, m; negative: overlap."""
    return circumferential_backlash(assembly) * cos(assembly.path.pressure_angle(0.0))
