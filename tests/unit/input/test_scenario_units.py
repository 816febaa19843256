import math

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.input import units
from tribodyn.input.messages import Origins
from tribodyn.input.unit_grammar import COMMON_UNITS
from tribodyn.input.units import NotAQuantity, factor_to_si, to_si
from tribodyn.numerics.curve import check_cover
from tribodyn.studies.protocol.load import load_scenario

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


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("2 N⋅m", units.TORQUE, 2.0),
        ("2 kN·m", units.TORQUE, 2000.0),
        ("60 rev/min", units.ANGULAR_SPEED, 2 * math.pi),
        ("60 r/min", units.ANGULAR_SPEED, 2 * math.pi),
        ("1 PS", units.POWER, 735.49875),  # DIN 66036: 75 kp m/s
        ("1 hp", units.POWER, 745.69987158227022),  # 550 ft lbf/s
    ],
)
def test_units_of_other_programs_are_read(text: str, kind: units.Kind, value: float):
    assert to_si(text, kind) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "kind", "remedy"),
    [
        ("1500 RPM", units.ANGULAR_SPEED, 'write "1500 rpm"'),
        ("25 KW", units.POWER, 'write "25 kW"'),
        ("25 HP", units.POWER, 'write "25 hp" of 745.7 W or "25 PS" of 735.5 W'),
        ("220 mm2/s", units.KINEMATIC_VISCOSITY, 'write "220 mm**2/s"'),
        ("7850 kg/m3", units.DENSITY, 'write "7850 kg/m**3"'),
        ("5 N.m", units.TORQUE, 'write "5 N*m"'),
    ],
)
def test_a_unit_that_is_spelled_otherwise(text: str, kind: units.Kind, remedy: str):
    with pytest.raises(NotAQuantity) as refused:
        to_si(text, kind)
    assert refused.value.remedy == remedy


def test_what_a_remedy_says_is_read():
    """Every spelling that is offered is a quantity of that kind."""
    for text, kind in (("9 RPM", units.ANGULAR_SPEED), ("9 mm2/s", units.KINEMATIC_VISCOSITY)):
        with pytest.raises(NotAQuantity) as refused:
            to_si(text, kind)
        assert to_si(refused.value.remedy.split('"')[1], kind) > 0.0


@pytest.mark.parametrize(
    ("key", "typed"),
    [("drive.pinion.wobble_angle", "20 deg"), ("drive.gear.eccentricity_angle", "0.2 turn")],
)
def test_messages_show_an_angle_in_the_unit_that_was_typed(key: str, typed: str):
    """The rule of an angle without effect speaks of a number in radians."""
    with pytest.raises(InputError, match="has no effect without") as found:
        load_scenario("crc-23-47", {key: typed})
    assert f"{key} = {typed}: " in str(found.value)


@pytest.mark.parametrize(
    ("shown", "typed", "said"),
    [
        ("0.349 rad", "20 deg", "20 deg"),  # rounded
        ("9 mm", "9000 um", "9000 um"),
        ("0.349 rad", "0.34906585 rad", "0.349 rad"),  # the unit is the same, and the digits fewer
        ("0.2 rad", "20 deg", "0.2 rad"),  # not what was typed
        ("20 mm", "20 deg", "20 mm"),
        ("a table", "20 deg", "a table"),
    ],
)
def test_a_value_that_was_typed_in_another_unit(shown: str, typed: str, said: str):
    origins = Origins("a.toml").over({"stage": [{"angle": typed}]})
    assert origins.locate(InputError("stage.0.angle", shown, "is wrong")).value == said


@pytest.mark.parametrize(("unit", "factor"), [("deg", math.pi / 180.0), ("mrad", 1e-3), ("rad", 1.0)])
def test_messages_show_a_table_s_range_in_its_own_unit(unit: str, factor: float):
    table = {"roll_angle": {"unit": unit, "values": [-2, 3]}, "error": {"unit": "um", "values": [0, 0]}}
    origins = Origins("file").over({"mesh": {"table": table}})
    with pytest.raises(InputError) as error, origins.naming():
        check_cover(np.array([-2.0, 3.0]) * factor, -4.0 * factor, 5.0 * factor, "mesh.table")
    assert f"mesh.table = -2 … 3 {unit}: " in str(error.value)
    assert f"from -4 to 5 {unit} of pinion rotation" in str(error.value)
