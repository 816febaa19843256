"""Shipped lubricants and materials: each is read, and lies where such things lie."""

import pytest

from tribodyn.input.sources import names, shipped
from tribodyn.interface.scenario import scenario
from tribodyn.tribology.oil import T_40

OILS = [name for name in names(shipped("models") / "lubricants") if name[:3] in ("iso", "75w", "atf")]
OILS.remove("75w90-diez-ibarbia")
GRADES = (32, 46, 68, 100, 150, 220, 320, 460)


def case(**changed):
    changes = {"operating.oil_temperature": "40 degC", "lubricant": "iso-vg-220-mineral"}
    return scenario("efficiency-involute-18-36", changes | changed)


def test_every_grade_is_there_as_mineral_and_pao():
    expected = {f"iso-vg-{grade}-{kind}" for grade in GRADES for kind in ("mineral", "pao")}
    assert set(OILS) == expected | {"75w90", "atf"}


@pytest.mark.parametrize("name", OILS)
def test_an_oil(name):
    """ISO 3448: the grade is the viscosity at 40 °C; viscosities at 100 °C grow with it."""
    oil = case(lubricant=name).lubricant
    assert 840 < oil.sheet.density_15 < 910
    assert 0.3 < oil.viscosity_pressure_index < 0.8
    if name.startswith("iso"):
        _, _, grade, kind = name.split("-")
        assert oil.sheet.type == kind
        assert oil.inlet_viscosity / oil.density == pytest.approx(1e-6 * float(grade), rel=1e-9)
    assert oil.temperature == T_40


@pytest.mark.parametrize("kind", ["mineral", "pao"])
def test_viscosity_at_100_degrees_grows_with_the_grade(kind):
    sheets = [case(lubricant=f"iso-vg-{grade}-{kind}").lubricant.sheet for grade in GRADES]
    at_100 = [sheet.viscosity_100 for sheet in sheets]
    assert at_100 == sorted(at_100)
    # of the same grade a PAO has the higher viscosity index
    others = [case(lubricant=f"iso-vg-{grade}-mineral").lubricant.sheet.viscosity_100 for grade in GRADES]
    assert kind == "mineral" or all(
        viscosity > other for viscosity, other in zip(at_100, others, strict=True)
    )


@pytest.mark.parametrize("name", ["18CrNiMo7-6", "16MnCr5", "20MnCr5", "42CrMo4", "C45"])
def test_a_steel_has_the_standards_elasticity_and_heat(name):
    """ISO 6336-1: 206 GPa and 0.3; ISO/TS 6336-20: 41 to 52 W/(m K) and about 3.8 MJ/(m³ K)."""
    steel, _ = case(**{"drive.material": name}).materials
    assert (steel.youngs_modulus, steel.poisson_ratio) == (206e9, 0.3)
    assert 41 <= steel.thermal_conductivity <= 52
    assert steel.density * steel.specific_heat == pytest.approx(3.8e6, rel=0.03)


@pytest.mark.parametrize(("name", "modulus"), [("EN-GJS-600-3", 174e9), ("CuSn12", 88.3e9)])
def test_other_materials(name, modulus):
    _, gear = case(**{"drive.gear.material": name}).materials
    assert gear.youngs_modulus == modulus


@pytest.mark.parametrize("name", ["soft-1e8", "medium-4e8", "stiff-2e9"])
def test_a_class_of_bearings(name):
    both = scenario("crc-23-47", {"bearings": name}).bearings
    assert {bearing.stiffness_x for bearing in both} == {float(name.partition("-")[2])}
