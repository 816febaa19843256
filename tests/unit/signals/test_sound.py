"""Sound: what is written is read back, and a signal is heard at a level and a length."""

import numpy as np
import pytest

from tribodyn import signals
from tribodyn.errors import InputError


def test_a_wav_file_is_read_back_within_a_step_of_16_bits():
    samples = np.sin(np.arange(5000) * 0.1) * 0.8
    found, rate = signals.read_wav(signals.wav(samples, 48000))
    assert rate == 48000
    np.testing.assert_allclose(found, samples, atol=0.5 / 32767 + 1e-9)


@pytest.mark.parametrize("shift", [1.0, 4.0])
def test_a_faint_short_tone_is_heard_for_seconds_at_its_pitch(shift: float):
    rate = 20e3
    heard = signals.hearable(
        5.0 + 1e-6 * np.cos(2.0 * np.pi * 400.0 * np.arange(8000) / rate), rate, shift=shift
    )
    assert len(heard.samples) >= 3.0 * heard.rate
    assert np.max(np.abs(heard.samples)) == pytest.approx(0.9, rel=1e-3)
    assert heard.gain == pytest.approx(0.9e6, rel=1e-2)
    assert heard.repeats > 1
    assert heard.samples[0] == pytest.approx(0.0, abs=0.01)
    lines = signals.spectrum(heard.samples, heard.rate)
    assert lines.frequencies[np.argmax(lines.amplitudes)] == pytest.approx(400.0 * shift, abs=1.0)


@pytest.mark.parametrize("sound_rate", [22050, 44100, 48000])
@pytest.mark.parametrize("tone", [400.0, 7300.0])
def test_full_scale_is_the_peak_of_the_signal_whatever_the_rate(sound_rate: int, tone: float):
    rate = 20e3
    values = 3.0 * np.sin(2.0 * np.pi * tone * np.arange(6000) / rate)
    heard = signals.hearable(values, rate, sound_rate)
    # the peak is sought at 8 places between samples, of which the next is off by half a place at most
    missed = 1.0 - np.cos(np.pi * tone / (8.0 * rate))
    assert 1.0 / heard.gain == pytest.approx(3.0 / 0.9, rel=missed + 1e-3)
    assert heard.gain == signals.hearable(values, rate).gain
    assert np.max(np.abs(heard.samples)) < 1.0


def test_silence_stays_silence():
    heard = signals.hearable(np.zeros(100), 1000.0)
    assert not np.any(heard.samples)
    assert heard.said("m/s²").startswith("silence")


def test_what_is_no_wav_file_is_refused():
    with pytest.raises(InputError, match="cannot be read"):
        signals.read_wav(b"RIFF")
