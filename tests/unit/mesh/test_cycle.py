"""The table of a mesh cycle between its nodes, against SciPy's splines."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from tribodyn.mesh.cycle import cubic, derivative_matrix


@pytest.mark.parametrize("nodes", [4, 5, 9])
def test_derivatives_are_those_of_the_not_a_knot_spline(rng, nodes):
    values = rng.normal(size=nodes)
    spline = CubicSpline(np.linspace(0.0, 1.0, nodes), values, bc_type="not-a-knot")
    expected = spline(np.linspace(0.0, 1.0, nodes), 1)
    np.testing.assert_allclose(derivative_matrix(nodes) @ values, expected, rtol=1e-10, atol=1e-10)


def test_coefficients_are_those_of_every_cell(rng):
    """Of u in [0, 1] over the cell; segments and slots by themselves."""
    values = rng.normal(size=(2, 6, 3))
    found = cubic(values)
    assert found.shape == (2, 5, 3, 4)
    share = np.linspace(0.0, 1.0, 7)
    for segment, slot in np.ndindex(2, 3):
        spline = CubicSpline(np.arange(6), values[segment, :, slot], bc_type="not-a-knot")
        for cell in range(5):
            inside = np.polynomial.polynomial.polyval(share, found[segment, cell, slot])
            np.testing.assert_allclose(inside, spline(cell + share), rtol=1e-10, atol=1e-11)
