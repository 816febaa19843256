"""Amplitude spectra over frequency and over orders of a shaft, spectrograms; envelopes of bands.

Amplitudes are of cosines. The kurtogram, which finds the band that is most impulsive, is that of J. Antoni,
Mechanical Systems and Signal Processing 21 (2007) 108; here every band is cut from the Fourier transform of
the whole signal, with no filter bank between.
"""

import itertools
from typing import Literal, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Complex, Float
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


#: Samples of the complex envelope of the narrowest band, at least: its kurtosis scatters by 2/√n.
FEWEST = 64
#: Share of the envelope at either end that is left out, where the signal is cut off; bands with less than
#: this share of the power have no kurtosis worth the name.
_ENDS, _FAINT = 1.0 / 16.0, 1e-6

Band = tuple[float, float]
"""Lower and upper frequency, Hz."""


def analytic(
    values: Float[Array, " sample"], rate: float, band: Band | None = None
) -> Complex[Array, " sample"]:
    """The analytic signal of a band, the whole by default: the signal, and i times its Hilbert transform.

    The band has no phase and ends sharply. Raises InputError for a band that is none below half the rate.
    """
    values = np.asarray(values, dtype=float)
    count = len(values)
    low, high = (0.0, rate / 2.0) if band is None else band
    if not 0.0 <= low < high <= rate / 2.0 * (1.0 + 1e-9):
        rule = f"is no band below half the rate, {rate / 2.0:g} Hz"
        raise InputError("band", f"{low:g} … {high:g} Hz", rule, "give a lower and an upper frequency")
    frequency = np.abs(np.fft.fftfreq(count, 1.0 / rate))
    lines = np.fft.fft(values)
    keep = (frequency >= low) & (frequency <= high)
    weight = np.zeros(count)
    weight[0] = 1.0
    weight[1 : (count + 1) // 2] = 2.0
    if count % 2 == 0:
        weight[count // 2] = 1.0
    return np.fft.ifft(lines * weight * keep)


def band_passed(values: Float[Array, " sample"], rate: float, band: Band) -> Float[Array, " sample"]:
    """What of a signal lies in a band, without a shift of phase."""
    return analytic(values, rate, band).real


def envelope(
    values: Float[Array, " sample"], rate: float, band: Band | None = None
) -> Float[Array, " sample"]:
    """Magnitude of the analytic signal of a band: a + m cos of (a + m cos Ω t) cos ω t, Ω < ω."""
    values = np.asarray(values, dtype=float)
    return np.abs(analytic(values - np.mean(values), rate, band))


def envelope_spectrum(
    values: Float[Array, " sample"], rate: float, band: Band | None = None, taper: Taper = "hann"
) -> AmplitudeSpectrum:
    """Amplitudes of the envelope: lines where faults repeat (ISO 13373-3)."""
    return spectrum(envelope(values, rate, band), rate, taper)


class Kurtogram(NamedTuple):
    """Kurtosis of the complex envelope over bands: ⟨|x|⁴⟩/⟨|x|²⟩² − 2, 0 of Gaussian noise, −1 of a tone.

    −1 too where a band holds next to nothing.
    """

    widths: tuple[float, ...]  # of the bands of every level, Hz, falling
    values: tuple[Float[Array, " band"], ...]  # of every level, from 0 Hz on

    def best(self) -> tuple[Band, float]:
        """The band of the largest kurtosis, and that."""
        level = int(np.argmax([np.max(row) for row in self.values]))
        place, width = int(np.argmax(self.values[level])), self.widths[level]
        return (place * width, (place + 1) * width), float(self.values[level][place])


def kurtogram(values: Float[Array, " sample"], rate: float, levels: int = 6) -> Kurtogram:
    """Cut the frequencies below half the rate into 1, 2, 3, 4, 6, 8, 12, … bands; kurtosis of each.

    Up to 2^`levels` bands, and no more than leave `FEWEST` samples of an envelope.
    """
    values = np.asarray(values, dtype=float)
    values = values - np.linspace(values[0], values[-1], len(values))  # no jump from the end to the start
    lines = np.fft.rfft(values - np.mean(values))[1:]
    least = _FAINT * float(np.sum(np.abs(lines) ** 2))
    parts = sorted({2**level for level in range(levels + 1)} | {3 * 2**level for level in range(levels - 1)})
    parts = [count for count in parts if len(lines) // count >= FEWEST] or [1]
    widths, kurtosis = [], []
    for count in parts:
        edges = np.round(np.linspace(0, len(lines), count + 1)).astype(int)
        kurtosis.append(np.array([_of_band(lines[a:b], least) for a, b in itertools.pairwise(edges)]))
        widths.append(rate / 2.0 / count)
    return Kurtogram(tuple(widths), tuple(kurtosis))


def _of_band(lines: Complex[Array, " line"], least: float) -> float:
    power = np.abs(np.fft.ifft(lines)) ** 2
    ends = int(len(power) * _ENDS)
    power = power[ends : len(power) - ends]
    mean = float(np.mean(power))
    faint = mean == 0.0 or float(np.sum(np.abs(lines) ** 2)) < least
    return -1.0 if faint else float(np.mean(power**2)) / mean**2 - 2.0
