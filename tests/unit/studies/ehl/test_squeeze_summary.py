"""Departures of films and friction with squeeze from those without: numbers added up by hand."""

import numpy as np
import pytest

from tribodyn.studies.ehl.run import squeeze_summary

NAN = np.nan
ARRAYS = {
    "transient_central_film_thickness": np.array([NAN, 1.2, 0.9, 2.0]),
    "central_film_thickness": np.array([5.0, 1.0, 1.0, 1.6]),
    "transient_minimum_film_thickness": np.array([NAN, 0.8, 0.5, 1.5]),
    "minimum_film_thickness": np.array([5.0, 1.0, 0.4, 1.0]),
    "transient_friction_coefficient": np.array([NAN, 0.05, 0.04, 0.06]),
    "friction_coefficient": np.array([0.9, 0.04, 0.04, 0.03]),
    "normal_load": np.array([700.0, 100.0, 300.0, 200.0]),
    "sliding_speed": np.array([9.0, -2.0, 0.5, 1.0]),
    "restarts": np.array(2.0),
}


def test_departures_are_those_of_the_positions_that_were_solved():
    found = squeeze_summary(dict(ARRAYS))
    assert (found["transient_positions_solved"], found["transient_restarts"]) == (3, 2)
    assert found["central_film_departure_max"] == pytest.approx(0.25)  # 0.2, 0.1, 0.25
    assert found["central_film_departure_mean"] == pytest.approx(0.55 / 3)
    assert found["minimum_film_departure_max"] == pytest.approx(0.5)  # 0.2, 0.25, 0.5
    assert found["minimum_film_departure_mean"] == pytest.approx(0.95 / 3)
    assert found["transient_minimum_film_min"] == 0.5
    # weighted with the loads times the sliding speeds: 200, 150, 200
    friction = (200 * 0.05 + 150 * 0.04 + 200 * 0.06) / 550
    steady = (200 * 0.04 + 150 * 0.04 + 200 * 0.03) / 550
    assert found["transient_friction_coefficient_mean"] == pytest.approx(friction)
    assert found["friction_departure_mean"] == pytest.approx(friction / steady - 1.0)


def test_where_nothing_was_solved_nothing_is_said_of_films():
    none = {**ARRAYS, "transient_central_film_thickness": np.full(4, NAN)}
    found = squeeze_summary(none)
    assert found == {"transient_positions_solved": 0, "transient_restarts": 2}
