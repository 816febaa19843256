"""Geometry and measures of the FZG gears of type C in the listing of STplus (DIN 3960); mm, degrees.

Arrays are of (pinion, gear).
"""

import math
from typing import Any

import numpy as np

from tribodyn.geometry.families.involute import involute_function
from tribodyn.geometry.gauges import Involute, over_pins, pin_contact_diameter, span, span_contact_diameter
from tribodyn.standards.allowances import centre_distance_allowance, thickness_allowances
from tribodyn.validation.books import printed, printed_sides

MODULE, ALPHA, CENTRES, WIDTH, TEETH = 4.5, math.radians(20.0), 91.5, 14.0, (16, 24)
#: x_2 follows from the centre distance.
SHIFTS = (0.1818, 0.171380508)
_SHIFTS = np.array(SHIFTS)


def geometry(sheet: dict[str, Any]) -> dict[str, Any]:
    """Geometry by DIN 3960."""

    def of(name: str) -> np.ndarray:
        return np.array([sheet["pinion"][name][0], sheet["gear"][name][0]])

    tips, roots, form = of("tip diameter"), of("root diameter"), of("form diameter")
    active, reference = of("lowest contact diameter"), of("reference diameter")
    working, clearance = of("working pitch diameter"), of("tip clearance")
    ratio = sheet["contact ratio"][0]
    # of the pinion's tip the end of contact, of the gear's its begin
    tip_ends = sheet["end of contact from pitch point"][0], -sheet["start of contact from pitch point"][0]
    common = sum(tips) / 2.0 - CENTRES
    upper, lower = 1e3 * np.transpose([thickness_allowances("c25", d * 1e-3) for d in reference])
    half = math.pi / 2.0 + 2.0 * _SHIFTS * math.tan(ALPHA)
    cut = printed_sides(printed("stplus-fzg-c"), "d_Ff")
    chords = (tips + cut) / 2.0
    angles = np.arccos(of("base diameter") / chords)
    arcs = chords * (half / TEETH + involute_function(ALPHA) - involute_function(angles))
    return {
        "alpha_wt": sheet["operating pressure angle"][0],
        "u": sheet["gear ratio"][0],
        "x_sum": sum(SHIFTS),
        "x": SHIFTS,
        "x_mn": _SHIFTS * MODULE,
        "p_t": math.pi * MODULE,
        "p_et": math.pi * MODULE * math.cos(ALPHA),
        "g_alpha": sum(tip_ends),
        "h_common": common / MODULE,
        "epsilon_alpha": ratio,
        "epsilon_gamma": ratio,
        "d_w": working,
        "d": reference,
        "d_b": of("base diameter"),
        "d_Nf": active,
        "d_Ff": form,
        "c_n": (active - cut) / 2.0,
        "d_f": roots,
        "h_aP": (tips - reference) / (2.0 * MODULE) - _SHIFTS,
        "h": (tips - roots) / 2.0,
        "h_gem": common,
        "h_a": (tips - reference) / 2.0,
        "c": clearance,
        "c_star": clearance / MODULE,
        "g_a": tip_ends,
        "K_ga": np.array(tip_ends) * sum(2.0 / working),
        "zeta_a": of("maximum specific sliding"),
        "zeta_f": of("minimum specific sliding"),
        "A_sne": upper,
        "A_sni": lower,
        "s_t": MODULE * half,
        "e_n": math.pi * MODULE - MODULE * half,
        "s_an": of("tip thickness"),
        "s_chord": chords * np.sin(arcs / chords),
        "h_chord": (tips - chords) / 2.0 + chords / 2.0 * (1.0 - np.cos(arcs / chords)),
        "d_chord": chords,
        "x_E": _SHIFTS + upper / (2.0 * math.tan(ALPHA)) / MODULE,
        "b_d": WIDTH / reference[0],
    }


def measures() -> dict[str, Any]:
    """Spans, balls, and backlash by the allowances."""
    gears = [Involute(MODULE, ALPHA, float(z), x) for z, x in zip(TEETH, SHIFTS, strict=True)]
    teeth, balls = (3, 4), (8.0, 7.5)
    upper, lower = 1e3 * np.transpose([thickness_allowances("c25", z * MODULE * 1e-3) for z in TEETH])
    spans = list(map(span, gears, teeth, upper))
    over, thickest, thinnest = (
        np.array(list(map(over_pins, gears, balls, allowance))) for allowance in (np.zeros(2), upper, lower)
    )
    away = 1e3 * centre_distance_allowance(7, CENTRES * 1e-3)
    angle = math.acos(MODULE * sum(TEETH) / 2.0 * math.cos(ALPHA) / CENTRES)
    open_by = [-sum(ends) * math.cos(ALPHA) for ends in (upper, lower)]
    return {
        "W_k": list(map(span, gears, teeth)),
        "A_We": upper * math.cos(ALPHA),
        "A_Wi": lower * math.cos(ALPHA),
        "A_W_factor": (math.cos(ALPHA), math.cos(ALPHA)),
        "d_Wk": list(map(span_contact_diameter, gears, spans)),
        "M_dK": over,
        "d_MK": list(map(pin_contact_diameter, gears, balls, upper)),
        "A_Mde": thickest - over,
        "A_Mdi": thinnest - over,
        "A_Md_factor": (thickest - over) / upper,
        "A_a": away,
        "j_te": open_by[0] / math.cos(angle),
        "j_ne": open_by[0],
        "j_ti": open_by[1] / math.cos(angle),
        "j_ni": open_by[1],
        "j_ta": 2.0 * away * math.tan(angle),
        "j_na": 2.0 * away * math.sin(angle),
    }
