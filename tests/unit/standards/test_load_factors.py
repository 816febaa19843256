"""K_Hβ and K_Hα of loads that are known."""

import numpy as np
import pytest

from tribodyn.standards.load_factors import face_load_factor, transverse_load_factor


def test_even_loads_have_factors_of_one():
    even = np.full((5, 2, 7), 100.0)
    share = np.array([0.4, 0.5, 1.0, 1.0, 0.5, 0.4])
    assert face_load_factor(even) == 1.0
    assert transverse_load_factor(share, share) == 1.0


def test_a_wedge_carries_twice_the_mean_at_its_end():
    wedge = np.linspace(0.0, 200.0, 201)[None, None, :] * np.array([0.5, 1.0])[:, None, None]
    assert face_load_factor(wedge) == pytest.approx(2.0)


def test_the_excess_counts_where_pairs_share():
    accurate, real = np.array([0.5, 0.5, 1.0]), np.array([0.6, 0.4, 1.0])
    assert transverse_load_factor(real, accurate) == pytest.approx(1.2)
    assert transverse_load_factor(np.ones(3), np.ones(3)) == 1.0
