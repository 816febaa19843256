"""Matrices of a straight piece of a round shaft in six directions: stiffness, consistent mass, gyroscopic.

A node has x, y, z (m), tilts about x and y and the turn about z (rad), right-handed: dx/dz = tilt_y, dy/dz =
−tilt_x. Timoshenko's beam with rotary inertia: J. S. Przemieniecki, Theory of Matrix Structural Analysis
(1968), (5.116) and (11.35); the gyroscopic matrix is twice its rotary one between both planes.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.beam import DIRECTIONS, ShaftMetal, ShaftSection, element, shear_factor

SIX = 6
#: Places of deflection and slope in both planes: x with tilt_y, y with −tilt_x.
_PLANES = (((0, 4, 6, 10), 1.0), ((1, 3, 7, 9), -1.0))


class BeamMatrices(NamedTuple):
    """Of both nodes of a piece, the one at smaller z first."""

    stiffness: Float[Array, "12 12"]
    mass: Float[Array, "12 12"]
    gyroscopic: Float[Array, "12 12"]  # per spin counter-clockwise about z, kg m²; skew


def matrices(section: ShaftSection, length: float, metal: ShaftMetal, density: float) -> BeamMatrices:
    """Those of a piece of so much length (m) of a section; density in kg/m³."""
    area = np.pi / 4.0 * (section.diameter**2 - section.bore**2)
    inertia = np.pi / 64.0 * (section.diameter**4 - section.bore**4)
    modulus, nu = metal
    rigidity = modulus / (2.0 * (1.0 + nu))
    shear = shear_factor(nu, section.bore / section.diameter) * rigidity * area
    phi = 12.0 * modulus * inertia / (shear * length**2)
    stiffness, mass, gyroscopic = np.zeros((3, 2 * SIX, 2 * SIX))
    five = [SIX * node + direction for node in (0, 1) for direction in range(DIRECTIONS)]
    stiffness[np.ix_(five, five)] = element(section, length, metal)
    turns, along = np.ix_((5, 11), (5, 11)), np.ix_((2, 8), (2, 8))
    stiffness[turns] = rigidity * 2.0 * inertia / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
    linear = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6.0
    mass[along] = density * area * length * linear
    mass[turns] = density * 2.0 * inertia * length * linear
    bending, rotary = _in_plane(length, phi)
    rotary *= density * inertia
    for places, sign in _PLANES:
        turned = np.outer(*2 * [np.array([1.0, sign, 1.0, sign])])
        mass[np.ix_(places, places)] += (density * area * bending + rotary) * turned
    (in_x, _), (in_y, sign) = _PLANES
    between = 2.0 * rotary * np.array([1.0, sign, 1.0, sign])[None, :]
    gyroscopic[np.ix_(in_x, in_y)] += between
    gyroscopic[np.ix_(in_y, in_x)] -= between.T
    return BeamMatrices(stiffness, mass, gyroscopic)


def _in_plane(length: float, phi: float) -> tuple[Float[Array, "4 4"], Float[Array, "4 4"]]:
    """Matrices of ∫ w w' dz and ∫ θ θ' dz over deflection and slope of both nodes."""
    square = phi**2
    a = 13.0 / 35.0 + 0.7 * phi + square / 3.0
    b = (11.0 / 210.0 + 11.0 * phi / 120.0 + square / 24.0) * length
    c = 9.0 / 70.0 + 0.3 * phi + square / 6.0
    d = -(13.0 / 420.0 + 3.0 * phi / 40.0 + square / 24.0) * length
    e = (1.0 / 105.0 + phi / 60.0 + square / 120.0) * length**2
    f = -(1.0 / 140.0 + phi / 60.0 + square / 120.0) * length**2
    deflected = np.array([[a, b, c, d], [b, e, -d, f], [c, -d, a, -b], [d, f, -b, e]])
    g = 1.2
    h = (0.1 - 0.5 * phi) * length
    i = (2.0 / 15.0 + phi / 6.0 + square / 3.0) * length**2
    j = (-1.0 / 30.0 - phi / 6.0 + square / 6.0) * length**2
    turned = np.array([[g, h, -g, h], [h, i, -h, j], [-g, -h, g, -h], [h, j, -h, i]])
    return length * deflected / (1.0 + phi) ** 2, turned / (length * (1.0 + phi) ** 2)
