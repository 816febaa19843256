"""Geometry, measures and tolerances of the helical stage of the design report of 2017; mm, degrees, µm.

With suffix e or i: the upper and lower end of what the tolerances leave, as the report names them.
"""

import math
from collections.abc import Callable
from typing import Any

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.helix import contact_lines
from tribodyn.standards.allowances import centre_distance_allowance, thickness_allowances

#: Inputs to the digits of the program's own file of the same minute: 20°, 10°, 1165.9/min, bores to 0.01 mm
#: are printed.
MODULE, ALPHA, HELIX, CENTRES, WIDTH = 14.0, 0.349066, 0.174533, 861.0, 360.0
SPEED = 1165.885417
TEETH, BORES = (24, 95), (179.101, 1193.318)
#: Lower end of the tip diameters' tolerance.
TIP_TOLERANCE = 0.1
TRANSVERSE = math.atan(math.tan(ALPHA) / math.cos(HELIX))
BASE_HELIX = math.asin(math.sin(HELIX) * math.cos(ALPHA))
REFERENCE = (MODULE / math.cos(HELIX) * TEETH[0], MODULE / math.cos(HELIX) * TEETH[1])
BASES = (REFERENCE[0] * math.cos(TRANSVERSE), REFERENCE[1] * math.cos(TRANSVERSE))
PITCH = math.pi * BASES[0] / TEETH[0]
RATIO = TEETH[1] / TEETH[0]


def both(of: Callable[[int], float]) -> tuple[float, float]:
    """What `of` gives of pinion (0) and gear (1)."""
    return of(0), of(1)


def _involute(value: float) -> float:
    return math.tan(value) - value


def working_angle(centres: float = CENTRES) -> float:
    """α_wt, rad."""
    return math.acos(sum(BASES) / 2.0 / centres)


#: x_1 and the tip alteration of −0.938 mm as printed, x_2 by the centre distance.
_SUM = sum(TEETH) * (_involute(working_angle()) - _involute(TRANSVERSE)) / (2.0 * math.tan(ALPHA))
SHIFTS = (0.48, _SUM - 0.48)
ROOTS = both(lambda i: REFERENCE[i] - 2.0 * MODULE * (1.25 - SHIFTS[i]))
TIPS = both(lambda i: REFERENCE[i] + 2.0 * MODULE * (1.0 + SHIFTS[i]) - 2.0 * 0.938)
OVERLAP = WIDTH * math.sin(HELIX) / (math.pi * MODULE)
ALLOWANCE = 1e3 * centre_distance_allowance(6, CENTRES * 1e-3)


def tangent(diameter: float, gear: int) -> float:
    """Length of the tangent to the base circle up to a circle."""
    return math.sqrt(diameter**2 - BASES[gear] ** 2) / 2.0


def path_points(tips: tuple[float, float], centres: float) -> dict[str, tuple[float, float]]:
    """Distances of A to E from both tangent points."""
    whole = centres * math.sin(working_angle(centres))
    start, end = whole - tangent(tips[1], 1), tangent(tips[0], 0)
    pitch_point = BASES[0] / 2.0 * math.tan(working_angle(centres))
    from_pinion = {"A": start, "B": end - PITCH, "C": pitch_point, "D": start + PITCH, "E": end}
    return {name: (place, whole - place) for name, place in from_pinion.items()}


#: nominal, e (greatest tips, least centre distance) and i.
CASES = {
    "": (TIPS, CENTRES),
    "_e": (TIPS, CENTRES - ALLOWANCE),
    "_i": ((TIPS[0] - TIP_TOLERANCE, TIPS[1] - TIP_TOLERANCE), CENTRES + ALLOWANCE),
}


def normal_thickness(gear: int, diameter: float, allowance: float = 0.0) -> float:
    """Normal tooth thickness on a circle."""
    half = (math.pi / 2.0 + 2.0 * SHIFTS[gear] * math.tan(ALPHA) + allowance / MODULE) / TEETH[gear]
    angle = math.acos(min(BASES[gear] / diameter, 1.0))
    across = diameter * (half + _involute(TRANSVERSE) - _involute(angle))
    return across * math.cos(math.atan(math.tan(HELIX) * diameter / REFERENCE[gear]))


def gap(gear: int, diameter: float, allowance: float = 0.0) -> float:
    """Normal gap on a circle; 0 within the base circle."""
    if diameter < BASES[gear]:
        return 0.0
    helix = math.atan(math.tan(HELIX) * diameter / REFERENCE[gear])
    return math.pi * diameter / TEETH[gear] * math.cos(helix) - normal_thickness(gear, diameter, allowance)


def geometry(assemblies: dict[str, Assembly]) -> dict[str, Any]:
    """Everything of sections 1 and 6 that follows from geometry; assemblies nominal, with A_se and A_si."""
    allowances = thickness_ends()
    working = working_angle()
    values = _plain(working) | _limits(allowances) | _paths()
    of_form = {
        name: both(
            lambda i, name=name: 2e3 * float(assemblies[name].tooth(("pinion", "gear")[i]).form_radius)
        )
        for name in assemblies
    }
    values |= {"dFf": of_form[""], "dFf_e": of_form["e"], "dFf_i": of_form["i"]}
    values["cF_e"] = both(lambda i: (values["dNf_e"][i] - of_form["i"][i]) / 2.0)
    values["cF_i"] = both(lambda i: (values["dNf_i"][i] - of_form["e"][i]) / 2.0)
    values["cF0_i"] = both(lambda i: (values["dNf0_i"][i] - of_form["e"][i]) / 2.0)
    for name in ("dFa", "dNa", "dNf", "dFf"):
        for end in "ei":
            values[f"xsi_{name}_{end}"] = both(
                lambda i, name=name, end=end: math.degrees(
                    math.sqrt((values[f"{name}_{end}"][i] / BASES[i]) ** 2 - 1.0)
                )
            )
    values["Lmin"] = 1e3 * float(contact_lines(assemblies[""]).minimum)
    return values


def contact_ratio() -> float:
    """ε_α."""
    points = path_points(TIPS, CENTRES)
    return (points["E"][0] - points["A"][0]) / PITCH


def cut_height() -> float:
    """The greater height of both gears' teeth, roots as they are cut, in the middle of their tolerance."""
    ends = thickness_ends()
    deeper = both(lambda i: -(ends["e"][i] + ends["i"][i]) / (4.0 * math.tan(ALPHA)))
    return max(both(lambda i: (TIPS[i] - ROOTS[i]) / 2.0 + deeper[i]))


def _plain(working: float) -> dict[str, Any]:
    """Nominal geometry."""
    pitch_diameters = both(lambda i: BASES[i] / math.cos(working))
    points = path_points(TIPS, CENTRES)
    addenda = both(lambda i: (TIPS[i] - REFERENCE[i]) / 2.0)
    roots = ROOTS
    active = both(lambda i: math.hypot(BASES[i], 2.0 * points["AE"[i]][i]))
    omega = SPEED * math.pi / 30.0
    slides = both(lambda i: 1e-3 * abs(points["EA"[i]][i] - points["C"][i]) * omega * (1.0 + 1.0 / RATIO))
    speed = omega * pitch_diameters[0] / 2e3

    def sliding(name: str, of: int) -> float:
        first, second = points[name][0], points[name][1] / RATIO
        velocity, other = (first, second) if of == 0 else (second, first)
        return (velocity - other) / velocity

    return {
        "u": RATIO,
        "mt": MODULE / math.cos(HELIX),
        "alft": math.degrees(TRANSVERSE),
        "alfwt": math.degrees(working),
        "alfwt_e": math.degrees(working_angle(CENTRES + ALLOWANCE)),
        "alfwt_i": math.degrees(working_angle(CENTRES - ALLOWANCE)),
        "alfwn": math.degrees(math.atan(math.tan(working) * math.cos(_working_helix(pitch_diameters[0])))),
        "betaw": math.degrees(_working_helix(pitch_diameters[0])),
        "betab": math.degrees(BASE_HELIX),
        "ad": sum(REFERENCE) / 2.0,
        "sn_star": both(lambda i: math.pi / 2.0 + 2.0 * SHIFTS[i] * math.tan(ALPHA)),
        "k_starmn": both(lambda i: addenda[i] - MODULE * (1.0 + SHIFTS[i])),
        "d": REFERENCE,
        "db": BASES,
        "da": TIPS,
        "dFa": TIPS,
        "dNa": TIPS,
        "dw": pitch_diameters,
        "df": roots,
        "c_theoretical": both(lambda i: CENTRES - TIPS[i] / 2.0 - roots[1 - i] / 2.0),
        "dNf": active,
        "ha": addenda,
        "hf": both(lambda i: MODULE * (1.25 - SHIFTS[i])),
        "h": both(lambda i: (TIPS[i] - roots[i]) / 2.0),
        "zn": both(lambda i: TEETH[i] / (math.cos(BASE_HELIX) ** 2 * math.cos(HELIX))),
        "san": both(lambda i: normal_thickness(i, TIPS[i])),
        "sFan": both(lambda i: normal_thickness(i, TIPS[i])),
        "efn": both(lambda i: gap(i, roots[i])),
        "vga": slides,
        "zetaa": both(lambda i: sliding("EA"[i], i)),
        "zetaf": both(lambda i: sliding("AE"[i], i)),
        "zetam": (sliding("E", 0) + sliding("A", 1)) / 2.0,
        "Kga": both(lambda i: slides[i] / speed),
        "Kgf": both(lambda i: -slides[1 - i] / speed),
        "pt": math.pi * MODULE / math.cos(HELIX),
        "pbt": PITCH,
        "pet": PITCH,
        "pz": both(lambda i: math.pi * REFERENCE[i] / math.tan(HELIX)),
        "px": math.pi * MODULE / math.sin(HELIX),
        "eps_b": OVERLAP,
    }


def _working_helix(diameter: float) -> float:
    return math.atan(math.tan(HELIX) * diameter / REFERENCE[0])


def _limits(allowances: dict[str, tuple[float, float]]) -> dict[str, Any]:
    """Diameters and heights between the ends of the tolerances."""
    tips = {"e": TIPS, "i": (TIPS[0] - TIP_TOLERANCE, TIPS[1] - TIP_TOLERANCE)}
    centres = {"e": CENTRES + ALLOWANCE, "i": CENTRES - ALLOWANCE}
    shifts = {
        end: both(lambda i, end=end: SHIFTS[i] + allowances[end][i] / (2.0 * MODULE * math.tan(ALPHA)))
        for end in "ei"
    }
    roots = {
        end: both(lambda i, end=end: REFERENCE[i] - 2.0 * MODULE * (1.25 - shifts[end][i])) for end in "ei"
    }
    values: dict[str, Any] = {}
    for end, other in ("ei", "ie"):
        points = path_points(tips[other], centres[end])
        values |= {
            f"da_{end}": tips[end],
            f"dFa_{end}": tips[end],
            f"dNa_{end}": tips[end],
            f"Ada_{end}": (0.0, 0.0) if end == "e" else (-TIP_TOLERANCE, -TIP_TOLERANCE),
            f"dw_{end}": both(lambda i, end=end: BASES[i] / math.cos(working_angle(centres[end]))),
            f"xE_{end}": shifts[end],
            f"df_{end}": roots[end],
            f"c_{end}": both(
                lambda i, end=end, other=other: (
                    centres[end] - tips[other][i] / 2.0 - roots[other][1 - i] / 2.0
                )
            ),
            f"dNf_{end}": both(lambda i, points=points: math.hypot(BASES[i], 2.0 * points["AE"[i]][i])),
            f"ha_{end}": both(lambda i, end=end: (tips[end][i] - REFERENCE[i]) / 2.0),
            f"hf_{end}": both(lambda i, end=end: MODULE * (1.25 - shifts[end][i])),
            f"san_{end}": both(
                lambda i, end=end, other=other: normal_thickness(i, tips[other][i], allowances[end][i])
            ),
            f"efn_{end}": both(lambda i, end=end: gap(i, roots[end][i], allowances[end][i])),
            f"As_{end}": allowances[end],
            f"Aa_{end}": ALLOWANCE if end == "e" else -ALLOWANCE,
        }
        values[f"sFan_{end}"] = values[f"san_{end}"]
    return values | _tight(allowances, tips["e"], roots["e"])


def _tight(
    allowances: dict[str, tuple[float, float]], tips: tuple[float, float], roots: tuple[float, float]
) -> dict[str, Any]:
    """Backlash, and the centre distance without it."""
    values: dict[str, Any] = {}
    for end in "ei":
        # both gears thinner: inv α_w of contact on both flanks
        thinner = sum(allowances[end])
        both_flanks = _involute(TRANSVERSE) + (2.0 * sum(SHIFTS) * math.tan(ALPHA) + thinner / MODULE) / sum(
            TEETH
        )
        centres = sum(BASES) / 2.0 / math.cos(_inverse(both_flanks))
        far = CENTRES + (ALLOWANCE if end == "i" else -ALLOWANCE)
        angle = working_angle(far)
        pitch_diameter = BASES[0] / math.cos(angle)
        open_by = 2.0 * far * (_involute(angle) - both_flanks)
        wide = "e" if end == "i" else "i"  # the greatest backlash is of the thinnest teeth
        values |= {
            f"aControl_{end}": centres,
            f"jta_{end}": centres - CENTRES,
            f"jtw_{wide}": open_by,
            f"jnw_{wide}": open_by * math.cos(angle) * math.cos(BASE_HELIX),
            f"jrw_{wide}": far - centres,
            f"j_tSys_{wide}": math.degrees(2.0 * open_by / pitch_diameter),
            f"jtw_Aa_{wide}": 2.0 * math.tan(working_angle()) * (far - CENTRES),
        }
        if end == "i":
            points = path_points(tips, centres)
            values["dNf0_i"] = both(lambda i, points=points: math.hypot(BASES[i], 2.0 * points["AE"[i]][i]))
            values["c0_i"] = both(lambda i, centres=centres: centres - tips[i] / 2.0 - roots[1 - i] / 2.0)
    return values


def _inverse(value: float) -> float:
    angle = 0.4
    for _ in range(50):
        angle -= (_involute(angle) - value) / math.tan(angle) ** 2
    return angle


def _paths() -> dict[str, Any]:
    """The path of contact, nominal and at the ends of the tolerances."""
    values: dict[str, Any] = {}
    for end, (tips, centres) in CASES.items():
        points = path_points(tips, centres)
        length = points["E"][0] - points["A"][0]
        values |= {f"T_{name}{end}": place for name, place in points.items()}
        values |= {
            f"g_alpha{end}": length,
            f"T1T2{end}": sum(points["C"]),
            f"d_B{end}": both(lambda i, points=points: math.hypot(BASES[i], 2.0 * points["B"][i])),
            f"d_D{end}": both(lambda i, points=points: math.hypot(BASES[i], 2.0 * points["D"][i])),
            f"eps_a_tip{end}": both(
                lambda i, points=points: abs(points["EA"[i]][0] - points["C"][0]) / PITCH
            ),
        }
        if end:
            values |= {f"eps_alpha{end}": length / PITCH, f"eps_gamma{end}": length / PITCH + OVERLAP}
        else:
            values |= {"eps_a": length / PITCH, "eps_g": length / PITCH + OVERLAP}
    middle = (values["eps_alpha_e"] + values["eps_alpha_i"]) / 2.0
    return values | {"eps_alpha_m": middle, "eps_gamma_m": middle + OVERLAP}


def thickness_ends() -> dict[str, tuple[float, float]]:
    """A_se and A_si of both gears, mm."""
    limits = [thickness_allowances("cd25", d * 1e-3) for d in REFERENCE]
    return {"e": both(lambda i: 1e3 * limits[i][0]), "i": both(lambda i: 1e3 * limits[i][1])}
