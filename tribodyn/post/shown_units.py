"""Units that engineers read, for the SI units of a sweep's parameters."""

from tribodyn.quantities.quantity import SHOWN

#: SI unit: the unit in which a parameter is shown.
SHOWN_IN = {"rad/s": "rpm", "N*m": "N m", "m": "mm", "rad": "°", "1": ""}


def shown_unit(units: str) -> tuple[str, float]:
    """Name of the unit that a quantity in SI is shown in, empty for plain numbers, and the factor to it."""
    name = SHOWN_IN.get(units, units)
    return name, SHOWN.get(name, ("", 1.0))[1]


def shown(value: object, units: str, digits: int = 5) -> str:
    """A parameter's value with its unit; texts as they are."""
    if not isinstance(value, float):
        return str(value)
    name, factor = shown_unit(units)
    return f"{value * factor:.{digits}g} {name}".rstrip()
