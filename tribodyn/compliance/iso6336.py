"""Tooth stiffness after ISO 6336-1, method B: the figures that ours are compared with.

External spur gears with the standard basic rack (20°, addendum 1.0, dedendum 1.2), steel on steel, solid
discs, specific load at least 100 N/mm. Theory after Weber & Banaschek, corrected by measurements.
"""

from typing import Any, NamedTuple

_PER_MM_UM = 1e9  # N/(mm µm) in Pa


class ToothStiffness(NamedTuple):
    """Stiffness of one pair of teeth per face width, in Pa = N/(m m); 1 N/(mm µm) is 1 GPa.

    Parameters
    ----------
    theoretical : float
        c'_th, maximum stiffness of a single pair, from theory.
    single_pair : float
        c' = 0.8 c'_th, with the correction C_M from measurements.
    """

    theoretical: Any
    single_pair: Any


def single_pair_stiffness(
    pinion_teeth: Any, gear_teeth: Any, pinion_shift: Any = 0.0, gear_shift: Any = 0.0
) -> ToothStiffness:
    """Single-pair stiffness of a spur gear pair of solid discs (C_R = 1) with the standard rack (C_B = 1).

    Valid for x1 ≥ x2 and −0.5 ≤ x1 + x2 ≤ 2.

    Parameters
    ----------
    pinion_teeth, gear_teeth : float
        Numbers of teeth z1, z2.
    pinion_shift, gear_shift : float
        Profile shift coefficients x1, x2.

    References
    ----------
    ISO 6336-1:2019, 9.3.2: c'_th = 1/q', q' the series (82), C_M = 0.8.
    """
    z1, z2, x1, x2 = pinion_teeth, gear_teeth, pinion_shift, gear_shift
    flexibility = (
        0.04723
        + 0.15551 / z1
        + 0.25791 / z2
        - 0.00635 * x1
        - 0.11654 * x1 / z1
        - 0.00193 * x2
        - 0.24188 * x2 / z2
        + 0.00529 * x1**2
        + 0.00182 * x2**2
    )
    theoretical = _PER_MM_UM / flexibility
    return ToothStiffness(theoretical, 0.8 * theoretical)
