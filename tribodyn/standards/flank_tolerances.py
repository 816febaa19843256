"""Flank tolerances of cylindrical gears by ISO 1328-1:2013 and :1995: class 5, and √2 from class to class.

The formulas are written from knowledge, without the standards at hand. Printed single pitch tolerances of
class 5 (2013, example 1 of ISO/TR 6336-30:2022) and all of class 6 (1995, a design report) confirm them.
Lengths are in m here, in mm and µm there; values are unrounded, `rounded` gives them as the standard prints
them.
"""

import bisect
import math
from typing import NamedTuple

#: Ranges of validity: teeth; module, reference diameter and face width, m.
TEETH, MODULE, DIAMETER, WIDTH = (5, 1000), (0.5e-3, 70e-3), (5e-3, 15.0), (4e-3, 1.2)
#: The same of 1995, m.
DIAMETER_1995, WIDTH_1995 = (5e-3, 10.0), (4e-3, 1.0)


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


#: Limits of the ranges of ISO 1328-1:1995 (and, of the module, ISO 1328-2:1997), mm, at whose geometric means
#: its tolerances are taken.
_DIAMETERS = (5.0, 20.0, 50.0, 125.0, 280.0, 560.0, 1000.0, 1600.0, 2500.0, 4000.0, 6000.0, 8000.0, 10000.0)
_MODULES = (0.5, 2.0, 3.5, 6.0, 10.0, 16.0, 25.0, 40.0, 70.0)
_WIDTHS = (4.0, 10.0, 20.0, 40.0, 80.0, 160.0, 250.0, 400.0, 650.0, 1000.0)


def _mean_of_range(value: float, limits: tuple[float, ...]) -> float:
    """Geometric mean of the range that a value (mm) lies in; the outer ranges end nowhere."""
    place = min(max(bisect.bisect_left(limits, value), 1), len(limits) - 1)
    return math.sqrt(limits[place - 1] * limits[place])


def flank_tolerances_1995(
    grade: float, module: float, diameter: float, face_width: float, *, ranges: bool = True
) -> FlankTolerances:
    """Tolerances by ISO 1328-1:1995, from m_n, d and b (m), of their ranges or (clause 5.3) exact.

    f_pt = 0.3 (m_n + 0.4 √d) + 4, F_p = 0.3 m_n + 1.25 √d + 7, f_fα = 2.5 √m_n + 0.17 √d + 0.5,
    f_Hα = 2 √m_n + 0.14 √d + 0.5, F_α = 3.2 √m_n + 0.22 √d + 0.7, f_fβ = f_Hβ = 0.07 √d + 0.45 √b + 3,
    F_β = 0.1 √d + 0.63 √b + 4.2, F_r = 0.8 F_p, times (√2)^(Q − 5).
    """
    m, d, b = 1e3 * module, 1e3 * diameter, 1e3 * face_width
    if ranges:
        m, d, b = _mean_of_range(m, _MODULES), _mean_of_range(d, _DIAMETERS), _mean_of_range(b, _WIDTHS)
    step = 1e-6 * math.sqrt(2.0) ** (grade - 5)
    root_m, root_d, root_b = math.sqrt(m), math.sqrt(d), math.sqrt(b)
    total_pitch = step * (0.3 * m + 1.25 * root_d + 7.0)
    helix = step * (0.07 * root_d + 0.45 * root_b + 3.0)
    return FlankTolerances(
        single_pitch=step * (0.3 * (m + 0.4 * root_d) + 4.0),
        total_pitch=total_pitch,
        profile_form=step * (2.5 * root_m + 0.17 * root_d + 0.5),
        profile_slope=step * (2.0 * root_m + 0.14 * root_d + 0.5),
        total_profile=step * (3.2 * root_m + 0.22 * root_d + 0.7),
        helix_form=helix,
        helix_slope=helix,
        total_helix=step * (0.1 * root_d + 0.63 * root_b + 4.2),
        runout=0.8 * total_pitch,
    )


def sector_pitch_1995(grade: float, module: float, diameter: float, pitches: int) -> float:
    """F_pk over so many pitches, m: f_pt + 1.6 √((k − 1) m_n), of the ranges of ISO 1328-1:1995."""
    single = flank_tolerances_1995(grade, module, diameter, 0.01).single_pitch
    step = 1e-6 * math.sqrt(2.0) ** (grade - 5)
    return single + step * 1.6 * math.sqrt((pitches - 1) * _mean_of_range(1e3 * module, _MODULES))


def single_flank_1995(
    grade: float, module: float, diameter: float, total_contact_ratio: float
) -> tuple[float, float]:
    """f_i′ and F_i′ = F_p + f_i′, m, of ISO 1328-1:1995, annex A.

    f_i′ = K (9 + 0.3 m_n + 3.2 √m_n + 0.34 √d), K = 0.2 (ε_γ + 4)/ε_γ below ε_γ = 4, then 0.4.
    """
    m, d = _mean_of_range(1e3 * module, _MODULES), _mean_of_range(1e3 * diameter, _DIAMETERS)
    share = 0.2 * (total_contact_ratio + 4.0) / total_contact_ratio if total_contact_ratio < 4.0 else 0.4
    step = 1e-6 * math.sqrt(2.0) ** (grade - 5)
    tooth = step * share * (9.0 + 0.3 * m + 3.2 * math.sqrt(m) + 0.34 * math.sqrt(d))
    return tooth, tooth + flank_tolerances_1995(grade, module, diameter, 0.01).total_pitch


def rounded(tolerance: float) -> float:
    """Round a tolerance (m) as the standard does: above 10 µm to 1, above 5 µm to 0.5, else to 0.1 µm."""
    micrometres = 1e6 * tolerance
    step = 1.0 if micrometres > 10.0 else 0.5 if micrometres > 5.0 else 0.1
    return 1e-6 * step * round(micrometres / step)


def outside(teeth: int, module: float, diameter: float, face_width: float, edition: int = 2013) -> list[str]:
    """Say which sizes are outside the range of an edition; that of 1995 limits no number of teeth."""
    of_1995 = edition == 1995
    exceeded = []
    for name, value, (least, greatest), factor, unit in (
        ("number of teeth", teeth, (1, math.inf) if of_1995 else TEETH, 1.0, ""),
        ("module", module, MODULE, 1e3, " mm"),
        ("reference diameter", diameter, DIAMETER_1995 if of_1995 else DIAMETER, 1e3, " mm"),
        ("face width", face_width, WIDTH_1995 if of_1995 else WIDTH, 1e3, " mm"),
    ):
        if not least * (1 - 1e-12) <= value <= greatest * (1 + 1e-12):
            limits = f"{factor * least:g} to {factor * greatest:g}{unit}"
            exceeded.append(f"{name} {factor * value:g}{unit}, it is for {limits}")
    return exceeded
