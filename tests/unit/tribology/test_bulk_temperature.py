"""Lumped network of gears, oil and housing: heat in is heat out, limits, closed forms; fixed points."""

import itertools
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
    "a little of both": Network(20.0, 40.0, 0.7, 0.3, 0.5, 295.0),
}


@pytest.mark.parametrize("name", NETWORKS)
def test_heat_in_is_heat_out_at_every_node(name):
    network = NETWORKS[name]
    heat = HEAT
    found = network_temperatures(network, heat, 350.0)
    assert network.pinion_oil * (found.pinion - found.oil) == pytest.approx(heat.pinion)
    assert network.gear_oil * (found.gear - found.oil) == pytest.approx(heat.gear)
    if network.holds_oil:
        assert found.oil == 350.0
        assert heat_given_off(network, found, 350.0) == pytest.approx(heat.pinion + heat.gear)
        return
    to_housing = network.oil_housing * (found.oil - found.housing)
    if not network.housing_ambient:
        assert found.housing == found.oil
        to_housing = -heat.housing
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


@pytest.mark.parametrize("slope", [-4.0, -0.9, 0.3, 0.9, 0.97])
def test_a_linear_map_takes_few_steps(slope):
    """Aitken's rule is exact in one dimension: the first two steps, the jump, and the one that finds it."""
    tried = []

    def step(here):
        tried.append(here)
        return 330.0 + slope * (here[0] - 330.0), 345.0

    bulk, oil = fixed_point(step, (325.0, 345.0))
    assert bulk == pytest.approx(330.0, abs=0.01 * abs(slope / (1.0 - slope)))
    assert oil == 345.0
    # a share of less than a fiftieth of the way, or more than all of it, is not taken
    if slope < 0.0:
        assert len(tried) <= 6
    assert len(tried) < 100


def test_no_step_goes_farther_than_40_kelvin():
    tried = []

    def step(here):
        tried.append(here[0])
        return 1000.0, 300.0

    assert fixed_point(step, (300.0, 300.0))[0] == pytest.approx(1000.0)
    steps = [b - a for a, b in itertools.pairwise(tried)]
    assert steps[0] == 40.0
    assert max(steps) == 40.0
    assert min(steps) > 0.0
    cooled = []
    fixed_point(lambda here: (cooled.append(here[1]) or 300.0, 100.0), (300.0, 350.0))
    assert min(b - a for a, b in itertools.pairwise(cooled)) == -40.0


def test_where_the_way_turns_back_steps_are_half_as_long():
    """A jump at 350 K from 0.2 K above to 0.1 K below: no fixed point, but a place within the jump."""
    tried = []

    def step(here):
        tried.append(here[0])
        return (350.2 if here[0] < 350.0 else 349.9), 300.0

    bulk, oil = fixed_point(step, (280.0, 300.0))
    assert bulk in (350.2, 349.9)
    assert oil == 300.0
    assert abs(tried[-1] - 350.0) < 1e-3
    steps = [b - a for a, b in itertools.pairwise(tried)]
    assert steps[0] == 40.0
    turns = [(abs(old), abs(new)) for old, new in itertools.pairwise(steps) if old * new < 0.0]
    assert len(turns) > 3
    assert all(new <= 0.5 * 40.0 for _, new in turns)


@pytest.mark.parametrize("to", [(500.0, 350.0), (150.0, 350.0), (350.0, 500.0), (350.0, 150.0)])
def test_bounds_hold_either_temperature(to):
    tried = []

    def step(here):
        tried.append(here)
        return to

    assert fixed_point(step, (340.0, 350.0), (230.0, 450.0)) == to
    assert all(230.0 <= value <= 450.0 for here in tried for value in here)


def test_steps_below_a_hundredth_of_a_kelvin_are_found():
    assert fixed_point(lambda here: (here[0] + 0.009, here[1] - 0.009), (300.0, 310.0)) == (300.009, 309.991)
    tried = []

    def step(here):
        tried.append(here)
        return max(here[0], 300.011), here[1]

    fixed_point(step, (300.0, 310.0))
    assert len(tried) == 2


def test_a_swing_between_cold_and_hot_is_damped():
    """Thick oil that churns itself warm: a steep falling step, T = 300 + 500 exp(−(T − 300)/20)."""

    def step(here):
        assert 230.0 <= here[1] <= 450.0
        warm = 300.0 + 500.0 * math.exp(-(here[1] - 300.0) / 20.0)
        return warm + 5.0, warm

    bulk, oil = fixed_point(step, (300.0, 300.0), (230.0, 450.0))
    assert oil == pytest.approx(step((bulk, oil))[1], abs=0.1)
    assert bulk == pytest.approx(oil + 5.0)


def test_a_runaway_is_said():
    with pytest.raises(SimulationError, match="does not settle"):
        fixed_point(lambda here: (300.0 + 1.5 * (here[0] - 290.0), 300.0), (300.0, 300.0))
