"""The oscillator with backlash against closed forms, Floquet theory, SciPy and harmonic balance."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.support.foreign_marching import oscillator_march
from tests.support.harmonic_balance import HarmonicBalance, restoring, turning_points
from tribodyn.solve.branch.arclength import FOLD, PERIOD_DOUBLING
from tribodyn.solve.orbit.search import find
from tribodyn.studies.backlash_oscillator.motion import OscillatorMap
from tribodyn.studies.backlash_oscillator.response import (
    CHAOTIC,
    DOWN,
    STABLE,
    UP,
    frequency_response,
    oscillator_at,
)
from tribodyn.studies.backlash_oscillator.scenario import BacklashOscillatorCase


def oscillator(frequencies, damping=0.05, mean_force=0.1, error=0.05, variation=0.0, **more):
    return BacklashOscillatorCase(
        "", "", "", "", "", damping, mean_force, error, variation, tuple(map(float, frequencies)), **more
    )


@pytest.mark.parametrize(
    "parameters",
    [
        (0.05, 0.1, 0.05, 0.0, 0.75),
        (0.05, 0.1, 0.05, 0.3, 0.62),
        (0.01, 0.05, 0.4, 0.5, 0.45),  # strikes the back side
        (0.02, 0.0, 0.9, 0.2, 1.1),
    ],
)
def test_the_path_through_the_corners_is_scipys(parameters):
    for state in ((1.02, 0.4), (0.3, -0.2), (-1.5, 0.1)):
        ours = OscillatorMap(np.array([parameters])).march(np.array([state]), np.array([0]), 3, True)
        np.testing.assert_allclose(ours.states[0], oscillator_march(parameters, state, 3), atol=1e-9)


def test_a_motion_that_grazes_the_corner_goes_on():
    """Started on a corner at rest, or so that it just touches: no step may be lost there, or stick."""
    parameters = np.array([[0.05, 0.1, 0.05, 0.0, 0.5]])
    system = OscillatorMap(parameters)
    for state in ((1.0, 0.0), (-1.0, 0.0), (1.0, 1e-15), (1.0 - 1e-16, -1e-12)):
        track = system.march(np.array([state]), np.array([0]), 2, True)
        np.testing.assert_allclose(track.states[0], oscillator_march(parameters[0], state, 2), atol=1e-8)
    # linear response whose minimum x is exactly 1
    gain = 0.25 / abs(0.75 + 2j * 0.05 * 0.5)
    touching = oscillator([0.5], error=0.1 / gain)
    response = frequency_response(touching)
    np.testing.assert_allclose(response.peak_to_peak_displacement, 0.2, rtol=1e-5)


def fundamental(damping, variation, frequency):
    """Monodromy matrix of x'' + 2ζx' + (1 + ε cos Ωτ)x = 0, integrated apart from our solver."""

    def rates(t, y):
        return [y[1], -2.0 * damping * y[1] - (1.0 + variation * np.cos(frequency * t)) * y[0]]

    span = (0.0, 2.0 * np.pi / frequency)
    columns = [
        solve_ivp(rates, span, start, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
        for start in ([1.0, 0.0], [0.0, 1.0])
    ]
    return np.array(columns).T


def steady_in_contact(damping, variation, frequency):
    """A state so loaded that it never leaves contact, by shooting: stable or not."""
    case = oscillator([frequency], damping, 50.0, 0.0, variation)
    system = oscillator_at(case, np.array([frequency]))
    return find(system, np.array([[51.0, 0.0]]), method="shooting")[0]


@pytest.mark.parametrize("frequency", [0.41, 0.6, 1.6, 1.98, 2.5])
def test_multipliers_of_varying_stiffness_are_floquets(frequency):
    damping, variation = 0.03, 0.4
    orbit = steady_in_contact(damping, variation, frequency)
    matrix = fundamental(damping, variation, frequency)
    expected = np.linalg.eigvals(matrix)
    for multiplier in expected:
        assert np.min(np.abs(orbit.multipliers - multiplier)) < 1e-9
    # Liouville: their product is what damping takes
    assert np.prod(orbit.multipliers).real == pytest.approx(np.exp(-4.0 * np.pi * damping / frequency))
    assert orbit.stable == (np.max(np.abs(expected)) < 1.0)


def test_the_tongue_at_twice_the_natural_frequency():
    """Its edges by averaging: (Ω − 2)² = ε²/4 − 4ζ², up to terms of the order ε²."""
    damping, variation = 0.005, 0.06
    half_width = np.sqrt(variation**2 / 4.0 - 4.0 * damping**2)
    for side in (-1.0, 1.0):
        inside, outside = 2.0, 2.0 + 3.0 * side * half_width
        assert not steady_in_contact(damping, variation, inside).stable
        assert steady_in_contact(damping, variation, outside).stable
        for _ in range(30):
            middle = 0.5 * (inside + outside)
            if steady_in_contact(damping, variation, middle).stable:
                outside = middle
            else:
                inside = middle
        assert inside == pytest.approx(2.0 + side * half_width, abs=variation**2 / 4.0)
        # and to the last digit against the fundamental matrix
        largest = np.max(np.abs(np.linalg.eigvals(fundamental(damping, variation, inside))))
        assert largest == pytest.approx(1.0, abs=2e-6)


@pytest.fixture(scope="module")
def folds():
    """Turning points of the branch of ε = 0 by harmonic balance: the way up jumps at the first."""
    amplitudes = np.concatenate([np.linspace(0.03, 0.099, 16), np.linspace(0.1, 0.33, 47)])
    frequencies = HarmonicBalance(0.05, 0.1, 0.05).branch(0.6, amplitudes)
    return turning_points(amplitudes, frequencies)


@pytest.fixture(scope="module")
def softening(folds):
    """Sweep with fine steps about the two folds."""
    up, down = folds
    near = [fold + np.arange(-10, 11) * 2e-4 + 1e-4 for fold in (down, up)]
    frequencies = np.unique(np.concatenate([np.arange(0.4, 1.1, 0.01), *near]))
    return frequency_response(oscillator(frequencies))


def jumps(response, direction):
    """Intervals over which the response of a direction jumps."""
    rise = np.abs(np.diff(response.rms_displacement[:, direction]))
    place = int(np.argmax(rise))
    return response.frequency[place], response.frequency[place + 1]


def test_jump_frequencies_are_those_of_harmonic_balance(softening, folds):
    """Softening: the way up stays low until the first fold, the way down stays high until the second."""
    up, down = folds
    assert down < up < 1.0
    for fold, direction in ((up, UP), (down, DOWN)):
        below, above = jumps(softening, direction)
        assert below - 1e-4 <= fold <= above + 1e-4
        assert above - below <= 2.01e-4


def test_the_ways_up_and_down_differ_between_the_jumps_only(softening, folds):
    up, down = folds
    frequency, rms = softening.frequency, softening.rms_displacement
    between = (frequency > down + 2e-4) & (frequency < up - 2e-4)
    outside = (frequency < down - 2e-4) | (frequency > up + 2e-4)
    np.testing.assert_allclose(rms[outside, UP], rms[outside, DOWN], rtol=1e-5)
    assert np.min(rms[between, DOWN] / rms[between, UP]) > 1.5
    assert np.all(softening.contact_loss_fraction[between, DOWN] > 0.1)  # contact is lost on the upper branch
    assert np.all(softening.motion == STABLE)


def test_a_multiplier_goes_to_plus_one_at_the_fold(folds):
    """As a saddle-node's must, real, with the square root of the distance."""
    before = folds[0] - np.array([1e-2, 8e-5, 4e-5, 2e-5])
    response = frequency_response(oscillator([*np.arange(0.4, 0.81, 0.01), *before]))
    largest = response.multiplier[-3:, UP, 0]
    assert np.all(largest.imag == 0.0)
    assert np.all(np.diff(largest.real) > 0.02)
    assert 0.88 < largest[-1].real < 1.0


def test_amplitudes_are_those_of_harmonic_balance(softening):
    amplitudes = np.array([0.05, 0.08])
    frequencies = HarmonicBalance(0.05, 0.1, 0.05).branch(0.6, amplitudes)
    response = frequency_response(oscillator(frequencies))
    np.testing.assert_allclose(response.rms_displacement[:, UP], amplitudes / np.sqrt(2.0), rtol=1e-5)


def test_period_two_and_what_it_leaves():
    """Near Ω = 2 the varying stiffness doubles the period; the state of one period lives on, unstable."""
    parameters = (0.05, 0.1, 0.05, 0.3, 1.95)
    system = OscillatorMap(np.array([parameters]))
    (double,) = find(system, np.array([[1.1, 0.0]]))
    assert double.kind == "period-2"
    track = oscillator_march(parameters, double.state, 2)
    assert np.max(np.abs(track[1] - double.state)) < 1e-6
    assert np.max(np.abs(track[0] - double.state)) > 0.05
    (single,) = find(system, np.array([[1.1, 0.0]]), method="shooting")
    assert single.kind == "unstable"
    assert np.max(np.abs(oscillator_march(parameters, single.state, 1)[0] - single.state)) < 1e-6
    largest = single.multipliers[0]
    assert largest.real < -1.0
    # a neighbour leaves it by that factor a period
    away = system.march(single.state[None] + [[1e-6, 0.0]], np.array([0]), 12, True).states[0] - single.state
    growth = np.linalg.norm(away[11]) / np.linalg.norm(away[9])
    assert growth == pytest.approx(abs(largest) ** 2, rel=1e-2)


def test_marching_and_shooting_agree():
    parameters = np.array([[0.05, 0.1, 0.05, 0.2, f] for f in (0.5, 0.68, 0.95, 1.4)])
    start = np.tile([1.1, 0.0], (4, 1))
    marched = find(OscillatorMap(parameters), start, method="marching", tolerance=1e-10)
    shot = find(
        OscillatorMap(parameters),
        np.array([orbit.state for orbit in marched]) + 1e-3,
        method="shooting",
        tolerance=1e-10,
    )
    for orbit, other in zip(marched, shot, strict=True):
        assert orbit.kind == other.kind == "period-1"
        np.testing.assert_allclose(orbit.state, other.state, atol=1e-8)
        np.testing.assert_allclose(orbit.multipliers, other.multipliers, atol=1e-6)


def test_chaos_is_said_and_measured_as_marched():
    """ε = 0.2 at 2 % damping and a strong error: the doubled period doubles on until nothing repeats."""
    case = oscillator([1.2], 0.02, 0.1, 0.2, 0.2, max_periods=240)
    response = frequency_response(case)
    assert np.all(response.motion == CHAOTIC)
    assert np.all(response.period == 0)
    assert np.all(np.isnan(response.multiplier))
    assert np.all(np.isfinite(response.rms_displacement))
    assert all("without repeating" in text for _, _, text in response.messages)


def test_a_motion_that_grows_is_a_failure_of_its_own():
    """In the tongue and so loaded that it stays in contact the linear equation has no bounded motion."""
    response = frequency_response(oscillator([1.5, 2.0], 0.005, 50.0, 0.02, 0.3))
    assert response.motion[0, UP] == STABLE
    assert np.isnan(response.rms_displacement[1, UP])
    assert "without bound" in response.messages[0][2]


def test_a_sweep_is_the_same_every_time():
    case = oscillator(np.arange(0.6, 0.9, 0.02))
    first, second = frequency_response(case), frequency_response(case)
    for mine, other in zip(first[:-2], second[:-2], strict=True):
        np.testing.assert_array_equal(mine, other)


def test_figures_are_those_of_the_motion():
    """RMS, extremes and shares against samples of SciPy's solution."""
    parameters = (0.05, 0.1, 0.05, 0.0, 0.75)
    response = frequency_response(oscillator([0.75, 0.8, 0.9]))
    state = np.array([response.section_displacement[0, DOWN], response.section_velocity[0, DOWN]])
    duration = 2.0 * np.pi / 0.75

    def rates(t, y):
        push = 0.1 + 0.05 * 0.75**2 * np.cos(0.75 * t)
        return [y[1], push - 0.1 * y[1] - float(restoring(y[0]))]

    at = (np.arange(20000) + 0.5) * duration / 20000
    x = solve_ivp(rates, (0.0, duration), state, t_eval=at, rtol=1e-10, atol=1e-12, max_step=0.02).y[0]
    assert parameters[-1] == response.frequency[0]
    assert response.rms_displacement[0, DOWN] == pytest.approx(np.std(x), rel=1e-5)
    assert response.mean_displacement[0, DOWN] == pytest.approx(np.mean(x), rel=1e-6)
    assert response.peak_to_peak_displacement[0, DOWN] == pytest.approx(np.ptp(x), rel=1e-5)
    assert response.contact_loss_fraction[0, DOWN] == pytest.approx(np.mean(np.abs(x) <= 1.0), abs=1e-4)
    assert response.contact_loss_fraction[0, DOWN] > 0.1
    assert response.back_contact_fraction[0, DOWN] == 0.0


@pytest.mark.parametrize("step", [0.04, 0.1])
def test_the_doubled_period_is_followed_to_its_end_whatever_the_step(step):
    """Down the branch of two periods; an independent march with DOP853 gives RMS 0.1215 and 0.1854."""
    values = np.unique(np.round(np.concatenate([np.arange(1.2, 2.2, step), [1.24, 1.6, 1.88]]), 6))
    response = frequency_response(oscillator(values, error=0.0, variation=0.3))
    for frequency, rms in ((1.88, 0.1215), (1.6, 0.1854)):
        place = int(np.argmin(np.abs(values - frequency)))
        assert response.period[place, DOWN] == 2
        assert response.rms_displacement[place, DOWN] == pytest.approx(rms, abs=1e-4)
        state = np.array([response.section_displacement[place, DOWN], response.section_velocity[place, DOWN]])
        parameters = (0.05, 0.1, 0.0, 0.3, frequency)
        np.testing.assert_allclose(oscillator_march(parameters, state, 2)[1], state, atol=1e-6)
    down = [end for direction, end in response.ends if direction == DOWN]
    doubling, fold = down[:2]
    assert (doubling.kind, doubling.period) == (PERIOD_DOUBLING, 1)
    # in contact the equation is linear: Floquet's multiplier is −1 there
    multipliers = np.linalg.eigvals(fundamental(0.05, 0.3, doubling.value))
    assert np.min(multipliers.real) == pytest.approx(-1.0, abs=2e-3)
    assert (fold.kind, fold.period) == (FOLD, 2)
    assert response.period[int(np.argmin(np.abs(values - 1.24))), DOWN] == 2
    if step < 0.1:
        return
    # two thousandths farther the motion of two periods is left by DOP853 too
    here = np.array([response.section_displacement, response.section_velocity])[
        :, int(np.argmin(np.abs(values - 1.24))), DOWN
    ]
    before, beyond = (
        oscillator_march((0.05, 0.1, 0.0, 0.3, frequency), here, 70)
        for frequency in (fold.value * 1.002, fold.value * 0.998)
    )
    assert np.max(np.abs(before[-1] - before[-2])) > 0.1
    assert np.max(np.abs(beyond[-1] - beyond[-2])) < 0.5 * np.max(np.abs(before[-1] - before[-2]))
