"""Pressure, shear and heat together: closed forms of friction, balance of energy, symmetry."""

import numpy as np
import pytest

from tests.support.line_contacts import REFERENCES
from tribodyn.errors import InputError
from tribodyn.tribology.ehl.coupled import friction_of, shear_force, solve_coupled
from tribodyn.tribology.ehl.fluid import Rheology, log_viscosity
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.ehl.steady import solve_steady

PROBLEM = REFERENCES[1][0]
OIL = HeatProperties(0.035)


def newtonian(solution):
    """η Δu/h at the nodes."""
    problem = solution.problem
    viscosity = problem.fluid.viscosity * np.exp(log_viscosity(solution.pressure, problem.fluid)[0])
    return viscosity * problem.sliding_speed / solution.film_thickness


def slid(share, law="eyring", thermal=None, step=0.1):
    return solve_coupled(PROBLEM._replace(sliding_speed=share), Rheology(law), thermal, step=step)


@pytest.mark.parametrize(("law", "sliding"), [("limiting", 0.001), ("eyring", 0.1), ("carreau", 0.1)])
def test_friction_on_a_coarse_grid(law, sliding):
    """Within a half per cent of that on a grid four times finer, where the trapezoidal rule is 3 % off."""
    fine = slid(sliding, law, step=0.05)
    assert slid(sliding, law, step=0.2).friction == pytest.approx(fine.friction, rel=5e-3)


def test_eyring_at_small_sliding_is_newtonian():
    found = slid(1e-6, step=0.05)
    expected = np.trapezoid(newtonian(found.solution), found.solution.place)
    # the pressure gradient alone shears the oil past τ_0 at the spike
    assert found.friction == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize(("sliding", "within"), [(0.1, 4e-3), (0.5, 2e-3), (1.5, 2e-3)])
def test_eyring_at_large_sliding(sliding, within):
    """τ_0 arsinh(η Δu/(τ_0 h)), and by its logarithm where that is large.

    Less where the pressure's gradient shears the oil at the spike, the more the slower it slides.
    """
    found = slid(sliding, step=0.05)
    stress = newtonian(found.solution)
    expected = np.trapezoid(5e6 * np.arcsinh(stress / 5e6), found.solution.place)
    assert found.friction == pytest.approx(expected, rel=within)
    loaded = stress > 1e9
    np.testing.assert_allclose(found.shear.stress[loaded], 5e6 * np.log(2 * stress[loaded] / 5e6), rtol=2e-3)


def test_limiting_stress_bounds_friction():
    """Below ∫ τ_00 + Λ p, and near it over the Hertz contact."""
    found = slid(0.5, "limiting")
    most = np.trapezoid(2e6 + 0.05 * found.solution.pressure, found.solution.place)
    contact = np.abs(found.solution.place) < found.solution.problem.half_width
    inside = np.trapezoid((2e6 + 0.05 * found.solution.pressure) * contact, found.solution.place)
    assert 0.9 * inside < found.friction < most


def test_newtonian_without_heat_is_the_steady_solution():
    found = slid(0.1, "newtonian")
    assert found.solution.central_film_thickness == pytest.approx(
        solve_steady(PROBLEM).central_film_thickness, rel=1e-9
    )


@pytest.mark.parametrize(
    ("law", "sliding"),
    [
        ("newtonian", 0.0),
        ("newtonian", 0.1),
        ("eyring", 0.1),
        ("eyring", 1.5),
        ("limiting", 0.5),
        ("carreau", 0.5),
    ],
)
def test_energy(law, sliding):
    """Heat of friction = heat into both surfaces + heat carried away; it is at least the sliding's work."""
    found = slid(sliding, law, OIL)
    heat = found.heat
    assert heat is not None
    assert heat.into_1 + heat.into_2 + heat.carried == pytest.approx(heat.made, rel=1e-6)
    width = np.gradient(found.solution.place)
    width[[0, -1]] *= 0.5
    assert np.sum(found.shear.heat * width[:, None]) == pytest.approx(heat.made, rel=1e-6)
    assert heat.made > found.friction * sliding
    assert found.solution.imbalance <= 1e-10


@pytest.mark.parametrize("roughness", [None, Roughness(3e-7)])
@pytest.mark.parametrize("sliding", [0.2, -0.2])
def test_friction_and_heat_of_a_coarse_contact(roughness, sliding):
    """∫ τ_m dx of the fluid and f_c ∫ p_a dx; all work on the film is heat; the film thins by what flows."""
    problem = PROBLEM._replace(sliding_speed=sliding, entrainment_speed=0.3, roughness=roughness)
    found = solve_coupled(problem, Rheology("eyring"), OIL, step=0.5)
    heat, solution = found.heat, found.solution
    assert heat is not None
    end = solution.grid.end + 1
    newtonian = found.shear.newtonian[:end]
    fluid = shear_force(newtonian, solution.fluid_pressure[:end], solution.place[:end], Rheology("eyring"))
    rubbed = np.trapezoid(solution.asperity_pressure, solution.place) * 0.12 * np.sign(sliding)
    assert (rubbed == 0.0) == (roughness is None)
    assert found.friction == pytest.approx(fluid + rubbed, rel=1e-9)
    assert friction_of(solution, Rheology("eyring"), OIL, heat.layers) == pytest.approx(found.friction)
    np.testing.assert_allclose(found.temperature, heat.layers.mean(axis=1))
    width = np.gradient(solution.place)
    width[[0, -1]] *= 0.5
    made = np.sum(found.shear.heat * width[:, None]) + abs(rubbed * sliding)
    assert heat.made == pytest.approx(made, rel=1e-6)
    assert heat.into_1 + heat.into_2 + heat.carried == pytest.approx(heat.made, rel=1e-6)
    assert np.all(found.shear.heat[end:] == 0.0)
    assert np.all(found.shear.stress[end:] == 0.0)
    # the closure that pressures were solved under: the effective viscosity, as pressure varies about it
    closure, cold = solution.closure, log_viscosity(solution.fluid_pressure, problem.fluid)[0]
    effective = closure.thinning + closure.response * cold
    np.testing.assert_allclose(effective, -np.log(found.shear.fluidity * 0.04), rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(closure.drift, found.shear.drift, atol=1e-5)
    np.testing.assert_allclose(closure.response, found.shear.response, atol=1e-3)


def test_without_sliding_asperities_do_not_rub():
    problem = PROBLEM._replace(entrainment_speed=0.3, roughness=Roughness(3e-7))
    found = solve_coupled(problem, Rheology("eyring"), step=0.5)
    assert found.solution.asperity_load_ratio > 0.01
    assert abs(found.friction) < 1e-6 * problem.line_load
    assert np.all(found.temperature == 0.0)
    plain = friction_of(found.solution, Rheology("eyring"), None, np.zeros((len(found.solution.place), 12)))
    assert plain == pytest.approx(found.friction, abs=1e-6)


def test_what_has_no_meaning_is_refused_before_anything_is_solved():
    for rheology, thermal, key in (
        (Rheology("plastic"), None, "rheology"),
        (Rheology("eyring"), HeatProperties(0.03, conductivity=-1.0), "oil_conductivity"),
    ):
        with pytest.raises(InputError) as caught:
            solve_coupled(PROBLEM, rheology, thermal)
        assert caught.value.key == key


def test_heat_lowers_friction_and_film():
    cold, warm = slid(0.5), slid(0.5, thermal=OIL)
    assert warm.friction < 0.95 * cold.friction
    assert warm.solution.central_film_thickness < cold.solution.central_film_thickness
    same = slid(0.5, thermal=HeatProperties(0.0))
    assert same.friction == pytest.approx(cold.friction, rel=1e-6)


def test_surfaces_exchanged():
    """The faster surface above or below: friction turns its sign, temperatures change places."""
    unlike = HeatProperties(0.035, solid_conductivity=(46.0, 20.0), solid_heat_capacity=(3.6e6, 2e6))
    swapped = unlike._replace(solid_conductivity=(20.0, 46.0), solid_heat_capacity=(2e6, 3.6e6))
    ahead, other = slid(0.4, thermal=unlike), slid(-0.4, thermal=swapped)
    assert ahead.friction > 0.0
    assert other.friction == pytest.approx(-ahead.friction, rel=1e-7)
    assert ahead.heat is not None
    assert other.heat is not None
    np.testing.assert_allclose(ahead.heat.layers, other.heat.layers[:, ::-1], rtol=1e-4, atol=1e-5)
    np.testing.assert_allclose(ahead.heat.surface_1, other.heat.surface_2, rtol=1e-4, atol=1e-5)
    assert ahead.solution.central_film_thickness == pytest.approx(
        other.solution.central_film_thickness, rel=1e-7
    )


def test_flash_temperature_of_the_surfaces():
    """Blok's estimate of equal surfaces, 1.11 μ w Δu/(√(k ρc) (√u_1 + √u_2) √(2b)), within a third."""
    found = slid(0.3, thermal=OIL)
    assert found.heat is not None
    problem = found.solution.problem
    root = np.sqrt(46.0 * 3.6e6)
    speeds = sum(np.sqrt(speed) for speed in problem.surface_speeds)
    blok = 1.11 * found.friction * 0.3 / (root * speeds * np.sqrt(2 * problem.half_width))
    assert max(found.heat.surface_1.max(), found.heat.surface_2.max()) == pytest.approx(blok, rel=0.35)
