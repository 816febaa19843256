"""The table [lubricant.viscosity_law]: how a measured oil thickens under pressure, and its rules."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.input import quantity, units
from tribodyn.tribology.oil import ZERO_CELSIUS
from tribodyn.tribology.pressure_law import (
    DoolittleTait,
    LawPart,
    MeasuredLaw,
    MeasuredViscosity,
    PressureLaw,
    Yasutomi,
)

Model = Literal["by-type", "roelands", "improved-yasutomi", "yasutomi", "doolittle-tait"]
Kelvins = Annotated[float, quantity.InUnit(units.positive(units.TEMPERATURE_DIFFERENCE))]
PerPascal = Annotated[float, quantity.InUnit(units.positive(units.PRESSURE_VISCOSITY), "0.719 1/GPa")]
PerKelvin = Annotated[float, quantity.InUnit(units.positive(units.EXPANSION))]
SignedPerKelvin = Annotated[float, quantity.InUnit(units.EXPANSION, "-9.6e-4 1/K")]
Temperature = Annotated[float, quantity.InUnit(units.TEMPERATURE_KIND)]
Pressure = Annotated[float, quantity.InUnit(units.positive(units.PRESSURE), "1 GPa")]


class ViscosityLaw(quantity.Table):
    """Constants of a measured oil's published law; viscosity at ambient pressure is the data sheet's."""

    model: Model = "by-type"
    a1: Kelvins | None = None
    a2: PerPascal | None = None
    b1: PerPascal | None = None
    b2: Annotated[float, Field(strict=True, ge=-5.0, le=0.0)] | None = None
    log_factor: quantity.Positive | None = None
    log_pressure: PerPascal | None = None
    c1: quantity.Positive | None = None
    c2: Kelvins | None = None
    glass_temperature: Temperature | None = None
    free_volume_factor: quantity.Positive | None = None
    occupied_share: Annotated[float, Field(strict=True, gt=0.0, lt=1.0)] | None = None
    occupied_expansion: SignedPerKelvin | None = None
    reference_temperature: Temperature | None = None
    expansion: PerKelvin | None = None
    bulk_modulus: Pressure | None = None
    bulk_modulus_decay: PerKelvin | None = None
    bulk_modulus_slope: quantity.Positive | None = None
    maximum_pressure: Pressure | None = None
    minimum_temperature: Temperature | None = None
    maximum_temperature: Temperature | None = None


_LIMITS = ("maximum_pressure", "minimum_temperature", "maximum_temperature")
_YASUTOMI = ("a1", "a2", "c1", "c2", "glass_temperature")
#: Model -> its keys, each of which it needs.
_KEYS: dict[str, tuple[str, ...]] = {
    "by-type": (),
    "roelands": (),
    "improved-yasutomi": (*_YASUTOMI, "b1", "b2", *_LIMITS),
    "yasutomi": (*_YASUTOMI, "log_factor", "log_pressure", *_LIMITS),
    "doolittle-tait": (*DoolittleTait._fields, *_LIMITS),
}
_PLACE = "lubricant.viscosity_law"
#: Largest ln(η/η0) within a law's measured range, four times that at which an oil is a glass.
MOST_RISE = 100.0


def measured_of(table: ViscosityLaw | None) -> MeasuredViscosity | None:
    """Return the law of a table that has passed its rules; None where it has no constants."""
    if table is None or not _KEYS[table.model]:
        return None
    values: dict[str, Any] = {name: getattr(table, name) for name in _KEYS[table.model]}
    limits = {name: values.pop(name) for name in _LIMITS}
    law: MeasuredLaw
    if table.model == "doolittle-tait":
        law = DoolittleTait(**values)
    elif table.model == "yasutomi":
        factor, pressure = values.pop("log_factor"), values.pop("log_pressure")
        law = Yasutomi(**values, b1=factor, b2=pressure, improved=False)
    else:
        law = Yasutomi(**values)
    return MeasuredViscosity(law, **limits)


def broken_viscosity_rules(lubricant: Any) -> Iterator[InputError]:
    """Go through the rules that a lubricant's table breaks."""
    table: ViscosityLaw | None = lubricant.viscosity_law
    if table is None:
        return
    if lubricant.viscosity_40 is None:
        rule = (
            "needs a data sheet: viscosity_40, viscosity_100, density_15 and type give it at ambient pressure"
        )
        yield InputError(_PLACE, None, rule, "add them, or leave the table out")
        return
    for name in ("viscosity_pressure_index", "pressure_viscosity"):
        if getattr(lubricant, name) is None or (name == "pressure_viscosity" and not _KEYS[table.model]):
            continue
        rule = f'contradicts viscosity_law.model = "{table.model}", which says how the viscosity rises'
        yield InputError(f"lubricant.{name}", getattr(lubricant, name), rule, "leave one of the two out")
    present = {name for name in type(table).model_fields if getattr(table, name) is not None} - {"model"}
    needed = _KEYS[table.model]
    if missing := [name for name in needed if name not in present]:
        rule = f'missing: model = "{table.model}" needs {", ".join(missing)}'
        yield InputError(f"{_PLACE}.{missing[0]}", None, rule, "give the constants of the oil's publication")
    if idle := [name for name in type(table).model_fields if name in present and name not in needed]:
        of = [model for model, keys in _KEYS.items() if idle[0] in keys]
        rule = f'no effect with model = "{table.model}": {", ".join(idle)}'
        remedy = f"leave out what has none, or write model = {quoted(of[0])}"
        yield InputError(f"{_PLACE}.{idle[0]}", getattr(table, idle[0]), rule, remedy)
    low, high = table.minimum_temperature, table.maximum_temperature
    if low is not None and high is not None and low >= high:
        rule = f"must be above minimum_temperature, {low:g} K"
        yield InputError(f"{_PLACE}.maximum_temperature", f"{high:g} K", rule, "swap the two")
    elif needed and not missing and not idle:
        yield from _unlike_oil(table)


def _unlike_oil(table: ViscosityLaw) -> Iterator[InputError]:
    """Refuse constants by which the viscosity falls under pressure, or rises beyond any oil's."""
    measured = measured_of(table)
    assert measured is not None
    for temperature in (measured.minimum_temperature, measured.maximum_temperature):
        law = PressureLaw((LawPart(measured.law),), temperature)
        with np.errstate(all="ignore"):
            rise = float(law.rise(np.array(measured.maximum_pressure), temperature)[0][0])
        if not 0.0 < rise <= MOST_RISE:
            rule = (
                f"at {measured.maximum_pressure / 1e9:.4g} GPa and {temperature - ZERO_CELSIUS:.4g} °C these "
                f"constants give e^{rise:.4g} times the viscosity at ambient pressure; oils have e^0 to "
                f"e^{MOST_RISE:g}"
            )
            yield InputError(_PLACE, None, rule, "compare values and units with the oil's publication")
            return
