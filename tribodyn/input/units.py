"""Quantities with units: the border between TOML ("3 mm") and SI floats.

A quantity in TOML is a string of a number and a unit. Pint reads what is not in `COMMON_UNITS`; what leaves
this module is a float in the SI unit of its `Kind`. A bare number, a wrong dimension, NaN and infinity are
refused with a sentence that says which unit is due.
"""

import re
from functools import cache
from math import isfinite, pi
from typing import Any, NamedTuple

from tribodyn.errors import InputError, quoted
from tribodyn.input.unit_grammar import (
    COMMON_UNITS,
    LONGEST,
    OWN_UNITS,
    RULE,
    decimal_comma,
    is_unit,
    range_for_one,
    spelling,
)


class Kind(NamedTuple):
    """A kind of quantity."""

    name: str  # what it is called in messages: "length"
    si: str  # the SI unit it is converted to, as pint writes it
    example: str  # a good way to write one
    allowed: str = "any"  # "any", "not negative" or "positive"


class NotAQuantity(ValueError):
    """A value that is not a quantity of the kind that is due; carries the broken rule and the remedy."""

    def __init__(self, rule: str, remedy: str):
        super().__init__(f"{rule}; {remedy}")
        self.rule = rule
        self.remedy = remedy


_NUMBER = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|nan|inf(?:inity)?))\s*(?P<unit>.*?)\s*$",
    re.ASCII,
)
_ONE_OVER = re.compile(r"^1(?=\s*/)")
_NM = re.compile(r"\bNm\b")

#: Magnitudes, in SI units, of what can be computed with: products of a few still are numbers.
SMALLEST, LARGEST = 1e-30, 1e30
EXTREME = f"not between {SMALLEST:g} and {LARGEST:g} in magnitude"

SPEED = "angular speed"
FREQUENCY = "frequency"
ANGLE = "angle"
TEMPERATURE = "temperature"


@cache
def registry() -> Any:
    """Pint's registry, made on first use; its parsed definitions are kept on disk where that is allowed."""
    import pint

    try:
        return pint.UnitRegistry(cache_folder=":auto:")
    except OSError:  # no home folder, or one that cannot be written
        return pint.UnitRegistry()


def to_si(value: Any, kind: Kind) -> float:
    """Convert the quantity `value`, written as TOML has it, to the SI unit of `kind`.

    Raises NotAQuantity: no or an unknown unit, one of something else, not finite, of a sign not allowed.
    """
    write = f'write a quantity with a unit of {kind.name}, such as "{kind.example}"'
    if isinstance(value, (bool, dict, list)) or not isinstance(value, (int, float, str)):
        names = {"bool": "a true/false value", "dict": "a table", "NoneType": "nothing", "datetime": "a date"}
        name = type(value).__name__
        what = names.get(name, f"{'an' if name[0] in 'aeiou' else 'a'} {name}")  # a list, a date
        raise NotAQuantity(f"not a quantity but {what}", write)
    if not isinstance(value, str):
        raise NotAQuantity("a number without a unit", write)
    if len(value) > LONGEST:
        raise NotAQuantity(f"longer than {LONGEST} characters", write)
    number = _NUMBER.match(value)
    if hint := decimal_comma(value) or range_for_one(value):
        raise NotAQuantity(*hint)
    if number is None:
        raise NotAQuantity("not a number and a unit", write)
    if kind.name == TEMPERATURE:
        magnitude = _absolute(float(number["number"]), number["unit"], write)
    else:
        factor = _spelled_factor(number["number"], number["unit"], kind, write)
        magnitude = scaled(float(number["number"]), factor)
    if not isfinite(magnitude):
        raise NotAQuantity("not a finite number", write)
    if is_extreme(magnitude):
        raise NotAQuantity(f"{EXTREME}, in {kind.si}", write)
    if (kind.allowed == "positive" and magnitude <= 0) or (kind.allowed == "not negative" and magnitude < 0):
        sign = "greater than zero" if kind.allowed == "positive" else "zero or more"
        raise NotAQuantity(f"must be {sign}", f'write it like "{kind.example}"')
    return magnitude


#: Spelling of a scale of temperature -> its degree in K, and its zero.
_SCALES = {
    **dict.fromkeys(("K", "kelvin"), (1.0, 0.0)),
    **dict.fromkeys(("degC", "°C", "℃", "celsius", "degree_Celsius"), (1.0, 273.15)),
    **dict.fromkeys(("degF", "°F", "fahrenheit", "degree_Fahrenheit"), (5.0 / 9.0, 459.67 * 5.0 / 9.0)),
}


def _absolute(number: float, scale: str, write: str) -> float:
    """Temperature, K, from its number on a scale, whose zero may be shifted."""
    if not scale:
        raise NotAQuantity("a number without a unit", write)
    if scale == "C":
        raise NotAQuantity('"C" is the coulomb', f'write "{number:g} degC"')
    if scale not in _SCALES:
        raise NotAQuantity(f'"{scale}" is not a unit of {TEMPERATURE}', write)
    degree, zero = _SCALES[scale]
    if isfinite(number) and number * degree + zero <= 0.0:
        raise NotAQuantity("not above absolute zero", write)
    return number * degree + zero


def is_extreme(number: float) -> bool:
    """Whether a number is so large or so small that what is computed from it would overflow or vanish."""
    return number != 0.0 and not SMALLEST <= abs(number) <= LARGEST


def factor_to_si(unit: str, kind: Kind) -> float:
    """Return the factor from `unit` to the SI unit of `kind`; raises as `to_si` does."""
    write = f'write a unit of {kind.name}, such as "{kind.example.split(" ", 1)[1]}"'
    return _spelled_factor("", unit, kind, write)


def scaled(number: float, factor: float) -> float:
    """Multiply; "9 mm" becomes 0.009 m to the last digit, which 9 × 0.001 is not."""
    divisor = round(1 / factor) if 0 < factor < 1 else 0
    return number / divisor if divisor and abs(1 / factor - divisor) < 1e-9 * divisor else number * factor


def base_units(value: Any) -> tuple[float, str] | None:
    """Magnitude and SI base units of a quantity whose kind only a family of teeth knows; None if none."""
    match = _NUMBER.fullmatch(value) if isinstance(value, str) else None
    if match is None or not match["unit"] or not is_unit(match["unit"]):
        return None
    try:
        base = registry().Quantity(1.0, match["unit"]).to_base_units()
    except Exception:  # pint raises whatever Python's tokenizer and arithmetic do
        return None
    value = scaled(float(match["number"]), float(base.magnitude))
    return (value, f"{base.units:~C}".replace("**", "") or "1") if isfinite(value) else None


def to_si_at(key: str, value: Any, kind: Kind) -> float:
    """As `to_si`; raises InputError, which names the key, for what is no quantity of that kind."""
    try:
        return to_si(value, kind)
    except NotAQuantity as error:
        raise InputError(key, quoted(value), error.rule, error.remedy) from None


def _units(text: str, write: str) -> Any:
    """Text to pint's units."""
    import pint

    if not is_unit(text):
        raise NotAQuantity(RULE if len(text) <= LONGEST else f"a unit of {len(text)} characters", write)
    # engineers' spelling to pint's: "Nm" (a nautical mile to pint), "·", "⋅", and the 1 of "1/K"
    spelled = _NM.sub("N*m", _ONE_OVER.sub("dimensionless", text).replace("·", "*").replace("⋅", "*"))
    try:
        return registry().parse_units(spelled)
    except pint.UndefinedUnitError as error:
        names = error.unit_names
        name = names if isinstance(names, str) else ", ".join(names)
        raise NotAQuantity(f'unknown unit "{name}"', write) from None
    except Exception:  # pint's parser raises whatever Python's tokenizer and arithmetic do
        raise NotAQuantity("not a number and a unit", write) from None


def _spelled_factor(number: str, unit: str, kind: Kind, write: str) -> float:
    """Factor of a unit; where it has none, the error says how it is written here, if that is known."""
    try:
        return _factor(unit, kind, write)
    except NotAQuantity:
        if hint := spelling(number, unit, kind.name):
            raise NotAQuantity(*hint) from None
        raise


@cache
def _factor(text: str, kind: Kind, write: str) -> float:
    """Factor from the unit `text` to the SI unit of `kind`; one with a shifted zero, °C, has none."""
    if not text.strip():
        raise NotAQuantity("a number without a unit", write)
    for table in (COMMON_UNITS, OWN_UNITS):
        if (unit := table.get(kind.name, {}).get(text)) is not None:
            return unit
    return _factor_by_pint(text, kind, write)


def _factor_by_pint(text: str, kind: Kind, write: str) -> float:
    import pint

    units = _units(text, write)
    if not is_unit(kind.si):  # of a file from elsewhere
        raise NotAQuantity(RULE, write)
    try:
        unit = registry().Quantity(1.0, units)
        if kind.name in (SPEED, FREQUENCY) and units.is_compatible_with("1/s"):
            # whether an angle stands in the unit: pint itself treats the radian as the number 1
            if "radian" not in dict(unit.to_root_units().unit_items()):
                if kind.name == FREQUENCY:
                    return 2 * pi * float(unit.to("1/s").magnitude)
                rule = "a frequency, which leaves open whether turns or radians are meant"
                raise NotAQuantity(rule, write)
        return float(unit.to(kind.si).magnitude)
    except pint.DimensionalityError:
        raise NotAQuantity(f'"{text}" is not a unit of {kind.name}', write) from None
    except pint.OffsetUnitCalculusError:
        raise NotAQuantity(f'"{text}" has a shifted zero', write) from None
    except ArithmeticError:
        raise NotAQuantity(f'"{text}": {EXTREME}', write) from None


def positive(kind: Kind) -> Kind:
    """Return the same kind, greater than zero."""
    return kind._replace(allowed="positive")


def not_negative(kind: Kind) -> Kind:
    """Return the same kind, zero or more."""
    return kind._replace(allowed="not negative")


LENGTH = Kind("length", "m", "3 mm")
RELIEF = Kind("length", "m", "20 um")
DEVIATION = Kind("length", "m", "4 um")
SMALL_ANGLE = Kind(ANGLE, "rad", "2 arcmin")
ANGLE_KIND = Kind(ANGLE, "rad", "20 deg")
ANGULAR_SPEED = Kind(SPEED, "rad/s", "10 rad/s")
ANGULAR_FREQUENCY = Kind(FREQUENCY, "rad/s", "30 Hz")
TIME = Kind("time", "s", "0.1 s")
NUMBER = Kind("a number", "dimensionless", "5 1")
POWER = Kind("power", "W", "1500 W")
TORQUE = Kind("torque", "N*m", "500 N*m")
MASS = Kind("mass", "kg", "0.7 kg")
FORCE = Kind("force", "N", "2 kN")
VOLUME = Kind("volume", "m**3", "2 l")
VOLUME_FLOW = Kind("volume flow", "m**3/s", "2 l/min")
AREA = Kind("area", "m**2", "0.8 m**2")
HEAT_TRANSFER = Kind("heat transfer coefficient", "W/(m**2*K)", "15 W/(m**2*K)")
CONDUCTANCE = Kind("thermal conductance", "W/K", "20 W/K")
INERTIA = Kind("moment of inertia", "kg*m**2", "4e-4 kg*m**2")
STIFFNESS = Kind("stiffness", "N/m", "2.8e8 N/m")
DAMPING = Kind("damping", "N*s/m", "500 N*s/m")
TORSIONAL_STIFFNESS = Kind("torsional stiffness", "N*m/rad", "5e4 N*m/rad")
TORSIONAL_DAMPING = Kind("torsional damping", "N*m*s/rad", "0.5 N*m*s/rad")
PRESSURE = Kind("pressure", "Pa", "206 GPa")
DENSITY = Kind("density", "kg/m**3", "7850 kg/m**3")
CONDUCTIVITY = Kind("thermal conductivity", "W/(m*K)", "60.5 W/(m*K)")
SPECIFIC_HEAT = Kind("specific heat", "J/(kg*K)", "434 J/(kg*K)")
KINEMATIC_VISCOSITY = Kind("kinematic viscosity", "m**2/s", "220 mm**2/s")
VISCOSITY = Kind("dynamic viscosity", "Pa*s", "0.35 Pa*s")
PRESSURE_VISCOSITY = Kind("pressure-viscosity coefficient", "1/Pa", "25 1/GPa")
PER_KELVIN = Kind("temperature coefficient", "1/K", "0.045 1/K")
TEMPERATURE_KIND = Kind(TEMPERATURE, "K", "80 degC")
TEMPERATURE_DIFFERENCE = Kind("temperature difference", "K", "17.38 K")
EXPANSION = Kind("thermal expansion", "1/K", "8.36e-4 1/K")
ACCELERANCE = Kind("acceleration per force", "1/kg", "0.05 m/s**2/N")
VELOCITY = Kind("velocity", "m/s", "2 m/s")
WEAR_COEFFICIENT = Kind("wear coefficient", "m**2/N", "1e-18 m**2/N")

#: Quantities that a tooth family or a law may have a key of, by name: `numerics.parameter.Parameter.kind`.
QUANTITIES = {
    kind.name: kind
    for kind in (
        LENGTH,
        ANGLE_KIND,
        ANGULAR_SPEED,
        ANGULAR_FREQUENCY,
        TIME,
        VELOCITY,
        POWER,
        TORQUE,
        MASS,
        INERTIA,
        STIFFNESS,
        TORSIONAL_STIFFNESS,
        TORSIONAL_DAMPING,
        PRESSURE,
        DENSITY,
        CONDUCTIVITY,
        SPECIFIC_HEAT,
        VISCOSITY,
        PRESSURE_VISCOSITY,
        PER_KELVIN,
        WEAR_COEFFICIENT,
    )
}
