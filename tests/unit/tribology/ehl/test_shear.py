"""Laws of shear and what they make of the flow: closed forms for one fluid between two plates."""

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.tribology.ehl.fluid import Rheology, newtonian_stress, stress_scale, thinned
from tribodyn.tribology.ehl.problem import check_rheology
from tribodyn.tribology.ehl.shear import LAYERS, sheared

LAWS = ("newtonian", "eyring", "limiting", "carreau")


def between_plates(law, sliding=0.2, gradient=0.0, viscosity=20.0, profile=0.0, film=2e-7):
    """Shear at one place, ln η rising by `profile` from surface 2 to surface 1."""
    layers = np.log(viscosity) + profile * ((np.arange(LAYERS) + 0.5) / LAYERS - 0.5)
    given = (np.array([film]), np.array([3e8]), np.array([gradient]), layers[None, :])
    return sheared(*given, (1.0 + sliding / 2, 1.0 - sliding / 2), Rheology(law))


@pytest.mark.parametrize("law", ["newtonian", "eyring", "carreau"])
def test_stress_and_rate_are_inverse(law):
    stress = np.array([-1.4e7, -3e5, 0.0, 1e3, 2e6, 1.6e7])
    rheology = Rheology(law)
    scale = stress_scale(np.full_like(stress, 3e8), rheology)
    equal, slope = newtonian_stress(stress, scale, rheology)
    np.testing.assert_allclose(thinned(equal, scale, rheology), stress, rtol=1e-9)
    above, _ = newtonian_stress(stress + 10.0, scale, rheology)
    below, _ = newtonian_stress(stress - 10.0, scale, rheology)
    np.testing.assert_allclose(slope, (above - below) / 20.0, rtol=1e-5)
    small, _ = newtonian_stress(np.array([1.0]), scale[:1], rheology)
    assert small[0] == pytest.approx(1.0, rel=1e-6)


def test_laws_in_closed_form():
    """τ at a Newtonian stress, in either direction; none of it is anything at rest."""
    equal, pressure = np.array([-3e8, -2e6, 0.0, 4e5, 7e6]), np.array([0.0, 3e8, 3e8, 9e8, 1e8])
    limit = 2e6 + 0.05 * pressure
    expected = {
        "newtonian": equal,
        "eyring": 5e6 * np.arcsinh(equal / 5e6),
        "limiting": np.sign(equal) * limit * (1 - np.exp(-np.abs(equal) / limit)),
        "carreau": equal * (1 + (equal / 5e6) ** 2) ** -0.25,
    }
    for law, stress in expected.items():
        rheology = Rheology(law)
        scale = stress_scale(pressure, rheology)
        np.testing.assert_allclose(thinned(equal, scale, rheology), stress, rtol=1e-12, atol=1e-300)
    assert Rheology() == ("newtonian", 5e6, 0.05, 2e6, 5e6, 0.5)
    check_rheology(Rheology("carreau", carreau_index=1.0))


@pytest.mark.parametrize("index", [0.3, 0.8, 1.0])
def test_carreau_of_any_index_is_inverted(index):
    """From far below the modulus to far above it, both ways; the slope by differences."""
    rheology = Rheology("carreau", carreau_modulus=3e6, carreau_index=index)
    equal = np.array([-1e13, -4e6, 0.0, 1e2, 2.9e6, 1e8, 1e15])
    scale = stress_scale(0.0 * equal, rheology)
    stress = thinned(equal, scale, rheology)
    back, slope = newtonian_stress(stress, scale, rheology)
    np.testing.assert_allclose(back, equal, rtol=1e-8)
    by = 1e-5 * np.maximum(np.abs(stress), 1.0)
    above, below = (newtonian_stress(stress + step, scale, rheology)[0] for step in (by, -by))
    np.testing.assert_allclose(slope, (above - below) / (2 * by), rtol=1e-5)


@pytest.mark.parametrize("viscosity", [1e-2, 1e6, 1e30, 1e200])
@pytest.mark.parametrize("gradient", [0.0, 1e14])
def test_no_stress_above_the_limit(viscosity, gradient):
    """However stiff the oil; the heat is the work of the sliding and of the pressure's flow."""
    found = between_plates("limiting", gradient=gradient, viscosity=viscosity)
    limit = 2e6 + 0.05 * 3e8
    assert 0.0 < found.stress[0] <= limit
    assert found.stress[0] == pytest.approx(limit * -np.expm1(-viscosity * 0.2 / 2e-7 / limit), rel=1e-9)
    through = found.fluidity[0] * 2e-7**3 / 12 * gradient**2
    assert np.sum(found.heat) == pytest.approx(found.stress[0] * 0.2 + through, rel=1e-9)


@pytest.mark.parametrize("law", LAWS)
def test_poiseuille_where_shear_is_slow(law):
    """Small stresses: h³/(12 η), no drift, and heat that is the work of the sliding."""
    found = between_plates(law, sliding=1e-5, gradient=1e6)
    assert found.fluidity[0] == pytest.approx(1.0 / 20.0, rel=1e-3)
    assert abs(found.drift[0]) < 1e-9
    assert found.response[0] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("sliding", [0.0, 0.02, 0.5])
@pytest.mark.parametrize("gradient", [2e12, 3e13, 1e14])
def test_eyring_flow_of_conry(sliding, gradient):
    """Conry, Wang & Cusano (1987): 3 (Σ cosh Σ − sinh Σ)/Σ³ √(1 + (η Δu/(τ_0 h))² Σ²/sinh² Σ)."""
    film, viscosity, stress = 2e-7, 20.0, 5e6
    s = 0.5 * film * gradient / stress
    sheared_by = viscosity * sliding / (stress * film)
    factor = 3 * (s * np.cosh(s) - np.sinh(s)) / s**3 * np.sqrt(1 + (sheared_by * s / np.sinh(s)) ** 2)
    found = between_plates("eyring", sliding, gradient)
    assert found.fluidity[0] * viscosity == pytest.approx(factor, rel=0.01)


def test_unequal_layers_drift():
    """η from e^a to e^−a over the film: u by quadrature; more oil goes with the surface that it sticks to."""
    found = between_plates("newtonian", sliding=0.4, profile=-2.0)
    z = np.linspace(-0.5, 0.5, 20001)
    rate = np.exp(2.0 * z)
    rate *= 0.4 / np.trapezoid(rate, z)
    velocity = 0.8 + np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(z))])
    assert found.drift[0] == pytest.approx(np.trapezoid(velocity, z) - 1.0, rel=0.02)
    assert found.drift[0] < 0.0


@pytest.mark.parametrize(
    ("rheology", "key"),
    [
        (Rheology("plastic"), "rheology"),
        (Rheology("eyring", eyring_stress=0.0), "eyring_stress"),
        (Rheology("limiting", limiting_coefficient=-0.1), "limiting_coefficient"),
        (Rheology("carreau", carreau_index=1.5), "carreau_index"),
    ],
)
def test_bad_laws(rheology, key):
    with pytest.raises(InputError) as caught:
        check_rheology(rheology)
    assert caught.value.key == key
