"""Which teeth meet when: every pair once in a hunting period, defects of planets at their intervals."""

from collections import Counter
from fractions import Fraction
from math import lcm

import numpy as np
import pytest

from tests.support.planet_sets import planet_set
from tests.support.train_scenarios import case_of_table
from tribodyn.dynamics.parameters import Model
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.schedule import interval_of, of_one_mesh, schedule_of, with_teeth


@pytest.mark.parametrize(("first", "second"), [(5, 7), (6, 9), (4, 4)])
def test_every_pair_that_can_meet_does_so_once_in_a_hunting_period(first: int, second: int):
    schedule = with_teeth(of_one_mesh(np.array([0.0, 0.4, 1.0])), [(2, 1)], [(first, second)], 10_000)
    assert schedule.period == lcm(first, second)
    begins = np.asarray(schedule.first)[:-1].astype(int)
    met = Counter(
        zip(schedule.driver_tooth[begins, 0].tolist(), schedule.driven_tooth[begins, 0].tolist(), strict=True)
    )
    assert len(met) == lcm(first, second)
    assert set(met.values()) == {1}
    assert (schedule.driver_tooth[0, 0], schedule.driven_tooth[0, 0]) == (2, 1)


def test_no_more_cycles_than_a_run_has_and_the_one_that_begins_at_its_end():
    schedule = with_teeth(of_one_mesh(np.array([0.0, 1.0])), [(0, 0)], [(23, 47)], 100)
    assert schedule.period == 101
    _, _, at_end = interval_of(np.array([100.0]), schedule)
    assert (schedule.driver_tooth[at_end, 0], schedule.driven_tooth[at_end, 0]) == (100 % 23, 100 % 47)


def test_teeth_of_a_slower_mesh_change_where_it_begins_a_cycle():
    base = schedule_of(
        [np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0])], [Fraction(1), Fraction(2, 3)], [0.0, 0.25]
    )
    schedule = with_teeth(base, [(0, 0), (3, 1)], [(8, 9), (11, 13)], 72)
    cycles = np.searchsorted(np.asarray(schedule.first)[1:], np.arange(len(schedule.start)), side="right")
    at = cycles + (schedule.start + schedule.end) / 2.0
    np.testing.assert_array_equal(schedule.driver_tooth[:, 0], np.floor(at) % 8)
    turned = np.floor(0.25 + at * 2.0 / 3.0)
    np.testing.assert_array_equal(schedule.driver_tooth[:, 1], (3 + turned) % 11)
    np.testing.assert_array_equal(schedule.driven_tooth[:, 1], (1 + turned) % 13)


@pytest.fixture(scope="module")
def planetary():
    """Section 11's set: z 17/37/91, three planets, ring held, sun at 800 rpm; its teeth may differ."""
    table = planet_set((17, 37, 91), solver={"cycles": 17 * 37 * 3})
    for gear in table["gear"].values():
        gear["modification"] = {"tooth_formula": "0*i"}
    table["operating"]["input_speed"] = "800 rpm"
    case = case_of_table(table)
    return case, prepare(case).model


def entries(model: Model, mesh: int, numbers: np.ndarray, tooth: int) -> np.ndarray:
    """Reference cycles at which a tooth enters a mesh."""
    schedule = model.schedule
    cycle = np.searchsorted(np.asarray(schedule.first)[1:], np.arange(len(schedule.start)), side="right")
    new = (numbers[:, mesh] == tooth) & (np.roll(numbers[:, mesh], 1) != tooth)
    new[0] = False  # what is there at the start has entered before
    return (cycle + schedule.start)[new]


def test_intervals_of_defects_of_a_planetary_set(planetary):
    """A tooth of the sun meets three planets per turn against the carrier, 33.704 Hz, at even intervals.

    One of a planet meets the sun once per turn of the planet against the carrier, 5.162 Hz, and about half
    such a turn later the ring.
    """
    case, model = planetary
    schedule = model.schedule
    cycle_time = model.operation.pitch_angle / model.operation.nominal_speed
    assert 1.0 / cycle_time == pytest.approx(190.988, abs=1e-3)
    names = [tuple(case.gears[gear].name for gear in mesh.gears) for mesh in case.meshes]
    of_sun = [m for m, (driver, _) in enumerate(names) if driver == "sun"]
    assert len(of_sun) == 3
    found = np.sort(np.concatenate([entries(model, m, schedule.driver_tooth, 5) for m in of_sun]))
    apart = np.diff(found) * cycle_time
    np.testing.assert_allclose(1.0 / apart, 33.704, rtol=2e-3)  # the twist of pins and shafts moves meshes
    for m in of_sun:
        planet = case.meshes[m].gears[1]
        ring = next(k for k, mesh in enumerate(case.meshes) if mesh.gears[0] == planet)
        with_sun = entries(model, m, schedule.driven_tooth, 9)
        with_ring = entries(model, ring, schedule.driver_tooth, 9)
        assert np.mean(np.diff(with_sun)) * cycle_time == pytest.approx(1.0 / 5.162, rel=1e-3)
        after = (with_ring[0] - with_sun[0]) % 37
        assert after == pytest.approx(18.5, abs=1.5)  # both begin before the pitch point
