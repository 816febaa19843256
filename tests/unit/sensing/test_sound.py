"""Radiated sound: a plate and a piston by closed forms; tables over frequency; energy by lines."""

import numpy as np
import pytest
from scipy.special import j1

from tribodyn.sensing.sound import AIR, level_of, power_of, radiated_pressure
from tribodyn.train.elastic.superelement import Radiation

RATE, COUNT = 8192.0, 8192
TIME = np.arange(COUNT) / RATE


def test_a_plate_that_bends_radiates_a_quarter_of_its_area():
    """∫ sin²(πx/a) sin²(πy/b) dS = a b/4; P = ρ c σ v²/2 of that."""
    area, speed, efficiency = 0.4 * 0.3, 2e-3, 0.7
    rates = (speed * np.sin(2.0 * np.pi * 250.0 * TIME))[:, None]
    pressure = radiated_pressure(rates, RATE, Radiation(np.array([[area / 4.0]])), efficiency)
    power = AIR * efficiency * area / 4.0 * speed**2 / 2.0
    assert power_of(pressure) == pytest.approx(power, rel=1e-9)
    assert np.std(pressure) ** 2 * 4.0 * np.pi / AIR == pytest.approx(power, rel=1e-9)
    spectrum = np.abs(np.fft.rfft(pressure))
    assert np.argmax(spectrum) == 250
    assert level_of(1e-3) == pytest.approx(90.0)


def test_a_piston_in_a_wall_by_its_table():
    """R = ρ c S (1 − J_1(2ka)/(ka)) of a round piston in a rigid wall (Rayleigh)."""
    radius, speed, known = 0.1, 1e-3, np.arange(50.0, 3001.0, 50.0)
    around = 2.0 * np.pi * known / 343.2 * radius
    resistance = AIR * np.pi * radius**2 * (1.0 - j1(2.0 * around) / around)
    radiation = Radiation(np.zeros((1, 1)), known, resistance[:, None, None])
    for frequency in (100.0, 1000.0, 2500.0, 3500.0):
        rates = (speed * np.cos(2.0 * np.pi * frequency * TIME))[:, None]
        expected = np.interp(frequency, known, resistance) * speed**2 / 2.0
        found = power_of(radiated_pressure(rates, RATE, radiation, 1.0))
        assert found == pytest.approx(expected, rel=1e-9)
    half = radiated_pressure((speed * np.cos(2.0 * np.pi * 25.0 * TIME))[:, None], RATE, radiation, 1.0)
    assert power_of(half) == pytest.approx(resistance[0] / 2.0 * speed**2 / 2.0, rel=1e-9)


def test_several_coordinates_radiate_together():
    """The mean of ρ c q'ᵀ A q' over time, whatever the phases and the forms between coordinates."""
    rng = np.random.default_rng(3)
    root = rng.normal(size=(4, 4))
    area, rates = root @ root.T, rng.normal(size=(COUNT, 4))
    rates -= rates.mean(axis=0)
    expected = AIR * np.mean(np.einsum("si,ij,sj->s", rates, area, rates))
    both = Radiation(area), Radiation(0.0 * area, np.array([1e-3]), AIR * area[None])
    for radiation in both:
        assert power_of(radiated_pressure(rates, RATE, radiation, 1.0)) == pytest.approx(expected, rel=1e-3)


def test_silence_has_no_level():
    assert (
        level_of(power_of(radiated_pressure(np.zeros((64, 2)), RATE, Radiation(np.eye(2)), 1.0))) == -np.inf
    )
