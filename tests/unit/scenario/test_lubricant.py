"""The table of a lubricant: data sheet or direct numbers, its temperature, and what is refused."""

import math
import tomllib

import pytest

from tribodyn.derivatives.numbers import numbers_of
from tribodyn.errors import InputError
from tribodyn.interface.scenario import scenario
from tribodyn.studies import study_of
from tribodyn.studies.gears.check import oil_data, oil_remarks, oil_table

SCENARIO = tomllib.loads(
    """
    title = "an oil by its data sheet"
    kind = "efficiency"
    drive = "diez-ibarbia-18-36"
    [lubricant]
    title = "ISO VG 220"
    source = "data sheet"
    type = "mineral"
    viscosity_40 = "220 mm**2/s"
    viscosity_100 = "19 mm**2/s"
    density_15 = "0.89 g/cm**3"
    [operating]
    pinion_speed = "1800 rpm"
    gear_torque = "200 N*m"
    oil_temperature = "80 degC"
    [friction]
    law = "schlenk"
    """
)


def oil(**changed):
    return scenario(SCENARIO, {key.replace("__", "."): value for key, value in changed.items()}).lubricant


@pytest.mark.parametrize("text", ["80 degC", "80 °C", "353.15 K", "176 degF"])
def test_a_temperature_in_any_scale(text):
    assert oil(operating__oil_temperature=text).temperature == pytest.approx(353.15)


def test_viscosity_at_the_temperature_of_the_oil():
    at_40, at_100 = (math.log10(math.log10(viscosity + 0.7)) for viscosity in (220.0, 19.0))
    share = math.log(353.15 / 313.15) / math.log(373.15 / 313.15)
    kinematic = 10**10 ** (at_40 + share * (at_100 - at_40)) - 0.7
    assert oil().inlet_viscosity == pytest.approx(1e-6 * kinematic * (890 - 0.7 * 64.15))
    assert oil(operating__oil_temperature="40 degC").inlet_viscosity == pytest.approx(
        220e-6 * (890 - 0.7 * 24.15)
    )
    # of the other keys of the sheet
    stages = oil(lubricant__fzg_scuffing_stage=12, lubricant__fzg_micropitting_temperature="60 degC").fzg
    assert (stages.scuffing, stages.micropitting) == (12, None)
    assert stages.micropitting_temperature == pytest.approx(333.15)


@pytest.mark.parametrize(
    ("key", "value", "at", "rule", "remedy"),
    [
        ("lubricant.viscosity_100", "250 mm**2/s", "lubricant.viscosity_100", "below viscosity_40", "swap"),
        ("lubricant.viscosity_100", "1 mm**2/s", "lubricant.viscosity_100", "D341 holds from 2", "give"),
        ("lubricant.density_15", "0.89 kg/m**3", "lubricant.density_15", "oils have 650", "g/cm**3"),
        ("lubricant.viscosity_40", "220 m**2/s", "lubricant.viscosity_40", "no oil", "mm**2/s"),
        ("lubricant.inlet_viscosity", "0.3 Pa*s", "lubricant.inlet_viscosity", "contradicts", "leave it out"),
        ("operating.oil_temperature", "200 degC", "operating.oil_temperature", "outside -40 to 180", "write"),
        ("operating.oil_temperature", "-60 °C", "operating.oil_temperature", "outside -40 to 180", "write"),
        ("operating.oil_temperature", "80 C", "operating.oil_temperature", "coulomb", "80 degC"),
        ("operating.oil_temperature", "80", "operating.oil_temperature", "without a unit", "80 degC"),
        ("operating.oil_temperature", "-300 degC", "operating.oil_temperature", "absolute zero", "80 degC"),
        ("lubricant.type", "water", "lubricant.type", "not one of the choices", '"pag"'),
        ("lubricant.density_15", "0.89", "lubricant.density_15", "without a unit", "g/cm**3"),
        ("lubricant", "liu-ni-2022", "operating.oil_temperature", "contradicts", "leave it out"),
    ],
)
def test_what_cannot_be_is_refused(key, value, at, rule, remedy):
    with pytest.raises(InputError) as refused:
        scenario(SCENARIO, {key: value})
    assert refused.value.key == at
    assert rule in refused.value.rule
    assert remedy in refused.value.remedy


@pytest.mark.parametrize(
    ("table", "name"),
    [
        ("lubricant", "type"),
        ("lubricant", "viscosity_40"),
        ("lubricant", "viscosity_100"),
        ("lubricant", "density_15"),
        ("operating", "oil_temperature"),
    ],
)
def test_what_is_missing_is_named(table, name):
    without = SCENARIO | {table: {key: value for key, value in SCENARIO[table].items() if key != name}}
    with pytest.raises(InputError, match="missing") as refused:
        scenario(without)
    assert refused.value.key == f"{table}.{name}"


def test_check_says_every_value_and_its_origin():
    given = oil(lubricant__pressure_viscosity="18 1/GPa")
    data = oil_data(given)
    assert data["type"] == "mineral"
    assert data["pressure_viscosity"] == {"value": pytest.approx(18e-9), "unit": "1/Pa", "origin": "given"}
    assert data["limiting_shear_coefficient"]["spread"] == [0.047, 0.053]
    assert all(number["origin"] for name, number in data.items() if name != "type")
    rows = {row[0]: row[1:3] for row in oil_table(given).rows}
    assert rows["pressure_viscosity"] == ("18", "1/GPa")
    assert not oil_remarks(given)
    assert "extrapolated" in oil_remarks(oil(operating__oil_temperature="120 degC"))[0]


def test_an_oil_without_a_data_sheet_is_as_given():
    direct = {key: value for key, value in SCENARIO["operating"].items() if key != "oil_temperature"}
    data = oil_data(scenario(SCENARIO | {"lubricant": "liu-ni-2022", "operating": direct}).lubricant)
    assert data["inlet_viscosity"] == {"value": 0.35, "unit": "Pa s", "origin": "given"}
    assert "oil_temperature" not in data
    assert "Diez-Ibarbia" in data["load_exponent"]["origin"]
    changes = {"lubricant": {"like": "liu-ni-2022", "type": "pao"}, "operating": direct}
    typed = oil_data(scenario(SCENARIO | changes).lubricant)
    assert typed["lubricant_factor"] == {"value": 0.8, "unit": "1", "origin": "ISO/TR 15144-1"}
    assert typed["limiting_shear_coefficient"] == {"value": 0.091, "unit": "1", "origin": "given"}


def test_numbers_of_the_data_sheet_can_be_varied():
    case = scenario(SCENARIO)
    numbers = numbers_of(case, study_of({"kind": case.kind}).table())
    assert numbers["operating.oil_temperature"].unit == "K"
    assert "lubricant.inlet_viscosity" not in numbers
    warmer = numbers["operating.oil_temperature"].put(case, 373.15)
    assert warmer.lubricant.inlet_viscosity == pytest.approx(19e-6 * (890 - 0.7 * 84.15))
    thicker = numbers["lubricant.viscosity_40"].put(case, 320e-6)
    assert thicker.lubricant.inlet_viscosity > case.lubricant.inlet_viscosity


def test_an_oil_that_would_be_stone_is_refused_and_no_number_overflows():
    changes = {"lubricant.viscosity_40": "9e4 mm**2/s", "lubricant.viscosity_100": "2 mm**2/s"}
    with pytest.raises(InputError, match="higher temperature"):
        scenario(SCENARIO, changes | {"operating.oil_temperature": "-40 degC"})
    assert scenario(SCENARIO, changes).lubricant.temperature_viscosity > 0.0
