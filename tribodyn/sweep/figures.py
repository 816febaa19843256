"""The figures of one case, out of the window that it was marched through."""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.outputs import outputs
from tribodyn.dynamics.parameters import XI, XI_RATE
from tribodyn.prepare import Prepared
from tribodyn.record.sweep_schema import FIGURES
from tribodyn.summary import RunningExtremes, steady_figures


class Passage(NamedTuple):
    """A case's way through its window.

    Attributes
    ----------
    first_cycle : int
        Whole mesh cycles done before.
    window : (cycles · samples, STATES)
        States over whole mesh cycles, the sample that closes the last not included.
    start, end : (STATES,)
        States at both ends, each before its engagement; the difference of their works is the window's.
    samples : int
        Samples in a mesh cycle.
    """

    first_cycle: int
    window: np.ndarray
    start: np.ndarray
    end: np.ndarray
    samples: int


def window_figures(prepared: Prepared, passed: Passage) -> dict[str, float]:
    """Return the figures of `sweep_schema.FIGURES` over a window, SI units."""
    cycles = passed.first_cycle + np.arange(len(passed.window)) / passed.samples
    block = outputs(cycles, passed.window, prepared.model)
    extremes = RunningExtremes()
    extremes.add(block)
    error = passed.window[:, XI]
    found = steady_figures(block, passed.end - passed.start, prepared.cycle, passed.samples)
    # a run's summary means the newest pair's; over a sweep only the error of the whole mesh is continuous
    found |= extremes.values | {
        "transmission_error_rms": float(np.std(error)),
        "transmission_error_peak_to_peak": float(np.ptp(error)),
        "transmission_error_mean": float(np.mean(error)),
    }
    return {name: found.get(name, float("nan")) for name in FIGURES}


def section(led_in: np.ndarray, passed: Passage, points: int) -> tuple[np.ndarray, np.ndarray]:
    """The last points (points,) of the Poincaré section at phase 0: ξ, m, and ξ', m/s; NaN behind them.

    Parameters
    ----------
    led_in : (cycles, STATES)
        One state a mesh cycle, from before the window.
    passed : Passage
    points : int
    """
    every = np.concatenate([led_in, passed.window[:: passed.samples]])[-points:]
    found = np.full((2, points), np.nan)
    found[:, : len(every)] = every[:, [XI, XI_RATE]].T
    return found[0], found[1]
