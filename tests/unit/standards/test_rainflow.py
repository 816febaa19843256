"""Rain-flow counting beside the counts that ASTM E1049-85 prints for its example."""

from collections import defaultdict

import numpy as np
import pytest

from tribodyn.standards.bending import pulsating_stress
from tribodyn.standards.rainflow import LoadCycle, rainflow, rainflow_repeated, reversals

#: Fig. 6 of ASTM E1049-85.
EXAMPLE = (-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0)


def counts(cycles: list[LoadCycle]) -> dict[float, float]:
    found: dict[float, float] = defaultdict(float)
    for each in cycles:
        found[each.range] += each.share
    return dict(found)


def test_the_standards_example_passed_once():
    """Range -> cycles of fig. 6."""
    assert counts(rainflow(EXAMPLE)) == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}


def test_the_standards_example_repeated():
    """Range -> cycles of fig. 7, begun at the maximum."""
    assert counts(rainflow_repeated(EXAMPLE)) == {3.0: 1.0, 4.0: 1.0, 7.0: 1.0, 9.0: 1.0}


def test_a_repeated_course_has_the_same_cycles_wherever_it_begins(rng):
    course = rng.normal(size=40)
    expected = counts(rainflow_repeated(course))
    for begin in (1, 17, 33):
        found = counts(rainflow_repeated(np.roll(course, begin)))
        assert found == pytest.approx(expected)


def test_every_reversal_ends_half_a_cycle(rng):
    """Cycles take the course apart: their ranges add up to half of the way it goes."""
    course = rng.normal(size=50)
    way = np.sum(np.abs(np.diff(course)))
    assert sum(2.0 * each.range * each.share for each in rainflow(course)) == pytest.approx(way)


def test_a_course_without_turns():
    assert reversals([1.0, 1.0, 2.0, 3.0, 3.0]) == [1.0, 3.0]
    assert rainflow([2.0, 2.0]) == []
    assert rainflow_repeated([]) == []
    assert counts(rainflow_repeated([0.0, 3.0, 0.0, 0.0])) == {3.0: 1.0}


@pytest.mark.parametrize("influence", [0.3, 0.5])
def test_a_pulsating_stress_is_on_the_same_line_of_equal_damage(influence):
    """σ_a + M σ_m is the same on Haigh's line; from 0 to σ both are σ/2."""
    low, high = -120.0, 400.0
    found = pulsating_stress(low, high, influence)
    assert (1.0 + influence) * found / 2.0 == pytest.approx((high - low) / 2 + influence * (high + low) / 2)
    assert pulsating_stress(0.0, high, influence) == high


@pytest.mark.parametrize("influence", [0.3, 0.5])
def test_cycles_in_tension_damage_by_what_they_vary(influence):
    """Lines meet where they change; a stress that does not vary does no damage, whatever it is."""
    for low in (0.0, 200.0):
        before, after = (pulsating_stress(low + shift, 400.0, influence) for shift in (-1e-9, 1e-9))
        assert after == pytest.approx(before)
    found = [pulsating_stress(low, 400.0, influence) for low in (-100.0, 0.0, 100.0, 200.0, 300.0, 400.0)]
    assert found == sorted(found, reverse=True)
    assert found[-1] == 0.0
