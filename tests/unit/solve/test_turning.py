"""Where steps end while friction turns."""

import pytest

from tribodyn.solve.march.step_control import NEAR, SHARES, UNLIMITED, next_share


def test_steps_end_at_both_ends_of_the_width_at_a_fifth_of_it_and_where_sliding_vanishes():
    """The force is C1 at the ends of the width, 1 and -1; its coefficient has a kink at 0."""
    assert sorted(SHARES) == list(SHARES) == [-place for place in reversed(SHARES)]
    assert {-1.0, 0.0, 1.0} <= set(SHARES)
    for place, near in zip(SHARES, NEAR, strict=True):
        for direction in (1.0, -1.0):
            distance, allowed = next_share(place - 0.15 * direction, direction)
            assert distance == pytest.approx(0.15)
            assert allowed == near


def test_nothing_is_ahead_behind_the_last_place():
    assert next_share(1.5, 1.0)[0] == next_share(-1.5, -1.0)[0] == UNLIMITED
