"""What one reported number is: its name, unit and meaning, and how it is shown; units of parameters."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.parameter import Variable

#: Unit in which a number is shown: the SI unit of it, what to multiply with, and what to add before that.
SHOWN: dict[str, tuple[str, float, float]] = {
    "": ("1", 1.0, 0.0),
    "%": ("1", 100.0, 0.0),
    "mm": ("m", 1e3, 0.0),
    "µm": ("m", 1e6, 0.0),
    "um": ("m", 1e6, 0.0),
    "mm/s": ("m/s", 1e3, 0.0),
    "mm/rad": ("m/rad", 1e3, 0.0),
    "kg mm²": ("kg*m2", 1e6, 0.0),
    "mm³": ("m3", 1e9, 0.0),
    "mg": ("kg", 1e6, 0.0),
    "mg/h": ("kg/s", 3.6e9, 0.0),
    "N m": ("N*m", 1.0, 0.0),
    "N/mm": ("N/m", 1e-3, 0.0),
    "N/µm": ("N/m", 1e-6, 0.0),
    "N/(mm µm)": ("N/m2", 1e-9, 0.0),
    "kW": ("W", 1e-3, 0.0),
    "kJ": ("J", 1e-3, 0.0),
    "MPa": ("Pa", 1e-6, 0.0),
    "GPa": ("Pa", 1e-9, 0.0),
    "°C": ("K", 1.0, -273.15),
    "°": ("rad", 180.0 / math.pi, 0.0),
    "rpm": ("rad/s", 30.0 / math.pi, 0.0),
    "h": ("s", 1.0 / 3600.0, 0.0),
    "(N/mm²)**0.5": ("Pa**0.5", 1e-3, 0.0),
}
#: Numbers of a fixed number of decimals have some up to this.
DECIMALS_TO = 1e5


def in_si(sheet: Mapping[str, Any]) -> dict[str, Any]:
    """A sheet of (value, unit) by name with SI values and units; what is no such pair stays as it is.

    Sheets in sheets are converted too. Plain numbers keep the unit "".
    """
    return {name: _line_in_si(line) for name, line in sheet.items()}


def _line_in_si(line: Any) -> Any:
    match line:
        case Mapping():
            return in_si(line)
        case (int() | float() as value, str(unit)) if unit and unit in SHOWN:
            si, factor, offset = SHOWN[unit]
            return value / factor - offset, si
        case _:
            return line


class Quantity(NamedTuple):
    """A number that studies report, in SI units wherever it is kept."""

    name: str  # in summaries, sweeps, searches and JSON
    label: str  # what a person calls it
    unit: str = ""  # in which it is shown: one of `SHOWN`, or any SI unit
    digits: str = ".4g"  # format of the number shown
    definition: str = ""  # what it is, over which part of the run, of which pairs, by what formula
    symbol: str = ""  # beside the label
    #: its label in a table directly below the quantity to which it belongs: "at the frequency"
    below: str = ""
    listed: bool = False  # whether an array is a list to be shown in its order; else its entries are of pairs

    @property
    def si(self) -> str:
        """SI unit in which it is kept, "1" of plain numbers."""
        return SHOWN.get(self.unit, (self.unit,))[0]

    @property
    def factor(self) -> float:
        """What `in_unit` multiplies with."""
        return SHOWN.get(self.unit, ("", 1.0))[1]

    def in_unit(self, value: Any) -> Any:
        """A number or an array in SI, in the unit in which it is shown."""
        _, factor, offset = SHOWN.get(self.unit, ("", 1.0, 0.0))
        moved = value + offset if offset else value
        return moved * factor if factor != 1.0 else moved

    @property
    def title(self) -> str:
        """Label and symbol."""
        return f"{self.label} {self.symbol}".rstrip()

    @property
    def titled(self) -> str:
        """Label, symbol, and in brackets the unit."""
        return f"{self.title} ({self.unit})" if self.unit else self.title

    @property
    def in_table(self) -> str:
        """What a table of the summary calls it, where it may lean on the line above."""
        return self.below or self.title

    def variable(self) -> Variable:
        """The dataset of a sweep that keeps it, one number per case."""
        first, second = self.label[0], self.label[1:]
        return Variable((), self.si, (first if second[:1].isupper() else first.lower()) + second)

    def written(self, value: Any) -> str:
        """One value in its unit; the values of pairs from pair 1 on, those of a list in its order."""
        if isinstance(value, str):
            return value
        if np.ndim(value):
            items = np.asarray(value).tolist()
            return " / ".join(self.written(item) for item in (items if self.listed else reversed(items)))
        if isinstance(value, float) and not math.isfinite(value):
            return "–"
        number = self.in_unit(value)
        if self.digits.endswith("d"):
            return format(int(number), self.digits)
        few = self.digits.endswith("f") and 0.0 < abs(number) < 10.0 ** (1 - int(self.digits[-2]))
        many = self.digits.endswith("f") and abs(number) >= DECIMALS_TO
        # small numbers are not rounded to zero, and large ones have no decimals
        return format(number, ".3g" if few else ",.0f" if many else self.digits)

    def written_of(self, values: Mapping[str, Any]) -> str:
        """Its value in a mapping by names; a lower bound, where ``NAME_unlimited`` is true, with "≥"."""
        return "≥ " * bool(values.get(f"{self.name}_unlimited")) + self.written(values[self.name])

    def with_unit(self, value: Any) -> str:
        """One value with its unit behind it."""
        return f"{self.written(value)} {self.unit}".rstrip()


Reported = Mapping[str, tuple[Quantity, ...]]
"""Heading -> quantities of a summary's table, in order; one that a summary lacks is left out."""


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


def from_to(low: float, high: float) -> str:
    """Two ends of a range to two digits, once where they are the same."""
    ends = f"{low:.2g}", f"{high:.2g}"
    return " to ".join(dict.fromkeys(ends))
