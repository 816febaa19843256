"""Weber and Banaschek's local deflection against Hertz's stresses integrated over the depth."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.compliance.local import freed_of_depth, hertz_half_width, weber_banaschek

STEEL = SimpleNamespace(youngs_modulus=207e9, poisson_ratio=0.3)
SOFT = SimpleNamespace(youngs_modulus=70e9, poisson_ratio=0.2)
LOAD, CURVATURE = 235e3, 1.0 / 6.2e-3


@pytest.mark.parametrize("material", [STEEL, SOFT])
@pytest.mark.parametrize("depth", [1e-5, 1e-4, 1e-3, 1e-2])
def test_equals_the_strain_under_hertz_pressure(material, depth):
    # stresses on the axis below a cylinder (K. L. Johnson, Contact Mechanics, (4.45)), strain in plane strain
    half = float(hertz_half_width(LOAD, CURVATURE, STEEL, material))
    peak = 2 * LOAD / (np.pi * half)
    nu, modulus = material.poisson_ratio, material.youngs_modulus

    def strain(z):
        root = np.hypot(half, z)
        across = -peak * ((half**2 + 2 * z**2) / root - 2 * z) / half
        along = -peak * half / root
        return -(1 + nu) / modulus * ((1 - nu) * along - nu * across)

    expected, _ = quad(strain, 0.0, depth, points=[min(half, depth)], limit=200)
    assert weber_banaschek(LOAD, half, depth, material)[0] == pytest.approx(expected, rel=1e-8)


def test_slope_is_the_derivative():
    def deflection(load):
        return weber_banaschek(load, hertz_half_width(load, CURVATURE, STEEL, SOFT), 1e-3, STEEL)[0]

    for load in (1e-3, 1.0, LOAD, 10 * LOAD):
        numeric = (deflection(load * 1.0001) - deflection(load * 0.9999)) / (2e-4 * load)
        half = hertz_half_width(load, CURVATURE, STEEL, SOFT)
        assert weber_banaschek(load, half, 1e-3, STEEL)[1] == pytest.approx(numeric, rel=1e-6)


def test_a_half_plane_is_freed_of_its_depth_exactly():
    inside = np.array([-2 * 0.91 / np.pi * np.log(h) for h in (1e-3, 2e-3)])
    assert freed_of_depth(inside, 0.3) == pytest.approx(inside[0], abs=1e-12)
