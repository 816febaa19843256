"""Rolling bearings: force and stiffness matrix over the displacement of the shaft in a fixed housing.

Sum over the rolling elements of Hertz contacts between rigid rings, without speed: A. B. Jones, J. Basic Eng.
82 (1960) 309; T. A. Harris, Rolling Bearing Analysis; as a matrix T. C. Lim, R. Singh, J. Sound Vib. 139
(1990) 179, and J. M. de Mul, J. M. Vree, D. A. Maas, J. Tribol. 111 (1989) 142. Displacements are those of
the shaft at the bearing's middle, in the directions of `beam`. Energies are convex in them, so that a shaft
has one equilibrium.
"""

from typing import NamedTuple, cast

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.element_contact import (
    BALL_EXPONENT,
    ROLLER_EXPONENT,
    ball_contact,
    roller_contact,
)

#: Elastic constants of rings and rolling elements, bearing steel: E in Pa, ν.
STEEL = 206e9, 0.3
#: Groove radius over ball diameter that ISO 281 and ISO/TS 16281 take for deep groove ball bearings.
CONFORMITY = 0.52
#: ISO/TS 16281: load of a roller between both raceways over deflection^(10/9) and effective length^(8/9), N
#: and mm; slices of a roller; its profile, drop over diameter and logarithm.
ROLLER_CONSTANT, SLICES, PROFILE = 35948.0, 41, 0.00035


class BallRow(NamedTuple):
    """A row of balls; m, rad."""

    elements: int
    diameter: float  # D of a ball
    pitch_diameter: float
    clearance: float = 0.0  # diametral, of the mounted bearing; negative: radial preload
    contact_angle: float = 0.0  # α, unloaded
    #: direction along z in which the shaft can push against it; 0: both, of α = 0
    thrust: int = 0
    preload: float = 0.0  # axial displacement of the rings against each other when mounted
    conformity: float = CONFORMITY
    located: bool = True  # False: the outer ring slides along z in its housing


class RollerRow(NamedTuple):
    """A row of rollers, cylindrical or tapered; m, rad."""

    elements: int
    diameter: float  # of a roller, mean
    length: float  # effective
    pitch_diameter: float
    clearance: float = 0.0
    contact_angle: float = 0.0  # α of the outer raceway
    thrust: int = 0  # as of balls; 0: none, of cylindrical rollers
    preload: float = 0.0
    profiled: bool = True  # logarithmic profile of ISO/TS 16281; False: straight


class BearingState(NamedTuple):
    """What a bearing answers to a displacement of the shaft."""

    force: Float[Array, "5"]  # on the housing: resists the displacement; N, N m
    stiffness: Float[Array, "5 5"]  # its derivative
    energy: float  # J
    element_load: Float[Array, " element"]  # N
    slice_load: Float[Array, "element slice"] | None = None  # of rollers, N


def ball_constant(row: BallRow) -> float:
    """Load over deflection^1.5 of a ball between both raceways, N/m^1.5, by Hertz.

    Of one contact δ = ξ [9/(2 ε R) (Q/(π k E'))²]^(1/3), 1/R = 1/R_x + 1/R_y, with the complete elliptic
    integrals ξ, ε of first and second kind of 1 − 1/k²; B. J. Hamrock, D. Brewe, J. Lubr. Technol. 105 (1983)
    171, whose k is an approximation of what is solved here.
    """
    modulus, nu = STEEL
    plane = modulus / (1.0 - nu**2)  # E' = 2/((1 − ν²)/E + (1 − ν²)/E)
    gamma = row.diameter * np.cos(row.contact_angle) / row.pitch_diameter
    across = 1.0 / (2.0 / row.diameter - 1.0 / (row.conformity * row.diameter))
    yielding = 0.0
    for side in (-1.0, 1.0):  # inner raceway, outer
        along = row.diameter / 2.0 * (1.0 + side * gamma)
        ellipticity, first, second = _ellipse(across / along)
        mean = along * across / (along + across)
        of_unit = first * (9.0 / (2.0 * second * mean) / (np.pi * ellipticity * plane) ** 2) ** (1.0 / 3.0)
        yielding += of_unit
    return float(yielding**-BALL_EXPONENT)


def _ellipse(ratio: float) -> tuple[float, float, float]:
    """Ellipticity k ≥ 1 of a contact whose radii are in this ratio R_y/R_x ≥ 1, and its integrals ξ, ε.

    Hertz: R_y/R_x = (k² ε − ξ)/(ξ − ε).
    """
    from scipy.optimize import brentq  # heavy, and most pairs have no such bearing
    from scipy.special import ellipe, ellipk

    def integrals(k: float) -> tuple[float, float]:
        parameter = 1.0 - 1.0 / k**2
        return float(ellipk(parameter)), float(ellipe(parameter))

    def missing(k: float) -> float:
        first, second = integrals(k)
        return (k**2 * second - first) - ratio * (first - second)

    if ratio <= 1.0 + 1e-9:
        return 1.0, np.pi / 2.0, np.pi / 2.0
    guess = ratio**0.636  # Hamrock & Brewe, within a few per cent
    k = cast(float, brentq(missing, 1.0 + 0.3 * (guess - 1.0), 3.0 * guess))
    return (k, *integrals(k))


def roller_constant(row: RollerRow) -> float:
    """Load over deflection^(10/9) of a roller between both raceways, N/m^(10/9), of ISO/TS 16281."""
    return ROLLER_CONSTANT * (1e3 * row.length) ** (8.0 / 9.0) * 1e3**ROLLER_EXPONENT


def answer(row: BallRow | RollerRow, moved: Float[Array, "5"]) -> BearingState:
    """What a bearing answers to a displacement of the shaft."""
    return _of_balls(row, moved) if isinstance(row, BallRow) else _of_rollers(row, moved)


def _movements(
    elements: int, radius: Float[Array, " slice"], offset: Float[Array, " slice"]
) -> Float[Array, "element slice 2 5"]:
    """Radial and axial movement of points at a radius and an offset along z, by the ring's five directions.

    The first element lies on the x axis; ψ × (R cos φ, R sin φ, a) moves a point.
    """
    angle = (2.0 * np.pi * np.arange(elements) / elements)[:, None]
    cosine, sine = np.broadcast_arrays(np.cos(angle), np.sin(angle), np.zeros((elements, len(radius))))[:2]
    movements = np.zeros((elements, len(radius), 2, 5))
    movements[..., 0, 0], movements[..., 0, 1] = cosine, sine
    movements[..., 0, 3], movements[..., 0, 4] = -offset * sine, offset * cosine
    movements[..., 1, 2] = 1.0
    movements[..., 1, 3], movements[..., 1, 4] = radius * sine, -radius * cosine
    return movements


def _of_balls(row: BallRow, moved: Float[Array, "5"]) -> BearingState:
    """Balls: the groove centres of both rings stand A apart, and the ball is compressed by A − A_0."""
    apart = (2.0 * row.conformity - 1.0) * row.diameter
    radius = row.pitch_diameter / 2.0 + (row.conformity - 0.5) * row.diameter * np.cos(row.contact_angle)
    by = _movements(row.elements, np.array([radius]), np.zeros(1))[:, 0]
    if not row.located:
        by[:, 1, 2] = 0.0
    rest = [
        apart * np.cos(row.contact_angle) - row.clearance / 2.0,
        row.thrust * (apart * np.sin(row.contact_angle) + row.preload),
    ]
    line = rest + by @ moved
    length = np.hypot(line[:, 0], line[:, 1])
    constant = ball_constant(row)
    load, pressed = ball_contact(length, apart, constant)
    normal = line / length[:, None]
    along = np.einsum("ei,eij->ej", normal, by)
    # the load turns with its line: Q/A across it
    across = np.einsum("ei,eij->ej", np.stack([-normal[:, 1], normal[:, 0]], axis=1), by)
    slope = BALL_EXPONENT * constant * np.sqrt(pressed)
    stiffness = np.einsum("e,ei,ej->ij", slope, along, along)
    stiffness += np.einsum("e,ei,ej->ij", load / length, across, across)
    energy = float(np.sum(load * pressed)) / (1.0 + BALL_EXPONENT)
    return BearingState(load @ along, stiffness, energy, load)


def _of_rollers(row: RollerRow, moved: Float[Array, "5"]) -> BearingState:
    """Rollers in slices, each pressed along the normal of the outer raceway; flanges carry nothing."""
    place = ((np.arange(SLICES) + 0.5) / SLICES - 0.5) * row.length
    sine, cosine = row.thrust * np.sin(row.contact_angle), np.cos(row.contact_angle)
    normal = np.array([cosine, sine])
    by = np.einsum(
        "i,esij->esj",
        normal,
        _movements(row.elements, row.pitch_diameter / 2.0 - place * sine, place * cosine),
    )
    rest = abs(sine) * row.preload - cosine * row.clearance / 2.0
    if row.profiled:  # both raceways
        rest = rest + 2.0 * PROFILE * row.diameter * np.log(1.0 - (2.0 * place / row.length) ** 2)
    constant = roller_constant(row) / SLICES
    load, pressed = roller_contact(rest + by @ moved, constant)
    slope = ROLLER_EXPONENT * constant * pressed ** (ROLLER_EXPONENT - 1.0)
    stiffness = np.einsum("es,esi,esj->ij", np.where(pressed > 0.0, slope, 0.0), by, by)
    force = np.einsum("es,esj->j", load, by)
    energy = float(np.sum(load * pressed)) / (1.0 + ROLLER_EXPONENT)
    return BearingState(force, stiffness, energy, np.sum(load, axis=1), load)
