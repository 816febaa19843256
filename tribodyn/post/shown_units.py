"""Units that engineers read, for the SI units of a sweep's parameters."""

import math

#: SI unit: name and factor.
SHOWN_IN = {
    "rad/s": ("rpm", 30 / math.pi),
    "N*m": ("N m", 1.0),
    "m": ("mm", 1e3),
    "rad": ("deg", 180 / math.pi),
}


def shown_unit(units: str) -> tuple[str, float]:
    """Name of the unit that a quantity in SI is shown in, empty for plain numbers, and the factor to it."""
    name, factor = SHOWN_IN.get(units, (units, 1.0))
    return ("" if name == "1" else name), factor


def shown(value: object, units: str, digits: int = 5) -> str:
    """A parameter's value with its unit; texts as they are."""
    if not isinstance(value, float):
        return str(value)
    name, factor = shown_unit(units)
    return f"{value * factor:.{digits}g} {name}".rstrip()
