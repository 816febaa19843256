"""What integrators return: results of parts of a batch, and samples by the segments that they fall into."""

import numpy as np

from tests.support.states import PAIR
from tribodyn.dynamics.recorded.extremes import no_extremes
from tribodyn.solve.integrator import nothing_yet, put
from tribodyn.train.schedule import of_one_mesh, sample_phases


def test_every_field_of_a_part_is_put_in_its_place(rng):
    whole = nothing_yet(PAIR, np.zeros((5, PAIR.states)), 3)
    assert np.all(np.isnan(whole.samples))
    part = nothing_yet(PAIR, rng.normal(size=(2, PAIR.states)), 3)
    part.samples[:] = rng.normal(size=part.samples.shape)
    part.status[:], part.reached[:] = (3, 1), (0.25, 7.5)
    part.steps[:], part.evaluations[:] = (40, 70), (300, 500)
    put(whole, np.array([4, 1]), part)
    for all_of_it, some in zip(whole[:-1], part[:-1], strict=True):
        np.testing.assert_array_equal(all_of_it[[4, 1]], some)
        assert not np.any(np.nan_to_num(all_of_it[[0, 2, 3]]))
    assert len(whole.extremes.measure) == len(no_extremes(PAIR, 0).measure) == 0


def test_extremes_of_a_part_are_put_in_their_places(rng):
    whole, part = (nothing_yet(PAIR, np.zeros((count, PAIR.states)), 1, extremes=True) for count in (4, 2))
    for values in part.extremes:
        values[:] = rng.integers(1, 9, size=values.shape)
    put(whole, np.array([2, 0]), part)
    empty = no_extremes(PAIR, 4)
    for all_of_it, some, before in zip(whole.extremes, part.extremes, empty, strict=True):
        np.testing.assert_array_equal(all_of_it[[2, 0]], some)
        np.testing.assert_array_equal(all_of_it[[1, 3]], before[[1, 3]])


def test_a_segment_has_its_start_and_not_its_end():
    found = sample_phases(of_one_mesh(np.array([0.0, 0.25, 0.6, 1.0])), 8)
    np.testing.assert_array_equal(np.concatenate(found), np.arange(8) / 8)
    assert [len(phases) for phases in found] == [2, 3, 3]
    assert found[1][0] == 0.25
    assert [len(phases) for phases in sample_phases(of_one_mesh(np.array([0.0, 1.0])), 0)] == [0]
