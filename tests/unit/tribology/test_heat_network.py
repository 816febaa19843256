"""Thermal networks: closed forms of two nodes, a chain by its eigenvalues, heat in is heat out."""

import itertools
import math

import numpy as np
import pytest
import scipy.linalg

from tribodyn.errors import SimulationError
from tribodyn.tribology.heat.network import HeatNetwork, HeatPath
from tribodyn.tribology.heat.steady import steady_heat
from tribodyn.tribology.heat.surfaces import (
    forced_convection,
    housing_coefficient,
    in_series,
    natural_convection,
    radiation,
    ring,
)
from tribodyn.tribology.heat.transient import heat_over_time

AMBIENT = 293.15
OIL, WALL = 4000.0, 9000.0
TWO = HeatNetwork(
    {"oil": OIL, "housing": WALL},
    {"ambient": AMBIENT},
    (HeatPath("oil", "housing", 30.0), HeatPath("housing", "ambient", 12.0)),
)


def _constant(*watts):
    return lambda points: np.tile(np.array(watts), (len(points), 1))


def test_two_nodes_settle_where_the_closed_form_says():
    found = steady_heat(TWO, _constant(300.0, 60.0), 0.0, [300.0, 300.0])
    housing = AMBIENT + 360.0 / 12.0
    assert found.temperatures == pytest.approx({"oil": housing + 10.0, "housing": housing}, rel=1e-9)
    assert found.given_off == pytest.approx({"ambient": 360.0})
    assert found.balance < 1e-8


@pytest.mark.parametrize("slope", [-40.0, -5.0, 3.0, 8.0])
def test_losses_that_depend_on_temperature_settle_where_the_linear_equations_say(slope):
    def heat(points):
        return np.stack([300.0 + slope * (points[:, 0] - 350.0), np.zeros(len(points))], axis=1)

    found = steady_heat(TWO, heat, 0.0, [300.0, 300.0], ["oil"])
    through = 1.0 / (1.0 / 30.0 + 1.0 / 12.0)
    oil = (300.0 - slope * 350.0 + through * AMBIENT) / (through - slope)
    assert found.temperatures["oil"] == pytest.approx(oil, rel=1e-9)


def test_losses_that_fall_steeply_in_cold_oil_settle_too():
    def heat(points):
        return np.stack([3e5 * np.exp(-(points[:, 0] - 260.0) / 9.0), np.zeros(len(points))], axis=1)

    found = steady_heat(TWO, heat, 0.0, [260.0, 260.0], ["oil"])
    through = in_series(30.0, 12.0)
    oil = found.temperatures["oil"]
    assert 3e5 * math.exp(-(oil - 260.0) / 9.0) == pytest.approx(through * (oil - AMBIENT), rel=1e-7)


def test_losses_that_outgrow_the_heat_that_leaves_and_heat_without_a_way_out_are_errors():
    def runaway(points):
        return np.stack([300.0 + 20.0 * (points[:, 0] - 300.0), 0.0 * points[:, 0]], axis=1)

    with pytest.raises(SimulationError, match="losses grow faster"):
        steady_heat(TWO, runaway, 0.0, [350.0, 300.0], ["oil"])
    apart = TWO._replace(capacities={"oil": 1.0, "housing": 1.0, "shaft": 1.0})
    with pytest.raises(SimulationError, match="away from shaft"):
        steady_heat(apart, _constant(1.0, 0.0, 1.0), 0.0, [300.0] * 3)


def test_two_nodes_over_time_follow_the_closed_form():
    times = np.array([0.0, 10.0, 200.0, 3000.0])
    found = heat_over_time(
        TWO,
        lambda number, share, points: _constant(300.0, 60.0)(points),
        lambda *_: 0.0,
        np.full(2, AMBIENT),
        times,
    )
    # rises x: C x' = P − G x, two exponentials
    matrix = np.array([[-30.0 / OIL, 30.0 / OIL], [30.0 / WALL, -42.0 / WALL]])
    trace, determinant = np.trace(matrix), np.linalg.det(matrix)
    rates = trace / 2.0 + np.array([1.0, -1.0]) * math.sqrt(trace**2 / 4.0 - determinant)
    steady = np.array([40.0, 30.0])
    slope = np.array([300.0 / OIL, 60.0 / WALL])  # at the start, where both rises are 0
    second = (slope + rates[0] * steady) / (rates[1] - rates[0])
    first = -steady - second
    rise = steady + np.outer(np.exp(rates[0] * times), first) + np.outer(np.exp(rates[1] * times), second)
    assert found.temperatures - AMBIENT == pytest.approx(rise, abs=2e-4)
    assert found.made[-1] == pytest.approx(360.0 * 3000.0)
    assert found.balance < 1e-9


def test_a_chain_cools_as_its_eigenvalues_say():
    names = [f"node {number}" for number in range(6)]
    capacities = np.array([50.0, 400.0, 90.0, 1000.0, 20.0, 300.0])
    conductances = np.array([5.0, 8.0, 2.0, 30.0, 6.0, 1.5])
    paths = [
        HeatPath(*ends, value)
        for ends, value in zip(itertools.pairwise([*names, "ambient"]), conductances, strict=True)
    ]
    network = HeatNetwork(dict(zip(names, capacities, strict=True)), {"ambient": 300.0}, paths)
    laplacian = np.diag(conductances + np.concatenate([[0.0], conductances[:-1]]))
    laplacian -= np.diag(conductances[:-1], 1) + np.diag(conductances[:-1], -1)
    values, vectors = scipy.linalg.eigh(laplacian, np.diag(capacities))
    start = 300.0 + np.array([60.0, 0.0, 20.0, -10.0, 90.0, 5.0])
    times = np.array([0.0, 3.0, 40.0, 700.0])
    modal = vectors.T @ (capacities * (start - 300.0))
    expected = 300.0 + (np.exp(-np.outer(times, values)) * modal) @ vectors.T
    for order in (list(range(6)), [3, 1, 5, 0, 4, 2]):
        reordered = network._replace(
            capacities={names[number]: capacities[number] for number in order}, paths=network.paths[::-1]
        )
        found = heat_over_time(
            reordered, lambda number, share, points: 0.0 * points, lambda *_: 0.0, start[order], times
        )
        assert found.temperatures == pytest.approx(expected[:, order], abs=2e-4)


def test_a_gearbox_that_is_run_long_enough_is_in_its_steady_state():
    def law(one, two, speed):
        return 0.4 * housing_coefficient(one, two, 0.3, speed, 0.9)

    network = TWO._replace(paths=(TWO.paths[0], HeatPath("housing", "ambient", law)))

    def heat(points):
        return np.stack([400.0 * np.exp(-(points[:, 0] - 350.0) / 50.0), 0.0 * points[:, 0]], axis=1)

    steady = steady_heat(network, heat, 2.0, [300.0, 300.0], ["oil"])
    found = heat_over_time(
        network,
        lambda *at: heat(at[-1]),
        lambda *_: 2.0,
        np.full(2, 280.0),
        np.array([0.0, 900.0, 3e4]),
    )
    assert found.temperatures[-1] == pytest.approx(list(steady.temperatures.values()), abs=1e-4)
    assert found.balance < 1e-9
    assert steady.balance < 1e-8


def test_heat_that_arises_in_a_held_node_leaves_at_once():
    held = HeatNetwork({"housing": WALL}, {"oil": 340.0, "ambient": AMBIENT}, TWO.paths)
    found = steady_heat(held, _constant(60.0, 300.0), 0.0, [300.0])
    housing = (60.0 + 30.0 * 340.0 + 12.0 * AMBIENT) / 42.0
    assert found.temperatures["housing"] == pytest.approx(housing)
    assert found.given_off["oil"] == pytest.approx(300.0 + 30.0 * (housing - 340.0))
    times, start = np.array([0.0, 50.0, 50.0]), np.array([housing])
    over = heat_over_time(held, lambda *at: _constant(60.0, 300.0)(at[-1]), lambda *_: 0.0, start, times)
    assert over.given_off[-1, 0] == pytest.approx(50.0 * found.given_off["oil"])
    assert over.balance < 1e-12


def test_a_wall_in_still_air_loses_what_the_textbook_says():
    # Incropera & DeWitt, example 9.2: 0.71 m high, 232 and 23 °C, Nu 147, 7.0 W/(m² K)
    assert natural_convection(505.0, 296.0, 0.71) == pytest.approx(7.0, rel=0.01)
    # radiation of a body at 100 °C among walls at 20 °C, exactly
    assert radiation(373.15, 293.15, 0.8) * 80.0 == pytest.approx(
        0.8 * 5.670374e-8 * (373.15**4 - 293.15**4), rel=1e-12
    )


def test_a_wall_in_moving_air_tends_to_laminar_and_turbulent_flow():
    # Incropera & DeWitt: 0.664 Re^½ Pr^⅓ and 0.037 Re^0.8 Pr^⅓ at 350 K
    slow, fast = (forced_convection(350.0, 350.0, speed, 0.3) for speed in (0.05, 40.0))
    laminar = 0.664 * math.sqrt(0.05 * 0.3 / 20.92e-6) * 0.7 ** (1 / 3) * 0.030 / 0.3
    turbulent = 0.037 * (40.0 * 0.3 / 20.92e-6) ** 0.8 * 0.7 ** (1 / 3) * 0.030 / 0.3
    assert slow == pytest.approx(laminar, rel=0.15)
    assert fast == pytest.approx(turbulent, rel=0.15)
    still = housing_coefficient(340.0, 293.0, 0.3, 0.0, 0.9)
    assert still == pytest.approx(natural_convection(340.0, 293.0, 0.3) + radiation(340.0, 293.0, 0.9))
    assert housing_coefficient(340.0, 293.0, 0.3, 5.0, 0.9) > 1.5 * still


def test_a_ring_is_a_series_of_thin_rings():
    radii = np.linspace(0.02, 0.05, 400)
    thin = [
        40.0 * 2.0 * math.pi * 0.5 * (one + two) * 0.03 / (two - one)
        for one, two in itertools.pairwise(radii)
    ]
    assert ring(40.0, 0.03, 0.02, 0.05) == pytest.approx(in_series(*thin), rel=1e-5)
