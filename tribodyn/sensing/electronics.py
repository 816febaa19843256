"""What a sensor's electronics add to its signal: noise, and the steps of a converter."""

from zlib import crc32

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.sensing.data import SensorData


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
