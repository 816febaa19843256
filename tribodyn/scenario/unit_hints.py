"""What is said of quantities that engineers write in their own way: decimal commas, 1/min, mPas, mm²/s."""

import re

_COMMA = re.compile(r"\s*(?P<before>[+-]?\d+),(?P<after>\d+)(?P<rest>[^,]*)", re.ASCII)
_TURNS = re.compile(r"(1\s*/\s*min|min\s*(\^|\*\*)?\s*-\s*1|min⁻¹|/\s*min|[uU]/min)")
#: Written without the sign of multiplication -> as it must be written.
_JOINED = {
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
_KINEMATIC = re.compile(r"([cm]?m\s*(²|\^2|\*\*2|2)\s*/\s*s|c?St)")


def decimal_comma(value: str) -> tuple[str, str] | None:
    """Rule and remedy for a number with a comma in it; None where there is none."""
    found = _COMMA.fullmatch(value)
    if found is None:
        return None
    point = f"{found['before']}.{found['after']}{found['rest']}".strip()
    if len(found["after"]) != 3:
        return "a comma in a number", f'write a decimal point: "{point}"'
    whole = f"{found['before']}{found['after']}{found['rest']}".strip()
    return "a comma in a number", f'write "{point}" or "{whole}", whichever is meant'


def spelling(number: str, unit: str, what: str) -> tuple[str, str] | None:
    """Rule and remedy for a unit that is not spelled as here, or is of something close; None: no hint.

    Parameters
    ----------
    number, unit : str
        The parts of the quantity as they were given; no number for a unit alone.
    what : str
        Name of the kind of quantity that is due.
    """
    unit = unit.strip()

    def written(right: str) -> str:
        return f'write "{f"{number} {right}".strip()}"'

    if what == "angular speed" and _TURNS.fullmatch(unit):
        return f'"{unit}" leaves open whether turns or radians are meant', written("rpm")
    if unit in _JOINED:
        return f'"{unit}" needs a sign of multiplication', written(_JOINED[unit])
    if what == "dynamic viscosity" and _KINEMATIC.fullmatch(unit):
        example = '100 mm²/s at 850 kg/m³ are "85 mPa*s"'
        return f'"{unit}" is a unit of kinematic viscosity', f"give it times the density: {example}"
    return None
