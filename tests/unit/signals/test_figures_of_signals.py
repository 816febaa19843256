"""Spectra, averages, envelopes and indicators against signals whose answers are known."""

import numpy as np
import pytest
from scipy.special import jv

from tribodyn import signals
from tribodyn.errors import InputError

RATE = 20e3
TIME = np.arange(20000) / RATE


def noise(seed: int, count: int = 100_000) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=count)


def test_a_phase_modulation_has_the_bessel_amplitudes():
    """cos(z φ + β sin φ): amplitude J_n(β) at the orders z + n, as of a gear that runs out."""
    turns = 25.0 * TIME + 0.02 * np.sin(2.0 * np.pi * 3.0 * TIME)
    phase, depth = 2.0 * np.pi * turns, 0.6
    found = signals.order_spectrum(np.cos(23.0 * phase + depth * np.sin(phase)), turns, 256, "none")
    for n in range(-3, 4):
        assert found.at(23.0 + n, 0) == pytest.approx(abs(jv(n, depth)), abs=5e-4)


@pytest.mark.parametrize(("taper", "line", "between"), [("hann", 0.16, 1e-4), ("flat-top", 2e-3, 2e-3)])
def test_amplitude_of_a_tone_between_two_lines(taper, line: float, between: float):
    """The line of Hann's window is 1 − 8/(3π) low in the middle (Harris 1978), the flat-top's right."""
    found = signals.spectrum(3.0 * np.cos(2.0 * np.pi * 1000.5 * TIME), RATE, taper)
    assert found.at(1000.5, 0) == pytest.approx(3.0, rel=line)
    assert found.at(1000.5) == pytest.approx(3.0, rel=between)


def turning(speed: float) -> np.ndarray:
    """Revolutions of a shaft whose speed swings by 2 %."""
    return speed * TIME + 0.02 * speed / (2.0 * np.pi * 3.0) * np.sin(2.0 * np.pi * 3.0 * TIME)


@pytest.mark.parametrize("taper", ["hann", "flat-top"])
@pytest.mark.parametrize("level", [0.0, 0.03])
def test_amplitudes_at_fractional_orders(taper, level: float):
    """Cosines of random orders, amplitudes and phases, with and without noise: each within 1 %."""
    drawn, turns = np.random.default_rng(7), turning(24.7)
    for number in range(25):
        order, amplitude = drawn.uniform(5.0, 60.0), 10.0 ** drawn.uniform(-1.0, 2.0)
        wave = amplitude * np.cos(2.0 * np.pi * order * turns + drawn.uniform(0.0, 2.0 * np.pi))
        rough = level * amplitude * noise(number, len(TIME))
        found = signals.order_spectrum(wave + rough + 5.0 * amplitude, turns, 256, taper)
        assert found.at(order) == pytest.approx(amplitude, rel=1e-2), order


@pytest.mark.parametrize("apart", [5.0, 6.4, 9.7])
def test_amplitudes_of_two_close_tones(apart: float):
    """Five lines apart or more, at any place between the lines."""
    turns = turning(24.7)
    step = signals.order_spectrum(turns, turns, 256).step
    for place in np.linspace(0.0, 1.0, 7):
        orders = (600.0 + place + np.array([0.0, apart])) * step
        waves = 2.0 * np.cos(2.0 * np.pi * orders[0] * turns + 0.4), np.cos(2.0 * np.pi * orders[1] * turns)
        found = signals.order_spectrum(sum(waves), turns, 256)
        assert found.at(orders[0]) == pytest.approx(2.0, rel=1e-2)
        assert found.at(orders[1]) == pytest.approx(1.0, rel=1.5e-2)


def test_a_mean_is_no_oscillation():
    """Nor is the flank of a stronger line: it is given as it is."""
    found = signals.spectrum(100.0 + np.cos(2.0 * np.pi * 1.5 * TIME), RATE)
    assert found.at(1.5) < 1.1
    strong = signals.spectrum(np.cos(2.0 * np.pi * 1000.0 * TIME), RATE)
    assert strong.at(1002.0) == pytest.approx(0.5)  # Hann's window is half as high a line beside


def test_mean_and_tone_of_whole_periods():
    found = signals.spectrum(0.7 + 2.0 * np.cos(2.0 * np.pi * 440.0 * TIME), RATE, "none")
    assert found.amplitudes[0] == pytest.approx(0.7)
    assert found.at(440.0, 0) == pytest.approx(2.0)
    assert found.at(441.0, 0) < 1e-12


def test_an_average_over_turns_leaves_noise_as_one_over_the_root_of_their_number():
    """Of that below 0.4 of the samples per turn, 0.8 of its power."""
    left = []
    for turns in (16, 64, 256):
        time = np.arange(turns * 400) / 20e3
        clean = np.cos(2.0 * np.pi * 50.0 * time * 7.0)
        found = signals.synchronous_average(clean + noise(3, len(time)), 50.0 * time, 400)
        assert found.turns == turns
        left.append(signals.rms(found.values - np.cos(2.0 * np.pi * 7.0 * found.turn)))
    np.testing.assert_allclose(np.array(left) * np.sqrt([16, 64, 256]), np.sqrt(0.8), rtol=0.1)
    np.testing.assert_allclose(np.divide(left[:-1], left[1:]), 2.0, rtol=0.1)


def test_a_signal_without_a_whole_turn_has_no_average():
    with pytest.raises(InputError, match="no whole one"):
        signals.synchronous_average(TIME, 0.4 + 0.3 * TIME)


def test_residual_and_difference_leave_what_they_are_said_to():
    """Mesh harmonics go from both, first sidebands from the difference alone."""
    phase = 2.0 * np.pi * np.arange(1024) / 1024
    fault = 0.1 * np.cos(57.0 * phase)
    regular = 0.5 + np.cos(phase) + 4.0 * np.cos(23.0 * phase + 1.0) + np.cos(46.0 * phase)
    beside = 0.3 * np.cos(24.0 * phase) + 0.2 * np.cos(45.0 * phase)
    np.testing.assert_allclose(signals.residual(regular + beside + fault, [23]), beside + fault, atol=1e-12)
    np.testing.assert_allclose(signals.difference(regular + beside + fault, [23]), fault, atol=1e-12)


def test_moments_of_sine_and_noise():
    sine = np.sin(2.0 * np.pi * 5.0 * TIME)
    assert signals.kurtosis(sine) == pytest.approx(1.5)
    assert signals.crest_factor(sine) == pytest.approx(np.sqrt(2.0), rel=1e-6)
    assert signals.rms(3.0 * sine + 7.0) == pytest.approx(3.0 / np.sqrt(2.0))
    assert signals.kurtosis(noise(1)) == pytest.approx(3.0, abs=0.06)
    assert signals.fm4(noise(2)) == pytest.approx(3.0, abs=0.06)
    assert signals.m6a(noise(2)) == pytest.approx(15.0, rel=0.05)


def test_indicators_of_a_modulated_mesh():
    """Amplitudes 2 of the mesh and 0.5 of its second harmonic, 0.3 and 0.1 beside."""
    phase = 2.0 * np.pi * np.arange(1024) / 1024
    mesh = 2.0 * np.cos(20.0 * phase) + 0.5 * np.cos(40.0 * phase)
    average = mesh + 0.3 * np.cos(19.0 * phase) + 0.1 * np.cos(21.0 * phase)
    assert signals.fm0(mesh, [20]) == pytest.approx(np.ptp(mesh) / 2.5)
    assert signals.sideband_level_factor(average, 20) == pytest.approx(0.4 / signals.rms(average))
    assert signals.sideband_energy_ratio(average, 20) == pytest.approx(0.2)
    fault = 0.2 * np.cos(31.0 * phase)
    assert signals.energy_ratio(average + fault, [20]) == pytest.approx(
        signals.rms(fault) / signals.rms(average)
    )


def test_na4_compares_the_last_record_with_all():
    """As `fm4` where there is one; three times as loud, the last of eight has 81/4 of that."""
    quiet = noise(4, 8000).reshape(8, 1000)
    louder = quiet * np.where(np.arange(8) == 7, 3.0, 1.0)[:, None]
    assert signals.na4(quiet[-1:]) == pytest.approx(signals.fm4(quiet[-1]))
    assert signals.na4(louder) / signals.fm4(quiet[-1]) == pytest.approx(81.0 / 4.0, rel=0.15)


def test_the_envelope_of_an_amplitude_modulation():
    """(1 + 0.4 cos Ω t) cos ω t beside a strong tone outside its band: a line of 0.4 at Ω."""
    carried = (1.0 + 0.4 * np.cos(2.0 * np.pi * 23.0 * TIME)) * np.cos(2.0 * np.pi * 3000.0 * TIME)
    found = signals.envelope_spectrum(
        carried + 5.0 * np.cos(2.0 * np.pi * 700.0 * TIME), RATE, (2500.0, 3500.0), "none"
    )
    assert found.at(23.0, 0) == pytest.approx(0.4, rel=1e-9)
    assert found.at(46.0, 0) < 1e-9


def test_the_kurtogram_finds_the_band_of_impacts():
    impacts = (TIME % 0.05 < 0.002) * np.exp(-2000.0 * (TIME % 0.05)) * np.cos(2.0 * np.pi * 6000.0 * TIME)
    (low, high), most = signals.kurtogram(noise(5, len(TIME)) * 0.1 + 3.0 * impacts, RATE).best()
    assert low <= 6000.0 <= high
    assert most > 5.0
    quiet = signals.kurtogram(noise(6, len(TIME)), RATE)
    assert quiet.best()[1] < 1.0
    tone = signals.kurtogram(np.cos(2.0 * np.pi * 3000.0 * TIME), RATE)
    assert tone.values[0][0] == pytest.approx(-1.0, abs=0.05)


def test_a_band_beyond_half_the_rate_is_refused():
    with pytest.raises(InputError, match="below half the rate, 10000 Hz"):
        signals.envelope(TIME, RATE, (8000.0, 12000.0))


def test_a_spectrogram_follows_a_sweep():
    found = signals.spectrogram(np.cos(2.0 * np.pi * (500.0 * TIME + 1000.0 * TIME**2)), RATE, 1024)
    ridge = found.frequencies[np.argmax(found.amplitudes, axis=1)]
    np.testing.assert_allclose(ridge, 500.0 + 2000.0 * found.time, atol=RATE / 1024)


def test_frequencies_of_a_planetary_set():
    """Teeth 17/37/91, three planets, ring held, sun 800 rpm; Liang & others give 190.99, 33.70, 5.16 Hz."""
    carrier = 800.0 / 60.0 * 17.0 / (17.0 + 91.0)
    found = signals.set_frequencies(17, 37, 91, 3, 91.0 * carrier)
    assert carrier == pytest.approx(2.0988, abs=5e-5)
    assert found.mesh == pytest.approx(190.988, abs=5e-4)
    assert found.carrier_against_ring == pytest.approx(carrier)
    assert found.sun_fault == pytest.approx(33.704, abs=5e-4)
    assert found.planet_fault == pytest.approx(5.162, abs=5e-4)
    assert found.planet_pass == pytest.approx(3.0 * carrier)


def test_lines_of_a_pair_and_their_names():
    lines = signals.lines_of_pair("pinion", "gear", (18, 36))
    by_sort = {line.sort: line.order for line in lines}
    assert by_sort["hunting"] == pytest.approx(0.5)  # the same teeth meet every turn of the gear
    assert [line.teeth_of(lines[0]) for line in lines if line.sort == "shaft"] == [18, 36]
    known = list(signals.named_orders(lines, 60.0))
    assert signals.names_at(35.0, known, 0.01)[0].label == "2 × mesh − pinion"
    assert signals.names_at(18.5, known, 0.01)[0].label == "mesh + gear"
    assert signals.names_at(36.0, known, 0.01)[0].sort == "mesh"
