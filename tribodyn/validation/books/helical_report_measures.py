"""Measures of tooth thickness and tolerances in the design report of 2017; mm and µm."""

import math
from typing import Any

from tribodyn.geometry.gauges import Involute, over_pins, pin_contact_diameter, span, span_contact_diameter
from tribodyn.standards import flank_tolerances as tolerances
from tribodyn.validation.books.helical_report_geometry import (
    ALPHA,
    HELIX,
    MODULE,
    REFERENCE,
    SHIFTS,
    TEETH,
    TIP_TOLERANCE,
    TIPS,
    TRANSVERSE,
    WIDTH,
    both,
    normal_thickness,
)


def measures(allowances: dict[str, tuple[float, float]]) -> dict[str, Any]:
    """Section 6: spans, balls, pins, chords."""
    gears = [Involute(MODULE, ALPHA, float(z), x, HELIX) for z, x in zip(TEETH, SHIFTS, strict=True)]
    teeth, balls = (4, 13), (28.0, 25.0)
    means = both(lambda i: (allowances["e"][i] + allowances["i"][i]) / 2.0)
    spans = both(lambda i: span(gears[i], teeth[i]))

    def radial(i: int, allowance: float) -> float:
        """M_rK: half of what an even number of teeth would measure."""
        whole = over_pins(gears[i], balls[i], allowance) - balls[i]
        opposite = math.cos(math.pi / (2 * TEETH[i])) if TEETH[i] % 2 else 1.0
        return whole / opposite / 2.0 + balls[i] / 2.0

    def chord(i: int, allowance: float) -> float:
        virtual = REFERENCE[i] / math.cos(HELIX) ** 2
        thickness = MODULE * (math.pi / 2.0 + 2.0 * SHIFTS[i] * math.tan(ALPHA)) + allowance
        return virtual * math.sin(thickness / virtual)

    arcs = both(lambda i: normal_thickness(i, REFERENCE[i]))
    values: dict[str, Any] = {
        "DM": both(lambda i: _theoretical_ball(gears[i], REFERENCE[i] + 2.0 * SHIFTS[i] * MODULE)),
        "Wk": spans,
        "MrK": both(lambda i: radial(i, 0.0)),
        "MdK": both(lambda i: over_pins(gears[i], balls[i])),
        "MdR": both(lambda i: 2.0 * radial(i, 0.0)),
        "d_Wk": both(lambda i: span_contact_diameter(gears[i], span(gears[i], teeth[i], means[i]))),
        "d_MrK": both(lambda i: pin_contact_diameter(gears[i], balls[i], means[i])),
        "sc": both(lambda i: chord(i, 0.0)),
        "sn": arcs,
        "ha_chord": both(
            lambda i: (
                (TIPS[i] - TIP_TOLERANCE / 2.0 - REFERENCE[i]) / 2.0
                + arcs[i] ** 2 * math.cos(HELIX) ** 2 / (4.0 * REFERENCE[i])
            )
        ),
    }
    for end in "ei":
        values |= {
            f"Wk_{end}": both(lambda i, end=end: span(gears[i], teeth[i], allowances[end][i])),
            f"dWk_{end}": both(lambda i, end=end: allowances[end][i] * math.cos(ALPHA)),
            f"MrK_{end}": both(lambda i, end=end: radial(i, allowances[end][i])),
            f"MdK_{end}": both(lambda i, end=end: over_pins(gears[i], balls[i], allowances[end][i])),
            f"MdR_{end}": both(lambda i, end=end: 2.0 * radial(i, allowances[end][i])),
            f"sc_{end}": both(lambda i, end=end: chord(i, allowances[end][i])),
            f"sn_{end}": both(lambda i, end=end: arcs[i] + allowances[end][i]),
        }
    return values


def _theoretical_ball(gear: Involute, diameter: float) -> float:
    """Ball that touches the flanks on a circle."""
    small, large = 1.2 * MODULE, 2.6 * MODULE
    for _ in range(60):
        middle = (small + large) / 2.0
        if pin_contact_diameter(gear, middle) < diameter:
            small = middle
        else:
            large = middle
    return small


def tolerances_1995(total_contact_ratio: float) -> dict[str, Any]:
    """Section 7: class 6 of ISO 1328-1:1995 and -2:1997, µm; as printed, to whole ones."""

    def of(gear: int) -> tolerances.FlankTolerances:
        return tolerances.flank_tolerances_1995(6, MODULE * 1e-3, REFERENCE[gear] * 1e-3, WIDTH * 1e-3)

    def whole(value: float) -> float:
        return 1e6 * tolerances.rounded(value)

    values: dict[str, Any] = {
        name: both(lambda i, field=field: whole(getattr(of(i), field)))
        for name, field in (
            ("fptT", "single_pitch"),
            ("ffaT", "profile_form"),
            ("fHaT", "profile_slope"),
            ("FaT", "total_profile"),
            ("ffbT", "helix_form"),
            ("fHbT", "helix_slope"),
            ("FbT", "total_helix"),
            ("FpT", "total_pitch"),
            ("FrT", "runout"),
        )
    }
    sizes = both(lambda i: REFERENCE[i] * 1e-3)
    composite = [tolerances.single_flank_1995(6, MODULE * 1e-3, size, total_contact_ratio) for size in sizes]
    # ISO 1328-2:1997, annex A, of the mean of the range from 280 to 560 mm; beyond 1000 mm there is none
    mean = (math.sqrt(280.0 * 560.0), REFERENCE[1])
    radial = both(lambda i: math.sqrt(2.0) * (3.2 * MODULE + 1.01 * math.sqrt(mean[i]) + 6.4))
    tooth = both(lambda i: math.sqrt(2.0) * (2.96 * MODULE + 0.01 * math.sqrt(REFERENCE[i]) + 0.8))
    return values | {
        "fpbT": both(lambda i: round(values["fptT"][i] * math.cos(TRANSVERSE), 1)),
        "Fpk8T": both(
            lambda i: whole(tolerances.sector_pitch_1995(6, MODULE * 1e-3, sizes[i], TEETH[i] // 8))
        ),
        "fisT": both(lambda i: whole(composite[i][0])),
        "FisT": both(lambda i: whole(composite[i][1])),
        "FidT": both(lambda i: float(round(radial[i]))),
        "fidT": both(lambda i: float(round(tooth[i]))),
        # ISO/TR 10064-3: bearings twice as far apart as the face is wide
        "fSigbet": values["FbT"][1],
        "fSigdel": 2.0 * values["FbT"][1],
    }
