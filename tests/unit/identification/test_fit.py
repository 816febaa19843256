"""Estimates and their intervals for models whose answer is known without a simulation."""

import numpy as np
import pytest
from scipy.stats import t

from tribodyn.identification.fit import covariance_of, fitted, sobol, whiteness

TIME = np.linspace(0.0, 2.0, 400)


def decay(shares: np.ndarray) -> np.ndarray:
    """A damped oscillation, its damping and its frequency sought."""
    damping, frequency = 0.1 + 2.0 * shares[0], 5.0 + 60.0 * shares[1]
    return np.exp(-damping * TIME) * np.cos(frequency * TIME)


def residuals_of(values: np.ndarray):
    return lambda places: [values - decay(place) for place in places]


def test_a_straight_line_has_the_intervals_of_the_textbook():
    """Slope of a line through the origin: variance s²/Σ x², intervals by t of n − 1."""
    random = np.random.default_rng(4)
    x = np.linspace(1.0, 2.0, 30)
    y = 0.4 * x + 0.05 * random.standard_normal(30)
    found = fitted(lambda places: [y - place[0] * x for place in places], [np.array([0.5])])
    slope = x @ y / (x @ x)
    deviation = np.sqrt(np.sum((y - slope * x) ** 2) / 29)
    assert found.shares[0] == pytest.approx(slope, rel=1e-6)
    assert found.freedom == 29
    assert found.deviation == pytest.approx(deviation, rel=1e-6)
    assert found.half_width(0.95)[0] == pytest.approx(t.ppf(0.975, 29) * deviation / np.sqrt(x @ x), rel=1e-6)


def test_the_truth_lies_in_the_intervals_of_95_of_100_seeds():
    truth, inside = np.array([0.3, 0.6]), np.zeros(2)
    for seed in range(400):
        noise = 0.1 * np.random.default_rng(seed).standard_normal(len(TIME))
        found = fitted(residuals_of(decay(truth) + noise), [np.array([0.35, 0.602])])
        inside += np.abs(found.shares - truth) <= found.half_width(0.95)
    # 380 expected; four deviations of the binomial distribution are 17
    assert np.all(np.abs(inside - 380.0) <= 17.0)


def test_the_best_of_the_starts_leaves_a_valley_that_is_none():
    truth = np.array([0.1, 0.9])
    lost = fitted(residuals_of(decay(truth)), [np.array([0.1, 0.2])])
    found = fitted(residuals_of(decay(truth)), [np.array([0.1, 0.2]), *sobol(2, 64, 0)])
    assert np.abs(lost.shares - truth)[1] > 0.2
    assert found.shares == pytest.approx(truth, abs=1e-4)


def test_what_the_data_do_not_tell_apart_has_no_interval():
    columns = np.array([[1.0, 2.0], [2.0, 4.0], [3.0, 6.0]])
    assert np.all(np.isinf(covariance_of(columns, 1.0)))
    assert np.all(np.isinf(covariance_of(np.zeros((3, 1)), 1.0)))


def test_the_covariance_is_the_inverse_of_the_normal_matrix():
    columns = np.random.default_rng(1).standard_normal((50, 3))
    assert covariance_of(columns, 0.25) == pytest.approx(0.25 * np.linalg.inv(columns.T @ columns))


def test_white_noise_is_called_so_and_what_follows_itself_is_not():
    random = np.random.default_rng(2)
    probabilities = [whiteness(random.standard_normal(500)) for _ in range(400)]
    # uniform between 0 and 1
    assert np.mean(np.array(probabilities) < 0.1) == pytest.approx(0.1, abs=0.05)
    assert np.mean(probabilities) == pytest.approx(0.5, abs=0.06)
    noise = random.standard_normal(500)
    assert whiteness(noise[1:] + 0.5 * noise[:-1]) < 1e-6
    assert whiteness(np.zeros(100)) == 1.0
