"""Explicit Runge-Kutta methods: coefficients of SciPy, and steps taken with their formulas."""

import numpy as np
import pytest
from scipy.integrate import RK45, solve_ivp
from scipy.integrate._ivp import dop853_coefficients as reference_8
from scipy.optimize import approx_fprime

from tests.support.states import PAIR
from tribodyn.solve.march import explicit_8 as triple
from tribodyn.solve.methods import dopri5 as pair
from tribodyn.solve.methods import rodas4 as rosenbrock


def test_the_pair_has_the_coefficients_of_scipy():
    np.testing.assert_allclose(pair.A[:6, :5], RK45.A, rtol=1e-14, atol=0)
    np.testing.assert_allclose(pair.A[6], RK45.B, rtol=1e-14, atol=0)
    np.testing.assert_allclose(pair.C[:6], RK45.C, rtol=1e-14)
    np.testing.assert_allclose(pair.E, -RK45.E, rtol=1e-12, atol=1e-17)
    assert pair.C[6] == 1.0
    assert len(pair.C) == pair.STAGES == 7


def test_the_triple_has_the_coefficients_of_scipy():
    stages = triple.STAGES
    assert stages == reference_8.N_STAGES
    np.testing.assert_allclose(
        triple.A[:stages, :stages], reference_8.A[:stages, :stages], rtol=1e-13, atol=0
    )
    np.testing.assert_allclose(triple.A[stages, :stages], reference_8.B, rtol=1e-13, atol=0)
    np.testing.assert_allclose(triple.C[:stages], reference_8.C[:stages], rtol=1e-13)
    assert triple.C[stages] == 1.0
    for ours, theirs in ((triple.E5, reference_8.E5), (triple.E3, reference_8.E3)):
        np.testing.assert_allclose(np.ravel(ours), theirs, rtol=1e-11, atol=1e-16)
    for row, weights in enumerate(reference_8.A[:stages]):
        others = np.flatnonzero(weights[1:]) + 1
        assert triple.SECOND[row] == (others[0] if len(others) else 1)


def test_a_step_of_the_pair_is_that_of_scipy(rng):
    """Stages, error and dense output of y' = sin(M y), written out in the laws."""
    matrix = rng.normal(size=(PAIR.states, PAIR.states))
    matrix[:, PAIR.mechanical :] = 0.0  # nothing depends on the works
    before, step = rng.normal(size=PAIR.states), 0.3

    def slope(_, y):
        return np.sin(matrix @ y)

    k = np.zeros((pair.STAGES, PAIR.states))
    k[0] = slope(0.0, before)
    stage = before.copy()
    for s in range(1, pair.STAGES):
        pair.stage_state(s, step, before, k, stage, PAIR)
        k[s] = slope(0.0, stage)
    theirs = RK45(slope, 0.0, before, 1.0, first_step=step, rtol=1e3, atol=1e3)
    theirs.step()
    assert theirs.t == step
    np.testing.assert_allclose(stage, theirs.y, rtol=1e-13)
    error = np.array([pair.embedded_difference(k, i) for i in range(PAIR.states)])
    np.testing.assert_allclose(error * step, -theirs._estimate_error(theirs.K, step), rtol=1e-9, atol=1e-14)
    for theta in (0.0, 0.25, 0.6, 1.0):
        ours = [pair.dense_output(theta, step, before[i], stage[i], k, i) for i in range(PAIR.states)]
        np.testing.assert_allclose(ours, theirs.dense_output()(theta * step), rtol=1e-11)


def test_steps_grow_and_shrink_as_their_error_says():
    """From an error e of order e^(1/p): 0.8 … 0.9 of the step that would have the error 1, within bounds."""
    assert pair.shrinkage(2.0) == pytest.approx(0.9 / 2.0 ** (1 / 5))
    assert pair.growth(0.5, 0.5) == pytest.approx(0.8 * 2.0**0.13)
    assert pair.growth(0.5, 1.0) == pytest.approx(0.8 * 2.0**0.17)
    assert (pair.growth(0.0, 1.0), pair.growth(1e9, 1.0), pair.shrinkage(1e9)) == (5.0, 0.2, 0.2)
    assert triple.shrinkage(2.0) == pytest.approx(0.9 / 2.0 ** (1 / 8))
    assert triple.growth(0.5) == pytest.approx(0.9 * 2.0 ** (1 / 8))
    assert (triple.growth(0.0), triple.growth(1e12), triple.shrinkage(1e12)) == (6.0, 0.3, 0.3)
    assert rosenbrock.shrinkage(2.0) == pytest.approx(0.9 / 2.0 ** (1 / 4))
    assert rosenbrock.growth(0.5, 0.5) == pytest.approx(0.8 * 2.0**0.16)
    assert rosenbrock.growth(0.5, 1.0) == pytest.approx(0.8 * 2.0**0.21)
    assert (rosenbrock.growth(0.0, 1.0), rosenbrock.growth(1e9, 1.0)) == (6.0, 0.2)
    assert rosenbrock.shrinkage(1e9) == 0.1


def test_the_third_order_difference_makes_the_error_of_the_triple_one_of_seventh():
    """Hairer's |e5|²/√(|e5|² + 0.01 |e3|²), the norm of the code DOP853."""
    for fifth, third in ((0.3, 2.0), (1e-3, 0.4), (2.0, 0.0)):
        expected = fifth**2 / np.sqrt(fifth**2 + 0.01 * third**2)
        assert fifth * triple.confidence(fifth, third) == pytest.approx(expected, rel=1e-12)


def rosenbrock_step(slope, y, step):
    """One step, with the formulas of the module's head; the new state and what the dense output needs."""
    size = rosenbrock.STAGES
    jacobian = np.array([approx_fprime(y, lambda v, i=i: slope(v)[i], 1e-7) for i in range(len(y))])
    matrix = np.eye(len(y)) / (rosenbrock.GAMMA * step) - jacobian
    u = np.zeros((size, len(y)))
    for i in range(size):
        at = y + rosenbrock.A[i, :i] @ u[:i]
        u[i] = np.linalg.solve(matrix, slope(at) + rosenbrock.C[i, :i] @ u[:i] / step)
    return at + u[-1], u[-1], rosenbrock.D @ u[: size - 1]


def test_a_rosenbrock_step_is_of_fourth_order_inside_of_third(rng):
    """Halving the step divides errors by 2^5 at the end, 2^4 inside, and so the difference to third order."""
    matrix, start = rng.normal(size=(3, 3)), rng.normal(size=3)

    def slope(y):
        return np.sin(matrix @ y)

    steps = (0.08, 0.04)
    ends, insides, embedded = [], [], []
    for step in steps:
        exact = solve_ivp(
            lambda _, y: slope(y), (0, step), start, "DOP853", [0.4 * step, step], rtol=1e-13, atol=1e-14
        ).y
        after, error, (first, second) = rosenbrock_step(slope, start, step)
        inside = rosenbrock.dense_output(0.4, start, after, first, second)
        ends.append(np.abs(after - exact[:, 1]).max())
        insides.append(np.abs(inside - exact[:, 0]).max())
        embedded.append(np.abs(error).max())
        np.testing.assert_allclose(rosenbrock.dense_output(0.0, start, after, first, second), start)
        np.testing.assert_allclose(rosenbrock.dense_output(1.0, start, after, first, second), after)
    assert np.log2(ends[0] / ends[1]) == pytest.approx(5.0, abs=0.6)
    assert np.log2(insides[0] / insides[1]) == pytest.approx(4.0, abs=0.6)
    assert np.log2(embedded[0] / embedded[1]) == pytest.approx(4.0, abs=0.6)
