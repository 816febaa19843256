"""Amplitude spectra against signals whose spectrum is known in closed form."""

import numpy as np
import pytest

from tribodyn.post.cycles import amplitude_spectrum


def signal(samples: int, per_cycle: int) -> np.ndarray:
    turn = 2 * np.pi * np.arange(samples) / per_cycle
    return -3.0 + 2.0 * np.cos(turn + 0.3) + 0.5 * np.sin(4 * turn) + 0.25 * np.cos(turn / 2)


@pytest.mark.parametrize("cycles", [2, 6])
@pytest.mark.parametrize("extra", [0, 1])
@pytest.mark.parametrize("per_cycle", [16, 25])
def test_amplitudes_are_those_put_in(cycles: int, extra: int, per_cycle: int):
    spectrum = amplitude_spectrum(signal(cycles * per_cycle + extra, per_cycle), per_cycle)
    expected = {0.0: -3.0, 0.5: 0.25, 1.0: 2.0, 4.0: 0.5}
    for order, amplitude in zip(spectrum.orders, spectrum.amplitudes, strict=True):
        assert amplitude == pytest.approx(expected.get(float(order), 0.0), abs=1e-13)


def test_only_the_last_whole_cycles_count():
    disturbed = signal(105, 25)
    disturbed[:5] = 1e6
    np.testing.assert_allclose(amplitude_spectrum(disturbed, 25).harmonics(2), [2.0, 0.0], atol=1e-13)


def test_the_highest_line_has_no_mirror_image():
    alternating = np.tile([1.0, -1.0], 20)
    spectrum = amplitude_spectrum(alternating, 10)
    assert spectrum.orders[-1] == 5.0
    assert spectrum.amplitudes[-1] == pytest.approx(1.0)


@pytest.mark.parametrize("per_cycle", [10, 11])
def test_mean_power_is_that_of_the_lines(per_cycle: int):
    """Parseval: mean square = mean² + Σ amplitude²/2, the line at half the sampling rate counting whole."""
    values = np.random.default_rng(3).normal(size=6 * per_cycle)
    spectrum = amplitude_spectrum(values, per_cycle)
    weights = np.full(spectrum.orders.size, 0.5)
    weights[0] = 1.0
    if values.size % 2 == 0:
        weights[-1] = 1.0
    assert np.sum(weights * spectrum.amplitudes**2) == pytest.approx(np.mean(values**2), rel=1e-12)


def test_harmonics_beyond_the_last_line_are_zero():
    np.testing.assert_allclose(
        amplitude_spectrum(signal(32, 16), 16).harmonics(12), [2, 0, 0, 0.5] + [0] * 8, atol=1e-13
    )


@pytest.mark.parametrize("bad", [np.ones(9), np.full(30, np.nan)])
def test_what_has_no_spectrum_is_refused(bad: np.ndarray):
    with pytest.raises(ValueError, match=r"cycle|finite"):
        amplitude_spectrum(bad, 10)
