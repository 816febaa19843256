"""Mixed contacts: Greenwood & Tripp's integral, smooth and dry limits, balance, the Jacobian."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from tests.support.line_contacts import REFERENCES
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.fluid import Fluid, Rheology
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.rough import (
    Roughness,
    asperity_pressure,
    mean_gap,
    pressure_flow_factor,
)
from tribodyn.tribology.ehl.steady import solve_steady

PROBLEM = REFERENCES[1][0]


def rough(height, speed=1.0, sliding=0.0):
    return PROBLEM._replace(roughness=Roughness(height), entrainment_speed=speed, sliding_speed=sliding)


def test_asperities_pressed_flat():
    """Below −6 σ the pressure goes straight on; F_5/2 is ∫ (s − t)^5/2 φ ds to six digits everywhere."""
    height, unlike = 0.4e-6, Roughness(0.4e-6, 0.04, 0.02)
    factor = 16 * math.sqrt(2) / 15 * math.pi * 0.04**2 * math.sqrt(0.02) * 0.5 * 211e9
    gaps = np.array([-9.0, -7.0, -6.0, -5.9, -1.4, 0.3, 2.2, 4.0]) * height
    value, slope = asperity_pressure(gaps, unlike, 211e9)

    def overlap(t, power):
        kernel = lambda s: (s - t) ** power * math.exp(-s * s / 2) / math.sqrt(2 * math.pi)  # noqa: E731
        return quad(kernel, t, 0.5 * (t + 10.0))[0] + quad(kernel, 0.5 * (t + 10.0), 10.0)[0]

    for k, t in enumerate(gaps / height):
        held = max(t, -6.0)
        integral, steep = overlap(held, 2.5), -2.5 * overlap(held, 1.5)
        assert value[k] == pytest.approx(factor * (integral + steep * (t - held)), rel=2e-6)
        assert slope[k] == pytest.approx(factor * steep / height, rel=2e-6)


def test_derivatives_of_gap_and_flow_factor():
    height = 0.5e-6
    gaps = np.array([-2.0, -0.4, 0.7, 3.0]) * height
    for function in (mean_gap, pressure_flow_factor):
        above, below = (function(gaps + by, Roughness(height))[0] for by in (1e-12, -1e-12))
        np.testing.assert_allclose(function(gaps, Roughness(height))[1], (above - below) / 2e-12, rtol=1e-4)
    mean = np.array([0.3, 1.9]) * height
    factor = pressure_flow_factor(mean, Roughness(height))[0]
    np.testing.assert_allclose(factor, 1 - 0.9 * np.exp(-0.56 * mean / height))
    # pressed together for good a trillionth of the roughness stays open
    shut, share = mean_gap(np.array([-60.0 * height]), Roughness(height))
    assert shut[0] == pytest.approx(1e-12 * height)
    assert share[0] == 0.0


def test_mean_gap():
    """h_T = ∫ (h + s) φ(s) ds over what does not overlap."""
    height = 0.5e-6
    gaps = np.array([-1.0, 0.0, 1.0, 8.0]) * height
    found, _ = mean_gap(gaps, Roughness(height))
    for gap, value in zip(gaps / height, found / height, strict=True):
        normal = quad(lambda s, gap=gap: (gap + s) * math.exp(-s * s / 2) / math.sqrt(2 * math.pi), -gap, 12)
        assert value == pytest.approx(normal[0], rel=1e-6)


def test_smooth_limit():
    smooth = solve_steady(PROBLEM)
    found = solve_steady(rough(1e-9))
    assert found.central_film_thickness == pytest.approx(smooth.central_film_thickness, rel=1e-4)
    assert found.asperity_load_ratio < 1e-9


def test_dry_limit():
    """Slower and slower: all load on the asperities, friction f_c."""
    shares = [solve_steady(rough(0.4e-6, speed)).asperity_load_ratio for speed in (1e-1, 1e-2, 1e-3, 1e-5)]
    assert np.all(np.diff(shares) > 0.0)
    assert shares[-1] > 0.99
    found = solve_coupled(rough(0.4e-6, 1e-5, 1e-6), Rheology("eyring"))
    assert found.friction / PROBLEM.line_load == pytest.approx(0.12, rel=0.02)


@pytest.mark.parametrize("height", [0.1e-6, 0.4e-6, 1e-6])
def test_load_is_shared(height):
    solution = solve_steady(rough(height, 0.1))
    whole = np.trapezoid(solution.fluid_pressure + solution.asperity_pressure, solution.place)
    assert whole == pytest.approx(PROBLEM.line_load, rel=1e-9)
    assert solution.imbalance <= 1e-10
    assert np.trapezoid(solution.asperity_pressure, solution.place) == pytest.approx(
        solution.asperity_load_ratio * PROBLEM.line_load, rel=1e-9
    )
    assert np.all(solution.mean_gap > 0.0)


def test_random_rough_contacts_converge(rng):
    """σ over the smooth film from 0.1 to far above 10, as the gears' oils and loads have it and beyond."""
    for _ in range(40):
        fluid = Fluid(10 ** rng.uniform(-2.3, 0.0), rng.uniform(5e-9, 35e-9), 0.6)
        load, radius, speed = 10 ** rng.uniform([4.0, -2.5, -1.0], [6.0, -1.3, 1.3])
        height = Roughness(10 ** rng.uniform(-6.5, -5.7))
        found = solve_steady(LineContact(load, radius, speed, fluid, 226e9, 0.0, height), step=0.15)
        assert found.imbalance <= 1e-10
