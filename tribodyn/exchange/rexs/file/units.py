"""Units of REXS: what each measures, and the unit in which scenarios write it."""

import math
from typing import NamedTuple


class RexsUnit(NamedTuple):
    """A unit of REXS beside the one of a scenario."""

    name: str  # as schema 2.0.0 spells it
    quantity: str
    toml: str  # "" of numbers
    si: float  # in SI units, of temperatures a kelvin
    factor: float = 1.0  # number in the unit of the scenario over that in this unit


UNITS = {
    unit.name: unit
    for unit in (
        RexsUnit("none", "number", "", 1.0),
        RexsUnit("%", "number", "", 0.01, 0.01),
        RexsUnit("mm", "length", "mm", 1e-3),
        RexsUnit("mum", "length", "um", 1e-6),
        RexsUnit("deg", "angle", "deg", math.pi / 180),
        RexsUnit("rad", "angle", "rad", 1.0),
        RexsUnit("1 / min", "angular speed", "rpm", math.pi / 30),
        RexsUnit("rad / s", "angular speed", "rad/s", 1.0),
        RexsUnit("N", "force", "N", 1.0),
        RexsUnit("kN", "force", "kN", 1e3),
        RexsUnit("N m", "torque", "N*m", 1.0),
        RexsUnit("kW", "power", "kW", 1e3),
        RexsUnit("W", "power", "W", 1.0),
        RexsUnit("Pa", "pressure", "Pa", 1.0),
        RexsUnit("MPa", "pressure", "MPa", 1e6),
        RexsUnit("HV", "pressure", "MPa", 9.80665e6, 9.80665),  # a kgf/mm²
        RexsUnit("kg / dm^3", "density", "g/cm**3", 1e3),
        RexsUnit("kg", "mass", "kg", 1.0),
        RexsUnit("kg m^2", "moment of inertia", "kg*m**2", 1.0),
        RexsUnit("mm^2 / s", "kinematic viscosity", "mm**2/s", 1e-6),
        RexsUnit("mm^2 / N", "pressure-viscosity coefficient", "1/GPa", 1e-6, 1e3),
        RexsUnit("h", "time", "h", 3600.0),
        RexsUnit("C", "temperature", "degC", 1.0),
        RexsUnit("N / m", "stiffness", "N/m", 1.0),
        RexsUnit("N / mm", "stiffness", "N/mm", 1e3),
        RexsUnit("N mm / rad", "torsional stiffness", "N*m/rad", 1e-3, 1e-3),
        RexsUnit("W / (m K)", "thermal conductivity", "W/(m*K)", 1.0),
        RexsUnit("J / (kg K)", "specific heat", "J/(kg*K)", 1.0),
    )
}
_PLAIN = {"".join(name.split()): unit for name, unit in UNITS.items()}
#: Spellings of files before 2.0.
_OTHER = {"": "none", "°": "deg", "µm": "mum", "μm": "mum", "°C": "C", "N/mm^2": "MPa"}


def unit_named(name: str | None) -> RexsUnit | None:
    """The unit that a file names; None where nothing is read in it."""
    plain = "".join((name or "").split())
    return _PLAIN.get(_OTHER.get(plain, plain))


def shown(value: float, unit: RexsUnit) -> str:
    """A number of a file as a scenario writes it, with its digits where the unit is the same."""
    text = f"{value:.15g}" if unit.factor == 1.0 else f"{value * unit.factor:.12g}"
    return f'"{text} {unit.toml}"' if unit.toml else text
