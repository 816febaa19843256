"""The steady line contact: another solver's films, asymptotes, Hertz, balances, order, bad input."""

import math

import numpy as np
import pytest

from tests.support.line_contacts import REFERENCES, by_moes
from tribodyn.errors import InputError, SimulationError
from tribodyn.tribology.ehl import steady
from tribodyn.tribology.ehl.fluid import Fluid, log_viscosity, relative_density
from tribodyn.tribology.ehl.grid import film_width, made, placed
from tribodyn.tribology.ehl.reynolds import newtonian, residual
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.ehl.steady import (
    converged,
    expected_film,
    first_state,
    grid_of,
    reduced_problem,
    solve_steady,
)
from tribodyn.tribology.film.moes import log_survey


def moes_films(solution, load):
    """Central and minimum film in Moes' units √U_Σ R."""
    problem = solution.problem
    unit = (
        problem.radius * math.sqrt(problem.line_load / problem.effective_modulus / problem.radius / load) ** 2
    )
    return solution.central_film_thickness / unit, solution.minimum_film_thickness / unit


@pytest.mark.parametrize(("problem", "central", "least"), REFERENCES)
def test_films_of_another_solver(problem, central, least):
    """Its grid is uniform and its pressure spike coarse: agreement within 0.5 %."""
    solution = solve_steady(problem)
    assert solution.central_film_thickness == pytest.approx(central, rel=5e-3)
    assert solution.minimum_film_thickness == pytest.approx(least, rel=5e-3)
    assert solution.imbalance <= 1e-10


@pytest.mark.parametrize("problem", [reference[0] for reference in REFERENCES])
def test_order_of_accuracy_and_error_of_the_default_grid(problem):
    films = [solve_steady(problem, step=step).flow_film_thickness for step in (0.2, 0.1, 0.05)]
    limit = solve_steady(problem, step=0.025).flow_film_thickness
    assert films[1] == pytest.approx(limit, rel=2e-3)
    problem = REFERENCES[1][0]
    films = [solve_steady(problem, step=step).central_film_thickness for step in (0.2, 0.1, 0.05)]
    assert math.log2((films[1] - films[0]) / (films[2] - films[1])) >= 1.9


def test_load_and_flow_are_balanced():
    """Force: pressures carry the load. Mass: ρ h − ρ h³/(12 η u) dp/dx is one number along the film."""
    problem = REFERENCES[1][0]
    solution = solve_steady(problem, step=0.02)
    place, pressure, film = solution.place, solution.pressure, solution.film_thickness
    assert np.trapezoid(pressure, place) == pytest.approx(problem.line_load, rel=1e-10)
    half = problem.half_width
    x, p, h = (0.5 * (values[1:] + values[:-1]) for values in (place / half, pressure, film))
    viscosity = problem.fluid.viscosity * np.exp(log_viscosity(p, problem.fluid)[0])
    density = relative_density(p, problem.fluid)[0]
    slope = np.diff(pressure) / np.diff(place)
    flow = density * h * (1.0 - h**2 * slope / (12.0 * viscosity * problem.entrainment_speed))
    spike = (x > 0.8) & (x < 0.9)
    shown = (x > -2.0) & (x < 1.1) & ~spike
    np.testing.assert_allclose(flow[shown], solution.flow_film_thickness, rtol=1e-3)


def test_martin():
    """A rigid isoviscous contact: h_0 = 2.449/M on the line of centres, 3/M where the pressure is highest."""
    load = 0.5
    reduced = reduced_problem(by_moes(load, 0.0))._replace(compliance=0.0)
    unit = 8.0 * load / math.pi
    film = 3.0 / load / unit
    grid = made(placed(film, 0.1))
    state, _, imbalance = converged(first_state(reduced, grid, film), reduced, grid, newtonian(grid))
    assert imbalance <= 1e-10
    assert state.rigid_film * unit * load == pytest.approx(2.449, rel=2e-3)
    assert state.flow * unit * load == pytest.approx(3.0, rel=2e-3)
    # the end of the film of the closed form, ξ_m = 0.4754 in √(2 R h_0)
    assert state.end / math.sqrt(2.0 * state.rigid_film) == pytest.approx(0.4754, rel=2e-3)


def test_blok():
    """A rigid contact under Barus' law: 1.287 L^(2/3), whatever the load."""
    load, material = 1.0, 50.0
    reduced = reduced_problem(by_moes(load, material))._replace(compliance=0.0)
    unit = 8.0 * load / math.pi
    film = 1.287 * material ** (2 / 3) / unit
    grid = made(placed(film, 0.1))
    state, _, imbalance = converged(first_state(reduced, grid, film), reduced, grid, newtonian(grid))
    assert imbalance <= 1e-10
    assert state.flow * unit == pytest.approx(1.287 * material ** (2 / 3), rel=2e-3)


def test_herrebrugh():
    """An isoviscous elastic contact at high load: H ∝ M^(−1/5).

    Its factor: 0.4467 λ^(3/5) b²/R in Hertz's units (Snoeijer, Eggers & Venner 2013, quoted from memory) is
    2.49 M^(−1/5); Moes' survey has 2.621, 5 % more.
    """
    films = {load: moes_films(solve_steady(by_moes(load, 0.0)), load)[0] for load in (5e3, 2e4)}
    assert math.log(films[2e4] / films[5e3]) / math.log(4.0) == pytest.approx(-0.2, abs=1e-3)
    hertz = films[2e4] * math.pi / (8.0 * 2e4)
    assert hertz == pytest.approx(0.4467 * (3.0 * math.pi**2 / (8.0 * 2e4**2)) ** 0.6, rel=3e-3)
    assert films[2e4] == pytest.approx(2.621 * 2e4**-0.2, rel=0.06)


def test_rounding_of_a_thin_film_costs_no_steps():
    """Films of 4e-6 b²/R, of which sums of terms of the size of 1 keep nine digits."""
    assert solve_steady(by_moes(4e4, 0.0)).steps <= 12


@pytest.mark.parametrize(("load", "material"), [(100.0, 10.0), (100.0, 25.0), (1e3, 10.0), (1e4, 10.0)])
def test_grubin(load, material):
    """Elastic and piezoviscous: 1.311 M^(−1/8) L^(3/4), reached slowly."""
    central, _ = moes_films(solve_steady(by_moes(load, material)), load)
    assert central == pytest.approx(1.311 * load**-0.125 * material**0.75, rel=0.06)


def test_hertz_at_high_load():
    problem = by_moes(5e3, 10.0, 1.5e9, 0.6, compressible=True)
    solution = solve_steady(problem)
    x = solution.place / problem.half_width
    inside = np.abs(x) < 0.9
    hertz = problem.hertz_pressure * np.sqrt(1.0 - x[inside] ** 2)
    np.testing.assert_allclose(solution.pressure[inside], hertz, rtol=0.02)
    assert solution.state.end == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(("load", "material"), [(0.5, 0.0), (20.0, 5.0), (100.0, 0.0), (500.0, 10.0)])
def test_traction_of_shear_and_of_pressure(load, material):
    """F_n,x = −2 F_t, by which Biboulet & Houpert (2010) check theirs."""
    solution = solve_steady(by_moes(load, material), step=0.05)
    # ∫ p dh/dx dx, to which the elastic part of the slope adds nothing: the influence is symmetric
    slope = solution.place / solution.problem.radius
    assert solution.rolling_drag > 0.0
    assert np.trapezoid(solution.fluid_pressure * slope, solution.place) == pytest.approx(
        -2.0 * solution.rolling_drag, rel=1e-2
    )


def test_rolling_drag_of_biboulet_and_houpert():
    """T* = 1.4/M rigid and 1.45/M^1.5 elastic, read with T* = F_t/(w √W) and Moes' M.

    Rigid: Martin's pressure gives 1.469/M in closed form, of which theirs is 5 % off. Elastic: one number for
    every L, which the solution meets within a fifth.
    """

    def dimensionless(load, material):
        solution = solve_steady(by_moes(load, material))
        problem = solution.problem
        w = problem.line_load / problem.effective_modulus / problem.radius
        return solution.rolling_drag / problem.line_load / math.sqrt(w)

    assert dimensionless(0.5, 0.0) * 0.5 == pytest.approx(1.4, rel=0.05)
    for load in (50.0, 200.0):
        for material in (5.0, 10.0):
            assert dimensionless(load, material) * load**1.5 == pytest.approx(1.45, rel=0.2)


def test_a_contact_by_way_of_thinner_oils():
    """Where Newton's method does not reach it at once the pressure-viscosity coefficient is raised."""
    problem = by_moes(26585.0, 48.7, 0.7e9, 0.3, True)
    found = solve_steady(problem, step=0.4)
    assert found.steps > 41
    assert found.reduced.fluid == problem.fluid
    values = residual(found.state, reduced_problem(problem), found.grid, newtonian(found.grid))[0]  # pyright: ignore[reportArgumentType]
    assert np.max(np.abs(values[:-2])) <= 1e-9 * found.state.flow
    assert np.trapezoid(found.pressure, found.place) == pytest.approx(problem.line_load, rel=1e-9)


@pytest.mark.parametrize("roughness", [None, Roughness(3e-7)])
def test_what_does_not_converge_says_so(monkeypatch, roughness):
    tried = []

    def failing(state, *_):
        tried.append(state)
        return state, 7, math.nan

    monkeypatch.setattr(steady, "converged", failing)
    with pytest.raises(SimulationError, match=r"did not converge in \d+ steps"):
        solve_steady(REFERENCES[1][0]._replace(roughness=roughness), step=0.4)
    # smooth: half of the pressure-viscosity coefficient, down to a 64th; rough: both ways end at once
    assert len(tried) == (3 if roughness else 7)


def test_grids_suit_all_their_contacts():
    """Nodes for the thinnest film, an inlet for the thickest; behind it as far as asperities may touch."""
    thin, thick = REFERENCES[0][0], REFERENCES[1][0]._replace(entrainment_speed=30.0)
    films = [expected_film(contact) for contact in (thin, thick)]
    for contact, survey in zip((thin, thick), films, strict=True):
        H = math.exp(log_survey(math.log(contact.moes_load), math.log(contact.moes_material)))
        drawn = (
            2
            * contact.fluid.viscosity
            * contact.entrainment_speed
            / (contact.effective_modulus * contact.radius)
        )
        assert survey == pytest.approx(H * contact.radius * math.sqrt(drawn) / contact.film_unit)
    both = grid_of(thin, 0.2, thick)
    np.testing.assert_allclose(both.node, placed(min(films), 0.2, 0.0, max(films)))
    np.testing.assert_allclose(grid_of(thick, 0.2, thin).node, both.node)
    rough = thin._replace(roughness=Roughness(4e-7))
    assert expected_film(rough) == pytest.approx(films[0] + 4e-7 / thin.film_unit)
    unit = min(thin.film_unit, thick.film_unit)
    beyond = 1.5 + 2.0 * film_width(4.0 * 4e-7 / unit)
    assert grid_of(rough, 0.2, thick).node[-1] == pytest.approx(beyond)
    assert grid_of(thin, 0.2).node[-1] == 0.0


def test_what_a_solution_says_of_itself():
    """Films in m, in Hertz's units and in those of the flow; asperities only where there are some."""
    problem = REFERENCES[1][0]
    found = solve_steady(problem, step=0.3)
    unit, b = problem.film_unit, problem.half_width
    np.testing.assert_allclose(found.film_thickness, found.film * unit)
    np.testing.assert_allclose(found.mean_gap, found.film * unit)
    np.testing.assert_allclose(found.place, b * (found.state.end + found.grid.node))
    np.testing.assert_allclose(found.pressure, found.state.pressure * problem.hertz_pressure)
    assert np.all(found.asperity_pressure == 0.0)
    assert found.asperity_load_ratio == 0.0
    assert found.flow_film_thickness == pytest.approx(found.state.flow * unit)
    gap = problem.radius * (found.place / problem.radius) ** 2 / 2
    assert found.film_thickness[0] == pytest.approx(gap[0], rel=0.2)  # far out hardly bent
    near = np.argmin(found.film)
    assert found.minimum_film_thickness <= found.film_thickness[near]
    assert found.minimum_film_thickness == pytest.approx(found.film_thickness[near], rel=0.02)


def test_a_contact_without_a_meaning_is_refused():
    with pytest.raises(InputError) as caught:
        solve_steady(REFERENCES[0][0]._replace(line_load=math.inf))
    assert caught.value.key == "line_load"


def test_cold_oil():
    """α p_H = 75 under Barus' law: the viscosity in the contact is e⁷⁵ times the inlet's."""
    problem = REFERENCES[0][0]
    cold = problem._replace(fluid=Fluid(50.0, 60e-9, 1.0), entrainment_speed=1e-3)
    solution = solve_steady(cold)
    assert np.all(np.isfinite(solution.pressure))
    assert solution.imbalance <= 1e-10


@pytest.mark.soak
@pytest.mark.parametrize("index", [0.6, 1.0])
@pytest.mark.parametrize("pressure", [0.05e9, 0.2e9, 0.7e9, 1.5e9, 3e9])
def test_map(index, pressure):
    """M 0.5 … 20000, L 0 … 25: every contact converges, its film grows with L, its minimum falls with M.

    The film at x = 0 rises with M about 2, where the thinnest place moves from the middle to the outlet.
    """
    materials = (0.0, 1.0, 2.5, 5.0, 8.0, 12.0, 16.0, 20.0, 25.0)
    loads = np.geomspace(0.5, 20000.0, 24)
    films = np.array(
        [
            [moes_films(solve_steady(by_moes(load, material, pressure, index)), load) for load in loads]
            for material in materials
        ]
    )
    assert np.all(np.diff(films[..., 0], axis=0) > 0.0)
    assert np.all(np.diff(films[..., 1], axis=1) < 0.01 * films[:, 1:, 1])
