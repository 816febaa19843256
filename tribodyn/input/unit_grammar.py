"""Units as they are written: the common ones, the form of the others, hints for what engineers write.

A unit is names joined by * and /, small exponents, one pair of brackets. Pint reads more than that, as
Python's tokenizer does: `rad//s`, `rad/s!` and towers of powers among it. To import pint takes as long as all
else that a run reads its scenario with, so the common units stand here.
"""

import re

#: Characters of a quantity, number and unit, at most.
LONGEST = 80
#: What is said of a unit that is none.
RULE = "not a unit: names joined by * and /, with exponents from -9 to 9"

_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_POWER = r"-?\d(?:\.\d{1,3})?"
_TOKEN = re.compile(
    rf"""(?P<blank>\s*)(?:
        (?P<operand>[^\W\d_{_RAISED}][^\W{_RAISED}]*|°[A-Za-z]?|[%‰]|1(?![\d.]))
        |(?P<power>(?:\*\*|\^)\s*(?:{_POWER}|\(\s*{_POWER}\s*\))|⁻?[{_RAISED}])
        |(?P<operator>[*/·⋅])
        |(?P<opening>\()
        |(?P<closing>\))
    )""",
    re.VERBOSE,
)


def is_unit(text: str) -> bool:
    """Whether a text has the form of a unit; whether there is such a unit is another question."""
    if len(text) > LONGEST:
        return False
    before, depth, at = "operator", 0, 0
    text = text.strip()
    while at < len(text):
        token = _TOKEN.match(text, at)
        if token is None:
            return False
        kind = str(token.lastgroup)
        joined = before in _ENDS and kind in ("operand", "opening") and not token["blank"]
        if joined or before not in _AFTER[kind]:
            return False
        depth += (kind == "opening") - (kind == "closing")
        before, at = kind, token.end()
        if not 0 <= depth <= 1:
            return False
    return depth == 0 and before in _ENDS


_ENDS = ("operand", "power", "closing")
#: Token -> those that it may follow; a blank between two names multiplies them.
_AFTER = {
    "operand": ("operator", "opening", *_ENDS),
    "power": ("operand", "closing"),
    "operator": _ENDS,
    "opening": ("operator", "operand", "power"),
    "closing": _ENDS,
}


#: As pint has them: kind of quantity -> unit, spelled as TOML has it -> factor to the kind's SI unit.
COMMON_UNITS: dict[str, dict[str, float]] = {
    "length": {"m": 1.0, "cm": 0.01, "mm": 0.001, "um": 1e-06, "µm": 1e-06, "nm": 1e-09},
    "angular speed": {"rad/s": 1.0, "rpm": 0.10471975511965977},
    "angle": {
        "rad": 1.0,
        "mrad": 0.001,
        "deg": 0.017453292519943295,
        "arcmin": 0.00029088820866572163,
        "arcsec": 4.84813681109536e-06,
    },
    "frequency": {"Hz": 6.283185307179586, "kHz": 6283.185307179586, "rad/s": 1.0},
    "time": {"s": 1.0, "ms": 0.001, "us": 1e-06},
    "power": {"W": 1.0, "kW": 1000.0},
    "torque": {"N*m": 1.0, "Nm": 1.0, "kN*m": 1000.0, "N*mm": 0.001},
    "force": {"N": 1.0, "kN": 1000.0},
    "volume": {"l": 0.001, "m**3": 1.0},
    "volume flow": {"l/min": 0.001 / 60.0, "m**3/s": 1.0},
    "thermal conductance": {"W/K": 1.0},
    "area": {"m**2": 1.0, "cm**2": 1e-4, "mm**2": 1e-6},
    "heat transfer coefficient": {"W/(m**2*K)": 1.0},
    "mass": {"kg": 1.0, "g": 0.001},
    "moment of inertia": {"kg*m**2": 1.0, "kg*m^2": 1.0},
    "stiffness": {"N/m": 1.0, "N/mm": 1000.0, "N/um": 1000000.0},
    "torsional stiffness": {"N*m/rad": 1.0, "Nm/rad": 1.0},
    "torsional damping": {"N*m*s/rad": 1.0},
    "pressure": {"Pa": 1.0, "kPa": 1000.0, "MPa": 1000000.0, "GPa": 1000000000.0, "N/mm**2": 1000000.0},
    "density": {"kg/m**3": 1.0, "kg/m^3": 1.0, "g/cm**3": 999.9999999999999},
    "thermal conductivity": {"W/(m*K)": 1.0},
    "specific heat": {"J/(kg*K)": 1.0},
    "kinematic viscosity": {"mm**2/s": 1e-06, "mm^2/s": 1e-06, "mm²/s": 1e-06, "cSt": 1e-06, "m**2/s": 1.0},
    "dynamic viscosity": {"Pa*s": 1.0, "mPa*s": 0.001},
    "pressure-viscosity coefficient": {"1/Pa": 1.0, "1/GPa": 1e-09, "1/MPa": 1e-06},
    "temperature coefficient": {"1/K": 1.0},
    "wear coefficient": {"m**2/N": 1.0, "m^2/N": 1.0, "mm**3/(N*m)": 1e-09, "mm**3/J": 1e-09},
}

#: Units that pint does not know by these names: kind of quantity -> unit -> factor to the kind's SI unit.
OWN_UNITS: dict[str, dict[str, float]] = {
    "angular speed": dict.fromkeys(("rev/min", "r/min"), 0.10471975511965977),
    "power": {"PS": 75.0 * 9.80665},  # DIN 66036: 75 kp m/s
    "pressure": {"HV": 9.80665e6},  # Vickers hardness: kp/mm²
}

_COMMA = re.compile(r"\s*(?P<before>[+-]?\d+),(?P<after>\d+)(?P<rest>[^,]*)", re.ASCII)
_TURNS = re.compile(r"(1\s*/\s*min|min\s*(\^|\*\*)?\s*-\s*1|min⁻¹|/\s*min|[uU]/min)")
#: Written without the sign of multiplication -> as it must be written.
_JOINED = {
    **dict.fromkeys(("N.m", "N-m"), "N*m"),
    "Pas": "Pa*s",
    "mPas": "mPa*s",
    "kNm": "kN*m",
    "Nmm": "N*mm",
    "kgm2": "kg*m^2",
    "kgm²": "kg*m^2",
    "kgm^2": "kg*m^2",
    "Nms/rad": "N*m*s/rad",
    "kNm/rad": "kN*m/rad",
}
_EXPONENT = re.compile(r"(?<=[A-Za-zµ])([2-9])(?![\w.])")
_KINEMATIC = re.compile(r"([cm]?m\s*(²|\^2|\*\*2|2)\s*/\s*s|c?St)")


_END = r"\d+(?:\.\d+)?+(?:[eE][+-]?\d+)?+"
_UNIT = r"[^\d\s.:,/-][^\d.:,-]*?"
_RANGE = re.compile(
    rf"\s*(?P<first>[+-]?{_END})\s*(?P<unit>{_UNIT})?\s*(?:-|–|—|:|\.{{2,3}}|…|\bto\b)\s*"
    rf"(?P<last>{_END})\s*(?:/\s*\d+\s*)?(?(unit)(?P=unit)|(?P<own>{_UNIT})?)\s*",
    re.ASCII,
)


def two_ends(value: str) -> tuple[str, str, str] | None:
    """First, last and unit of a range that is written as in a sentence, "500-6000 rpm"; None: it is none."""
    match = _RANGE.fullmatch(value)
    unit = (match["own"] or match["unit"] or "") if match else ""
    return (match["first"], match["last"], unit) if match and unit.isprintable() else None


def range_for_one(value: str) -> tuple[str, str] | None:
    """Rule and remedy for a range where one number is due; None where it is none."""
    ends = two_ends(value)
    if ends is None:
        return None
    first, last, unit = ends
    one = f'"{first} {unit}"' if unit else first
    vary = f"tribodyn sweep SCENARIO --vary KEY={first}:{last}/20{unit}"
    return "a range, where one value is expected", f"write {one}, or vary it: {vary}"


def decimal_comma(value: str) -> tuple[str, str] | None:
    """Rule and remedy for a number with a comma in it; None where there is none."""
    match = _COMMA.fullmatch(value)
    if match is None:
        return None
    point = f"{match['before']}.{match['after']}{match['rest']}".strip()
    if len(match["after"]) != 3:
        return "a comma in a number", f'write a decimal point: "{point}"'
    whole = f"{match['before']}{match['after']}{match['rest']}".strip()
    return "a comma in a number", f'write "{point}" or "{whole}", whichever is meant'


def spelling(number: str, unit: str, what: str) -> tuple[str, str] | None:
    """Rule and remedy for a unit that is not spelled as here, or is of something close; None: no hint.

    Number (empty for a unit alone) and unit are as they were given; `what` is the kind of quantity due.
    """
    unit = unit.strip()

    def written(right: str) -> str:
        return f'write "{f"{number} {right}".strip()}"'

    if what == "angular speed" and _TURNS.fullmatch(unit):
        return f'"{unit}" leaves open whether turns or radians are meant', written("rpm")
    if unit in _JOINED:
        return f'"{unit}" needs a sign of multiplication', written(_JOINED[unit])
    alike = [candidate for candidate in COMMON_UNITS.get(what, ()) if candidate.casefold() == unit.casefold()]
    if len(alike) == 1:
        return f'"{unit}" is not a unit of {what}: capitals count', written(alike[0])
    if what == "power" and unit.casefold() in ("hp", "bhp"):
        return f'"{unit}" is not a unit here', f"{written('hp')} of 745.7 W or {written('PS')[6:]} of 735.5 W"
    if what == "dynamic viscosity" and _KINEMATIC.fullmatch(unit):
        example = '100 mm²/s at 850 kg/m³ are "85 mPa*s"'
        return f'"{unit}" is a unit of kinematic viscosity', f"give it times the density: {example}"
    if (raised := _EXPONENT.sub(r"**\1", unit)) != unit:
        return f'"{unit}" has an exponent without a sign', written(raised)
    return None
