"""A user's curve through points against SciPy's monotone interpolation."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from tribodyn.compliance.table import interpolate, monotone_slopes

X = np.array([-1.3, -0.9, 0.1, 0.35, 1.9, 2.0])


@pytest.mark.parametrize(
    "y",
    [
        (0.0, 1.0, 1.5, 4.0, 4.2, 9.0),
        (3.0, 1.0, 2.0, 2.0, -4.0, 5.0),
        (0.0, 0.0, 0.0, 1.0, 1.0, 0.5),
        (0.0, 5.0, 4.9, 4.0, 0.1, 0.0),
        (2.0, 2.1, -7.0, -7.5, -8.0, -7.9),
    ],
)
def test_it_is_fritsch_and_butlands(y):
    x, y = X, np.array(y)
    reference = PchipInterpolator(x, y)
    np.testing.assert_allclose(monotone_slopes(x, y), reference(x, 1), rtol=1e-12, atol=1e-13)
    at = np.linspace(x[0], x[-1], 83)
    np.testing.assert_allclose(interpolate(x, y, at), reference(at), rtol=1e-12, atol=1e-13)
    few = slice(0, 3)
    np.testing.assert_allclose(monotone_slopes(x[few], y[few]), PchipInterpolator(x[few], y[few])(x[few], 1))


def test_two_points_are_a_straight_line():
    x, y = np.array([0.5, 2.5]), np.array([3.0, -1.0])
    assert monotone_slopes(x, y).tolist() == [-2.0, -2.0]
    np.testing.assert_allclose(interpolate(x, y, np.array([0.5, 1.0, 2.5])), [3.0, 2.0, -1.0])
