"""Figures of losses and temperatures, by adding up powers."""

from types import SimpleNamespace
from typing import Any

import pytest

from tribodyn.gears.prepare import contact_quantities, thermal_quantities
from tribodyn.tribology.bulk_temperature import heat_partition
from tribodyn.tribology.losses.loss import Loss

LOSSES = {"churning": Loss(30.0, ("too fast",)), "windage": Loss(5.0, ()), "bearings": Loss(15.0, ())}


def settled(given_off=None) -> Any:
    heat = heat_partition(200.0, LOSSES, housing=given_off is not None)
    temperatures = SimpleNamespace(bulk=350.0, pinion=352.0, gear=348.0, oil=340.0, housing=330.0)
    return SimpleNamespace(temperatures=temperatures, heat=heat, given_off=given_off, losses=LOSSES)


def test_output_over_what_the_motor_gives():
    """1000 W into the mesh and 50 W beside it; 970 W come out."""
    summary = thermal_quantities(settled(240.0), 1000.0, 0.97)
    assert summary["power_load_independent"] == pytest.approx(50.0)
    assert summary["efficiency_with_losses"] == pytest.approx(970.0 / 1050.0)
    assert summary["heat_generated"] == pytest.approx(250.0)
    assert summary["heat_given_off"] == 240.0
    assert summary["power_windage"] == 5.0
    assert (summary["bulk_temperature_pinion"], summary["bulk_temperature_gear"]) == (352.0, 348.0)
    assert summary["losses_outside"] == "churning: too fast"
    assert "housing_temperature" not in thermal_quantities(settled(), 1000.0, 0.97)
    assert thermal_quantities(None, 1000.0, 0.97) == {}


@pytest.mark.parametrize("housing", [True, False])
def test_heat_arises_where_it_is_lost(housing):
    """Half of the teeth's friction in either gear; of bearings in the housing, where there is one."""
    heat = heat_partition(200.0, LOSSES, housing=housing)
    assert tuple(heat[:4]) == (100.0, 100.0, *((35.0, 15.0) if housing else (50.0, 0.0)))
    assert heat.total == pytest.approx(250.0)


def test_contact_temperature_is_bulk_and_flash():
    oil: Any = SimpleNamespace(temperature=340.0)
    unknown: Any = SimpleNamespace(temperature=None)
    assert contact_quantities(oil, {"bulk_temperature": 350.0, "flash_temperature_max": 40.0}) == {
        "contact_temperature_max": 390.0
    }
    assert contact_quantities(oil, {"flash_temperature_max": 40.0})["contact_temperature_max"] == 380.0
    assert contact_quantities(unknown, {"flash_temperature_max": 40.0}) == contact_quantities(oil, {}) == {}
