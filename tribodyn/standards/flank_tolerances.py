"""Flank tolerances of cylindrical gears by ISO 1328-1:2013, clause 5: class 5, and √2 from class to class.

The formulas are written from knowledge, without the standard at hand. Lengths are in m here, in mm and µm
there; values are unrounded, `rounded` gives them as the standard prints them.
"""

import math
from typing import NamedTuple

#: Ranges of validity: teeth; module, reference diameter and face width, m.
TEETH, MODULE, DIAMETER, WIDTH = (5, 1000), (0.5e-3, 70e-3), (5e-3, 15.0), (4e-3, 1.2)


class FlankTolerances(NamedTuple):
    """Tolerances of one gear, m."""

    single_pitch: float  # f_pT, of either sign
    total_pitch: float  # F_pT, range of the index deviations
    profile_form: float  # f_fαT
    profile_slope: float  # f_HαT, of either sign
    total_profile: float
    helix_form: float  # f_fβT
    helix_slope: float  # f_HβT, of either sign, over the face width
    total_helix: float
    runout: float


def flank_tolerances(grade: float, module: float, diameter: float, face_width: float) -> FlankTolerances:
    """Tolerances of a gear of a tolerance class, from m_n, d and b (m).

    f_pT = 0.001 d + 0.4 m_n + 5, F_pT = 0.002 d + 0.55 √d + 0.7 m_n + 12, f_HαT = 0.4 m_n + 0.001 d + 4,
    f_fαT = 0.55 m_n + 5, f_HβT = 0.05 √d + 0.35 √b + 4, f_fβT = 0.07 √d + 0.45 √b + 4, times (√2)^(A − 5);
    F_αT and F_βT are the roots of the sums of squares, F_rT = 0.9 F_pT.
    """
    m, d, b = 1e3 * module, 1e3 * diameter, 1e3 * face_width
    step = 1e-6 * math.sqrt(2.0) ** (grade - 5)
    total_pitch = step * (0.002 * d + 0.55 * math.sqrt(d) + 0.7 * m + 12.0)
    profile_form, profile_slope = step * (0.55 * m + 5.0), step * (0.4 * m + 0.001 * d + 4.0)
    helix_form = step * (0.07 * math.sqrt(d) + 0.45 * math.sqrt(b) + 4.0)
    helix_slope = step * (0.05 * math.sqrt(d) + 0.35 * math.sqrt(b) + 4.0)
    return FlankTolerances(
        single_pitch=step * (0.001 * d + 0.4 * m + 5.0),
        total_pitch=total_pitch,
        profile_form=profile_form,
        profile_slope=profile_slope,
        total_profile=math.hypot(profile_form, profile_slope),
        helix_form=helix_form,
        helix_slope=helix_slope,
        total_helix=math.hypot(helix_form, helix_slope),
        runout=0.9 * total_pitch,
    )


def rounded(tolerance: float) -> float:
    """Round a tolerance (m) as the standard does: above 10 µm to 1, above 5 µm to 0.5, else to 0.1 µm."""
    micrometres = 1e6 * tolerance
    step = 1.0 if micrometres > 10.0 else 0.5 if micrometres > 5.0 else 0.1
    return 1e-6 * step * round(micrometres / step)


def outside(teeth: int, module: float, diameter: float, face_width: float) -> list[str]:
    """Say which sizes are outside the standard's range."""
    found = []
    for name, value, (least, greatest), factor, unit in (
        ("number of teeth", teeth, TEETH, 1.0, ""),
        ("module", module, MODULE, 1e3, " mm"),
        ("reference diameter", diameter, DIAMETER, 1e3, " mm"),
        ("face width", face_width, WIDTH, 1e3, " mm"),
    ):
        if not least * (1 - 1e-12) <= value <= greatest * (1 + 1e-12):
            limits = f"{factor * least:g} to {factor * greatest:g}{unit}"
            found.append(f"{name} {factor * value:g}{unit}, it is for {limits}")
    return found
