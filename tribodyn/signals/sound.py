"""Signals as sound: WAV files, and what is done to a signal so that it can be heard."""

import io
import struct
import wave
from math import ceil
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.files.output_files import MARKS
from tribodyn.numerics.shapes import Array, Float
from tribodyn.signals.resampling import REACH, at_places

#: Rates of sound, samples per second: of compact discs, and of video.
SOUND_RATES = (44100, 48000)
#: Highest magnitude, of full scale, so that nothing clips; fades at both ends and between repetitions, s.
LEVEL, FADE = 0.9, 0.02
#: Longest sound, s, and samples of a signal for one of a sound, at most.
LONGEST, FASTEST = 600.0, 1000.0
#: Places per sample at which a signal's peak is looked for: between them it is at most 2 % higher.
BETWEEN = 8
_BYTES = 2


class Hearable(NamedTuple):
    """A signal made hearable, and what was done to it."""

    samples: Float[Array, " sample"]  # −1 … 1
    rate: int  # samples per second
    gain: float  # full scale per unit of the signal
    shift: float  # factor on all frequencies: played so much faster
    repeats: int  # how often the signal is played, 1: once

    def said(self, units: str) -> str:
        """What was done, in words."""
        parts = [f"full scale is {1.0 / self.gain:.4g} {units}" if self.gain else "silence"]
        if self.shift != 1.0:
            parts.append(f"played {self.shift:g} times as fast: all frequencies × {self.shift:g}")
        if self.repeats > 1:
            parts.append(f"{self.repeats} times in a row, with fades of {FADE * 1e3:g} ms between")
        return "; ".join(parts)


def hearable(
    values: Float[Array, " sample"],
    rate: float,
    sound_rate: int = SOUND_RATES[0],
    seconds: float = 3.0,
    shift: float = 1.0,
) -> Hearable:
    """Bring a signal to a hearable level, to the rate of a sound card, and to a length of some seconds.

    Its mean is taken out and its peak, between samples too, put at `LEVEL` of full scale, whatever the rate
    and the shift are. A signal shorter than `seconds` is repeated, the repetitions faded into each other.
    `shift` multiplies all frequencies. Raises InputError where the sound would be longer than `LONGEST`, or
    hardly any sample of it be left.
    """
    values = np.asarray(values, dtype=float)
    played = rate * shift
    if not (shift > 0.0 and len(values) / LONGEST <= played <= FASTEST * sound_rate):
        low, high = len(values) / LONGEST / rate, FASTEST * sound_rate / rate
        rule = f"{len(values)} samples at {rate:g} Hz can be shifted by {low:.2g} to {high:.2g}"
        raise InputError("shift", shift, rule, "1 leaves the frequencies as they are")
    count = int(np.floor((len(values) - 1) * sound_rate / played)) + 1
    around = values - np.mean(values)
    audible = at_places(around, np.arange(count) * played / sound_rate, 0.5 * sound_rate / played)
    fade = min(int(FADE * sound_rate), count // 4)
    apart = count - fade
    repeats = max(1, int(np.ceil((seconds * sound_rate - fade) / max(apart, 1))))
    rise = np.ones(count)
    if fade:
        rise[:fade] = (np.arange(fade) + 0.5) / fade
        rise[-fade:] = rise[:fade][::-1]
    samples = np.zeros(apart * repeats + fade)
    for number in range(repeats):
        samples[number * apart : number * apart + count] += rise * audible
    between = at_places(around, np.arange(len(around) * BETWEEN) / BETWEEN, 0.5)
    ends = BETWEEN * ceil(REACH)  # where the low-pass overshoots, and which are faded
    between = between[ends:-ends] if len(between) > 4 * ends else between
    top = float(np.max(np.abs(between), initial=0.0))
    gain = LEVEL / top if top > 0.0 else 0.0
    return Hearable(samples * gain, sound_rate, gain, shift, repeats)


def wav(samples: Float[Array, " sample"], rate: int) -> bytes:
    """A WAV file of one channel, 16 bits, of samples −1 … 1; it says who made it."""
    steps = np.round(np.clip(samples, -1.0, 1.0) * (2 ** (8 * _BYTES - 1) - 1))
    form = struct.pack("<HHIIHH", 1, 1, rate, rate * _BYTES, _BYTES, 8 * _BYTES)
    parts = _part(b"fmt ", form) + _part(b"LIST", b"INFO" + MARKS[".wav"])
    return _part(b"RIFF", b"WAVE" + parts + _part(b"data", steps.astype("<i2").tobytes()))


def _part(name: bytes, content: bytes) -> bytes:
    return name + struct.pack("<I", len(content)) + content


def read_wav(content: bytes) -> tuple[Float[Array, " sample"], int]:
    """Samples −1 … 1 and their rate of a WAV file of one channel and 16 bits; InputError for others."""
    try:
        with wave.open(io.BytesIO(content), "rb") as file:
            if file.getnchannels() != 1 or file.getsampwidth() != _BYTES:
                raise wave.Error("not of one channel and 16 bits")
            steps = np.frombuffer(file.readframes(file.getnframes()), "<i2")
            return steps / (2.0 ** (8 * _BYTES - 1) - 1.0), file.getframerate()
    except (wave.Error, EOFError) as error:
        raise InputError("wav", None, f"cannot be read: {error}", "name a WAV file of one channel") from None
