"""Loss factor of an involute mesh with a constant friction coefficient: η = 1 − μ H_v.

Höhn's formula and the integral that it evaluates, as given by A. Diez-Ibarbia et al., efficiency of spur
gears with a shifting profile, (8)-(11). The tip contact ratios ε1 (pinion, recess) and ε2 (gear, approach)
are the pinion's rotation from the pitch point to the end and to the beginning of contact, in pitches.
"""

import math
from itertools import pairwise

from tribodyn.geometry.drive import Drive, tip_radius
from tribodyn.geometry.families import Family
from tribodyn.geometry.path import contact_limits


def tip_contact_ratios(family: Family, drive: Drive) -> tuple[float, float]:
    """ε1 of the pinion's tip and ε2 of the gear's; their sum is the contact ratio."""
    path = family.working_path(drive)
    start, end = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    pitch = 2.0 * math.pi / drive.pinion.teeth
    return float(path.rotation(end)) / pitch, -float(path.rotation(start)) / pitch


def hoehn(pinion_tip: float, gear_tip: float, pinion_teeth: float, ratio: float) -> float:
    """H_v = π (u + 1)/(z1 u) (1 − ε_α + ε1² + ε2²), Diez-Ibarbia (10).

    Valid for ε1, ε2 ≤ 1 ≤ ε1 + ε2 only, with the pitch point where one pair alone carries the load; beyond,
    see `exact`.

    Parameters
    ----------
    pinion_tip, gear_tip : ε1, ε2
    pinion_teeth : z1
    ratio : u = z2/z1
    """
    total = 1.0 - (pinion_tip + gear_tip) + pinion_tip**2 + gear_tip**2
    return math.pi * (ratio + 1.0) / (pinion_teeth * ratio) * total


def exact(pinion_tip: float, gear_tip: float, pinion_teeth: float, ratio: float) -> float:
    """Evaluate the integral (8) behind Höhn's formula: equal loads on all pairs in contact, however many.

    H_v = 2π (u + 1)/(z1 u) ∫ |ξ|/n(ξ) dξ over −ε2 … ε1, with ξ in pitches from the pitch point and n the
    number of pairs in contact. Piecewise closed form; parameters as for `hoehn`.
    """
    pairs = range(-math.ceil(pinion_tip + gear_tip), math.ceil(pinion_tip + gear_tip) + 1)
    edges = {0.0, -gear_tip, pinion_tip}
    edges |= {pinion_tip - k for k in pairs} | {k - gear_tip for k in pairs}
    inside = sorted(edge for edge in edges if -gear_tip <= edge <= pinion_tip)
    total = 0.0
    for low, high in pairwise(inside):
        middle = (low + high) / 2.0
        loaded = sum(-gear_tip < middle + k < pinion_tip for k in pairs)
        total += abs(middle) * (high - low) / loaded
    return 2.0 * math.pi * (ratio + 1.0) / (pinion_teeth * ratio) * total
