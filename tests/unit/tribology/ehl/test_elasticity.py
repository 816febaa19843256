"""Deformation of the half space: numerical quadrature, Hertz's contact, symmetry."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.tribology.ehl.elasticity import hertz_gap, influence


def test_influence_of_uneven_nodes_is_the_integral():
    node = np.array([-300.0, -250.0, -3.0, -1.0, -0.5, -0.49, -0.488, 0.0, 0.3, 1.1])
    place = np.array([-299.0, -0.5, -0.4895, 0.2, 1.1])
    pressure = np.sin(node)
    for x, found in zip(place, influence(place, node) @ pressure, strict=True):
        ends = sorted({*node, x})
        parts = [
            quad(lambda s, x=x: np.interp(s, node, pressure) * np.log(abs(x - s)), a, b, epsabs=1e-12)[0]
            for a, b in pairwise(ends)
        ]
        assert found == pytest.approx(sum(parts), rel=1e-11)


def test_hertz_pressure_flattens_the_parabola_and_leaves_the_gap():
    node = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 801))
    place = np.concatenate([np.linspace(-0.95, 0.95, 7), [1.2, 2.0, 5.0, -20.0]])
    bent = influence(place, node) @ np.sqrt(1.0 - node**2) / -np.pi
    film = 0.5 * place**2 + bent
    gap = film - film[3]
    np.testing.assert_allclose(gap, hertz_gap(place), atol=1e-5)


def test_far_and_near_forms_meet():
    """At 30 cells' distance the kernel changes from exact to expanded: no step there."""
    node = np.array([-0.1, 0.0, 0.13])
    around = 30.0 * 0.13 * np.array([1.0 - 1e-9, 1.0 + 1e-9])
    value = influence(around, node)[:, 1]
    slope = 0.115 / around[0]
    assert value[1] - value[0] == pytest.approx(slope * (around[1] - around[0]), abs=1e-10)
