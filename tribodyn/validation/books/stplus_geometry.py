"""Geometry and measures of the FZG gears of type C in the listing of STplus (DIN 3960); mm, degrees."""

import math
from collections.abc import Callable
from typing import Any

from tribodyn.geometry.gauges import Involute, over_pins, pin_contact_diameter, span, span_contact_diameter
from tribodyn.standards.allowances import centre_distance_allowance, thickness_allowances

MODULE, ALPHA, CENTRES, WIDTH, TEETH = 4.5, math.radians(20.0), 91.5, 14.0, (16, 24)
#: x_2 follows from the centre distance.
SHIFTS = (0.1818, 0.171380508)


def pair(of: Callable[[int], float]) -> tuple[float, float]:
    """What `of` gives of pinion (0) and gear (1)."""
    return of(0), of(1)


def _involutes() -> tuple[Involute, Involute]:
    first, second = (Involute(MODULE, ALPHA, float(z), x) for z, x in zip(TEETH, SHIFTS, strict=True))
    return first, second


def geometry(sheet: dict[str, Any]) -> dict[str, Any]:
    """Geometry by DIN 3960."""

    def of(name: str) -> tuple[float, float]:
        return sheet["pinion"][name][0], sheet["gear"][name][0]

    tips, roots, form = of("tip diameter"), of("root diameter"), of("form diameter")
    active, reference, working = (
        of("lowest contact diameter"),
        of("reference diameter"),
        of("working pitch diameter"),
    )
    base, clearance = of("base diameter"), of("tip clearance")
    pitch = math.pi * MODULE * math.cos(ALPHA)
    ratio = sheet["contact ratio"][0]
    ends = -sheet["start of contact from pitch point"][0], sheet["end of contact from pitch point"][0]
    tip_ends = ends[1], ends[0]
    common = sum(tips) / 2.0 - CENTRES
    allowances = [thickness_allowances("c25", d * 1e-3) for d in reference]
    shifted = [1e3 * upper[0] / (2.0 * math.tan(ALPHA)) for upper in allowances]
    thickness = pair(lambda i: MODULE * (math.pi / 2.0 + 2.0 * SHIFTS[i] * math.tan(ALPHA)))
    chords = pair(lambda i: (tips[i] + form[i]) / 2.0)
    arcs = pair(lambda i: _arc(i, chords[i]))
    height = pair(
        lambda i: (tips[i] - chords[i]) / 2.0 + chords[i] / 2.0 * (1.0 - math.cos(arcs[i] / chords[i]))
    )
    return {
        "alpha_wt": sheet["operating pressure angle"][0],
        "u": sheet["gear ratio"][0],
        "x_sum": sum(SHIFTS),
        "x": SHIFTS,
        "x_mn": pair(lambda i: SHIFTS[i] * MODULE),
        "p_t": math.pi * MODULE,
        "p_et": pitch,
        "g_alpha": sum(ends),
        "h_common": common / MODULE,
        "epsilon_alpha": ratio,
        "epsilon_gamma": ratio,
        "d_w": working,
        "d": reference,
        "d_b": base,
        "d_Nf": active,
        "d_Ff": form,
        "c_n": pair(lambda i: (active[i] - form[i]) / 2.0),
        "d_f": roots,
        "h_aP": pair(lambda i: (tips[i] - reference[i]) / (2.0 * MODULE) - SHIFTS[i]),
        "h": pair(lambda i: (tips[i] - roots[i]) / 2.0),
        "h_gem": common,
        "h_a": pair(lambda i: (tips[i] - reference[i]) / 2.0),
        "c": clearance,
        "c_star": pair(lambda i: clearance[i] / MODULE),
        "g_a": tip_ends,
        "K_ga": pair(lambda i: tip_ends[i] * (2.0 / working[0] + 2.0 / working[1]) * working[i] / working[i]),
        "zeta_a": of("maximum specific sliding"),
        "zeta_f": of("minimum specific sliding"),
        "A_sne": pair(lambda i: 1e3 * allowances[i][0]),
        "A_sni": pair(lambda i: 1e3 * allowances[i][1]),
        "s_t": thickness,
        "e_n": pair(lambda i: math.pi * MODULE - thickness[i]),
        "s_an": of("tip thickness"),
        "s_chord": pair(lambda i: chords[i] * math.sin(arcs[i] / chords[i])),
        "h_chord": height,
        "d_chord": chords,
        "x_E": pair(lambda i: SHIFTS[i] + shifted[i] / MODULE),
        "b_d": WIDTH / reference[0],
    }


def _arc(gear: int, diameter: float) -> float:
    """Thickness on a circle, nominal."""
    involute = _involutes()[gear]
    angle = math.acos(involute.base_diameter / diameter)
    return diameter * (
        (math.pi / 2.0 + 2.0 * SHIFTS[gear] * math.tan(ALPHA)) / TEETH[gear]
        + (math.tan(ALPHA) - ALPHA)
        - (math.tan(angle) - angle)
    )


def measures() -> dict[str, Any]:
    """Spans, balls, and backlash by the allowances."""
    gears, teeth, balls = _involutes(), (3, 4), (8.0, 7.5)
    limits = [thickness_allowances("c25", z * MODULE * 1e-3) for z in TEETH]
    upper, lower = ([1e3 * limit[end] for limit in limits] for end in (0, 1))
    spans = pair(lambda i: span(gears[i], teeth[i]))
    over = pair(lambda i: over_pins(gears[i], balls[i]))
    away = 1e3 * centre_distance_allowance(7, CENTRES * 1e-3)
    angle = math.acos(MODULE * sum(TEETH) / 2.0 * math.cos(ALPHA) / CENTRES)
    open_by = [-sum(ends) * math.cos(ALPHA) for ends in (upper, lower)]

    def of_balls(ends: list[float]) -> tuple[float, float]:
        return pair(lambda i: over_pins(gears[i], balls[i], ends[i]) - over[i])

    return {
        "W_k": spans,
        "A_We": pair(lambda i: upper[i] * math.cos(ALPHA)),
        "A_Wi": pair(lambda i: lower[i] * math.cos(ALPHA)),
        "A_W_factor": (math.cos(ALPHA), math.cos(ALPHA)),
        "d_Wk": pair(lambda i: span_contact_diameter(gears[i], span(gears[i], teeth[i], upper[i]))),
        "M_dK": over,
        "d_MK": pair(lambda i: pin_contact_diameter(gears[i], balls[i], upper[i])),
        "A_Mde": of_balls(upper),
        "A_Mdi": of_balls(lower),
        "A_Md_factor": pair(lambda i: of_balls(upper)[i] / upper[i]),
        "A_a": away,
        "j_te": open_by[0] / math.cos(angle),
        "j_ne": open_by[0],
        "j_ti": open_by[1] / math.cos(angle),
        "j_ni": open_by[1],
        "j_ta": 2.0 * away * math.tan(angle),
        "j_na": 2.0 * away * math.sin(angle),
    }
