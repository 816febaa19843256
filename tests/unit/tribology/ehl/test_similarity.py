"""Line contacts by dimensions and second methods: fluid, numbers, the start, and the film's figures.

Units of length, force and time are changed by odd factors: every answer has to change by its dimension.
"""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from tests.support.line_contacts import MODULUS, REFERENCES
from tribodyn.tribology.ehl import fluid as fluids
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.fluid import Fluid, Rheology
from tribodyn.tribology.ehl.grid import film_width, made, placed
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.reynolds import Snapshot, cells, faces, mesh_speed, squeeze_of, stored
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.ehl.steady import (
    _reduced_pressure,
    first_state,
    reduced_problem,
    solve_steady,
    survey_film,
)

LENGTH, FORCE, TIME, KELVIN = 1.7, 0.6, 2.3, 1.9
PRESSURE = FORCE / LENGTH**2
SMOOTH = LineContact(2e5, 0.01, 1.0, Fluid(0.04, 2.2e-8), MODULUS, 0.3)


def in_other_units(contact):
    return contact._replace(
        line_load=contact.line_load * FORCE / LENGTH,
        radius=contact.radius * LENGTH,
        entrainment_speed=contact.entrainment_speed * LENGTH / TIME,
        sliding_speed=contact.sliding_speed * LENGTH / TIME,
        effective_modulus=contact.effective_modulus * PRESSURE,
        fluid=contact.fluid._replace(
            viscosity=contact.fluid.viscosity * PRESSURE * TIME,
            pressure_viscosity=contact.fluid.pressure_viscosity / PRESSURE,
            compressible=False,
        ),
        roughness=contact.roughness and contact.roughness._replace(height=contact.roughness.height * LENGTH),
    )


@pytest.mark.parametrize("roughness", [None, Roughness(2e-7)])
def test_a_contact_in_other_units(roughness):
    """Barus' law, no density: the fluid has no pressures of its own. Shear by Eyring's stress, and heat."""
    contact = SMOOTH._replace(roughness=roughness, fluid=SMOOTH.fluid._replace(compressible=False))
    conducted = FORCE / TIME / KELVIN
    thermal = HeatProperties(0.03, 0.14, 1.7e6, (46.0, 40.0), (3.6e6, 3.2e6))
    other = HeatProperties(
        0.03 / KELVIN,
        0.14 * conducted,
        1.7e6 * PRESSURE / KELVIN,
        (46.0 * conducted, 40.0 * conducted),
        (3.6e6 * PRESSURE / KELVIN, 3.2e6 * PRESSURE / KELVIN),
    )
    known = solve_coupled(contact, Rheology("eyring"), thermal, step=0.3)
    scaled = solve_coupled(
        in_other_units(contact), Rheology("eyring", eyring_stress=5e6 * PRESSURE), other, step=0.3
    )
    for name in ("central_film_thickness", "minimum_film_thickness", "flow_film_thickness"):
        assert getattr(scaled.solution, name) == pytest.approx(
            getattr(known.solution, name) * LENGTH, rel=1e-6
        )
    assert scaled.friction == pytest.approx(known.friction * FORCE / LENGTH, rel=1e-6)
    np.testing.assert_allclose(scaled.temperature, known.temperature * KELVIN, rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(scaled.solution.place, known.solution.place * LENGTH, rtol=1e-6)
    np.testing.assert_allclose(
        scaled.solution.pressure, known.solution.pressure * PRESSURE, rtol=1e-6, atol=1.0
    )


def test_numbers_of_a_contact():
    """Hertz: w = π b p_H/2, b = 4 p_H R/E'; Reynolds' λ = 3π²/(8 M²)."""
    b, top = SMOOTH.half_width, SMOOTH.hertz_pressure
    assert math.pi / 2 * b * top == pytest.approx(SMOOTH.line_load)
    assert b == pytest.approx(4 * top * SMOOTH.radius / MODULUS)
    assert SMOOTH.film_unit == pytest.approx(b * b / 0.01)
    assert SMOOTH.speed_number == pytest.approx(3 * math.pi**2 / 8 / SMOOTH.moes_load**2)
    drawn = 2 * 0.04 * 1.0 / (MODULUS * 0.01)
    assert SMOOTH.moes_load == pytest.approx(2e5 / (MODULUS * 0.01) / drawn**0.5)
    assert SMOOTH.moes_material == pytest.approx(2.2e-8 * MODULUS * drawn**0.25)
    assert SMOOTH.surface_speeds == pytest.approx((1.15, 0.85))


@pytest.mark.parametrize("index", [0.6, 1.0])
def test_viscosity_of_a_warm_fluid(index):
    """Roelands over pressure and temperature by its plain formula; slopes by differences."""
    oil = Fluid(0.04, 2.2e-8, index)
    p, theta, k = np.array([0.0, 2e8, 9e8]), np.array([0.0, 30.0, 80.0]), 0.03
    value, slope = fluids.hot_log_viscosity(p, theta, oil, k)
    if index == 1.0:
        expected = 2.2e-8 * p - k * theta
    else:
        a = 2.2e-8 * 1.962e8 / index
        expected = a * ((1 + p / 1.962e8) ** index * np.exp(-k * theta / a) - 1)
    np.testing.assert_allclose(value, expected, rtol=1e-12, atol=1e-12)
    above, below = (fluids.hot_log_viscosity(p, theta + by, oil, k)[0] for by in (1e-4, -1e-4))
    np.testing.assert_allclose(slope, (above - below) / 2e-4, rtol=1e-6)
    cold, by_pressure = fluids.log_viscosity(p, oil)
    np.testing.assert_allclose(cold, fluids.hot_log_viscosity(p, 0.0 * p, oil, k)[0], atol=1e-12)
    above, below = (fluids.log_viscosity(p + by, oil)[0] for by in (1e3, -1e3))
    np.testing.assert_allclose(by_pressure, (above - below) / 2e3, rtol=1e-6)
    dense, by_pressure = fluids.relative_density(p, oil)
    np.testing.assert_allclose(dense, 1 + 0.6 * p / (1e9 + 1.7 * p), rtol=1e-12)
    above, below = (fluids.relative_density(p + by, oil)[0] for by in (1e4, -1e4))
    np.testing.assert_allclose(by_pressure, (above - below) / 2e4, rtol=1e-5)
    assert fluids.log_viscosity(np.array([1e12]), oil)[0][0] == fluids.MAXIMUM_LOG_VISCOSITY or index < 1


@pytest.mark.parametrize("number", [0, 1])
def test_the_start_is_near_the_solution(number):
    """It carries the load, has the film of the survey on the line of centres, and Newton needs few steps."""
    problem = REFERENCES[number][0]
    reduced = reduced_problem(problem)
    central = survey_film(problem.moes_load, problem.moes_material)
    solution = solve_steady(problem, step=0.2)
    state = first_state(reduced, solution.grid, central)
    assert solution.grid.weight @ state.pressure == pytest.approx(math.pi / 2)
    assert solution.central_film_thickness == pytest.approx(central * problem.film_unit, rel=0.25)
    before = state.end + solution.grid.node < 0.7  # the spike
    assert np.max(np.abs(state.pressure - solution.state.pressure)[before]) < 0.3
    assert state.end == pytest.approx(solution.state.end, abs=0.15)
    assert solution.steps <= 15


def test_nodes_are_dense_at_both_ends_of_the_contact():
    """The step grows with the distance from inlet and end; the film begins 60 widths before the contact."""
    film, step = 0.01, 0.2
    node = placed(film, step)
    width = (1.06 * film) ** (2 / 3)
    assert film_width(film) == pytest.approx(width)
    assert film_width(8.0) == pytest.approx(max((1.06 * 8.0) ** (2 / 3), 4.0))
    # between both only the parabola is wider
    assert [film_width(film) for film in (1.0, 2.0, 5.0)] == pytest.approx([1.06 ** (2 / 3), 2.0, 10.0**0.5])
    assert node[0] == pytest.approx(-3.0 - 60.0 * width)
    assert node[-1] == 0.0
    middle = 0.5 * (node[1:] + node[:-1])
    wanted = step / (1 / np.hypot(width, middle) + 1 / np.hypot(width, middle + 2.0))
    assert np.all(np.diff(node) == pytest.approx(wanted, rel=0.15))
    beyond = placed(film, step, 0.7)
    np.testing.assert_allclose(beyond[: len(node)], node)
    assert beyond[-1] == pytest.approx(0.7)
    assert placed(film, step, 0.0, 0.3)[0] == pytest.approx(-3.0 - 60.0 * film_width(0.3))


def test_rates_of_what_the_film_holds_are_of_second_order():
    """m = 2 + 3 t + 5 t² and x = 1 + t²: exact derivatives over unequal steps; one step back is Euler's."""
    grid = made(np.array([-2.0, -1.2, -0.5, 0.0]))
    half, speed, unit, t = 1e-4, 2.0, 1e-6, (0.1, 0.25, 0.3)

    def held(at):
        return Snapshot(at, np.full(4, 2 + 3 * at + 5 * at**2), np.full(4, 1 + at**2))

    for before, mass_rate, place_rate in (
        ([held(t[0]), held(t[1])], 3 + 10 * t[2], 2 * t[2]),
        ([held(t[1])], 3 + 5 * (t[1] + t[2]), t[1] + t[2]),
    ):
        squeeze = squeeze_of(t[2], before, half, speed, unit)
        own = held(t[2])
        np.testing.assert_allclose(
            squeeze.rate / half / unit * own.mass - squeeze.mass, mass_rate / speed / unit
        )
        np.testing.assert_allclose(squeeze.rate / half * own.place - squeeze.place, place_rate / speed)
    np.testing.assert_allclose(cells(grid), [0.4, 0.75, 0.6, 0.25])
    np.testing.assert_allclose(faces(grid), [-1.6, -0.85, -0.25, 0.0])
    np.testing.assert_allclose(
        mesh_speed(squeeze, 0.3, grid), squeeze.rate * (0.3 + faces(grid)) - squeeze.place
    )
    mass = np.array([1.0, 2.0, 3.0, 4.0])
    each = squeeze.rate * cells(grid) * mass - squeeze.mass
    np.testing.assert_allclose(stored(squeeze, grid, mass), [each[i + 1 :].sum() for i in range(3)])


def test_reduced_pressure_of_the_inlet_is_its_integral():
    known, reduced = _reduced_pressure(5e8, Fluid(0.04, 2.2e-8))
    for at in (100, 400, 550):
        exact = quad(lambda p: math.exp(-2.2e-8 * 5e8 * p), 0.0, known[at])[0]
        assert reduced[at] == pytest.approx(exact, rel=1e-3)
    assert known[-1] == 3.0
