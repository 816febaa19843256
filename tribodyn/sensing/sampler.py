"""Samples at a sensor's rate of a motion that arrives in blocks; kept is what the filter still needs."""

from collections.abc import Sequence

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.signals.resampling import REACH, at_places


class Sampler:
    """Takes blocks of a motion at smoothly uneven times and gives it at k/`rate`, see `signals.resampled`.

    Of channels with `slopes` it gives the slope over time.
    """

    def __init__(self, rate: float, slopes: Sequence[bool] = (), filtered: bool = True) -> None:
        self.rate, self._filtered = rate, filtered
        self._slopes = np.flatnonzero(np.asarray(slopes, dtype=bool))
        self._time, self._angle, self._values = np.empty(0), np.empty(0), np.empty((0, 0))
        self._next: int | None = None
        self._found: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []

    def add(
        self,
        time: Float[Array, " sample"],
        angle: Float[Array, " sample"],
        values: Float[Array, "sample channel"],
    ) -> None:
        """Take in a block: times (s), rotation of the reference (rad), channels."""
        if self._next is None:
            self._next = int(np.ceil(time[0] * self.rate - 1e-9))
            self._values = np.empty((0, values.shape[1]))
        self._time = np.concatenate([self._time, time])
        self._angle = np.concatenate([self._angle, angle])
        self._values = np.concatenate([self._values, values])
        if len(self._time) > 2:
            self._take()

    def _take(self) -> None:
        time, first = self._time, self._next or 0
        number = np.arange(first, int(np.floor(time[-1] * self.rate + 1e-9)) + 1)
        if not len(number):
            return
        at = number / self.rate
        places = np.interp(at, time, np.arange(len(time)))
        if self._filtered:
            cutoff = np.minimum(0.5 * self.rate * np.interp(at, time, np.gradient(time)), 0.5)
            half = REACH / cutoff
            inside = (places - half >= 0.0) & (places + half <= len(time) - 1)
        else:
            cutoff, half, inside = np.empty(0), np.zeros(len(at)), np.ones(len(at), dtype=bool)
        ready = np.flatnonzero(inside)
        if not len(ready):
            return
        part = slice(int(ready[0]), int(ready[-1]) + 1)
        if self._filtered:
            values = at_places(self._values, places[part], cutoff[part])
            steep = at_places(self._values[:, self._slopes], places[part], cutoff[part], slope=True)
            interval = np.interp(at[part], time, np.gradient(time))
            values[:, self._slopes] = steep / interval[:, None]
        else:
            raw = self._values.copy()
            raw[:, self._slopes] = np.gradient(raw[:, self._slopes], time, axis=0)
            values = np.stack([np.interp(at[part], time, column) for column in raw.T], axis=1)
        self._found.append((at[part], np.interp(at[part], time, self._angle), values))
        self._next = int(number[part][-1]) + 1
        last = part.stop - 1
        kept = max(0, int(places[last] - 1.5 * half[last]) - 4)
        self._time, self._angle, self._values = time[kept:], self._angle[kept:], self._values[kept:]

    def sampled(
        self,
    ) -> tuple[Float[Array, " sample"], Float[Array, " sample"], Float[Array, "sample channel"]]:
        """Times, rotations of the reference and channels so far."""
        if not self._found:
            return np.empty(0), np.empty(0), np.empty((0, self._values.shape[1]))
        times, angles, values = zip(*self._found, strict=True)
        return np.concatenate(times), np.concatenate(angles), np.concatenate(values)
