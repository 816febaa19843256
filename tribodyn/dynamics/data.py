"""What a case says of shafts, bearings, drive and load, in SI units; stiffness of rolling bearings.

From type, size and load: E. P. Gargiulo, "A simple way to estimate bearing stiffness", Machine Design 52
(1980) 107: Palmgren's deflections with the load of the most loaded element, 5 F/(Z cos α), without preload,
with normal clearance.
"""

from dataclasses import dataclass
from math import sqrt
from typing import Literal

import numpy as np

from tribodyn.numerics.elementary import cos, exp, log
from tribodyn.numerics.shapes import Array, Float


@dataclass(frozen=True)
class BearingData:
    """Shaft and bearing of one gear: stiffness (N/m) and damping ratio of each axis (x: pitch tangent)."""

    stiffness_x: float
    stiffness_y: float
    damping_ratio_x: float
    damping_ratio_y: float
    stiffness_axial: float | None = None  # along z, N/m; None: the smaller of x and y
    #: stiffness against tilts about x and y, N m/rad; None: that of two bearings at the `span`
    stiffness_tilt: float | None = None
    span: float | None = None  # distance of the bearings, m; None: twice the face width
    #: five by five, of x, y, z and tilts about x and y, N/m, N, N m/rad; in place of all other stiffness, and
    #: the damping ratio then that of every motion of the gear alone on it
    matrix: tuple[tuple[float, ...], ...] | None = None

    @classmethod
    def of_matrix(cls, matrix: tuple[tuple[float, ...], ...], damping_ratio: float) -> "BearingData":
        """The bearing that a matrix is."""
        return cls(matrix[0][0], matrix[1][1], damping_ratio, damping_ratio, matrix=matrix)


@dataclass(frozen=True)
class OperatingData:
    """Speed and load of a pair of gears."""

    pinion_speed: float  # nominal speed ω_p, rad/s
    gear_torque: float  # T_g, the constant part of the load, N m


def in_space(bearing: BearingData, width: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Stiffness and damping ratio of bearings in x, y, z and tilts about x and y; face width in m.

    Two bearings, half of the stiffness each, at ± span/2 resist a tilt about x by k_y span²/4. z and tilts
    are damped by the smaller of the ratios.
    """
    arm = ((2.0 * width if bearing.span is None else bearing.span) / 2.0) ** 2
    x, y = bearing.stiffness_x, bearing.stiffness_y
    axial = min(x, y) if bearing.stiffness_axial is None else bearing.stiffness_axial
    tilt = bearing.stiffness_tilt
    tilts = (y * arm, x * arm) if tilt is None else (tilt, tilt)
    ratio = min(bearing.damping_ratio_x, bearing.damping_ratio_y)
    return (x, y, axial, *tilts), (bearing.damping_ratio_x, bearing.damping_ratio_y, ratio, ratio, ratio)


def matrices_in_space(
    bearing: BearingData, width: float, mass: float, tilting: float
) -> tuple[Float[Array, "5 5"], Float[Array, "5 5"]]:
    """Stiffness and damping of a bearing in x, y, z and tilts about x and y, of a gear of that mass (kg).

    `width` of its face, m; `tilting` its inertia about x and y, kg m². A matrix K is damped by C =
    2 ζ M^½ (M^−½ K M^−½)^½ M^½: by the ratio ζ in every motion of the gear alone.
    """
    inertia = np.repeat([mass, tilting], [3, 2])
    if bearing.matrix is None:
        stiffness, ratios = (np.array(values) for values in in_space(bearing, width))
        return np.diag(stiffness), np.diag(2.0 * ratios * np.sqrt(stiffness * inertia))
    matrix, root = np.array(bearing.matrix), np.sqrt(inertia)
    squares, modes = np.linalg.eigh(matrix / np.outer(root, root))
    rate = modes * np.sqrt(np.maximum(squares, 0.0)) @ modes.T
    return matrix, 2.0 * bearing.damping_ratio_x * rate * np.outer(root, root)


BearingType = Literal[
    "deep-groove-ball", "angular-contact-ball", "cylindrical-roller", "tapered-roller", "needle-roller"
]
#: Of those with line contact.
ROLLERS = ("cylindrical-roller", "tapered-roller", "needle-roller")

_INCH, _POUND = 0.0254, 4.4482216152605
#: Gargiulo's factors, lbf and inch: of point contact, and of line contact.
_BALL, _ROLLER = 0.0325e6, 0.30e6


@dataclass(frozen=True)
class RollingBearing:
    """A row of rolling elements under a radial load."""

    type: BearingType
    elements: int  # Z, number of rolling elements
    diameter: float  # D of a rolling element, m; of balls alone
    length: float  # l, effective length of a roller, m; of rollers alone
    contact_angle: float  # α, rad
    radial_load: float  # F_r of one bearing, N
    count: int  # bearings that carry the shaft, alike and equally loaded


def radial_stiffness(bearing: RollingBearing) -> float:
    """Stiffness dF/dδ of all `count` bearings in the direction of the load, N/m; shaft and housing are rigid.

    Balls 0.0325e6 (D F Z² cos⁵ α)^(1/3), rollers 0.30e6 F^0.1 Z^0.9 l^0.8 cos^1.9 α, lbf and inch. Across the
    load a bearing without preload is softer; the same is taken for both axes.
    """
    load, elements = log(bearing.radial_load / _POUND), log(float(bearing.elements))
    angle = log(cos(bearing.contact_angle))
    if bearing.type in ROLLERS:
        size = log(bearing.length / _INCH)
        stiffness = _ROLLER * exp(0.1 * load + 0.9 * elements + 0.8 * size + 1.9 * angle)
    else:
        size = log(bearing.diameter / _INCH)
        stiffness = _BALL * exp((size + load + 2.0 * elements + 5.0 * angle) / 3.0)
    return bearing.count * stiffness * _POUND / _INCH


def equivalent_mass(inertias: tuple[float, float], radii: tuple[float, float]) -> float:
    """Mass of two gears along their line of action, kg: J_1 J_2/(J_1 r_2² + J_2 r_1²).

    `inertias` about their axes, kg m²; `radii` at which the load acts, m.
    """
    (first, second), (radius_1, radius_2) = inertias, radii
    return first * second / (first * radius_2**2 + second * radius_1**2)


def mesh_damping(ratio: float, mass: float, slices: int) -> float:
    """2 ζ √m of a mesh with the equivalent mass m (kg): times √k the damping of a contact of the stiffness k.

    Of slices together that of the pair: √K times as much of a Kth of the stiffness.
    """
    return 2.0 * ratio * sqrt(mass / slices)


def spring_damping(given: float, ratio: float, stiffness: float, *inertias: float) -> float:
    """What is given and 2 ζ √(k m) of a spring; m of the body on it, or of two against each other.

    Of two m_1 m_2/(m_1 + m_2). In translation N/m, kg and N s/m, in rotation N m/rad, kg m² and N m s/rad.
    """
    own, *other = inertias
    mass = own * other[0] / (own + other[0]) if other else own
    return given + 2.0 * ratio * sqrt(stiffness * mass)
