"""Sound that a structure radiates by how its coordinates move: its power, and a pressure that stands for it.

Of a line with rates q' (complex amplitudes) the power is P = ½ q'* R q', R the real part of the radiation
impedance: of a table over frequency, or ρ c σ ∫ n φ_i n φ_j dS, the estimate by area and velocity with a
radiation efficiency σ (F. J. Fahy, P. Gardonio, Sound and Structural Vibration, 2nd ed. 2007, ch. 3).
"""

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.superelement import Radiation

#: ρ c of air at 20 °C and 1013 hPa, N s/m³; power of 0 dB, W (ISO 3744).
AIR, NO_LEVEL = 413.3, 1e-12


def radiated_pressure(
    rates: Float[Array, "sample coordinate"], rate: float, radiation: Radiation, efficiency: float
) -> Float[Array, " sample"]:
    """Sound pressure (Pa) at 1 m from a point source in a free field whose lines have the power radiated.

    `rates` of the coordinates are at even times, `rate` in a second; `efficiency` is that of the estimate.
    The phase of a line is that of the coordinate that radiates most.
    """
    lines = np.fft.rfft(rates, axis=0)
    lines[0] = 0.0  # nothing is moved away for ever
    frequency = np.fft.rfftfreq(len(rates), 1.0 / rate)
    form = _form(lines, frequency, radiation, efficiency)
    own = radiation.resistance[-1] if len(radiation.resistance) else radiation.area
    loudest = int(np.argmax(np.diag(own) * np.sum(np.abs(lines) ** 2, axis=0)))
    pressure = np.sqrt(form * AIR / (4.0 * np.pi)) * np.exp(1j * np.angle(lines[:, loudest]))
    return np.fft.irfft(pressure, len(rates))


def power_of(pressure: Float[Array, " sample"]) -> float:
    """Power of the point source, W: 4 π r² p²/(ρ c), r = 1 m."""
    return float(4.0 * np.pi * np.mean((pressure - np.mean(pressure)) ** 2) / AIR)


def level_of(power: float) -> float:
    """Sound power level, dB re 1 pW; −∞ of silence."""
    return float(10.0 * np.log10(power / NO_LEVEL)) if power > 0.0 else float("-inf")


def _form(
    lines: Float[Array, "line coordinate"],
    frequency: Float[Array, " line"],
    radiation: Radiation,
    efficiency: float,
) -> Float[Array, " line"]:
    """q'* R q' of every line: R linear over frequency from 0 at 0 Hz, and behind its last as there."""
    if not len(radiation.frequency):
        return efficiency * AIR * _quadratic(lines, radiation.area)
    known = np.concatenate([[0.0], radiation.frequency])
    at = np.clip(np.searchsorted(known, frequency, side="right") - 1, 0, len(known) - 1)
    form = np.zeros(len(frequency))
    for first in np.unique(at):
        there = at == first
        below, above = first - 1, min(first, len(known) - 2)  # numbers of matrices; −1: that of 0 Hz
        span = known[above + 1] - known[first]
        share = (frequency[there] - known[first]) / span if span else np.ones(np.sum(there))
        form[there] += share * _quadratic(lines[there], radiation.resistance[above])
        if below >= 0:
            form[there] += (1.0 - share) * _quadratic(lines[there], radiation.resistance[below])
    return form


def _quadratic(lines: Array, matrix: Float[Array, "coordinate coordinate"]) -> Float[Array, " line"]:
    parts = (np.einsum("li,ij,lj->l", part, matrix, part, optimize=True) for part in (lines.real, lines.imag))
    return np.maximum(sum(parts), 0.0)
