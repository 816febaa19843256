"""One definition of efficiency for both directions of power."""

import numpy as np
import pytest

from tribodyn.mesh.quasi_static import driving_gear, efficiency, power_put_in


@pytest.mark.parametrize("watt", [1.0, 1e-6])
def test_what_the_driving_gear_puts_in_less_the_loss(watt):
    assert power_put_in(100.0 * watt, 98.0 * watt) == 100.0 * watt
    assert efficiency(100.0 * watt, 98.0 * watt, 2.0 * watt) == pytest.approx(0.98)
    assert driving_gear(100.0 * watt, 98.0 * watt) == "pinion"
    # the gear gives 100 W, the pinion gets 97 W
    assert power_put_in(-97.0 * watt, -100.0 * watt) == 100.0 * watt
    assert efficiency(-97.0 * watt, -100.0 * watt, 3.0 * watt) == pytest.approx(0.97)
    assert driving_gear(-97.0 * watt, -100.0 * watt) == "gear"


@pytest.mark.parametrize("powers", [(3.0, -2.0), (3.0, 0.0), (0.0, 0.0), (0.0, -2.0), (-1.0, 2.0)])
def test_nothing_that_passes_through_has_no_efficiency(powers):
    assert np.isnan(efficiency(*powers, 1.0))
    assert driving_gear(*powers) == "neither"
    assert power_put_in(*powers) == max(powers[0], 0.0) + max(-powers[1], 0.0)


def test_arrays_of_moments():
    found = efficiency(*np.array([[100.0, -97.0, 1.0], [98.0, -100.0, -1.0], [2.0, 3.0, 2.0]]))
    np.testing.assert_allclose(found, [0.98, 0.97, np.nan])
