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
    measures = period_map.measures(STATES[case : case + 1], CASES[case : case + 1], 2)[0]
    free, back = np.mean(np.abs(x[:-1]) < 1.0) * end, np.mean(x[:-1] < -1.0) * end
    assert free > 0.1
    assert back > 0.1
    expected = [np.trapezoid(x, t), np.trapezoid(x**2, t), free, back, np.max(x), np.min(x)]
    np.testing.assert_allclose(measures[:2], expected[:2], rtol=2e-6)
    np.testing.assert_allclose(measures[2:4], expected[2:4], atol=5e-3)
    np.testing.assert_allclose(measures[4:], expected[4:], atol=1e-5)


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
    measures = period_map.measures(start[None], np.array([0]), 1)[0]
    duration = 2.0 * np.pi / frequency
    assert measures[motion.FREE] == pytest.approx(0.0 if side else duration, rel=1e-12)
    assert measures[motion.BACK] == pytest.approx(duration if side < 0 else 0.0, rel=1e-12)


def test_a_motion_beyond_ten_thousand_half_backlashes_grows():
    rows = np.array([[10500.0, 0.0], [-10500.0, 0.0], [9000.0, 0.0], [2.0, 0.0]])
    still = np.array([[0.0, 0.0, 0.0, 0.0, 1.0]])
    reasons = OscillatorMap(still).march(rows, np.zeros(4, dtype=int), 1).reasons
    assert [bool(reason) for reason in reasons] == [True, True, False, False]
    assert "grows" in reasons[0]


def test_what_nothing_accelerates_reaches_the_flank_in_its_time():
    """Without any force a corner is met where the velocity leads to, and no sooner."""
    still = OscillatorMap(np.array([[0.0, 0.0, 0.0, 0.0, 2.0 * np.pi]]))
    found = still.march(np.array([[-0.9, 0.3]]), np.array([0]), 9).states[0]
    free = -0.9 + 0.3 * np.arange(1, 7)
    np.testing.assert_allclose(found[:6, 0], free, rtol=1e-12)
    inside = np.arange(7, 10) - 1.9 / 0.3
    np.testing.assert_allclose(found[6:, 0], 1.0 + 0.3 * np.sin(inside), rtol=1e-10)


def test_the_last_terms_of_a_step_are_as_small_as_rounding():
    """The larger of both is just as small, as a share of position and velocity, and of 1 at least."""
    for first, (last, before) in (
        (0.3, (2.0, 7.0)),
        (-40.0, (9.0, 1e-9)),
        (0.3, (0.0, 5.0)),
        (60.0, (1e-4, 0.0)),
    ):
        for velocity in (0.2, -50.0):
            a = np.zeros(motion.DEGREE + 1)
            a[0], a[1], a[-1], a[-2] = first, velocity, last, -before
            step = motion._longest(a)
            terms = last * step**motion.DEGREE, before * step ** (motion.DEGREE - 1)
            assert max(terms) == pytest.approx(
                motion.ROUNDING * max(1.0, abs(first), abs(velocity)), rel=1e-9
            )
    assert motion._longest(np.zeros(motion.DEGREE + 1)) > 100.0


def test_integrals_and_extremes_of_a_polynomial(rng):
    """Of any degree that a step has, by NumPy's polynomials."""
    for side in (-1, 0, 1):
        a = rng.normal(size=motion.DEGREE + 1)
        step = 0.9
        # a step begins where the one before it ended
        measures = np.array([0.5, 0.25, 0.125, 0.0625, a[0], a[0]])
        motion._record(a, step, side, measures)
        x = np.polynomial.Polynomial(a)
        t = np.linspace(0.0, step, 20001)
        assert measures[motion.INTEGRAL] == pytest.approx(0.5 + x.integ()(step), rel=1e-12)
        assert measures[motion.SQUARE] == pytest.approx(0.25 + (x**2).integ()(step), rel=1e-12)
        assert measures[motion.FREE] == 0.125 + (step if side == 0 else 0.0)
        assert measures[motion.BACK] == 0.0625 + (step if side == -1 else 0.0)
        assert measures[motion.MAXIMUM] == pytest.approx(np.max(x(t)), abs=1e-7)
        assert measures[motion.MINIMUM] == pytest.approx(np.min(x(t)), abs=1e-7)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_no_corner_is_passed_by(direction, rng):
    """The first of two passages close together is found, however far away the motion was."""
    for _ in range(60):
        first, gap = rng.uniform(0.2, 0.7), 10.0 ** rng.uniform(-3.0, -1.0)
        # a motion that goes through the corner and back, times one that has no root there
        others = rng.uniform(1.1, 1.6, 7) * rng.choice([-1.0, 1.0], 7)
        x = np.polynomial.Polynomial.fromroots([first, first + gap, *others])
        x = x * (-0.5 * direction / x(0.0))
        a = np.zeros(motion.DEGREE + 1)
        a[:10] = x.coef
        a[0] += 0.3
        assert motion._until_corner(a, 1.0, 0.3, direction, False) == pytest.approx(first, abs=1e-3 * gap)


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_a_corner_that_is_met_with_growing_acceleration(direction):
    """From rest half a unit before it, as t^k: it is met at the k-th root of a half, and not behind it."""
    for power in range(2, motion.DEGREE + 1):
        a = np.zeros(motion.DEGREE + 1)
        a[0], a[power] = 0.3 - 0.5 * direction, direction
        assert motion._until_corner(a, 1.0, 0.3, direction, False) == pytest.approx(
            0.5 ** (1.0 / power), abs=1e-9
        )
        a[power] *= 0.49
        assert motion._until_corner(a, 1.0, 0.3, direction, False) == 1.0


def test_at_rest_on_a_corner_the_search_for_it_goes_on():
    """A speed away from the corner that moves the time by less than its last digit once went on for ever."""
    a = np.zeros(motion.DEGREE + 1)
    a[0], a[2], a[3] = 1.0, 0.5, 100.0
    start = motion.MINIMUM_STEP
    resting = -(2.0 * a[2] * start + 3.0 * a[3] * start**2)
    for digits in range(-8, 9):  # whichever of them leaves almost nothing of the slope there
        a[1] = resting + digits * np.spacing(resting)
        assert motion._until_corner(a, 1.0, 1.0, -1.0, True) in (start, 1.0)
