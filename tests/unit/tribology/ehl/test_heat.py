"""Heat in film and surfaces: Blok's and Jaeger's moving sources, conduction, balance."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.linalg import lu_solve
from scipy.special import k0

from tribodyn.errors import InputError
from tribodyn.tribology.ehl.heat import (
    HeatProperties,
    _conductances,
    _coupling,
    heated,
    moving_source,
    surfaces_under,
)
from tribodyn.tribology.ehl.problem import check_heat
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
    surfaces = surfaces_under(place, (speed, speed), HeatProperties(0.0, solid_conductivity=(solid, solid)))
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


def test_surfaces_under_their_flux():
    """What the film gives to a surface warms it as Blok says."""
    found = uniform_film(46.0, speed=100.0)
    expected = 2 * 0.5e8 * math.sqrt(4e-4 / (math.pi * 46.0 * 3.6e6 * 100.0))
    assert found.surface_1[-1] == pytest.approx(expected, rel=0.03)
    np.testing.assert_allclose(found.surface_1, found.surface_2)


def test_fluxes_across_a_film_that_does_not_flow(rng):
    """A chain of resistances: half a layer at both walls; each layer loses what it makes less when warm."""
    film, loss = np.array([2e-7, 5e-7]), rng.uniform(0.0, 2e5, (2, LAYERS))
    thermal = HeatProperties(0.03, conductivity=0.17)
    own_1, between, own_2 = _conductances(film, loss, thermal)
    for i in range(2):
        layer = 0.17 * LAYERS / film[i]

        def fluxes(wall_2, wall_1, layer=layer, i=i):
            chain, right = np.zeros((LAYERS, LAYERS)), np.zeros(LAYERS)
            for k in range(LAYERS):
                chain[k, k] += loss[i, k]
                for other in (k - 1, k + 1):
                    if 0 <= other < LAYERS:
                        chain[k, k] += layer
                        chain[k, other] -= layer
            for k, wall in ((0, wall_2), (LAYERS - 1, wall_1)):
                chain[k, k] += 2 * layer
                right[k] += 2 * layer * wall
            warm = np.linalg.solve(chain, right)
            return 2 * layer * (warm[0] - wall_2), 2 * layer * (warm[-1] - wall_1)

        assert fluxes(0.0, -1.0)[1] == pytest.approx(own_1[i])
        assert fluxes(-1.0, 0.0)[0] == pytest.approx(own_2[i])
        assert fluxes(1.0, 0.0)[1] == pytest.approx(between[i])
        assert fluxes(0.0, 1.0)[0] == pytest.approx(between[i])
    plain = _conductances(film, np.zeros((2, LAYERS)), thermal)
    np.testing.assert_allclose(plain, [0.17 / film] * 3)


def test_coupling_is_that_of_surfaces_with_a_film_at_rest(rng):
    """Θ_1 + R_1 (g_1 Θ_1 − g Θ_2), and the same of the other surface."""
    response = rng.uniform(0.1, 1.0, (3, 3)), rng.uniform(0.1, 1.0, (3, 3))
    own_1, between, own_2 = rng.uniform(0.1, 1.0, (3, 3))
    warm = rng.standard_normal(6)
    first = warm[:3] + response[0] @ (own_1 * warm[:3] - between * warm[3:])
    two = warm[3:] + response[1] @ (own_2 * warm[3:] - between * warm[:3])
    factors = _coupling(response, (own_1, between, own_2))
    np.testing.assert_allclose(lu_solve(factors, np.concatenate([first, two])), warm)


def test_a_surface_at_rest_is_warmed_as_by_a_source_that_creeps():
    """Below u ρc/2k = 1 1/m, in either direction, nothing depends on the speed."""
    place, edge = np.array([-1e-4, 2e-5, 3e-4]), np.array([-2e-4, 0.0, 2e-4])
    slowest = 2 * CONDUCTIVITY / CAPACITY
    for direction in (1.0, -1.0):
        creeping = moving_source(place, edge, direction * slowest, CONDUCTIVITY, CAPACITY)
        for share in (0.9, 1e-3):
            found = moving_source(place, edge, share * direction * slowest, CONDUCTIVITY, CAPACITY)
            np.testing.assert_array_equal(found, creeping)
    np.testing.assert_array_equal(
        moving_source(place, edge, 0.0, CONDUCTIVITY, CAPACITY),
        moving_source(place, edge, slowest, CONDUCTIVITY, CAPACITY),
    )


@pytest.mark.parametrize(
    ("thermal", "key"),
    [
        (HeatProperties(-0.1), "temperature_viscosity"),
        (HeatProperties(0.03, conductivity=0.0), "oil_conductivity"),
        (HeatProperties(0.03, solid_conductivity=(46.0,)), "solid_conductivity"),
        (HeatProperties(0.03, solid_heat_capacity=(1e6, math.nan)), "solid_heat_capacity"),
    ],
)
def test_bad_values(thermal, key):
    with pytest.raises(InputError) as caught:
        check_heat(thermal)
    assert caught.value.key == key
