"""A lubricant by its data sheet or by the numbers that the laws read, its law of pressure, and the rules."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, cast

import numpy as np
from pydantic import Field, ValidationError

from tribodyn.errors import InputError, quoted
from tribodyn.input import quantity, units
from tribodyn.input.messages import explain
from tribodyn.input.sources import find_model, read_toml
from tribodyn.input.tables.gears.model_files import Described
from tribodyn.tribology import oil
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


KinematicViscosity = Annotated[float, quantity.InUnit(units.positive(units.KINEMATIC_VISCOSITY))]


class Lubricant(Described):
    """A lubricant (`models/lubricants/`): by its data sheet, or by the numbers that the laws read."""

    type: oil.OilType | None = None
    viscosity_40: KinematicViscosity | None = None
    viscosity_100: (
        Annotated[float, quantity.InUnit(units.positive(units.KINEMATIC_VISCOSITY), "19 mm**2/s")] | None
    ) = None
    density_15: Annotated[float, quantity.InUnit(units.positive(units.DENSITY), "0.89 g/cm**3")] | None = None
    asperity_friction: quantity.NotNegative | None = None
    limiting_shear_coefficient: quantity.Positive | None = None
    inlet_viscosity: Annotated[float, quantity.InUnit(units.positive(units.VISCOSITY))] | None = None
    pressure_viscosity: Annotated[float, quantity.InUnit(units.positive(units.PRESSURE_VISCOSITY))] | None = (
        None
    )
    viscosity_pressure_index: quantity.Positive | None = None
    temperature_viscosity: Annotated[float, quantity.InUnit(units.not_negative(units.PER_KELVIN))] | None = (
        None
    )
    density: Annotated[float, quantity.InUnit(units.positive(units.DENSITY), "870 kg/m**3")] | None = None
    load_exponent: quantity.NotNegative | None = None
    lubricant_factor: quantity.Positive | None = None
    schlenk_factor: quantity.Positive | None = None
    fzg_scuffing_stage: Annotated[int, Field(strict=True, ge=1, le=14)] | None = None
    fzg_micropitting_stage: Annotated[int, Field(strict=True, ge=5, le=11)] | None = None
    fzg_micropitting_temperature: Annotated[float, quantity.InUnit(units.TEMPERATURE_KIND, "90 degC")] = (
        quantity.written("90 degC")
    )
    viscosity_law: ViscosityLaw | None = None


#: What is taken for an oil: densities at 15 °C, kg/m³, and the kinematic viscosity at 40 °C at most, m²/s.
DENSITIES, THICKEST = (650.0, 1300.0), 0.1
_SHEET = ("viscosity_40", "viscosity_100", "density_15")
#: What the laws read, with an example; the last two follow from the type.
_DIRECT = {
    "inlet_viscosity": '"0.35 Pa*s"',
    "pressure_viscosity": '"25 1/GPa"',
    "viscosity_pressure_index": "0.57",
    "temperature_viscosity": '"0.045 1/K"',
    "density": '"870 kg/m**3"',
    "asperity_friction": "0.11",
    "limiting_shear_coefficient": "0.05",
}
_EXAMPLES = {"viscosity_40": '"220 mm**2/s"', "viscosity_100": '"19 mm**2/s"', "density_15": '"0.89 g/cm**3"'}


def lubricant_of(lubricant: Lubricant, oil_temperature: float | None = None) -> oil.LubricantData:
    """Return the lubricant's numbers, at the oil's temperature (K) where a data sheet gives them.

    Rules as in `broken_lubricant_rules`.
    """
    specified = {name: value for name in oil.UNITS if (value := getattr(lubricant, name)) is not None}
    stages = oil.FzgStages(
        lubricant.fzg_scuffing_stage, lubricant.fzg_micropitting_stage, lubricant.fzg_micropitting_temperature
    )
    if (sheet := sheet_of(lubricant)) is not None and oil_temperature is not None:
        return oil.lubricant_from(sheet, oil_temperature, stages)
    typical = oil.by_type(lubricant.type) if lubricant.type else {}
    numbers: dict[str, Any] = {name: number.value for name, number in typical.items()} | specified
    return oil.LubricantData(**numbers, type=lubricant.type, given=frozenset(specified), fzg=stages)


def read_lubricant(name: str, oil_temperature: float) -> oil.LubricantData:
    """Return the numbers at a temperature, K, of a shipped lubricant, or of a file (.toml); InputError."""
    path = find_model(name, "lubricants", "lubricant", Path("scenario"))
    try:
        table = Lubricant.model_validate(read_toml(path))
    except ValidationError as error:
        raise explain(error, Lubricant)[0] from None
    if table.viscosity_40 is None:
        rule = "is known at one temperature only"
        raise InputError("lubricant", quoted(name), rule, "give viscosity and pressure_viscosity instead")
    for broken in broken_lubricant_rules(table, oil_temperature):
        raise broken
    return lubricant_of(table, oil_temperature)


def sheet_of(lubricant: Lubricant) -> oil.OilSheet | None:
    """Return the data sheet of a lubricant; None where it is given by the numbers that the laws read."""
    if lubricant.type is None or lubricant.viscosity_40 is None:
        return None
    specified = {name: value for name in oil.UNITS if (value := getattr(lubricant, name)) is not None}
    viscosity_100, density_15 = cast(float, lubricant.viscosity_100), cast(float, lubricant.density_15)
    law = lubricant.viscosity_law
    roelands = law is not None and law.model == "roelands"
    at_40 = lubricant.viscosity_40
    return oil.OilSheet(
        lubricant.type, at_40, viscosity_100, density_15, specified, measured_of(law), roelands
    )


def broken_lubricant_rules(lubricant: Lubricant, oil_temperature: float | None) -> Iterator[InputError]:
    """Go through the rules that a lubricant breaks by itself or at the oil's temperature (K)."""
    yield from broken_viscosity_rules(lubricant)
    if all(getattr(lubricant, name) is None for name in _SHEET):
        yield from _direct(lubricant, oil_temperature)
        return
    broken = list(_sheet(lubricant))
    yield from broken
    if oil_temperature is None:
        rule = "missing: the lubricant is given by its data sheet"
        remedy = 'add oil_temperature = "80 degC" to [operating]'
        yield InputError("operating.oil_temperature", rule=rule, remedy=remedy)
    elif not broken:
        yield from _temperature(lubricant, oil_temperature)


def _direct(lubricant: Lubricant, oil_temperature: float | None) -> Iterator[InputError]:
    typical = oil.by_type(lubricant.type) if lubricant.type else {}
    for name, example in _DIRECT.items():
        if getattr(lubricant, name) is None and name not in typical:
            remedy = f"add {name} = {example}"
            if name == "inlet_viscosity":
                remedy += ", or the data sheet: type, viscosity_40, viscosity_100 and density_15"
            yield InputError(f"lubricant.{name}", rule="missing", remedy=remedy)
    if oil_temperature is not None:
        temperature = f"{oil_temperature - oil.ZERO_CELSIUS:.6g} degC"
        rule = "contradicts a lubricant whose inlet_viscosity is given at one temperature"
        remedy = "leave it out, or give the data sheet: type, viscosity_40, viscosity_100 and density_15"
        yield InputError("operating.oil_temperature", temperature, rule, remedy)


def _sheet(lubricant: Lubricant) -> Iterator[InputError]:
    if lubricant.type is None:
        rule = "missing: pressure-viscosity, limiting shear and lubricant factor go by it"
        remedy = f"write one of {', '.join(map(quoted, oil.OIL_TYPES))}"
        yield InputError("lubricant.type", rule=rule, remedy=remedy)
    for name in _SHEET:
        if getattr(lubricant, name) is None:
            rule = "missing: a data sheet needs viscosity_40, viscosity_100 and density_15"
            yield InputError(f"lubricant.{name}", rule=rule, remedy=f"add {name} = {_EXAMPLES[name]}")
    if lubricant.inlet_viscosity is not None:
        written = f"{lubricant.inlet_viscosity:g} Pa*s"
        rule = (
            "contradicts viscosity_40 and viscosity_100, from which it follows at operating.oil_temperature"
        )
        remedy = "leave it out, or leave out viscosity_40, viscosity_100 and density_15"
        yield InputError("lubricant.inlet_viscosity", written, rule, remedy)
    density = lubricant.density_15
    if density is not None and not DENSITIES[0] <= density <= DENSITIES[1]:
        written, rule = f"{density:g} kg/m**3", f"oils have {DENSITIES[0]:g} to {DENSITIES[1]:g} kg/m**3"
        yield InputError("lubricant.density_15", written, rule, f"check the unit: {_EXAMPLES['density_15']}")
    at_40, at_100 = lubricant.viscosity_40, lubricant.viscosity_100
    if at_40 is not None and at_40 > THICKEST:
        written, rule = f"{1e6 * at_40:g} mm**2/s", f"more than {1e6 * THICKEST:g} mm**2/s, which is no oil"
        remedy = f"check the unit: {_EXAMPLES['viscosity_40']}"
        yield InputError("lubricant.viscosity_40", written, rule, remedy)
    if at_40 is None or at_100 is None:
        return
    written = f"{1e6 * at_100:g} mm**2/s"
    if at_100 >= at_40:
        rule = f"must be below viscosity_40, {1e6 * at_40:g} mm**2/s: oil gets thinner as it warms up"
        yield InputError("lubricant.viscosity_100", written, rule, "swap the two, or check the data sheet")
    elif at_100 < oil.MINIMUM_VISCOSITY:
        rule = f"ASTM D341 holds from {1e6 * oil.MINIMUM_VISCOSITY:g} mm**2/s on"
        remedy = "give inlet_viscosity and the other numbers that the laws read instead of the data sheet"
        yield InputError("lubricant.viscosity_100", written, rule, remedy)


def _temperature(lubricant: Lubricant, temperature: float) -> Iterator[InputError]:
    low, high = (round(limit - oil.ZERO_CELSIUS) for limit in oil.TEMPERATURE_RANGE)
    key, written = "operating.oil_temperature", f"{temperature - oil.ZERO_CELSIUS:.6g} degC"
    if not oil.TEMPERATURE_RANGE[0] <= temperature <= oil.TEMPERATURE_RANGE[1]:
        rule = f"outside {low} to {high} degC, for which viscosity and density are derived from a data sheet"
        yield InputError(key, written, rule, f"write a temperature from {low} to {high} degC")
    elif lubricant.viscosity_40 and lubricant.viscosity_100:
        viscosity = oil.kinematic_viscosity(lubricant.viscosity_40, lubricant.viscosity_100, temperature)
        limits = f"{1e6 * oil.MINIMUM_VISCOSITY:g} to {1e6 * oil.MAXIMUM_VISCOSITY:g} mm**2/s"
        if not oil.MINIMUM_VISCOSITY <= viscosity <= oil.MAXIMUM_VISCOSITY:
            rule = f"the oil has {1e6 * viscosity:.2g} mm**2/s there, and ASTM D341 holds from {limits}"
            other = "lower" if viscosity < oil.MINIMUM_VISCOSITY else "higher"
            yield InputError(key, written, rule, f"write a {other} temperature, or take another oil")
