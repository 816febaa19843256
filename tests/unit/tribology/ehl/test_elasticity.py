"""Deformation of the half space: numerical quadrature, Hertz's contact, symmetry."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.tribology.ehl.grid import HERTZ_LOAD, hertz_gap, influence


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


@pytest.mark.parametrize(("left", "right"), [(0.1, 0.13), (0.13, 0.04), (0.0, 0.1), (0.1, 0.0)])
@pytest.mark.parametrize("distance", [-31.0, 30.5, 47.0])
def test_far_influence_to_rounding(left, right, distance):
    """By Gauss' rule over both sides of the hat, exact for so smooth a logarithm."""
    size = max(left, right)
    node = np.array([-9.0, -left, 0.0, right, 8.0])
    node = np.delete(node, [] if left and right else [0, 1] if not left else [3, 4])
    at = int(np.argmin(np.abs(node)))
    x = distance * size
    gauss, weight = np.polynomial.legendre.leggauss(12)
    share, weight = 0.5 * (gauss + 1.0), 0.5 * weight
    exact = sum(
        side * weight @ ((1.0 - share) * np.log(np.abs(x - sign * side * share)))
        for side, sign in ((left, -1.0), (right, 1.0))
    )
    assert influence(np.array([x]), node)[0, at] == pytest.approx(exact, rel=2e-10)


@pytest.mark.parametrize("x", [-4.0, -1.7, 1.0, 1.2, 9.0])
def test_gap_beside_a_hertz_contact(x):
    """½ [|x| √(x² − 1) − arcosh |x|] is ∫ √(s² − 1) ds from 1 to |x|; nothing inside."""
    exact = quad(lambda s: math.sqrt(s * s - 1.0), 1.0, abs(x))[0]
    assert hertz_gap(np.array([x]))[0] == pytest.approx(exact, rel=1e-9)
    assert hertz_gap(np.array([0.0, 0.7, -0.99])) == pytest.approx(0.0)
    assert quad(lambda s: math.sqrt(1.0 - s * s), -1.0, 1.0)[0] == pytest.approx(HERTZ_LOAD)
