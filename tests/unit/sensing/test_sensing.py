"""From motion to a sensor: a housing's mode, planets that pass, sampling by blocks, noise and steps."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribodyn.sensing.data import HousingData, HousingMode, HousingTransfer, SensorData
from tribodyn.sensing.sampler import Sampler, as_measured, heard, housing_acceleration
from tribodyn.signals import resampled

MODE = HousingMode(900.0, 0.02, 12.0, {"pinion": (0.3, -0.8), "gear": (0.5,)}, {"top": 1.5})


def force(time):
    return 100.0 * (1.0 - np.cos(2.0 * np.pi * 40.0 * time)) * np.sin(2.0 * np.pi * 700.0 * time) + 50.0


def test_a_mode_is_an_oscillator():
    """Against the equation m (q'' + 2 ζ ω q' + ω² q) = φ F of one oscillator, from its rest under F(0)."""
    rate, omega = 20e3, 2.0 * np.pi * MODE.frequency
    time = np.arange(4000) / rate
    moved = MODE.shape["pinion"][1] / MODE.mass

    def accelerated(t, state):
        return moved * (force(t) - force(0.0)) - omega**2 * state[0] - 0.04 * omega * state[1]

    exact = solve_ivp(
        lambda t, state: [state[1], accelerated(t, state)],
        (0.0, time[-1]),
        [0.0, 0.0],
        t_eval=time,
        rtol=1e-10,
        atol=1e-14,
    )
    expected = 1.5 * accelerated(time, exact.y)
    found = housing_acceleration(HousingData((MODE,)), "top", [("pinion", 1)], force(time)[:, None], rate)
    np.testing.assert_allclose(found, expected, atol=2e-4 * np.max(np.abs(expected)))


def test_forces_add_up_and_a_measured_transfer_function_is_as_the_mode_it_was_measured_of():
    rate = 20e3
    time = np.arange(4000) / rate
    housing = HousingData((MODE,))
    inputs = housing.inputs("top")
    assert inputs == (("pinion", 0), ("pinion", 1), ("gear", 0))
    values = np.stack([force(time), -force(0.5 * time), 2.0 * force(time)], axis=1)
    whole = housing_acceleration(housing, "top", inputs, values, rate)
    frequency = np.linspace(0.0, rate / 2.0, 20001)
    paths = [
        HousingTransfer(
            "top",
            at,
            "xyz"[direction],
            tuple(frequency),
            tuple(housing.transfer("top", (at, direction), frequency)),
        )
        for at, direction in inputs
    ]
    measured = HousingData(transfers=tuple(paths))
    assert measured.points == ("top",)
    found = housing_acceleration(measured, "top", measured.inputs("top"), values, rate)
    np.testing.assert_allclose(found[:2000], whole[:2000], atol=2e-3 * np.max(np.abs(whole)))


def test_planets_are_heard_as_they_pass():
    away = np.array([[0.0, 2.0 * np.pi / 3.0, -2.0 * np.pi / 3.0], [np.pi / 6.0, np.pi, 6.0 * np.pi]])
    np.testing.assert_allclose(heard(away, "hann", 3), [[1.0, 0.0, 0.0], [0.5, 0.0, 1.0]], atol=1e-12)
    np.testing.assert_allclose(heard(away, "hamming", 3)[:, 0], [1.0, 0.54 + 0.46 * np.sqrt(0.75)])
    assert heard(away, "hamming", 3)[1, 1] == pytest.approx(0.08)


@pytest.mark.parametrize("blocks", [[20000], [7, 13, 500, 4000, 15479, 1]])
def test_blocks_of_a_motion_are_sampled_as_the_whole(blocks: list[int]):
    time = np.arange(sum(blocks)) / 100e3
    time = time + 1e-6 * np.sin(2.0 * np.pi * 200.0 * time)
    values = np.stack([np.cos(3e3 * time), np.sin(2e4 * time), np.sin(2e4 * time)], axis=1)
    sampler, start = Sampler(20e3, [False, False, True]), 0
    for count in blocks:
        part = slice(start, start + count)
        sampler.add(time[part], 50.0 * time[part], values[part])
        start += count
    at, angle, found = sampler.sampled()
    whole_at, whole = resampled(time, values, 20e3)
    assert len(at) >= len(whole_at)
    np.testing.assert_allclose(np.diff(at), 1.0 / 20e3)
    np.testing.assert_allclose(angle, 50.0 * at, atol=1e-9)
    common = np.searchsorted(at, whole_at[0] - 1e-9) + np.arange(len(whole_at))
    np.testing.assert_allclose(found[common, :2], whole[:, :2], atol=1e-4)
    np.testing.assert_allclose(found[:, 2], 2e4 * np.cos(2e4 * at), atol=2e-4 * 2e4)  # the slope


def test_without_a_filter_values_are_those_of_the_moments():
    time = np.arange(2001) / 1e5
    sampler = Sampler(1e4, [False], filtered=False)
    sampler.add(time, time, np.cos(2.0 * np.pi * 9e3 * time)[:, None])
    at, _, found = sampler.sampled()
    np.testing.assert_allclose(found[:, 0], np.cos(2.0 * np.pi * 1e3 * at), atol=1e-9)  # the alias


def sensor(**own) -> SensorData:
    return SensorData("a", "acceleration", None, "x", 20e3, "kaiser", **own)


def test_noise_has_its_level_and_its_seed():
    clean = np.sin(0.1 * np.arange(50_000))
    given = as_measured(clean, sensor(noise=0.05, seed=3)) - clean
    assert np.std(given) == pytest.approx(0.05, rel=0.02)
    by_ratio = as_measured(clean, sensor(snr=20.0, seed=3)) - clean
    assert np.std(by_ratio) == pytest.approx(0.1 * np.std(clean), rel=0.02)
    np.testing.assert_array_equal(as_measured(clean, sensor(noise=0.05, seed=3)) - clean, given)
    assert not np.allclose(as_measured(clean, sensor(noise=0.05, seed=4)) - clean, given)


def test_a_converter_clips_and_has_steps():
    found = as_measured(np.linspace(-3.0, 3.0, 601), sensor(bits=8, full_scale=2.0))
    assert (found.min(), found.max()) == (-2.0, 2.0 * 127.0 / 128.0)
    np.testing.assert_allclose(found / (2.0 / 128.0), np.round(found / (2.0 / 128.0)), atol=1e-9)
