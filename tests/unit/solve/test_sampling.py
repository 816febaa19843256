"""Samples of a mesh cycle by the segments that they fall into."""

import numpy as np

from tribodyn.solve.sampling import sample_phases


def test_a_segment_has_its_start_and_not_its_end():
    found = sample_phases(np.array([0.0, 0.25, 0.6, 1.0]), 8)
    np.testing.assert_array_equal(np.concatenate(found), np.arange(8) / 8)
    assert [len(one) for one in found] == [2, 3, 3]
    assert found[1][0] == 0.25
    assert [len(one) for one in sample_phases(np.array([0.0, 1.0]), 0)] == [0]
