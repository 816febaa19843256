"""Oil from its data sheet: a published design report, closed forms, limits."""

import math
import re
from dataclasses import replace
from pathlib import Path

import pytest

from tribodyn.tribology import oil
from tribodyn.tribology.contact import NominalConditions
from tribodyn.tribology.friction.niemann import niemann, schlenk
from tribodyn.tribology.oil import (
    OIL_TYPES,
    T_40,
    ZERO_CELSIUS,
    FzgStages,
    LubricantData,
    OilSheet,
    lubricant_around,
    lubricant_at,
    lubricant_from,
    oil_values,
)

#: Of the KISSsoft report of 2017: ISO VG 220, mineral.
REPORT = OilSheet("mineral", 220e-6, 19e-6, 890.0)
T_80 = ZERO_CELSIUS + 80.0


def test_a_published_design_report():
    """Pressure-viscosity at 38 °C and viscosity at a bulk temperature printed as 85.0 °C."""
    viscosity = REPORT.viscosity(ZERO_CELSIUS + 38.0)
    assert oil.pressure_viscosity_38("mineral", viscosity) == pytest.approx(2.162e-8, rel=3e-4)
    warmer, colder = (1e3 * REPORT.viscosity(ZERO_CELSIUS + theta) for theta in (85.05, 84.95))
    assert warmer < 25.25
    assert colder > 25.15


def test_given_values_take_the_place_of_derived_ones_at_every_temperature():
    sheet = OilSheet("pao", 220e-6, 26e-6, 850.0, {"pressure_viscosity": 1.5e-8, "asperity_friction": 0.1})
    for temperature in (T_40, T_80):
        found = lubricant_from(sheet, temperature)
        assert (found.pressure_viscosity, found.asperity_friction) == (1.5e-8, 0.1)
        index = 1.5e-8 * 1.962e8 / (math.log(found.inlet_viscosity) + 9.67)
        assert found.viscosity_pressure_index == pytest.approx(index)
        assert oil_values(found)["pressure_viscosity"].origin == "given"
    assert "ASTM D341" in oil_values(found)["inlet_viscosity"].origin


def test_an_oil_at_another_temperature_is_the_same_oil():
    warm = lubricant_at(lubricant_from(REPORT, T_40), T_80)
    assert warm == lubricant_from(REPORT, T_80)
    with pytest.raises(ValueError, match="data sheet"):
        lubricant_at(LubricantData(0.11, 0.06, 0.01, 1.5e-8, 0.58, 0.03, 820.0), T_80)


def test_niemann_and_schlenk_differ_by_the_lubricant_factor_of_the_type():
    def conditions(lubricant):
        return NominalConditions(
            4000.0, 0.027, 0.054, math.radians(20), 150.0, 0.02, 0.025, 840.0, 8e-7,
            lubricant.load_exponent, lubricant.lubricant_factor, lubricant.schlenk_factor,
        )  # fmt: skip

    means = {
        kind: conditions(lubricant_from(OilSheet(kind, 220e-6, 25e-6, 860.0), T_80)) for kind in OIL_TYPES
    }
    for kind, factor in {"mineral": 0.846, "pao": 0.65, "ester": 0.65, "pag": 0.585}.items():
        assert schlenk(means[kind]) / schlenk(means["mineral"]) == pytest.approx(factor / 0.846)
    assert niemann(means["pao"]) / niemann(means["mineral"]) == pytest.approx(0.8)
    assert niemann(means["pag"]) / niemann(means["mineral"]) == pytest.approx(0.7)
    # by hand, in engineers' units: w 212.8 N/mm, V_ΣC 2.770 m/s, ρ_C 6.156 mm, η 25 mPa s, Ra 0.8 µm
    load = 4.0 / 20e-3 / math.cos(math.radians(20))
    speed, radius = 2 * 150 * 0.027 * math.sin(math.radians(20)), 18.0 * math.sin(math.radians(20))
    by_hand = 0.048 * (load / speed / radius) ** 0.2 * 25**-0.05 * 0.8**0.25
    assert niemann(means["mineral"]) == pytest.approx(by_hand, rel=1e-9)
    assert schlenk(means["mineral"]) == pytest.approx(0.846 * by_hand, rel=1e-9)


@pytest.mark.parametrize("kind", OIL_TYPES)
def test_every_number_of_an_oil_by_hand(kind):
    """In mm²/s, mPa s and °C, with decadic logarithms, from two lines of a data sheet."""
    v40, v100, density, theta = 146.0, 17.3, 873.0, 67.0
    kelvin = theta + 273.15
    found = lubricant_from(OilSheet(kind, v40 * 1e-6, v100 * 1e-6, density), kelvin)

    def kinematic(at):
        doubled = [math.log10(math.log10(v + 0.7)) for v in (v40, v100)]
        slope = (doubled[0] - doubled[1]) / math.log10(373.15 / 313.15)
        return 10**10 ** (doubled[0] - slope * math.log10(at / 313.15)) - 0.7

    def dynamic(at):
        return kinematic(at) * 1e-6 * (density - 0.7 * (at - 289.0))

    assert found.density == pytest.approx(density - 0.7 * (kelvin - 289))
    assert found.inlet_viscosity == pytest.approx(dynamic(kelvin), rel=1e-12)
    at_38 = dynamic(38 + 273.15)
    factor, power = {"mineral": (2.657, 0.1348), "pao": (1.466, 0.0507), "pag": (1.392, 0.1572)}.get(
        kind, (0.0, 0.0)
    )
    alpha = factor * 1e-8 * at_38**power * (1 + 516 * (1 / (theta + 273) - 1 / 311))
    if kind == "ester":  # Gold et al. (2001)
        alpha = 6.605e-9 * kinematic(kelvin) ** 0.136
    assert found.pressure_viscosity == pytest.approx(alpha, rel=1e-12)
    index = alpha * 1.962e8 / (math.log(dynamic(kelvin)) + 9.67)
    assert found.viscosity_pressure_index == pytest.approx(index, rel=1e-12)
    slope = (math.log(dynamic(kelvin + 0.01)) - math.log(dynamic(kelvin - 0.01))) / 0.02
    assert found.temperature_viscosity == pytest.approx(-slope, rel=1e-6)
    assert found.load_exponent == 0.0
    # mineral, PAO, PAG of ISO/TR 15144-1; the phosphate ester is its only ester
    assert found.lubricant_factor == {"mineral": 1.0, "pao": 0.8, "pag": 0.7, "ester": 0.8}[kind]
    assert found.schlenk_factor == {"mineral": 0.846, "pao": 0.65, "pag": 0.585, "ester": 0.65}[kind]


def test_an_oil_without_a_data_sheet_is_mineral_75w90():
    """Niemann's exponent of 75W90 for a lubricant factor, Schlenk's factor of mineral oil; FZG at 90 °C."""
    plain = LubricantData(0.11, 0.06, 0.01, 1.5e-8, 0.58, 0.03, 820.0)
    mean = NominalConditions(4e3, 0.027, 0.054, 0.35, 150.0, 0.02, 0.025, 840.0, 8e-7, 0.0651)
    for lubricant in (plain, mean):
        assert (lubricant.load_exponent, lubricant.lubricant_factor, lubricant.schlenk_factor) == (
            0.0651,
            1.0,
            0.846,
        )
    assert plain.fzg == (FzgStages(None, None, 90.0 + 273.15))
    assert lubricant_around(plain) is plain
    known = oil_values(
        replace(plain, type="pao", given=frozenset(oil.UNITS) - {"limiting_shear_coefficient"})
    )
    assert known["density"] == (820.0, "kg/m3", "given", None)
    assert known["limiting_shear_coefficient"][1:] == ("1", oil.LIMITING_SHEAR["pao"].source, (0.03, 0.04))
    assert known["asperity_friction"].origin == "given"
    assert all(value.origin == "given" for value in oil_values(plain).values())
    untyped = oil_values(replace(plain, given=frozenset(oil.UNITS) - {"schlenk_factor", "load_exponent"}))
    assert untyped["schlenk_factor"].origin.startswith("default: mineral")
    assert "75W90" in untyped["load_exponent"].origin


def test_coefficients_by_type_are_those_of_the_page():
    """Values, and spreads where there are some, of the table "By type"."""
    page = (Path(__file__).parents[3] / "docs" / "oil.md").read_text(encoding="utf-8")
    for name in ("limiting_shear_coefficient", "asperity_friction", "lubricant_factor", "schlenk_factor"):
        (row,) = re.findall(rf"^\| `{name}` \|(.+)$", page, re.MULTILINE)
        cells, first = row.split("|")[:4], row.split("|")[0]
        for kind, cell in zip(("mineral", "pao", "ester", "pag"), cells, strict=True):
            numbers = [float(text) for text in re.findall(r"[\d.]+", first if "same" in cell else cell)]
            found = oil.by_type(kind)[name]
            assert found.value == numbers[0]
            assert found.spread == (tuple(numbers[1:]) or None), (name, kind)
            assert found.spread is None or found.spread[0] <= found.value <= found.spread[1]


def test_viscosities_far_beyond_those_of_oils_stay_numbers():
    """Near 0 K the line of D341 is held at ln ln(ν + 0.7) = 4; a slope there is finite."""
    assert oil.kinematic_viscosity(220e-6, 19e-6, 40.0) == pytest.approx(1e-6 * math.exp(math.exp(4.0)))
    assert math.isfinite(oil.temperature_viscosity_at(220e-6, 19e-6, 890.0, 40.0))
    assert (oil.TEMPERATURE_RANGE, oil.MINIMUM_VISCOSITY) == (pytest.approx((233.15, 453.15)), 2e-6)
    assert oil.MAXIMUM_VISCOSITY == 20.0


def test_heat_of_a_mineral_oil_by_cragoe():
    """(1685 + 3.39 θ)/√d."""
    theta, d = 63.0, 0.861
    kelvin = theta + 273.15
    assert oil.specific_heat(861.0, kelvin) == pytest.approx((1685 + 3.39 * theta) / math.sqrt(d), rel=1e-12)
