"""Amplitude spectra over whole mesh cycles.

Samples are uniform in the phase of the mesh, so a spectrum is one of orders: its line at order n has n
periods per mesh cycle whatever the speed does. At constant speed, frequency is order times mesh frequency.
Whole cycles are taken, so harmonics of the mesh fall exactly on lines and no window is needed.
"""

from typing import NamedTuple

import numpy as np


class Spectrum(NamedTuple):
    """One-sided amplitude spectrum."""

    orders: np.ndarray  # (lines,); mesh orders: 1 is the mesh frequency
    #: (lines,); amplitude of the cosine at each order, in the unit of the signal; at order 0 the mean, with
    #: sign
    amplitudes: np.ndarray

    def harmonics(self, count: int) -> np.ndarray:
        """Amplitudes at the mesh orders 1 … count, 0 beyond the last line."""
        amplitudes = np.zeros(count)
        whole = (self.orders >= 0.5) & (np.abs(self.orders - np.round(self.orders)) < 1e-9)
        harmonics = self.amplitudes[whole][:count]
        amplitudes[: harmonics.size] = harmonics
        return amplitudes


def amplitude_spectrum(signal: np.ndarray, samples_per_cycle: int) -> Spectrum:
    """Spectrum of the last whole cycles of a signal sampled uniformly in phase.

    Any stretch of whole cycles serves, so it does not matter whether the signal includes the sample that
    closes the last cycle and is the first of the next one.

    Parameters
    ----------
    signal : (samples,); samples at the phases k / samples_per_cycle; what exceeds whole cycles is left out at
        the beginning
    samples_per_cycle : samples in one mesh cycle

    Raises
    ------
    ValueError
        If the signal does not hold a whole cycle, or holds NaN.
    """
    signal = np.asarray(signal, dtype=float)
    cycles = signal.size // samples_per_cycle
    if cycles < 1:
        raise ValueError(f"{signal.size} samples hold no whole cycle of {samples_per_cycle}")
    if not np.isfinite(signal).all():
        raise ValueError("the signal is not finite")
    count = cycles * samples_per_cycle
    lines = np.fft.rfft(signal[-count:]) / count
    amplitudes = 2 * np.abs(lines)
    amplitudes[0] = lines[0].real
    if count % 2 == 0:
        amplitudes[-1] /= 2  # the line at half the sampling rate has no mirror image
    return Spectrum(np.arange(lines.size) / cycles, amplitudes)
