"""Amplitude spectra of the cases of a branch, from their steady windows."""

import numpy as np

from tribodyn.errors import InputError
from tribodyn.post.figures.sweep.branch import Branch
from tribodyn.post.spectra import Spectrum, amplitude_spectrum


def spectra(branch: Branch) -> list[Spectrum | None]:
    """Spectrum, m over mesh orders, of every case; None where there is no window.

    Raises
    ------
    InputError
        If no case has one.
    """
    per_cycle = branch.record.samples_per_cycle
    results = [_spectrum(window, per_cycle) for window in branch.values("transmission_error_rotational")]
    if not any(results):
        raise InputError("record", str(branch.record.path), "no case is done", "wait, or sweep again")
    return results


def _spectrum(window: np.ndarray, per_cycle: int) -> Spectrum | None:
    window = window[np.isfinite(window)]
    return amplitude_spectrum(window, per_cycle) if window.size >= per_cycle else None


def order_amplitudes(branch: Branch, orders: int) -> np.ndarray:
    """Amplitudes (cases, orders) of the mesh orders 1 … orders, m; NaN where a case is not done."""
    rows = [np.full(orders, np.nan) if one is None else one.harmonics(orders) for one in spectra(branch)]
    return np.array(rows)
