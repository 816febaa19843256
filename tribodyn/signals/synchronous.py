"""Time-synchronous average of a shaft, and what is left of it without what regular teeth make.

P. D. McFadden, Mechanical Systems and Signal Processing 1 (1987) 83: the average over turns keeps what
repeats with the shaft; the rest falls like one over the root of their number.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.signals.resampling import PASSED, by_angle
from tribodyn.signals.spectra import samples_per_turn

#: Orders of the shaft itself that belong to the regular part: unbalance, and a coupling out of line.
SHAFT_ORDERS = 2


class SynchronousAverage(NamedTuple):
    """A turn of a shaft, averaged."""

    turn: Float[Array, " sample"]  # place in the turn, 0 ≤ … < 1
    values: Float[Array, " sample"]  # mean over the turns
    turns: int  # over how many
    each: Float[Array, "turn sample"]  # the turns that it is the mean of


def synchronous_average(
    values: Float[Array, " sample"],
    turns: Float[Array, " sample"],
    per_turn: int | None = None,
    passed: float = PASSED,
) -> SynchronousAverage:
    """Average a signal at even times over the whole turns of a shaft.

    Parameters
    ----------
    turns : revolutions of the shaft at the samples
    per_turn : samples of the average; default: as many as the signal has where the shaft turns slowest
    passed : orders above this share of `per_turn` are left out: there a sampled signal may hold aliases

    Raises InputError below one whole turn.
    """
    turns = np.asarray(turns, dtype=float)
    per_turn = samples_per_turn(turns) if per_turn is None else per_turn
    first = float(np.ceil(turns[0] - 1e-9))
    whole = int(np.floor(turns[-1] + 1.0 / per_turn - first + 1e-9))
    if whole < 1:
        rule = f"the signal has {turns[-1] - turns[0]:.3g} turns of the shaft, and no whole one"
        raise InputError("turns", None, rule, "run longer: solver.cycles, or solver.revolutions")
    _, even = by_angle(values, turns, per_turn, first, whole * per_turn)
    lines = np.fft.rfft(even.reshape(whole, per_turn), axis=1)
    lines[:, int(passed * per_turn) + 1 :] = 0.0
    each = np.fft.irfft(lines, per_turn, axis=1)
    return SynchronousAverage(np.arange(per_turn) / per_turn, np.mean(each, axis=0), whole, each)


def _regular_lines(count: int, teeth: Sequence[int], sidebands: int, shaft: int) -> np.ndarray:
    lines = np.zeros(count // 2 + 1, dtype=bool)
    lines[: shaft + 1] = True
    for number in teeth:
        for mesh in range(number, len(lines) + sidebands, number):
            lines[max(0, mesh - sidebands) : mesh + sidebands + 1] = True
    return lines


def _without(
    average: Float[Array, "... sample"], teeth: Sequence[int], sidebands: int, shaft: int
) -> Float[Array, "... sample"]:
    values = np.asarray(average, dtype=float)
    lines = np.fft.rfft(values, axis=-1)
    lines[..., _regular_lines(values.shape[-1], teeth, sidebands, shaft)] = 0.0
    return np.fft.irfft(lines, values.shape[-1], axis=-1)


def residual(
    average: Float[Array, "... sample"], teeth: Sequence[int], shaft_orders: int = SHAFT_ORDERS
) -> Float[Array, "... sample"]:
    """Average without its mean, the shaft's first orders and all harmonics of the mesh.

    `teeth` are the numbers of teeth of the gears on the shaft: orders of their meshes. First sidebands stay
    (Zakrajsek, Townsend & Decker, NASA TM 105950, 1993).
    """
    return _without(average, teeth, 0, shaft_orders)


def difference(
    average: Float[Array, "... sample"],
    teeth: Sequence[int],
    sidebands: int = 1,
    shaft_orders: int = SHAFT_ORDERS,
) -> Float[Array, "... sample"]:
    """The residual without so many sidebands of every harmonic of the mesh on either side (Stewart 1977)."""
    return _without(average, teeth, sidebands, shaft_orders)


def mesh_harmonics(
    average: Float[Array, " sample"], teeth: int, sidebands: int = 0
) -> Iterator[tuple[float, list[float]]]:
    """Amplitudes of every harmonic of a mesh, and of its sidebands −n … −1, 1 … n, up to half the samples."""
    amplitudes = 2.0 * np.abs(np.fft.rfft(average)) / len(average)
    for mesh in range(teeth, len(amplitudes) - sidebands, teeth):
        sideband = [float(amplitudes[mesh + n]) for n in range(-sidebands, sidebands + 1) if n]
        yield float(amplitudes[mesh]), sideband
