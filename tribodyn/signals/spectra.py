"""Amplitude spectra over frequency and over orders of a shaft, spectrograms; amplitudes are of cosines."""

from typing import Literal, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.signals.resampling import by_angle

Taper = Literal["none", "hann", "flat-top"]
#: Cosines of the windows, whose mean is the first. That of whole periods needs none; Hann's parts lines that
#: are two apart; the flat-top (ISO 18431-2) has the amplitude of a line between two within 0.2 %.
_COSINES: dict[str, tuple[float, ...]] = {
    "none": (1.0,),
    "hann": (0.5, -0.5),
    "flat-top": (0.21557895, -0.41663158, 0.277263158, -0.083578947, 0.006947368),
}


class AmplitudeSpectrum(NamedTuple):
    """One-sided amplitude spectrum: of a cosine its amplitude, at 0 the mean with its sign."""

    frequencies: Float[Array, " line"]  # Hz; of an order spectrum orders, cycles per turn
    amplitudes: Float[Array, " line"]  # in the unit of the signal
    taper: Taper = "flat-top"  # the window that they were made with

    @property
    def step(self) -> float:
        """Distance of two lines."""
        return float(self.frequencies[1] - self.frequencies[0])

    def at(self, frequency: float, lines: int = 1) -> float:
        """Amplitude of the strongest line within so many lines of a frequency; 0 beyond the last one.

        Of a peak the amplitude of the cosine that made it, wherever that lies between two lines: the ratio
        of the larger neighbour to the peak says where, and the shape of the window by how much the peak is
        lower (Rife & Vincent 1970; Grandke 1983, for Hann's window). Within 0.1 % of a cosine alone, within
        1 % beside another as strong that is five lines off or more. With `lines` = 0, and on the flank of a
        stronger line beyond them, the line as it is.
        """
        middle = round(frequency / self.step)
        first = max(int(middle > 0), middle - lines)  # the mean is no neighbour of an oscillation
        near = self.amplitudes[first : middle + lines + 1]
        if not len(near):
            return 0.0
        peak = first + int(np.argmax(near))
        highest = float(self.amplitudes[peak])
        neighbours = [self.amplitudes[at] for at in (peak - 1, peak + 1) if 0 < at < len(self.amplitudes)]
        if not lines or not peak or not neighbours or not 0.0 < highest >= max(neighbours):
            return highest
        return highest / _height(self.taper, float(max(neighbours)) / highest)


def _height(taper: Taper, ratio: float) -> float:
    """Height of the highest line of a cosine of amplitude 1, from the ratio of its larger neighbour to it."""
    if taper == "hann":
        off = max(0.0, (2.0 * ratio - 1.0) / (ratio + 1.0))
        return float(np.sinc(off)) / (1.0 - off**2)
    return float(np.sinc(ratio / (1.0 + ratio))) if taper == "none" else 1.0


def taper_of(count: int, taper: Taper) -> Float[Array, " sample"]:
    """A window over so many samples, periodic, of mean 1."""
    turn = 2.0 * np.pi * np.arange(count) / count
    cosines = _COSINES[taper]
    return sum((a * np.cos(n * turn) for n, a in enumerate(cosines)), np.zeros(count)) / cosines[0]


def spectrum(values: Float[Array, " sample"], rate: float, taper: Taper = "hann") -> AmplitudeSpectrum:
    """Amplitude spectrum of a signal at even times.

    Parameters
    ----------
    values, rate : signal, and its samples per second; or per turn
    taper : "hann", "flat-top" for amplitudes of lines between two, "none" of whole periods
    """
    values = np.asarray(values, dtype=float)
    count, mean = len(values), float(np.mean(values))
    lines = np.fft.rfft((values - mean) * taper_of(count, taper)) / count
    amplitudes = 2.0 * np.abs(lines)
    if count % 2 == 0:
        amplitudes[-1] /= 2.0  # the line at half the rate has no mirror image
    amplitudes[0] = mean
    return AmplitudeSpectrum(np.arange(len(lines)) * rate / count, amplitudes, taper)


def order_spectrum(
    values: Float[Array, " sample"],
    turns: Float[Array, " sample"],
    per_turn: int | None = None,
    taper: Taper = "hann",
) -> AmplitudeSpectrum:
    """Amplitudes over the orders of a shaft: cycles per turn, whatever its speed does.

    Parameters
    ----------
    values : at even times
    turns : revolutions of the shaft at these
    per_turn : samples per revolution; default: as many as the signal has where it turns slowest
    taper : as of `spectrum`; over whole turns, so that with "none" the orders of the shaft are lines
    """
    if per_turn is None:
        per_turn = samples_per_turn(turns)
    _, even = by_angle(values, turns, per_turn)
    whole = len(even) // per_turn * per_turn
    return spectrum(even[: whole or len(even)], per_turn, taper)


def samples_per_turn(turns: Float[Array, " sample"]) -> int:
    """Samples per revolution where a shaft turns slowest, rounded up; at most 16 times the mean."""
    each = np.diff(turns)
    return int(np.ceil(1.0 / max(float(np.min(each)), float(np.mean(each)) / 16.0, 1e-9)))


class Spectrogram(NamedTuple):
    """Amplitude spectra along a signal."""

    time: Float[Array, " part"]  # at the middle of each, s from the first sample
    frequencies: Float[Array, " line"]  # Hz
    amplitudes: Float[Array, "part line"]


def spectrogram(
    values: Float[Array, " sample"], rate: float, length: int, hop: int | None = None, taper: Taper = "hann"
) -> Spectrogram:
    """Spectra of parts of so many samples, a `hop` apart (default: a quarter of them)."""
    hop = max(1, length // 4 if hop is None else hop)
    parts = np.lib.stride_tricks.sliding_window_view(np.asarray(values, dtype=float), length)[::hop]
    parts = parts - np.mean(parts, axis=1, keepdims=True)
    lines = np.fft.rfft(parts * taper_of(length, taper), axis=1)
    time = (np.arange(len(parts)) * hop + 0.5 * (length - 1)) / rate
    return Spectrogram(time, np.arange(lines.shape[1]) * rate / length, 2.0 * np.abs(lines) / length)
