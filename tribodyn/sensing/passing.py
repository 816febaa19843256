"""How strongly a sensor at a fixed place hears each planet while they pass it."""

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Window -> what it is.
WINDOWS = {
    "hann": "Hann's, as wide as the planets are apart: one planet after the other is heard "
    "(Inalpolat & Kahraman, J. Sound Vib. 323 (2009) 677)",
    "hamming": "Hamming's over the whole turn: every planet is always heard, with 0.08 on the far side "
    "(Liang, Zuo & Hoseini, Eng. Fail. Anal. 48 (2015) 245, without their factor for the width)",
}


def heard(away: Float[Array, "sample planet"], window: str, planets: int) -> Float[Array, "sample planet"]:
    """Weights 0 … 1 of planets by their angles from the sensor, rad."""
    near = (np.asarray(away, dtype=float) + np.pi) % (2.0 * np.pi) - np.pi
    if window == "hamming":
        return 0.54 + 0.46 * np.cos(near)
    half = np.pi / planets
    return np.where(np.abs(near) < half, 0.5 + 0.5 * np.cos(np.pi * near / half), 0.0)
