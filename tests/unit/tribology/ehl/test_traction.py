"""Forces along the surfaces: stresses between nodes in closed form and by quadrature, rolling by parts."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.tribology.ehl.coupled import shear_force
from tribodyn.tribology.ehl.fluid import Rheology

PLACE = np.array([-2e-4, -1.3e-4, -0.9e-4, 0.0, 0.2e-4, 1.1e-4])


def force(newtonian, pressure, law):
    return shear_force(newtonian, pressure, PLACE, Rheology(law))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_newtonian_stress_is_exponential_between_nodes(sign):
    stress = np.array([2e4, 5e4, 4e4, 9e4, 7e4, 1.1e5])
    parts = np.diff(PLACE) * np.diff(stress) / np.diff(np.log(stress))
    assert force(sign * stress, 0.0 * stress, "newtonian") == pytest.approx(sign * parts.sum(), rel=1e-3)


@pytest.mark.parametrize("law", ["eyring", "limiting", "carreau"])
def test_the_law_of_shear_is_applied_between_nodes(law):
    """By quadrature, ln of the Newtonian stress and the pressure linear between nodes."""
    stress, pressure = np.geomspace(3e5, 4e8, 6), np.array([0.0, 2e7, 1e8, 6e8, 7e8, 5e8])

    def at(x):
        equal, p = math.exp(np.interp(x, PLACE, np.log(stress))), np.interp(x, PLACE, pressure)
        limit = 2e6 + 0.05 * p
        if law == "eyring":
            return 5e6 * math.asinh(equal / 5e6)
        if law == "limiting":
            return limit * (1 - math.exp(-equal / limit))
        return equal * (1 + (equal / 5e6) ** 2) ** -0.25

    whole = sum(quad(at, a, b)[0] for a, b in pairwise(PLACE))
    assert force(stress, pressure, law) == pytest.approx(whole, rel=2e-3)
    assert force(-stress, pressure, law) == pytest.approx(-whole, rel=2e-3)


def test_without_sliding_there_is_no_force():
    assert force(np.zeros(6), np.zeros(6), "eyring") == 0.0
