import math

import pytest

from tribodyn.scenario import units
from tribodyn.scenario.unit_grammar import COMMON_UNITS
from tribodyn.scenario.units import NotAQuantity, factor_to_si, to_si

GRAMMAR = "not a unit: names joined by * and /, with exponents from -9 to 9"


@pytest.mark.parametrize(
    ("text", "kind", "expected"),
    [
        ("3 mm", units.LENGTH, 0.003),
        ("9mm", units.LENGTH, 0.009),
        ("0.3 µm", units.LENGTH, 0.3e-6),
        ("-2.5e-1 um", units.LENGTH, -0.25e-6),
        ("1500 rpm", units.ANGULAR_SPEED, 50 * math.pi),
        ("10 rad/s", units.ANGULAR_SPEED, 10.0),
        ("2 turn/s", units.ANGULAR_SPEED, 4 * math.pi),
        ("30 Hz", units.ANGULAR_FREQUENCY, 60 * math.pi),
        ("30 1/s", units.ANGULAR_FREQUENCY, 60 * math.pi),
        ("30 rad/s", units.ANGULAR_FREQUENCY, 30.0),
        ("20 deg", units.ANGLE_KIND, math.pi / 9),
        ("20°", units.ANGLE_KIND, math.pi / 9),
        ("500 N*m", units.TORQUE, 500.0),
        ("500 N m", units.TORQUE, 500.0),
        ("500 Nm", units.TORQUE, 500.0),
        ("0.5 kN·m", units.TORQUE, 500.0),
        ("206 GPa", units.PRESSURE, 206e9),
        ("25 1/GPa", units.PRESSURE_VISCOSITY, 25e-9),
        ("2.5e-8 m**2/N", units.PRESSURE_VISCOSITY, 25e-9),
        ("350 mPa*s", units.VISCOSITY, 0.35),
        ("0.045 1/K", units.PER_KELVIN, 0.045),
        ("7.85 g/cm**3", units.DENSITY, 7850.0),
        ("60.5 W/m/K", units.CONDUCTIVITY, 60.5),
        ("280 N/um", units.STIFFNESS, 2.8e8),
        ("1000 N*m/deg", units.TORSIONAL_STIFFNESS, 180e3 / math.pi),
    ],
)
def test_a_quantity_becomes_si(text, kind, expected):
    assert to_si(text, kind) == pytest.approx(expected, rel=1e-14)


def test_decimal_prefixes_are_exact():
    assert to_si("9 mm", units.LENGTH) == 0.009
    assert to_si("0.3 um", units.LENGTH) == 0.3e-6


@pytest.mark.parametrize(
    ("value", "kind", "rule"),
    [
        (10, units.LENGTH, "a number without a unit"),
        (10.5, units.LENGTH, "a number without a unit"),
        ("10", units.LENGTH, "a number without a unit"),
        ("0.35", units.ANGLE_KIND, "a number without a unit"),
        ("10 kg", units.LENGTH, '"kg" is not a unit of length'),
        ("10 mm mm", units.LENGTH, '"mm mm" is not a unit of length'),
        ("10 parsnip", units.LENGTH, 'unknown unit "parsnip"'),
        ("10 Hz", units.ANGULAR_SPEED, "a frequency, which leaves open whether turns or radians are meant"),
        ("nan mm", units.LENGTH, "not a finite number"),
        ("inf mm", units.LENGTH, "not a finite number"),
        ("1e999 mm", units.LENGTH, "not a finite number"),
        ("0 mm", units.positive(units.LENGTH), "must be greater than zero"),
        ("-1 mm", units.not_negative(units.LENGTH), "must be zero or more"),
        ("20 degC", units.PER_KELVIN, '"degC" is not a unit of temperature coefficient'),
        ("", units.LENGTH, "not a number and a unit"),
        ("mm", units.LENGTH, "not a number and a unit"),
        ("9**9**9**9 mm", units.LENGTH, GRAMMAR),
        ("3 mm(", units.LENGTH, GRAMMAR),
        ([3, "mm"], units.LENGTH, "not a quantity but a list"),
        (True, units.LENGTH, "not a quantity but a true/false value"),
    ],
)
def test_what_is_no_quantity_is_refused_with_the_rule_and_an_example(value, kind, rule):
    with pytest.raises(NotAQuantity) as refused:
        to_si(value, kind)
    assert refused.value.rule == rule
    assert "such as" in refused.value.remedy or kind.example in refused.value.remedy


def test_a_unit_alone_has_a_factor():
    assert factor_to_si("ms", units.TIME) == pytest.approx(1e-3, rel=1e-15)
    with pytest.raises(NotAQuantity, match="without a unit"):
        factor_to_si("", units.TIME)


@pytest.mark.parametrize(
    ("kind", "unit"), [(name, unit) for name, known in COMMON_UNITS.items() for unit in known]
)
def test_common_units_are_as_pint_has_them(kind, unit):
    kinds = [value for value in vars(units).values() if isinstance(value, units.Kind) and value.name == kind]
    assert COMMON_UNITS[kind][unit] == pytest.approx(units._factor_by_pint(unit, kinds[0], ""), rel=5e-16)
