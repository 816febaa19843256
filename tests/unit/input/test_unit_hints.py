"""Quantities in engineers' own spelling are refused with what to write instead, which then is taken."""

import re

import pytest

from tribodyn.errors import InputError
from tribodyn.input import units
from tribodyn.input.sources import read_toml
from tribodyn.input.unit_grammar import range_for_one
from tribodyn.input.units import NotAQuantity, factor_to_si, to_si
from tribodyn.studies.protocol.load import json_schema


@pytest.mark.parametrize(
    ("value", "kind", "remedy", "meant"),
    [
        ("0,5 mm", units.LENGTH, 'write a decimal point: "0.5 mm"', 0.5e-3),
        ("-0,25 um", units.LENGTH, 'write a decimal point: "-0.25 um"', -0.25e-6),
        ("1,500 rpm", units.ANGULAR_SPEED, 'write "1.500 rpm" or "1500 rpm", whichever is meant', None),
        ("1500 1/min", units.ANGULAR_SPEED, 'write "1500 rpm"', 157.07963267948966),
        ("1500 min^-1", units.ANGULAR_SPEED, 'write "1500 rpm"', 157.07963267948966),
        ("350 mPas", units.VISCOSITY, 'write "350 mPa*s"', 0.35),
        ("0.35 Pas", units.VISCOSITY, 'write "0.35 Pa*s"', 0.35),
        ("0.5 kNm", units.TORQUE, 'write "0.5 kN*m"', 500.0),
        ("1500 min-1", units.ANGULAR_SPEED, 'write "1500 rpm"', 157.07963267948966),
        ("4e-4 kgm2", units.INERTIA, 'write "4e-4 kg*m^2"', 4e-4),
    ],
)
def test_what_is_advised_is_taken(value, kind, remedy, meant):
    with pytest.raises(NotAQuantity) as refused:
        to_si(value, kind)
    assert refused.value.remedy == remedy
    for advised in re.findall(r'"([^"]*)"', remedy):
        assert meant is None or to_si(advised, kind) == pytest.approx(meant, rel=1e-14)


@pytest.mark.parametrize(
    "value",
    ["500-6000rpm", "500 – 6000 rpm", "500rpm-6000 rpm", "500 to 6000 rpm", "500..6000rpm", "500:6000/20rpm"],
)
def test_a_range_is_not_one_value(value):
    with pytest.raises(NotAQuantity, match="a range") as refused:
        to_si(value, units.ANGULAR_SPEED)
    one, ends = re.findall(r'write "([^"]*)", or vary it: .*KEY=([^/]*)', refused.value.remedy)[0]
    assert to_si(one, units.ANGULAR_SPEED) == pytest.approx(500 * 0.10471975511965977)
    assert ends == "500:6000"


@pytest.mark.parametrize("value", ["5e-3 rad/s", "-5 rad/s", "1e-6-"])
def test_these_are_no_ranges(value):
    assert range_for_one(value) is None


@pytest.mark.parametrize("unit", ["mm²/s", "mm^2/s", "mm**2/s", "cSt", "m²/s"])
def test_a_kinematic_viscosity_is_to_be_multiplied_by_the_density(unit):
    with pytest.raises(NotAQuantity, match="times the density") as refused:
        to_si(f"100 {unit}", units.VISCOSITY)
    advised = re.findall(r'"([^"]*)"', refused.value.remedy)
    assert to_si(advised[0], units.VISCOSITY) == pytest.approx(100e-6 * 850)


def test_a_unit_of_a_column_is_advised_without_a_number():
    with pytest.raises(NotAQuantity, match='write "kN\\*m"'):
        factor_to_si("kNm", units.TORQUE)


@pytest.mark.parametrize(
    ("line", "remedy"),
    [
        (r'drive = "C:\drives\mine.toml"', r"write / for \ in a path"),
        ("damping_ratio = 0,05", "write a decimal point"),
    ],
)
def test_lines_that_are_not_toml(tmp_path, line, remedy):
    (tmp_path / "wrong.toml").write_text(f'title = "wrong"\n{line}\n', encoding="utf-8")
    with pytest.raises(InputError) as refused:
        read_toml(tmp_path / "wrong.toml")
    assert refused.value.key == "line 2"
    assert remedy in refused.value.remedy


def test_examples_of_the_schema_are_of_the_size_of_what_they_stand_for():
    """A roughness of millimetres, or a hardness like Young's modulus, would be no help."""
    tables = json_schema()["$defs"]

    def example(table: str, key: str) -> float:
        shape = tables[table]["properties"][key]
        [text] = shape.get("examples") or shape["anyOf"][0]["examples"]
        kind = units.PRESSURE if key == "hardness" else units.LENGTH
        return to_si(text, kind)

    for key in ("roughness", "mean_roughness"):
        assert 0.05e-6 <= example("DriveTable", key) <= 5e-6
    assert 0.01e-6 <= example("Mesh", "contact_width") <= 10e-6
    assert 1e9 <= example("Material", "hardness") <= 10e9
    assert example("Gear", "bore_radius") > example("DriveTable", "module")
    assert example("Gear", "face_width") > example("DriveTable", "module")
