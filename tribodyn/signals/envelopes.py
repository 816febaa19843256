"""Envelope of a band of a signal, its spectrum, and the band that is most impulsive.

J. Antoni, Fast computation of the kurtogram for the detection of transient faults, Mechanical Systems and
Signal Processing 21 (2007) 108; here every band is cut from the Fourier transform of the whole signal, with
no filter bank between.
"""

import itertools
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Complex, Float
from tribodyn.signals.spectra import AmplitudeSpectrum, Taper, spectrum

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
