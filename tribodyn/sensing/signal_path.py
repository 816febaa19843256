"""From motion to signal: acceleration of the housing, passing planets, noise and the converter's steps."""

from collections.abc import Sequence
from zlib import crc32

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.sensing.data import HousingData, SensorData


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


def as_measured(values: Float[Array, " sample"], sensor: SensorData) -> Float[Array, " sample"]:
    """The signal with the sensor's noise, which is white and Gaussian, clipped and in steps."""
    level = sensor.noise
    if sensor.snr is not None and len(values):
        level = float(np.std(values)) * 10.0 ** (-sensor.snr / 20.0)
    if level > 0.0:
        # sensors of one seed have different noise, and a sensor the same whatever others there are
        random = np.random.default_rng([sensor.seed, crc32(sensor.name.encode())])
        values = values + level * random.standard_normal(len(values))
    if sensor.full_scale is not None:
        values = np.clip(values, -sensor.full_scale, sensor.full_scale)
        if sensor.bits is not None:
            step = sensor.full_scale / 2.0 ** (sensor.bits - 1)
            values = np.clip(
                np.round(values / step), -(2.0 ** (sensor.bits - 1)), 2.0 ** (sensor.bits - 1) - 1
            )
            values = values * step
    return values


def heard(away: Float[Array, "sample planet"], window: str, planets: int) -> Float[Array, "sample planet"]:
    """Weights 0 … 1 of planets by their angles from the sensor, rad.

    The window "hann" is as wide as the planets are apart, so that one after the other is heard (Inalpolat &
    Kahraman, J. Sound Vib. 323 (2009) 677); "hamming" goes over the whole turn, with 0.08 on the far side
    (Liang, Zuo & Hoseini, Eng. Fail. Anal. 48 (2015) 245, without their factor for the width).
    """
    near = (np.asarray(away, dtype=float) + np.pi) % (2.0 * np.pi) - np.pi
    if window == "hamming":
        return 0.54 + 0.46 * np.cos(near)
    half = np.pi / planets
    return np.where(np.abs(near) < half, 0.5 + 0.5 * np.cos(np.pi * near / half), 0.0)
