"""Thermal rating by one coefficient: at the rated power the sump is at its limit."""

import math

import pytest

from tribodyn.tribology.heat.thermal_rating import (
    COEFFICIENTS,
    heat_dissipated,
    heat_transfer_coefficient,
    rated_load,
    sump_temperature,
)


@pytest.mark.parametrize(("speed", "coefficient"), [(0.0, 15.0), (3.75, 19.5), (7.5, 33.0), (40.0, 58.0)])
def test_coefficients_are_linear_between_the_air_speeds_of_the_table(speed, coefficient):
    assert heat_transfer_coefficient(speed) == pytest.approx(coefficient)


def test_every_row_of_the_table_is_itself():
    assert [heat_transfer_coefficient(speed) for speed, _ in COEFFICIENTS] == [k for _, k in COEFFICIENTS]


def test_at_the_rated_power_the_sump_is_at_its_limit():
    """Of a loss that grows as the power 1.3 of the load."""
    area, ambient, limit = 0.9, 298.15, 368.15
    dissipated = heat_dissipated(15.0, area, limit, ambient)
    assert dissipated == pytest.approx(945.0)
    rated = rated_load(lambda load: (120.0, 1500.0 * load**1.3), dissipated)
    loss = 120.0 + 1500.0 * rated**1.3
    assert sump_temperature(lambda _: loss, 15.0 * area, ambient, (233.0, 453.0)) == pytest.approx(limit)
    assert rated_load(lambda load: (120.0, 1500.0 * load), 100.0) == 0.0
    assert rated_load(lambda load: (120.0, 0.0), 945.0) == math.inf


def test_a_loss_that_falls_as_the_sump_warms_is_met_where_the_closed_form_says():
    found = sump_temperature(lambda sump: 900.0 - 6.0 * (sump - 300.0), 12.0, 300.0, (233.0, 453.0))
    assert found == pytest.approx(300.0 + 900.0 / 18.0)
    assert sump_temperature(lambda _: 1e5, 12.0, 300.0, (233.0, 453.0)) is None
    assert math.isclose(sump_temperature(lambda _: 0.0, 12.0, 300.0, (233.0, 453.0)) or 0.0, 300.0)
