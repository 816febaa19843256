"""The oscillator's motion by Taylor series against SciPy's integration, and against identities of its map."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from tests.support.plain_kernels import make_plain
from tribodyn.studies.backlash_oscillator import motion
from tribodyn.studies.backlash_oscillator.motion import OscillatorMap

#: ζ, F_m, F_e, ε, Ω of motions that meet both corners, and of one that does at a varying stiffness.
PARAMETERS = np.array([[0.03, 0.15, 0.9, 0.0, 0.7], [0.06, -0.2, 1.1, 0.3, 0.8]])
STATES = np.array([[1.4, -1.9], [-0.4, 1.3]])
CASES = np.array([0, 1])


@pytest.fixture(autouse=True)
def plainly(monkeypatch):
    make_plain(monkeypatch, motion)


def restoring(x):
    return x - np.clip(x, -1.0, 1.0)


@pytest.mark.parametrize("case", CASES)
def test_motion_and_figures_are_those_of_scipy(case):
    """Over two periods, with contact lost and on the back side for a part of the time."""
    damping, mean, error, variation, frequency = PARAMETERS[case]

    def slope(t, y):
        cosine = np.cos(frequency * t)
        force = mean + error * frequency**2 * cosine
        return [y[1], force - 2 * damping * y[1] - (1 + variation * cosine) * restoring(y[0])]

    end = 4.0 * np.pi / frequency
    t = np.linspace(0.0, end, 20001)
    found = solve_ivp(slope, (0.0, end), STATES[case], "DOP853", t, rtol=1e-8, atol=1e-9)
    x = found.y[0]
    period_map = OscillatorMap(PARAMETERS)
    marched = period_map.march(STATES[case : case + 1], CASES[case : case + 1], 2)
    assert marched.reasons == [""]
    np.testing.assert_allclose(marched.states[0], found.y[:, [10000, 20000]].T, atol=3e-6)
    figures = period_map.figures(STATES[case : case + 1], CASES[case : case + 1], 2)[0]
    free, back = np.mean(np.abs(x[:-1]) < 1.0) * end, np.mean(x[:-1] < -1.0) * end
    assert free > 0.1
    assert back > 0.1
    expected = [np.trapezoid(x, t), np.trapezoid(x**2, t), free, back, np.max(x), np.min(x)]
    np.testing.assert_allclose(figures[:2], expected[:2], rtol=2e-6)
    np.testing.assert_allclose(figures[2:4], expected[2:4], atol=5e-3)
    np.testing.assert_allclose(figures[4:], expected[4:], atol=1e-5)


def test_the_tangent_is_the_maps_derivative_and_loses_area_as_damping_says():
    """Its determinant is exp(−2 ζ t) whatever the stiffness does."""
    period_map = OscillatorMap(PARAMETERS)
    tangent = period_map.tangent(STATES, CASES, 1)
    np.testing.assert_allclose(tangent.image, period_map.march(STATES, CASES, 1).states[:, -1], atol=1e-12)
    for shift, column in zip(1e-5 * np.eye(2), (0, 1), strict=True):
        up, down = (period_map.march(STATES + sign * shift, CASES, 1).states[:, -1] for sign in (1, -1))
        np.testing.assert_allclose(tangent.jacobian[:, :, column], (up - down) / 2e-5, atol=2e-5)
    time = 2.0 * np.pi / PARAMETERS[:, 4]
    expected = np.exp(-2.0 * PARAMETERS[:, 0] * time)
    np.testing.assert_allclose(np.linalg.det(tangent.jacobian), expected, rtol=1e-10)


@pytest.mark.parametrize("side", [1.0, 0.0, -1.0])
def test_without_a_corner_the_motion_is_that_of_the_linear_oscillator(side):
    """On either flank, and free between them; the excitation is a state of the linear system too."""
    damping, mean, error, frequency = 0.1, 0.07, 0.02, 2.3
    parameters = np.array([[damping, 3.0 * side + (mean if side else 0.0), error, 0.0, frequency]])
    stiffness = abs(side)
    start = np.array([4.0 * side + 0.1, -0.05])
    # x, v, cos, sin, 1
    flow = np.array(
        [
            [0.0, 1.0, 0.0, 0.0, 0.0],
            [-stiffness, -2 * damping, error * frequency**2, 0.0, parameters[0, 1] + side],
            [0.0, 0.0, 0.0, -frequency, 0.0],
            [0.0, 0.0, frequency, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0],
        ]
    )
    end = expm(flow * 2.0 * np.pi / frequency) @ [*start, 1.0, 0.0, 1.0]
    period_map = OscillatorMap(parameters)
    found = period_map.march(start[None], np.array([0]), 1).states[0, 0]
    np.testing.assert_allclose(found, end[:2], rtol=1e-12)
    figures = period_map.figures(start[None], np.array([0]), 1)[0]
    duration = 2.0 * np.pi / frequency
    assert figures[motion.FREE] == pytest.approx(0.0 if side else duration, rel=1e-12)
    assert figures[motion.BACK] == pytest.approx(duration if side < 0 else 0.0, rel=1e-12)


def test_a_motion_beyond_ten_thousand_half_backlashes_grows():
    rows = np.array([[10500.0, 0.0], [-10500.0, 0.0], [9000.0, 0.0], [2.0, 0.0]])
    still = np.array([[0.0, 0.0, 0.0, 0.0, 1.0]])
    reasons = OscillatorMap(still).march(rows, np.zeros(4, dtype=int), 1).reasons
    assert [bool(one) for one in reasons] == [True, True, False, False]
    assert "grows" in reasons[0]


def test_what_nothing_accelerates_reaches_the_flank_in_its_time():
    """Without any force a corner is met where the velocity leads to, and no sooner."""
    still = OscillatorMap(np.array([[0.0, 0.0, 0.0, 0.0, 2.0 * np.pi]]))
    found = still.march(np.array([[-0.9, 0.3]]), np.array([0]), 9).states[0]
    free = -0.9 + 0.3 * np.arange(1, 7)
    np.testing.assert_allclose(found[:6, 0], free, rtol=1e-12)
    inside = np.arange(7, 10) - 1.9 / 0.3
    np.testing.assert_allclose(found[6:, 0], 1.0 + 0.3 * np.sin(inside), rtol=1e-10)
