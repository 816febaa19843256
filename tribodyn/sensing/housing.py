"""What a point of a housing does under the forces on its bearings."""

from collections.abc import Sequence

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.sensing.data import HousingData


def housing_acceleration(
    housing: HousingData,
    point: str,
    forces: Sequence[tuple[str, int]],
    values: Float[Array, "sample force"],
    rate: float,
) -> Float[Array, " sample"]:
    """Acceleration of a point, m/s², of a housing that the first sample's forces hold in equilibrium.

    By Fourier transform: exact for forces that have nothing above half the rate. Behind their end the forces
    fade out while the modes forget, so that nothing comes around.

    Parameters
    ----------
    forces : of `HousingData.inputs`
    values, rate : their samples, N, at even times, and how many there are in a second
    """
    values = np.asarray(values, dtype=float)
    count = len(values)
    moved = values - values[:1]
    behind = max(count, int(np.ceil(housing.memory() * rate)))
    size = 2 ** int(np.ceil(np.log2(count + behind)))
    fade = 0.5 + 0.5 * np.cos(np.pi * (np.arange(size - count) + 1.0) / (size - count))
    whole = np.concatenate([moved, moved[-1:] * fade[:, None]])
    lines = np.fft.rfft(whole, axis=0)
    frequency = np.fft.rfftfreq(size, 1.0 / rate)
    total = np.zeros(len(frequency), dtype=complex)
    for column, force in enumerate(forces):
        total += lines[:, column] * housing.transfer(point, force, frequency)
    return np.fft.irfft(total, size)[:count]
