"""Geometry, measures and tolerances of the helical stage of the design report of 2017; mm, degrees, µm.

Arrays are of (pinion, gear). With suffix e or i: the upper and lower end of what the tolerances leave, as the
report names them.
"""

import math
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.families.involute import inverse_involute, involute_function
from tribodyn.geometry.gauges import Involute, over_pins, pin_contact_diameter, span, span_contact_diameter
from tribodyn.geometry.helix import contact_lines
from tribodyn.standards import flank_tolerances as tolerances
from tribodyn.standards.allowances import centre_distance_allowance, thickness_allowances

#: Inputs to the digits of the program's own file of the same minute: 20°, 10°, 1165.9/min, bores to 0.01 mm
#: are printed.
MODULE, ALPHA, HELIX, CENTRES, WIDTH = 14.0, 0.349066, 0.174533, 861.0, 360.0
SPEED = 1165.885417
TEETH, BORES = (24, 95), np.array([179.101, 1193.318])
#: Lower end of the tip diameters' tolerance.
TIP_TOLERANCE = 0.1
TRANSVERSE = math.atan(math.tan(ALPHA) / math.cos(HELIX))
BASE_HELIX = math.asin(math.sin(HELIX) * math.cos(ALPHA))
REFERENCE = MODULE / math.cos(HELIX) * np.array(TEETH)
BASES = REFERENCE * math.cos(TRANSVERSE)
PITCH = math.pi * BASES[0] / TEETH[0]
RATIO = TEETH[1] / TEETH[0]


def working_angle(centres: float = CENTRES) -> float:
    """α_wt, rad."""
    return math.acos(sum(BASES) / 2.0 / centres)


#: x_1 and the tip alteration of −0.938 mm as printed, x_2 by the centre distance.
_OPENED = float(involute_function(working_angle()) - involute_function(TRANSVERSE))
SHIFTS = np.array([0.48, sum(TEETH) * _OPENED / (2.0 * math.tan(ALPHA)) - 0.48])
ROOTS = REFERENCE - 2.0 * MODULE * (1.25 - SHIFTS)
TIPS = REFERENCE + 2.0 * MODULE * (1.0 + SHIFTS) - 2.0 * 0.938
OVERLAP = WIDTH * math.sin(HELIX) / (math.pi * MODULE)
ALLOWANCE = 1e3 * centre_distance_allowance(6, CENTRES * 1e-3)
#: A_se and A_si.
THICKNESS = dict(
    zip("ei", 1e3 * np.transpose([thickness_allowances("cd25", d * 1e-3) for d in REFERENCE]), strict=True)
)


def path_points(tips: np.ndarray, centres: float) -> dict[str, np.ndarray]:
    """Distances of A to E from both tangent points."""
    whole = centres * math.sin(working_angle(centres))
    end, from_gear = np.sqrt(tips**2 - BASES**2) / 2.0
    start = whole - from_gear
    pitch_point = BASES[0] / 2.0 * math.tan(working_angle(centres))
    from_pinion = {"A": start, "B": end - PITCH, "C": pitch_point, "D": start + PITCH, "E": end}
    return {name: np.array([place, whole - place]) for name, place in from_pinion.items()}


_POINTS = path_points(TIPS, CENTRES)
CONTACT_RATIO = (_POINTS["E"][0] - _POINTS["A"][0]) / PITCH
#: The greater height of both gears' teeth, roots as they are cut, in the middle of their tolerance.
_DEEPER = -(THICKNESS["e"] + THICKNESS["i"]) / (4.0 * math.tan(ALPHA))
CUT_HEIGHT = float(np.max((TIPS - ROOTS) / 2.0 + _DEEPER))


def _active(points: dict[str, np.ndarray]) -> np.ndarray:
    """d_Nf, where contact begins on the pinion and ends on the gear."""
    return np.hypot(BASES, 2.0 * np.array([points["A"][0], points["E"][1]]))


#: Tips and centre distance: nominal, and by the tolerances those of the longest and of the shortest path.
_CASES = {
    "": (TIPS, CENTRES),
    "_e": (TIPS, CENTRES - ALLOWANCE),
    "_i": (TIPS - TIP_TOLERANCE, CENTRES + ALLOWANCE),
}


def _helix(diameter: Any) -> np.ndarray:
    """Helix angle on a circle, rad."""
    return np.arctan(math.tan(HELIX) * diameter / REFERENCE)


def _thickness(diameter: np.ndarray, allowance: Any = 0.0) -> np.ndarray:
    """Normal tooth thickness on a circle."""
    half = (math.pi / 2.0 + 2.0 * SHIFTS * math.tan(ALPHA) + allowance / MODULE) / TEETH
    angle = np.arccos(np.minimum(BASES / diameter, 1.0))
    across = diameter * (half + involute_function(TRANSVERSE) - involute_function(angle))
    return across * np.cos(_helix(diameter))


def _gap(diameter: np.ndarray, allowance: Any = 0.0) -> np.ndarray:
    """Normal gap on a circle; 0 within the base circle."""
    pitch = math.pi * diameter / TEETH * np.cos(_helix(diameter))
    return np.where(diameter < BASES, 0.0, pitch - _thickness(diameter, allowance))


def geometry(assemblies: dict[str, Assembly]) -> dict[str, Any]:
    """Everything of sections 1 and 6 that follows from geometry; assemblies nominal, with A_se and A_si."""
    values = _plain() | _limits() | _paths()
    for end, assembly in assemblies.items():
        form = np.array([2e3 * float(assembly.tooth(side).form_radius) for side in SIDES])
        values[f"dFf_{end}" if end else "dFf"] = form
    values["cF_e"] = (values["dNf_e"] - values["dFf_i"]) / 2.0
    values["cF_i"] = (values["dNf_i"] - values["dFf_e"]) / 2.0
    values["cF0_i"] = (values["dNf0_i"] - values["dFf_e"]) / 2.0
    for name in ("dFa", "dNa", "dNf", "dFf"):
        for end in "ei":
            values[f"xsi_{name}_{end}"] = np.degrees(np.sqrt((values[f"{name}_{end}"] / BASES) ** 2 - 1.0))
    return values | {"Lmin": 1e3 * float(contact_lines(assemblies[""]).minimum)}


def _plain() -> dict[str, Any]:
    """Nominal geometry."""
    working, omega = working_angle(), SPEED * math.pi / 30.0
    pitch_diameters = BASES / math.cos(working)
    working_helix = _helix(pitch_diameters[0])[0]
    points, addenda = _POINTS, (TIPS - REFERENCE) / 2.0
    tip_places = np.array([points["E"][0], points["A"][1]])
    slides = 1e-3 * np.abs(tip_places - points["C"]) * omega * (1.0 + 1.0 / RATIO)
    speed = omega * pitch_diameters[0] / 2e3

    def sliding(name: str, of: int) -> float:
        velocities = points[name] / (1.0, RATIO)
        return (velocities[of] - velocities[1 - of]) / velocities[of]

    at_tips, at_roots = [sliding("E", 0), sliding("A", 1)], [sliding("A", 0), sliding("E", 1)]
    return {
        "u": RATIO,
        "mt": MODULE / math.cos(HELIX),
        "alft": math.degrees(TRANSVERSE),
        "alfwt": math.degrees(working),
        "alfwt_e": math.degrees(working_angle(CENTRES + ALLOWANCE)),
        "alfwt_i": math.degrees(working_angle(CENTRES - ALLOWANCE)),
        "alfwn": math.degrees(math.atan(math.tan(working) * math.cos(working_helix))),
        "betaw": math.degrees(working_helix),
        "betab": math.degrees(BASE_HELIX),
        "ad": sum(REFERENCE) / 2.0,
        "sn_star": math.pi / 2.0 + 2.0 * SHIFTS * math.tan(ALPHA),
        "k_starmn": addenda - MODULE * (1.0 + SHIFTS),
        "d": REFERENCE,
        "db": BASES,
        **dict.fromkeys(("da", "dFa", "dNa"), TIPS),
        "dw": pitch_diameters,
        "df": ROOTS,
        "c_theoretical": CENTRES - TIPS / 2.0 - ROOTS[::-1] / 2.0,
        "dNf": _active(points),
        "ha": addenda,
        "hf": MODULE * (1.25 - SHIFTS),
        "h": (TIPS - ROOTS) / 2.0,
        "zn": np.array(TEETH) / (math.cos(BASE_HELIX) ** 2 * math.cos(HELIX)),
        **dict.fromkeys(("san", "sFan"), _thickness(TIPS)),
        "efn": _gap(ROOTS),
        "vga": slides,
        "zetaa": at_tips,
        "zetaf": at_roots,
        "zetam": sum(at_tips) / 2.0,
        "Kga": slides / speed,
        "Kgf": -slides[::-1] / speed,
        "pt": math.pi * MODULE / math.cos(HELIX),
        **dict.fromkeys(("pbt", "pet"), PITCH),
        "pz": math.pi * REFERENCE / math.tan(HELIX),
        "px": math.pi * MODULE / math.sin(HELIX),
        "eps_b": OVERLAP,
    }


def _limits() -> dict[str, Any]:
    """Diameters and heights between the ends of the tolerances."""
    tips = {"e": TIPS, "i": TIPS - TIP_TOLERANCE}
    centres = {"e": CENTRES + ALLOWANCE, "i": CENTRES - ALLOWANCE}
    shifts = {end: SHIFTS + of / (2.0 * MODULE * math.tan(ALPHA)) for end, of in THICKNESS.items()}
    roots = {end: REFERENCE - 2.0 * MODULE * (1.25 - shift) for end, shift in shifts.items()}
    values: dict[str, Any] = {}
    for (end, other), tip, away in (("ei", 0.0, ALLOWANCE), ("ie", -TIP_TOLERANCE, -ALLOWANCE)):
        values |= {
            **dict.fromkeys((f"da_{end}", f"dFa_{end}", f"dNa_{end}"), tips[end]),
            f"Ada_{end}": (tip, tip),
            f"dw_{end}": BASES / math.cos(working_angle(centres[end])),
            f"xE_{end}": shifts[end],
            f"df_{end}": roots[end],
            f"c_{end}": centres[end] - tips[other] / 2.0 - roots[other][::-1] / 2.0,
            f"dNf_{end}": _active(path_points(tips[other], centres[end])),
            f"ha_{end}": (tips[end] - REFERENCE) / 2.0,
            f"hf_{end}": MODULE * (1.25 - shifts[end]),
            f"san_{end}": _thickness(tips[other], THICKNESS[end]),
            f"efn_{end}": _gap(roots[end], THICKNESS[end]),
            f"As_{end}": THICKNESS[end],
            f"Aa_{end}": away,
        }
        values[f"sFan_{end}"] = values[f"san_{end}"]
    return values | _tight(tips["e"], roots["e"])


def _tight(tips: np.ndarray, roots: np.ndarray) -> dict[str, Any]:
    """Backlash, and the centre distance without it."""
    values: dict[str, Any] = {}
    for end, wide in ("ei", "ie"):  # the greatest backlash is of the thinnest teeth
        # both gears thinner: inv α_w of contact on both flanks
        thinner = sum(THICKNESS[end])
        closed = (2.0 * sum(SHIFTS) * math.tan(ALPHA) + thinner / MODULE) / sum(TEETH)
        both_flanks = float(involute_function(TRANSVERSE)) + closed
        centres = sum(BASES) / 2.0 / math.cos(float(inverse_involute(both_flanks)))
        far = CENTRES + (ALLOWANCE if end == "i" else -ALLOWANCE)
        angle = working_angle(far)
        open_by = 2.0 * far * (float(involute_function(angle)) - both_flanks)
        values |= {
            f"aControl_{end}": centres,
            f"jta_{end}": centres - CENTRES,
            f"jtw_{wide}": open_by,
            f"jnw_{wide}": open_by * math.cos(ALPHA) * math.cos(HELIX),  # as the report does
            f"jrw_{wide}": far - centres,
            f"j_tSys_{wide}": math.degrees(2.0 * open_by / (BASES[0] / math.cos(angle))),
            f"jtw_Aa_{wide}": 2.0 * math.tan(working_angle()) * (far - CENTRES),
        }
    # the last end: the thinnest teeth
    values["dNf0_i"] = _active(path_points(tips, values["aControl_i"]))
    values["c0_i"] = values["aControl_i"] - tips / 2.0 - roots[::-1] / 2.0
    return values


def _paths() -> dict[str, Any]:
    """The path of contact, nominal and at the ends of the tolerances."""
    values: dict[str, Any] = {}
    for end, (tips, centres) in _CASES.items():
        points = path_points(tips, centres)
        tip_places = np.array([points["E"][0], points["A"][0]])
        length = tip_places[0] - tip_places[1]
        transverse, total = ("eps_alpha", "eps_gamma") if end else ("eps_a", "eps_g")
        values |= {f"T_{name}{end}": place for name, place in points.items()}
        values |= {
            f"g_alpha{end}": length,
            f"T1T2{end}": sum(points["C"]),
            f"d_B{end}": np.hypot(BASES, 2.0 * points["B"]),
            f"d_D{end}": np.hypot(BASES, 2.0 * points["D"]),
            f"eps_a_tip{end}": np.abs(tip_places - points["C"][0]) / PITCH,
            f"{transverse}{end}": length / PITCH,
            f"{total}{end}": length / PITCH + OVERLAP,
        }
    middle = (values["eps_alpha_e"] + values["eps_alpha_i"]) / 2.0
    return values | {"eps_alpha_m": middle, "eps_gamma_m": middle + OVERLAP}


def measures() -> dict[str, Any]:
    """Section 6: spans, balls, pins, chords."""
    gears = [Involute(MODULE, ALPHA, float(z), x, HELIX) for z, x in zip(TEETH, SHIFTS, strict=True)]
    teeth, balls = (4, 13), np.array([28.0, 25.0])
    none, mean = np.zeros(2), (THICKNESS["e"] + THICKNESS["i"]) / 2.0
    opposite = np.array([math.cos(math.pi / (2 * z)) if z % 2 else 1.0 for z in TEETH])
    virtual = REFERENCE / math.cos(HELIX) ** 2
    arcs = _thickness(REFERENCE)

    def spans(allowance: np.ndarray) -> np.ndarray:
        return np.array(list(map(span, gears, teeth, allowance)))

    def pins(allowance: np.ndarray) -> np.ndarray:
        return np.array(list(map(over_pins, gears, balls, allowance)))

    def radial(allowance: np.ndarray) -> np.ndarray:
        """M_rK: half of what an even number of teeth would measure."""
        return (pins(allowance) - balls) / opposite / 2.0 + balls / 2.0

    def chord(allowance: np.ndarray) -> np.ndarray:
        thickness = MODULE * (math.pi / 2.0 + 2.0 * SHIFTS * math.tan(ALPHA)) + allowance
        return virtual * np.sin(thickness / virtual)

    height = (TIPS - TIP_TOLERANCE / 2.0 - REFERENCE) / 2.0
    values: dict[str, Any] = {
        "DM": list(map(_theoretical_ball, gears, REFERENCE + 2.0 * SHIFTS * MODULE)),
        "d_Wk": list(map(span_contact_diameter, gears, spans(mean))),
        "d_MrK": list(map(pin_contact_diameter, gears, balls, mean)),
        "ha_chord": height + arcs**2 * math.cos(HELIX) ** 2 / (4.0 * REFERENCE),
    }
    for end, allowance in {"": none, **{f"_{end}": of for end, of in THICKNESS.items()}}.items():
        values |= {
            f"Wk{end}": spans(allowance),
            f"dWk{end}": allowance * math.cos(ALPHA),
            f"MrK{end}": radial(allowance),
            f"MdK{end}": pins(allowance),
            f"MdR{end}": 2.0 * radial(allowance),
            f"sc{end}": chord(allowance),
            f"sn{end}": arcs + allowance,
        }
    return values


def _theoretical_ball(gear: Involute, diameter: float) -> float:
    """Ball that touches the flanks on a circle."""
    from scipy.optimize import brentq

    def beyond(ball: float) -> float:
        return pin_contact_diameter(gear, ball) - diameter

    ball: Any = brentq(beyond, 1.2 * MODULE, 2.6 * MODULE, xtol=1e-12)
    return float(ball)


def tolerances_1995(total_contact_ratio: float) -> dict[str, Any]:
    """Section 7: class 6 of ISO 1328-1:1995 and -2:1997, µm; as printed, to whole ones."""
    module, sizes = MODULE * 1e-3, REFERENCE * 1e-3
    of = [tolerances.flank_tolerances_1995(6, module, size, WIDTH * 1e-3) for size in sizes]

    def whole(values: Any) -> list[float]:
        return [1e6 * tolerances.rounded(value) for value in values]

    fields = {
        "fptT": "single_pitch",
        "ffaT": "profile_form",
        "fHaT": "profile_slope",
        "FaT": "total_profile",
        "ffbT": "helix_form",
        "fHbT": "helix_slope",
        "FbT": "total_helix",
        "FpT": "total_pitch",
        "FrT": "runout",
    }
    values = {name: whole(getattr(gear, field) for gear in of) for name, field in fields.items()}
    tooth, total = np.transpose(
        [tolerances.single_flank_1995(6, module, size, total_contact_ratio) for size in sizes]
    )
    sectors = [
        tolerances.sector_pitch_1995(6, module, size, z // 8) for size, z in zip(sizes, TEETH, strict=True)
    ]
    # ISO 1328-2:1997, annex A, of the mean of the range from 280 to 560 mm; beyond 1000 mm there is none
    mean = np.array([math.sqrt(280.0 * 560.0), REFERENCE[1]])
    return values | {
        "fpbT": [round(pitch * math.cos(TRANSVERSE), 1) for pitch in values["fptT"]],
        "Fpk8T": whole(sectors),
        "fisT": whole(tooth),
        "FisT": whole(total),
        "FidT": np.round(math.sqrt(2.0) * (3.2 * MODULE + 1.01 * np.sqrt(mean) + 6.4)),
        "fidT": np.round(math.sqrt(2.0) * (2.96 * MODULE + 0.01 * np.sqrt(REFERENCE) + 0.8)),
        # ISO/TR 10064-3: bearings twice as far apart as the face is wide
        "fSigbet": values["FbT"][1],
        "fSigdel": 2.0 * values["FbT"][1],
    }
