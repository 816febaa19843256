"""What a case of a batch says of its steady motion, from what marching and shooting gave."""

import numpy as np
import pytest

from tribodyn.dynamics.parameters import STATES
from tribodyn.solve.orbit.periodic import SteadyMotion
from tribodyn.studies.gear_pair.batch.marched import UNKNOWN, Outcome
from tribodyn.studies.gear_pair.batch.steady import _described, _periodic

NONE = np.full(3, np.nan + 0j)


def steady(kind: str, period: int, multipliers=NONE, stable=False, cycles=5) -> SteadyMotion:
    samples = np.arange(6.0)[:, None] * np.ones(STATES)
    one = np.ones(STATES)
    return SteadyMotion(
        one, one, period, 3e-9, multipliers, stable, kind, "shooting", cycles, "a remark", samples, one, None
    )


def test_a_motion_of_two_cycles_is_described():
    answer = steady("period-2", 2, np.array([-0.5 + 0.6j, 0.2 + 0j, np.nan + 0j]), stable=True)
    found = _periodic(answer, 3)
    assert (found.solution, found.period, found.stable) == ("period-2", 2, 1)
    assert found.multiplier_max == pytest.approx(np.hypot(0.5, 0.6))
    assert found.residual == 3e-9
    # periods of the motion, and the mesh cycles on the way to it
    assert found.cycles == 2 + 5
    assert found.message == "a remark"
    np.testing.assert_array_equal(found.section[:, 0], [0.0, 3.0])


def test_of_what_has_no_period_nothing_is_said():
    passed = _periodic(steady("chaotic", 0), 3)
    found = _described(passed._replace(cycles=40), steady("chaotic", 0, cycles=7))
    assert (found.solution, found.stable, found.cycles) == ("chaotic", UNKNOWN, 47)
    assert np.isnan(found.multiplier_max)
    failed = Outcome(None, np.zeros(STATES), np.zeros((0, STATES)), "failed", 9, "why")
    assert _described(failed, steady("period-1", 1)) is failed
