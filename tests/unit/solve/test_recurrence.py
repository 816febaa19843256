"""After how many periods a motion repeats, from its states once a period."""

import numpy as np
import pytest

from tribodyn.solve.orbit.motions import recognised, recurrences


@pytest.mark.parametrize("period", [1, 2, 3, 4])
def test_the_smallest_period_comes_first(period):
    """States that go round `period` points, on a transient that falls by a tenth each time."""
    track = np.array([[n % period, 3e-3 * 0.9**n] for n in range(40)], dtype=float)
    found = recurrences(track)
    assert [recurrence.period for recurrence in found][:4] == [1, 2, 3, 4]
    assert recognised(found)[0].period == period
    assert found[period - 1].rate == pytest.approx(0.9, rel=1e-6)
