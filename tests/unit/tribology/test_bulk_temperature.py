"""Lumped network of gears, oil and housing: heat in is heat out, limits, closed forms; fixed points."""

import math

import pytest

from tribodyn.errors import SimulationError
from tribodyn.tribology.bulk_temperature import (
    Heat,
    Network,
    fixed_point,
    heat_given_off,
    network_temperatures,
)

HEAT = Heat(90.0, 90.0, 20.0, 15.0)
NETWORKS = {
    "oil held": Network(20.0, 40.0),
    "oil flow": Network(20.0, 40.0, oil_flow=60.0),
    "housing": Network(20.0, 40.0, oil_housing=30.0, housing_ambient=20.0, ambient_temperature=295.0),
    "both": Network(20.0, 40.0, 60.0, 30.0, 20.0, 295.0),
}


@pytest.mark.parametrize("name", NETWORKS)
def test_heat_in_is_heat_out_at_every_node(name):
    network = NETWORKS[name]
    heat = HEAT if network.housing_ambient else HEAT._replace(housing=0.0)
    found = network_temperatures(network, heat, 350.0)
    assert network.pinion_oil * (found.pinion - found.oil) == pytest.approx(heat.pinion)
    assert network.gear_oil * (found.gear - found.oil) == pytest.approx(heat.gear)
    if network.holds_oil:
        assert found.oil == 350.0
        assert heat_given_off(network, found, 350.0) == pytest.approx(heat.pinion + heat.gear)
        return
    to_housing = network.oil_housing * (found.oil - found.housing)
    carried = network.oil_flow * (found.oil - 350.0)
    assert heat.pinion + heat.gear + heat.oil == pytest.approx(to_housing + carried)
    to_ambient = network.housing_ambient * (found.housing - network.ambient_temperature)
    assert to_housing + heat.housing == pytest.approx(to_ambient)
    assert heat_given_off(network, found, 350.0) == pytest.approx(heat.total, rel=1e-12)


def test_without_heat_all_is_as_warm_as_its_surroundings():
    found = network_temperatures(NETWORKS["housing"], Heat(0.0, 0.0), 350.0)
    assert found == pytest.approx((295.0,) * 4)


def test_a_large_oil_flow_holds_the_oil():
    flooded = NETWORKS["both"]._replace(oil_flow=1e9)
    assert network_temperatures(flooded, HEAT, 350.0).oil == pytest.approx(350.0, abs=1e-5)


def test_bulk_is_the_mean_of_both_gears():
    found = network_temperatures(NETWORKS["oil held"], HEAT, 350.0)
    assert found.bulk == pytest.approx(350.0 + (90.0 / 20.0 + 90.0 / 40.0) / 2)


def test_a_fixed_point_is_found_to_a_tenth_of_a_kelvin():
    # T = 350 + 20 (1 − 0.02 (T − 350)): T = 350 + 20/1.4
    def step(here):
        return 350.0 + 20.0 * (1.0 - 0.02 * (here[0] - 350.0)), 350.0

    bulk, oil = fixed_point(step, (350.0, 350.0))
    assert bulk == pytest.approx(350.0 + 20.0 / 1.4, abs=0.1)
    assert oil == 350.0


def test_a_swing_between_cold_and_hot_is_damped():
    """Thick oil that churns itself warm: a steep falling step, T = 300 + 500 exp(−(T − 300)/20)."""

    def step(here):
        assert 230.0 <= here[1] <= 450.0
        warm = 300.0 + 500.0 * math.exp(-(here[1] - 300.0) / 20.0)
        return warm + 5.0, warm

    bulk, oil = fixed_point(step, (300.0, 300.0), (230.0, 450.0))
    assert oil == pytest.approx(step((bulk, oil))[1], abs=0.1)
    assert bulk == pytest.approx(oil + 5.0)


def test_what_leads_out_of_the_bounds_is_given_back():
    assert fixed_point(lambda here: (500.0, 350.0), (350.0, 350.0), (230.0, 450.0)) == (500.0, 350.0)


def test_a_runaway_is_said():
    with pytest.raises(SimulationError, match="does not settle"):
        fixed_point(lambda here: (300.0 + 1.5 * (here[0] - 290.0), 300.0), (300.0, 300.0))
