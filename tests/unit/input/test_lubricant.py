"""The table of a lubricant: data sheet or direct numbers, its temperature, and what is refused."""

import math
import tomllib

import pytest

from tribodyn.derivatives.numbers import numbers_of
from tribodyn.errors import InputError
from tribodyn.gears.check import oil_data, oil_remarks, oil_table
from tribodyn.interface.scenario import scenario
from tribodyn.studies import study_of

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


LAW = {
    "model": "improved-yasutomi",
    "a1": "188.86 K",
    "a2": "0.719 1/GPa",
    "b1": "8.2 1/GPa",
    "b2": -0.5278,
    "c1": 16.09,
    "c2": "17.38 K",
    "glass_temperature": "-83.2 degC",
    "maximum_pressure": "1 GPa",
    "minimum_temperature": "20 degC",
    "maximum_temperature": "120 degC",
}


def test_a_measured_law_gives_the_pressure_viscosity_coefficient():
    given = oil(lubricant__viscosity_law=LAW)
    assert given.sheet.law.law.c1 == 16.09
    assert given.pressure_viscosity == given.sheet.law.coefficient(353.15)
    assert "viscosity_law" in oil_data(given)["pressure_viscosity"]["origin"]
    assert not oil_remarks(given)
    hot = oil_remarks(oil(lubricant__viscosity_law=LAW, operating__oil_temperature="130 degC"))
    assert "was measured from 20 to 120 °C" in hot[0]
    assert oil(lubricant__viscosity_law={"model": "by-type"}).sheet.law is None
    assert oil(lubricant__viscosity_law={"model": "roelands"}).sheet.roelands


@pytest.mark.parametrize(
    ("changed", "at", "rule"),
    [
        ({"viscosity_law.c2": None}, "viscosity_law.c2", 'missing: model = "improved-yasutomi" needs c2'),
        ({"viscosity_law.bulk_modulus": "8 GPa"}, "viscosity_law.bulk_modulus", "no effect"),
        ({"viscosity_law.b2": 0.5}, "viscosity_law.b2", "0"),
        ({"viscosity_law.a1": 188.86}, "viscosity_law.a1", "without a unit"),
        ({"viscosity_law.model": "barus"}, "viscosity_law.model", "not one of the choices"),
        ({"viscosity_law.maximum_temperature": "10 degC"}, "viscosity_law.maximum_temperature", "above"),
        ({"viscosity_law.a3": 1.0}, "viscosity_law.a3", "unknown"),
        ({"viscosity_law.a2": "719 1/GPa"}, "viscosity_law", "times the viscosity at ambient pressure"),
        ({"viscosity_law.glass_temperature": "600 K"}, "viscosity_law", "at 1 GPa and 20 °C"),
        ({"viscosity_pressure_index": 0.6}, "viscosity_pressure_index", "contradicts"),
        ({"pressure_viscosity": "20 1/GPa"}, "pressure_viscosity", "contradicts"),
    ],
)
def test_a_law_that_cannot_be_is_refused(changed, at, rule):
    table = SCENARIO["lubricant"] | {"viscosity_law": dict(LAW)}
    for key, value in changed.items():
        place, last = (table["viscosity_law"], key[14:]) if key.startswith("viscosity_law.") else (table, key)
        place[last] = value
        if value is None:
            del place[last]
    with pytest.raises(InputError) as refused:
        scenario(SCENARIO | {"lubricant": table})
    assert refused.value.key == f"lubricant.{at}"
    assert rule in refused.value.rule
    assert refused.value.remedy


@pytest.mark.parametrize(
    ("name", "value"),
    [("occupied_expansion", "10 1/K"), ("occupied_expansion", "-1 1/K"), ("bulk_modulus_decay", "1 1/K")],
)
def test_constants_that_are_of_no_oil_are_refused(name, value):
    """Of squalane's Doolittle-Tait constants one is wrong."""
    law = {
        **{"model": "doolittle-tait", "free_volume_factor": 4.71, "occupied_share": 0.6568},
        **{"occupied_expansion": "-9.599e-4 1/K", "reference_temperature": "40 degC"},
        **{"expansion": "8.36e-4 1/K", "bulk_modulus": "8.658 GPa", "bulk_modulus_decay": "6.332e-3 1/K"},
        **{"bulk_modulus_slope": 11.74, "maximum_pressure": "1 GPa"},
        **{"minimum_temperature": "20 degC", "maximum_temperature": "100 degC"},
    }
    assert oil(lubricant__viscosity_law=law).sheet.law is not None
    with pytest.raises(InputError, match="compare values and units with the oil's publication"):
        oil(lubricant__viscosity_law=law | {name: value})


def test_a_law_needs_a_data_sheet():
    direct = {key: value for key, value in SCENARIO["operating"].items() if key != "oil_temperature"}
    lubricant = {"like": "liu-ni-2022", "viscosity_law": {"model": "by-type"}}
    with pytest.raises(InputError, match="needs a data sheet"):
        scenario(SCENARIO | {"lubricant": lubricant, "operating": direct})


def test_a_finish_that_does_not_exist_is_refused():
    with pytest.raises(InputError) as refused:
        scenario(SCENARIO, {"drive.finish": "honed"})
    assert refused.value.key == "drive.finish"
    assert '"superfinished"' in refused.value.remedy
    with pytest.raises(InputError, match="asperity_slope"):
        scenario(SCENARIO, {"drive.asperity_slope": -0.01})
    case = scenario(SCENARIO, {"drive.finish": "hobbed", "drive.asperity_density": 0.04})
    assert case.asperities == (0.04, 0.03)


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
