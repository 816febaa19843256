"""The curve through a user's points, against SciPy's monotone curve; where a table must reach."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from tribodyn.errors import InputError
from tribodyn.numerics.curve import check_cover, interpolate

X = np.array([-0.3, -0.1, 0.05, 0.4, 0.45, 0.9, 1.0])
CURVES = [
    [0.0, 1.0, 1.5, 4.0, 4.1, 4.2, 9.0],  # rising throughout
    [2.0, 1.0, 3.0, 3.0, 2.5, -1.0, 0.0],  # up and down, with a flat part
    [0.0, 0.1, 5.0, 2.0, 7.0, 6.9, -3.0],  # ends that would overshoot
    [5.0, 4.9, -3.0, -3.1, 0.0, 0.2, 3.0],
    [0.0, 1.0, -9.0, 2.0, 2.0, 1.0, 0.9],
]


@pytest.mark.parametrize("y", CURVES)
@pytest.mark.parametrize("count", [2, 3, 7])
def test_curve_is_that_of_fritsch_and_butland(y, count):
    x, y = X[:count], np.array(y[:count])
    expected = PchipInterpolator(x, y)
    at = np.unique(np.concatenate([x, np.linspace(x[0], x[-1], 83)]))
    np.testing.assert_allclose(interpolate(x, y, at), expected(at), atol=1e-13)


def test_a_table_must_reach_both_ends_but_for_half_a_microradian():
    x = np.array([-0.2, 0.0, 0.3])
    check_cover(x, -0.2 - 4e-7, 0.3 + 4e-7, "key")
    check_cover(x, -0.1, 0.2, "key")
    for limits in ((-0.2 - 6e-7, 0.3), (-0.2, 0.3 + 6e-7)):
        with pytest.raises(InputError, match=r"key = -0\.2 … 0\.3 rad: .*does not cover"):
            check_cover(x, *limits, "key")
