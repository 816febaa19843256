"""Viscosity of an oil where friction is made: by its measured law, by Roelands', or estimated by its type.

A data sheet says nothing of the viscosity at 1 GPa. The measured oils of a type say how it rises: at the
temperature of the contact ln(η/η0) of oils of one kind hardly depends on their grade (the exponents of η38 in
ISO/TR 15144-1's α are 0.05 to 0.16). A measured oil gives two such rises, its own, and one over pressures
that are scaled to the sheet's α. The band of a mineral oil is what both of both measured mineral oils span;
of other types, what all measured oils at the sheet's α and squalane itself do.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.elementary import is_jax
from tribodyn.tribology.oil import ZERO_CELSIUS, LubricantData
from tribodyn.tribology.pressure_law import (
    DoolittleTait,
    LawPart,
    MeasuredLaw,
    MeasuredViscosity,
    PressureLaw,
    Yasutomi,
    asymptotic_coefficient,
    with_coefficient,
)

#: Oils measured to 1 GPa, as `models/lubricants` has them with their sources.
MEASURED: dict[str, MeasuredLaw] = {
    "hvi-650": Yasutomi(
        309.1, 0.3064e-9, 0.2186, 29.99e-9, 10.264, 27.04, ZERO_CELSIUS - 30.4, improved=False
    ),
    "shell-t9": Yasutomi(188.86, 0.719e-9, 8.2e-9, -0.5278, 16.09, 17.38, ZERO_CELSIUS - 83.2),
    "squalane": DoolittleTait(
        4.710, 0.6568, -9.599e-4, ZERO_CELSIUS + 40.0, 8.36e-4, 8.658e9, 6.332e-3, 11.74
    ),
}
#: Measured oils of mineral type: their mean, at the sheet's α, is the best estimate of a mineral oil; ISO/TR
#: 15144-1's α of HVI 650 is its α* within 3 % at 80 and 100 °C, a sixth below it at 40 °C.
MINERAL = "hvi-650", "shell-t9"
#: Stands for the other types. No polyalphaolefin, ester or polyglycol was found with published constants:
#: squalane is a branched alkane of 30 carbon atoms, as the trimers in PAO 4 are; of esters and glycols it is
#: an assumption.
#: Its own α* is kept: ISO/TR 15144-1's α of PAO, made for films, is two thirds of it.
STAND_IN = "squalane"
#: Pressure at which rises are compared, Pa.
_COMPARED = 0.8e9


class ContactViscosity(NamedTuple):
    """How the viscosity of an oil rises with pressure in the solved contact."""

    origin: str  # in words
    law: PressureLaw | None = None  # None: Roelands' law
    pressure_viscosity: float = 0.0  # α* of the law, 1/Pa
    #: lowest, highest: what measured oils of the type span, where the law is estimated
    lowest: PressureLaw | None = None
    highest: PressureLaw | None = None
    measured: MeasuredViscosity | None = None  # what an oil's own law is known for
    estimated: bool = False

    @property
    def maximum_pressure(self) -> float:
        """Pressure up to which the law was measured, Pa; infinite where no limit is known."""
        return np.inf if self.measured is None else self.measured.maximum_pressure

    def temperature_outside(self, temperature: float) -> float:
        """How far a temperature is outside the measured ones, K; 0 inside."""
        if self.measured is None:
            return 0.0
        _, _, low, high = self.measured
        return max(low - temperature, temperature - high, 0.0)

    def limits(self, pressure: float, temperature: float | None) -> tuple[str, ...]:
        """Say what does not cover friction solved at a Hertz pressure, Pa, and an oil temperature, K."""
        limits = []
        if self.estimated:
            limits.append(f"viscosity at high pressure estimated: {self.origin}")
        if pressure > self.maximum_pressure:
            limits.append(
                f"p_H {pressure / 1e9:.4g} GPa is above {self.maximum_pressure / 1e9:.4g} GPa, up to which "
                f"the viscosity was measured: friction is extrapolated"
            )
        if temperature is not None and self.temperature_outside(temperature) and self.measured is not None:
            low, high = (
                limit - ZERO_CELSIUS
                for limit in (self.measured.minimum_temperature, self.measured.maximum_temperature)
            )
            limits.append(
                f"The oil at {temperature - ZERO_CELSIUS:.4g} °C: its viscosity under pressure was measured "
                f"from {low:.4g} to {high:.4g} °C"
            )
        return tuple(limits)


def contact_viscosity(lubricant: LubricantData) -> ContactViscosity:
    """Return how an oil's viscosity rises with pressure at its temperature.

    Raises InputError where the oil's numbers are traced for a derivative.
    """
    sheet, temperature = lubricant.sheet, lubricant.temperature
    if sheet is None:
        return ContactViscosity("Roelands' law, numbers given")
    if "viscosity_pressure_index" in sheet.given:
        return ContactViscosity("Roelands' law, viscosity_pressure_index given")
    if sheet.roelands:
        return ContactViscosity("Roelands' law from the data sheet's α", estimated=True)
    if is_jax(temperature) or is_jax(lubricant.pressure_viscosity):
        rule = "has no derivative by the oil where the contact is solved"
        raise InputError("lubricant", None, rule, "use a law of formulas, or differences")
    temperature = float(temperature)
    if sheet.law is not None:
        law = PressureLaw((LawPart(sheet.law.law),), temperature)
        origin = "measured, viscosity_law of the lubricant"
        return ContactViscosity(origin, law, asymptotic_coefficient(law), measured=sheet.law)
    return _estimated(lubricant, temperature)


def _estimated(lubricant: LubricantData, temperature: float) -> ContactViscosity:
    """The best estimate by type, and the lowest and highest rise of the measured oils of the type."""
    sheet, coefficient = lubricant.sheet, float(lubricant.pressure_viscosity)
    assert sheet is not None
    stated, mineral = "pressure_viscosity" in sheet.given, sheet.type == "mineral"
    names = MINERAL if mineral else tuple(MEASURED)
    scaled = {name: with_coefficient(MEASURED[name], temperature, coefficient) for name in names}
    parts = (
        {} if stated else {name: LawPart(MEASURED[name]) for name in (MINERAL if mineral else (STAND_IN,))}
    )
    kind = scaled if mineral or stated else parts
    best = [kind[name] for name in (MINERAL if mineral else (STAND_IN,))]
    law = PressureLaw(tuple(part._replace(weight=1.0 / len(best)) for part in best), temperature)
    single = [PressureLaw((part,), temperature) for part in (*scaled.values(), *parts.values())]
    single.sort(key=lambda each: float(each.rise(np.array([_COMPARED]), temperature)[0][0]))
    how = "at the oil's α" if kind is scaled else "as measured"
    origin = f"by type {sheet.type}, from {' and '.join(MINERAL) if mineral else STAND_IN} {how}"
    at_zero = asymptotic_coefficient(law)
    return ContactViscosity(origin, law, at_zero, single[0], single[-1], estimated=True)
