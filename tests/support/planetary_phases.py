"""Phases of the meshes of a planetary set in closed form."""

from collections.abc import Sequence
from math import pi

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.planetary import SetTeeth


def mesh_phases(
    teeth: SetTeeth,
    angles: Sequence[float],
    half_angles: tuple[float, float],
    entries: tuple[float, float] = (0.0, 0.0),
    sense: int = 1,
) -> tuple[Float[Array, " planet"], Float[Array, " planet"]]:
    """Phases of the meshes of sun and ring with every planet, cycles, 0 ≤ … < 1; the first sun mesh's is 0.

    Phases grow while the sun turns counter-clockwise against the carrier; `sense` is that of its load, +1
    counter-clockwise.

    Parameters
    ----------
    angles : of the planets, counter-clockwise, rad
    half_angles : of a planet's tooth on its working pitch circles with sun and ring, rad: (π/2 + 2 x tan α)/z
        + inv α − inv α_w
    entries : where the tables of both meshes begin, on the path of contact from the pitch point, base pitches
    """
    turned = sense * (np.asarray(angles, dtype=float) - angles[0]) / (2.0 * pi)
    between = teeth.planet * (sum(half_angles) / (2.0 * pi) - 0.5) + entries[0] - entries[1]
    return (-teeth.sun * turned) % 1.0, (between - teeth.ring * turned) % 1.0
