"""Heat in film and surfaces: Blok's and Jaeger's moving sources, conduction, balance."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import k0

from tribodyn.errors import InputError
from tribodyn.tribology.ehl.heat import Thermal, check, heated, moving_source, surfaces_under
from tribodyn.tribology.ehl.shear import LAYERS

CONDUCTIVITY, CAPACITY = 46.0, 3.6e6


def test_blok():
    """Uniform flux q, fast: 2 q √(s/(π k ρc u)) after the way s under it."""
    half, speed, flux = 1e-4, 200.0, 1e9
    edge = np.linspace(-half, half, 41)
    place = np.array([-0.5 * half, 0.0, 0.9 * half])
    found = moving_source(place, edge, speed, CONDUCTIVITY, CAPACITY) @ np.full(40, flux)
    expected = 2 * flux * np.sqrt((place + half) / (math.pi * CONDUCTIVITY * CAPACITY * speed))
    np.testing.assert_allclose(found, expected, rtol=2e-3)


@pytest.mark.parametrize("speed", [0.3, -0.3, 0.01])
def test_jaeger(speed):
    """Slow: the integral over the line source exp(s) K_0(|s|)/(π k), quadrature."""
    edge = np.array([-1e-4, -2e-5, 3e-5, 1e-4])
    place = np.array([-1.5e-4, -5e-5, 6e-5, 2e-4])
    rate = speed * CAPACITY / (2 * CONDUCTIVITY)
    found = moving_source(place, edge, speed, CONDUCTIVITY, CAPACITY)
    for i, x in enumerate(place):
        for j in range(3):
            cuts = sorted({edge[j], edge[j + 1], min(max(x, edge[j]), edge[j + 1])})
            whole = sum(
                quad(lambda s, x=x: math.exp(rate * (x - s)) * k0(abs(rate * (x - s))), a, b)[0]
                for a, b in pairwise(cuts)
            )
            assert found[i, j] == pytest.approx(whole / (math.pi * CONDUCTIVITY), rel=1e-6)


def uniform_film(solid, flux=1e8, speed=1e-9, carried=0.0):
    """A film of 0.2 µm with a uniform source over 0.4 mm, nearly at rest or carrying heat."""
    place = np.linspace(-2e-4, 2e-4, 61)
    film = np.full(61, 2e-7)
    made = np.full((61, LAYERS), flux / LAYERS)
    flow = np.full((61, LAYERS), carried / LAYERS)
    surfaces = surfaces_under(place, (speed, speed), Thermal(0.0, solid_conductivity=(solid, solid)))
    zero = np.zeros((61, LAYERS))
    return heated(surfaces, film, flow, made, zero, zero)


def test_conduction_across_the_film():
    """Between surfaces that stay cold: ∫ q/(8 k) h in the middle, half of the heat to either."""
    found = uniform_film(1e9)
    middle = found.layers[30]
    z = (np.arange(LAYERS) + 0.5) / LAYERS
    parabola = 1e8 * 2e-7 / (2 * 0.14) * z * (1 - z)
    np.testing.assert_allclose(middle, parabola, rtol=0.05)
    assert found.into_1 == pytest.approx(0.5 * found.made, rel=1e-6)


def test_heat_is_balanced():
    for carried in (0.0, 3e-7, 3e-4):
        found = uniform_film(46.0, speed=1.0, carried=carried)
        assert found.made == pytest.approx(1e8 * 4e-4, rel=1e-9)
        assert found.into_1 + found.into_2 + found.carried == pytest.approx(found.made, rel=1e-9)
    assert found.carried > 0.3 * found.made


def test_surfaces_under_their_flux():
    """What the film gives to a surface warms it as Blok says."""
    found = uniform_film(46.0, speed=100.0)
    expected = 2 * 0.5e8 * math.sqrt(4e-4 / (math.pi * 46.0 * 3.6e6 * 100.0))
    assert found.surface_1[-1] == pytest.approx(expected, rel=0.03)
    np.testing.assert_allclose(found.surface_1, found.surface_2)


@pytest.mark.parametrize(
    ("thermal", "key"),
    [
        (Thermal(-0.1), "temperature_viscosity"),
        (Thermal(0.03, conductivity=0.0), "oil_conductivity"),
        (Thermal(0.03, solid_conductivity=(46.0,)), "solid_conductivity"),
        (Thermal(0.03, solid_heat_capacity=(1e6, math.nan)), "solid_heat_capacity"),
    ],
)
def test_bad_values(thermal, key):
    with pytest.raises(InputError) as caught:
        check(thermal)
    assert caught.value.key == key
