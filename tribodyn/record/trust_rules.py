"""What models assume of their results: quantities, limits, and why each limit is where it is."""

import math
from typing import NamedTuple

import numpy as np


class Rule(NamedTuple):
    """What a model assumes of a quantity."""

    label: str  # the quantity in words
    most: float  # above it a result lies outside the model; SI
    units: str
    about: str  # why the limit is where it is
    least: float = -math.inf  # below it likewise
    #: factor, unit, offset: From SI to what is shown, value · factor + offset, and the unit of that.
    factor: float = 1.0
    unit: str = ""
    offset: float = 0.0
    #: whether a result beyond the limit is extrapolated only, and not outside the model
    extrapolates: bool = False

    def outside(self, values: np.ndarray) -> np.ndarray:
        """Where values are outside; NaN is not."""
        return (values > self.most) | (values < self.least)

    def beyond(self, values: np.ndarray) -> np.ndarray:
        """How far values are beyond the limit that they come nearest to, below 0 inside."""
        return np.maximum(values - self.most, self.least - values)

    def limit(self, value: float) -> float:
        """The limit that a value is beyond."""
        return self.least if value < self.least else self.most

    def shown(self, value: float) -> str:
        """A value as it is read."""
        return f"{value * self.factor + self.offset:.4g}{' ' if self.unit else ''}{self.unit}"

    def short(self, value: float) -> str:
        """The quantity and the limit that a value is beyond."""
        side = "below" if value < self.least else "above"
        return f"{self.label} {side} {self.shown(self.limit(value))}"


RULES: dict[str, Rule] = {
    "deflection": Rule(
        "deflection of a pair of teeth over the module",
        0.1,
        "1",
        "stiffness and path of contact are those of teeth that keep their form; a tenth of the module is ten "
        "times what gears are designed for, and bends them beyond any yield strength",
        factor=100.0,
        unit="%",
    ),
    "friction_coefficient": Rule(
        "friction coefficient",
        1.0,
        "1",
        "no lubricated contact has more; regressions extrapolated give it",
    ),
    "hertz_pressure": Rule(
        "Hertz pressure",
        4e9,
        "Pa",
        "case-hardened steel yields under its surface at about 3 GPa and shakes down to no more than 4; the "
        "elastic half space says nothing of it",
        factor=1e-9,
        unit="GPa",
    ),
    "contact_temperature": Rule(
        "contact temperature",
        80.0 + 2.25 * 14**2 + 273.15,
        "K",
        "scuffing temperature of case-hardened steel with an oil of the highest failure load stage S = 14: "
        "80 + 2.25 S² °C (ISO/TS 6336-20, (99)); no oil is known to separate flanks beyond it",
        unit="°C",
        offset=-273.15,
    ),
    "flash_temperature": Rule(
        "flash temperature rise",
        500.0,
        "K",
        "the same where the temperature of the oil is not known: teeth are warmer than 20 °C",
        unit="K",
    ),
    "film_thickness": Rule(
        "minimum film thickness",
        20e-6,
        "m",
        "films of gears are 0.01 to 3 µm thick, and heat of the inlet and want of oil thin those of cold "
        "oil; a thickness ten times that, at the thinnest place, is a regression extrapolated",
        factor=1e6,
        unit="µm",
    ),
    "film_parameter": Rule(
        "minimum film parameter",
        100.0,
        "1",
        "above 3 a film separates the flanks; 100 takes polished teeth of 0.03 µm under the thickest film of "
        "gears",
    ),
    "efficiency": Rule(
        "efficiency",
        1.0 + 1e-12,
        "1",
        "a share of a power; outside, a force makes power that no source gives",
        least=-1e-12,
        factor=100.0,
        unit="%",
    ),
    "energy_residual": Rule(
        "residual of the energy balance over solver.rtol",
        100.0,
        "1",
        "works are integrated with the motion and close within some ten times the tolerance",
    ),
    "bearing_displacement": Rule(
        "displacement of a gear in its bearings over the tip clearance",
        1.0,
        "1",
        "tips would touch the roots of the mate; the path of contact is that of fixed centres",
        factor=100.0,
        unit="%",
    ),
    "film_law_range": Rule(
        "share of the contact in which the film law is outside its range",
        0.99,
        "1",
        "a law that is nowhere used where it was fitted is a guess; one that leaves its range in a part of "
        "the contact is a remark",
        factor=100.0,
        unit="%",
        extrapolates=True,
    ),
    "friction_law_range": Rule(
        "share of the contact in which the friction law is outside its range",
        0.99,
        "1",
        "likewise",
        factor=100.0,
        unit="%",
        extrapolates=True,
    ),
}
