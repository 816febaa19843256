"""Signals at other places: what the filter keeps, and what it stops."""

import numpy as np
import pytest

from tribodyn.signals import by_angle, resampled

RATE = 100e3
TIME = np.arange(20000) / RATE


@pytest.mark.parametrize("rate", [20e3, 19876.5, 73e3, RATE])
@pytest.mark.parametrize("share", [1e-3, 0.1, 0.27, 0.4])
def test_a_tone_below_0_4_of_the_rate_keeps_its_amplitude_and_phase_within_1e_4(rate: float, share: float):
    tone = 2.0 * np.pi * share * rate
    at, found = resampled(TIME, np.cos(tone * TIME + 0.3), rate)
    assert np.allclose(np.diff(at), 1.0 / rate)
    np.testing.assert_allclose(found, np.cos(tone * at + 0.3), atol=1e-4)


@pytest.mark.parametrize("frequency", [12.0e3, 13.3e3, 20.0e3, 27.1e3, 47.0e3])
def test_what_would_alias_is_stopped_by_60_db(frequency: float):
    _, found = resampled(TIME, np.cos(2.0 * np.pi * frequency * TIME), 20e3)
    assert np.max(np.abs(found)) < 1e-3


def test_uneven_samples_are_taken_where_they_lie():
    """As those of a solver that are even in the phase of the mesh while the speed oscillates."""
    time = TIME + 2e-6 * np.sin(2.0 * np.pi * 300.0 * TIME)
    at, found = resampled(time, np.cos(2.0 * np.pi * 7e3 * time), 20e3)
    np.testing.assert_allclose(found, np.cos(2.0 * np.pi * 7e3 * at), atol=1e-4)


def test_several_channels_are_resampled_as_each_alone():
    both = np.stack([np.cos(5e3 * TIME), np.sin(9e3 * TIME)], axis=1)
    _, together = resampled(TIME, both, 20e3)
    for column in (0, 1):
        alone = resampled(TIME, both[:, column], 20e3)[1]
        np.testing.assert_allclose(together[:, column], alone, atol=1e-14)


def test_over_the_angle_an_order_is_a_tone_whatever_the_speed_does():
    time = np.arange(40000) / 20e3
    turns = 5.0 * time + 4.0 * time**2
    places, found = by_angle(np.cos(2.0 * np.pi * 23.0 * turns), turns, 128)
    inner = slice(200, -200)
    np.testing.assert_allclose(found[inner], np.cos(2.0 * np.pi * 23.0 * places)[inner], atol=1e-4)
