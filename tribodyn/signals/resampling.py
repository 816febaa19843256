"""Signals at other places: even in time, even in a shaft's angle, at a sensor's rate; Kaiser's filter.

A sample at any place is a weighted sum of those around it, by a sinc under Kaiser's window (Kaiser & Schafer,
IEEE Trans. ASSP 28 (1980) 105): up to `PASSED` of the new rate a tone keeps its amplitude within 1e-4, from
`STOPPED` on it is less than 1e-4 of it. What lies between may fold into the band above `PASSED`, so that up
to there the signal is free of aliases, as data loggers state it.
"""

from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float

#: Edges of the filter over the new rate: passed up to the one, stopped from the other.
PASSED, STOPPED = 0.4, 0.6
#: Attenuation of the filter, dB: ripple and rest are 10^(−A/20) = 3e-5.
ATTENUATION = 90.0
#: Kaiser's β for it, and half the length of the filter over a period of the cut-off frequency.
_BETA = 0.1102 * (ATTENUATION - 8.7)
REACH = (ATTENUATION - 7.95) / (2.0 * 2.285 * 2.0 * np.pi * 2.0 * (STOPPED - PASSED))
#: Weights are tabulated for so many places between two samples; values are linear between those.
_BETWEEN = 256
#: Samples even in angle, at most, for each one even in time, or in all; and the reverse.
MOST, FEW = 64, 2_000_000
#: Places that share a table where the rate of the samples drifts against the new one.
_TOGETHER = 1024


def _weights(cutoff: float, slope: bool) -> tuple[np.ndarray, float]:
    """Weights (between, tap) of the samples from half a length before a place on, and that half, samples.

    Of the value there, or of its slope per sample.
    """
    half = REACH / cutoff
    taps = 2 * int(np.ceil(half)) + 1
    away = np.arange(_BETWEEN + 1)[:, None] / _BETWEEN + np.arange(taps) - half  # from the place, samples
    root = np.sqrt(np.maximum(1.0 - (away * cutoff / REACH) ** 2, 0.0))
    inside = np.abs(away) <= half
    window, wave = np.where(inside, np.i0(_BETA * root), 0.0), np.sinc(2.0 * cutoff * away)
    kernel = wave * window
    whole = np.sum(kernel, axis=1, keepdims=True)
    if not slope:
        return kernel / whole, half
    turn_rate = 2.0 * np.pi * cutoff
    turn = turn_rate * away
    near = np.abs(turn) < 1e-4
    kernel = window * np.where(
        near, turn * turn_rate / 3.0, (wave - np.cos(turn)) / np.where(near, 1.0, away)
    )
    # none of a constant
    kernel -= window * np.sum(kernel, axis=1, keepdims=True) / np.sum(window, axis=1, keepdims=True)
    return kernel / whole, half


def at_places(
    values: Float[Array, "sample ..."], places: Float[Array, " place"], cutoff: Any, slope: bool = False
) -> Float[Array, "place ..."]:
    """Values at places among even samples, low-passed.

    Parameters
    ----------
    values : along their first axis; beyond its ends they go on as they end
    places : in samples, 0 the first one; fractions lie between
    cutoff : half the new rate over the rate of the samples, at most 0.5; a number, or one per place
    slope : whether slopes per sample are returned in place of the values
    """
    values, places = np.asarray(values, dtype=float), np.asarray(places, dtype=float)
    flat = values.reshape(len(values), -1)
    cutoff = np.minimum(cutoff, 0.5)
    resampled = np.empty((len(places), flat.shape[1]))
    tabulated, table, half = 0.0, np.empty((0, 0)), 0.0
    for start in range(0, len(places), _TOGETHER):
        part = slice(start, start + _TOGETHER)
        now = float(np.mean(cutoff[part] if np.ndim(cutoff) else cutoff))
        if abs(now - tabulated) > 1e-6 * now:
            tabulated, (table, half) = now, _weights(now, slope)
        first = np.ceil(places[part] - half)
        row = (first - (places[part] - half)) * _BETWEEN
        low = np.minimum(row.astype(int), _BETWEEN - 1)
        share = (row - low)[:, None]
        index = first.astype(int)[:, None] + np.arange(table.shape[1])
        samples = flat[np.clip(index, 0, len(flat) - 1)]
        weights = table[low] * (1.0 - share) + table[low + 1] * share
        resampled[part] = np.einsum("pt,ptc->pc", weights, samples, optimize=True)
    return resampled.reshape(len(places), *values.shape[1:])


def resampled(
    time: Float[Array, " sample"], values: Float[Array, "sample ..."], rate: float
) -> tuple[Float[Array, " place"], Float[Array, "place ..."]]:
    """Times k/`rate` (s), and the signal there, low-passed; `time` may be uneven, but smoothly so.

    Only times around which the filter lies inside the signal are returned. Where the samples are sparser than
    the new ones, the signal has no more than they hold.
    """
    time = np.asarray(time, dtype=float)
    interval = np.gradient(time)
    reach = REACH * 2.0 * max(1.0 / rate, float(np.max(interval)))
    first, last = np.ceil((time[0] + reach) * rate - 1e-9), np.floor((time[-1] - reach) * rate + 1e-9)
    at = np.arange(first, last + 1) / rate
    places = np.interp(at, time, np.arange(len(time)))
    return at, at_places(values, places, 0.5 * rate * np.interp(at, time, interval))


def by_angle(
    values: Float[Array, "sample ..."],
    turns: Float[Array, " sample"],
    per_turn: int,
    first: float | None = None,
    count: int | None = None,
) -> tuple[Float[Array, " place"], Float[Array, "place ..."]]:
    """A signal at even angles of a shaft: turns k/`per_turn`, and values there, low-passed (order tracking).

    Parameters
    ----------
    values : at even times
    turns : revolutions of the shaft at these, increasing
    per_turn : samples per revolution; orders up to 0.4 times that many are kept
    first, count : revolution to begin at, and samples; default: all that the signal covers

    Raises InputError where these would be many more samples than the signal has.
    """
    turns = np.asarray(turns, dtype=float)
    begin = np.ceil(turns[0] * per_turn - 1e-9) if first is None else first * per_turn
    most = np.floor(turns[-1] * per_turn + 1e-9) - begin + 1 if count is None else count
    if not most <= max(FEW, MOST * len(turns)):
        rule = f"turns of which {most:.3g} samples would be made of {len(turns)}"
        raise InputError("reference_angle", None, rule, "sample it at a higher rate")
    at = (begin + np.arange(int(most))) / per_turn
    places = np.interp(at, turns, np.arange(len(turns)))
    # where it hardly turns, no filter is longer than those of so many samples
    per_sample = np.maximum(np.interp(at, turns, np.gradient(turns)), 1.0 / (MOST * per_turn))
    pad = int(np.ceil(2.0 * REACH / max(min(1.0, per_turn * float(np.min(per_sample))), 1e-6)))
    pad = min(pad, len(turns) - 1)
    widths = [(pad, pad), *((0, 0) for _ in np.shape(values)[1:])]
    padded = np.pad(np.asarray(values, dtype=float), widths, mode="reflect", reflect_type="odd")
    return at, at_places(padded, places + pad, 0.5 * per_turn * per_sample)
