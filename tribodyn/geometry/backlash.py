"""Backlash of a pair whose teeth are cut: how far a gear can turn, and how far the back flanks are apart."""

from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.helix import normal_slope, pitch_slope
from tribodyn.geometry.tooth import thickness_half_angle
from tribodyn.numerics.elementary import cos, sqrt


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
    """Distance j_bn between the back flanks along their normal at the pitch point, m; negative: overlap.

    j_bn = j_wt cos α_wt cos β_b (ISO 21771); of other families β_n at the pitch point stands for β_b.
    """
    angle = assembly.path.pressure_angle(0.0)
    leaning = sqrt(1.0 + normal_slope(pitch_slope(assembly), angle) ** 2)
    return circumferential_backlash(assembly) * cos(angle) / leaning
