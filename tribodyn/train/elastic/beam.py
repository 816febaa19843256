"""A shaft as Timoshenko beams: straight elements of round section, exact under loads at their ends.

A node has x, y, z (m) and tilts about x and y (rad), right-handed: dx/dz = tilt_y, dy/dz = −tilt_x. The
rotation about z is no part of it: a round shaft couples it with nothing, and the dynamics have it as a degree
of freedom of their own. J. S. Przemieniecki, Theory of Matrix Structural Analysis (1968), (5.116).
"""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

#: Directions of a node: x, y, z, tilts about x and y.
DIRECTIONS = 5


class ShaftSection(NamedTuple):
    """A stretch of a shaft with one section; m."""

    length: float
    diameter: float
    bore: float = 0.0


class ShaftMetal(NamedTuple):
    """What a shaft is made of."""

    youngs_modulus: float  # Pa
    poisson_ratio: float


def shear_factor(poisson_ratio: float, ratio: float) -> float:
    """Shear factor κ of a round section with the bore `ratio` times its diameter.

    G. R. Cowper, J. Appl. Mech. 33 (1966) 335: 6 (1 + ν)(1 + m²)²/[(7 + 6 ν)(1 + m²)² + (20 + 12 ν) m²].
    """
    square = (1.0 + ratio**2) ** 2
    below = (7.0 + 6.0 * poisson_ratio) * square + (20.0 + 12.0 * poisson_ratio) * ratio**2
    return 6.0 * (1.0 + poisson_ratio) * square / below


def element(section: ShaftSection, length: float, metal: ShaftMetal) -> Float[Array, "10 10"]:
    """Stiffness of a piece of so much length (m) of a section: of its two nodes, the one at smaller z first.

    Bending in a plane with w its deflection and θ = w', Φ = 12 E I/(κ G A L²).
    """
    area = np.pi / 4.0 * (section.diameter**2 - section.bore**2)
    inertia = np.pi / 64.0 * (section.diameter**4 - section.bore**4)
    modulus, nu = metal
    shear = shear_factor(nu, section.bore / section.diameter) * modulus / (2.0 * (1.0 + nu)) * area
    bending = modulus * inertia
    phi = 12.0 * bending / (shear * length**2)
    half, square = 6.0 * length, length**2
    in_plane = (
        bending
        / (length**3 * (1.0 + phi))
        * np.array(
            [
                [12.0, half, -12.0, half],
                [half, (4.0 + phi) * square, -half, (2.0 - phi) * square],
                [-12.0, -half, 12.0, -half],
                [half, (2.0 - phi) * square, -half, (4.0 + phi) * square],
            ]
        )
    )
    stiffness = np.zeros((2 * DIRECTIONS, 2 * DIRECTIONS))
    for places, sign in (((0, 4, 5, 9), 1.0), ((1, 3, 6, 8), -1.0)):
        turned = np.array([1.0, sign, 1.0, sign])
        stiffness[np.ix_(places, places)] = in_plane * np.outer(turned, turned)
    stiffness[np.ix_((2, 7), (2, 7))] = modulus * area / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return stiffness
