"""Höhn's loss factor and the integral behind it."""

import math

import numpy as np
import pytest

from tribodyn.standards.loss_factors import equal_loads


@pytest.mark.parametrize("tips", [(0.8, 0.8), (1.3, 0.4), (1.2, 1.1), (0.2, 1.6), (1.5, 1.7)])
def test_integral_against_sums(tips):
    """A fine sum of |ξ|/n, with n counted directly."""
    gear, pinion = -tips[1], tips[0]
    edges = np.linspace(gear, pinion, 400001)
    xi = (edges[1:] + edges[:-1]) / 2
    count = sum(((xi + k > gear) & (xi + k < pinion)).astype(float) for k in range(-5, 6))
    total = np.sum(np.abs(xi) / count) * (edges[1] - edges[0])
    expected = 2 * math.pi * 3.0 / (20 * 2.0) * total
    assert equal_loads(*tips, 20, 2.0) == pytest.approx(expected, rel=1e-5)
