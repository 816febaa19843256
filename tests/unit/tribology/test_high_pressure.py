"""Viscosity in the solved contact: measured, estimated by type with its band, or Roelands'."""

from dataclasses import replace

import numpy as np
import pytest

from tribodyn.input.sources import read_toml, shipped
from tribodyn.input.tables.lubricant import Lubricant, lubricant_of
from tribodyn.tribology.high_pressure import MEASURED, contact_viscosity
from tribodyn.tribology.oil import OIL_TYPES, OilSheet, lubricant_from
from tribodyn.tribology.pressure_law import asymptotic_coefficient

T_80 = 353.15
SHEETS = {kind: OilSheet(kind, 220e-6, 22e-6, 880.0) for kind in OIL_TYPES}


def shipped_oil(name, temperature=T_80):
    table = read_toml(shipped("models") / "lubricants" / f"{name}.toml")
    return lubricant_of(Lubricant.model_validate(table), temperature)


def rise(law, pressure=0.8e9):
    return float(law.rise(np.array([pressure]), law.temperature)[0][0])


@pytest.mark.parametrize("name", MEASURED)
def test_a_shipped_measured_oil_has_the_constants_of_the_estimates(name):
    oil = shipped_oil(name)
    found = contact_viscosity(oil)
    assert found.measured is not None
    assert found.measured.law == pytest.approx(MEASURED[name])
    assert not found.estimated
    # α* by its definition is what film regressions read
    assert found.law is not None
    assert oil.pressure_viscosity == asymptotic_coefficient(found.law)
    assert 1e-8 < oil.pressure_viscosity < 2.5e-8


def test_viscosities_of_squalane_as_published():
    """35.8, 15.5 and 3.16 mPa s at 20, 40 and 100 °C (Harris 2009; Comuñas et al. 2013), from memory."""
    for temperature, viscosity in ((293.15, 35.8e-3), (313.15, 15.5e-3), (373.15, 3.16e-3)):
        assert shipped_oil("squalane", temperature).inlet_viscosity == pytest.approx(viscosity, rel=0.03)


@pytest.mark.parametrize(
    ("name", "glass"), [("shell-t9", 1e12), ("hvi-650", 1e7)], ids=["Shell T9", "HVI 650"]
)
def test_sheets_of_oils_are_their_laws_at_ambient_pressure(name, glass):
    for temperature in (313.15, 343.15, 373.15):
        law = np.log(glass) + MEASURED[name].exponent(np.array([0.0]), np.array(temperature))[0][0]
        assert shipped_oil(name, temperature).inlet_viscosity == pytest.approx(np.exp(law), rel=0.1)


@pytest.mark.parametrize("kind", OIL_TYPES)
def test_an_estimate_lies_in_its_band(kind):
    oil = lubricant_from(SHEETS[kind], T_80)
    found = contact_viscosity(oil)
    assert found.estimated
    assert found.law is not None
    assert found.lowest is not None
    assert found.highest is not None
    assert rise(found.lowest) <= rise(found.law) <= rise(found.highest)
    assert rise(found.highest) > 1.1 * rise(found.lowest)
    assert found.pressure_viscosity == asymptotic_coefficient(found.law)
    assert "estimated" in found.limits(1e9, T_80)[0]
    # hotter oil rises less
    assert rise(contact_viscosity(lubricant_from(SHEETS[kind], T_80 + 20.0)).law) < rise(found.law)


@pytest.mark.parametrize("kind", OIL_TYPES)
def test_a_given_coefficient_is_that_of_the_estimate(kind):
    sheet = replace(SHEETS[kind], given={"pressure_viscosity": 1.7e-8})
    found = contact_viscosity(lubricant_from(sheet, T_80))
    assert found.pressure_viscosity == pytest.approx(1.7e-8, rel=0.01)
    assert asymptotic_coefficient(found.lowest) == pytest.approx(1.7e-8, rel=0.01)


def test_roelands_where_it_is_asked_for():
    oil = lubricant_from(SHEETS["pao"], T_80)
    given = replace(SHEETS["pao"], given={"viscosity_pressure_index": 0.5})
    for sheet, estimated in ((given, False), (replace(SHEETS["pao"], roelands=True), True)):
        found = contact_viscosity(lubricant_from(sheet, T_80))
        assert found.law is None
        assert found.estimated == estimated
    direct = contact_viscosity(replace(oil, sheet=None))
    assert direct.law is None
    assert not direct.limits(5e9, None)


def test_limits_of_a_measured_oil_are_said():
    found = contact_viscosity(shipped_oil("squalane"))
    assert found.limits(1.1e9, T_80) == ()
    (pressure,) = found.limits(1.3e9, T_80)
    assert "1.3 GPa is above 1.2 GPa" in pressure
    (temperature,) = found.limits(1.1e9, 393.15)
    assert "from 20 to 100 °C" in temperature
