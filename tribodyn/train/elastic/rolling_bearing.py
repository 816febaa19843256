"""Rolling bearings: force and stiffness matrix over the displacement of the shaft in a fixed housing.

Sum over the rolling elements of Hertz contacts between rigid rings, without speed: A. B. Jones, J. Basic Eng.
82 (1960) 309; T. A. Harris, Rolling Bearing Analysis; as a matrix T. C. Lim, R. Singh, J. Sound Vib. 139
(1990) 179, and J. M. de Mul, J. M. Vree, D. A. Maas, J. Tribol. 111 (1989) 142. Displacements are those of
the shaft at the bearing's middle, in the directions of `beam`. Energies are convex in them, so that a shaft
has one equilibrium.
"""

from collections.abc import Callable, Sequence
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
    offset: float = 0.0  # along z, of the row from the bearing's middle
    aligning: bool = False  # the outer raceway is a sphere about the bearing's middle


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
    located: bool = True  # as of balls
    offset: float = 0.0
    aligning: bool = False  # barrels, which stay straight on the raceways when the shaft tilts
    #: of a barrel: 1/radius of its profile less 1/radius of the raceway's, sum of both raceways, 1/m
    crown: float = 0.0
    #: distance between the centres of both raceways' profiles, along which a barrel is pressed: of toroidal
    #: rollers; of a sphere about the bearing's middle the line stays as it is
    centres: float = np.inf


class BearingRows(NamedTuple):
    """Rows of balls or of rollers between the same rings."""

    rows: tuple[BallRow | RollerRow, ...]
    #: the outer rings of rows that take thrust both ways slide along z together, to where they take none
    sliding: bool = False


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
    yielding = 0.0
    for along, across in _ball_radii(row):
        ellipticity, first, second = _ellipse(across / along)
        mean = along * across / (along + across)
        of_unit = first * (9.0 / (2.0 * second * mean) / (np.pi * ellipticity * plane) ** 2) ** (1.0 / 3.0)
        yielding += of_unit
    return float(yielding**-BALL_EXPONENT)


def _ball_radii(row: BallRow) -> tuple[tuple[float, float], tuple[float, float]]:
    """R_x along the raceway and R_y across it, of a ball on the inner raceway and on the outer one."""
    gamma = row.diameter * np.cos(row.contact_angle) / row.pitch_diameter
    inner, outer = (row.diameter / 2.0 * (1.0 + side * gamma) for side in (-1.0, 1.0))
    across = 1.0 / (2.0 / row.diameter - 1.0 / (row.conformity * row.diameter))
    return (inner, across), (outer, outer if row.aligning else across)


def outer_conformity(row: BallRow) -> float:
    """Radius of the outer raceway across the rolling direction, over the ball's diameter."""
    across = 1.0 / (2.0 - row.diameter / _ball_radii(row)[1][1])
    return float(across) if row.aligning else row.conformity


def contact_pressure(row: BallRow | RollerRow, load: float) -> float:
    """Largest pressure of a rolling element on its raceways under a load (N), Pa, by Hertz.

    Ellipse: p = 3 Q/(2 π a b), a = (6 k² ε Q R/(π E'))^⅓ and b = a/k, E' as of `ball_constant`; line contact
    of a roller on the inner raceway, evenly loaded: p = √(q E'/(2 π R)).
    """
    modulus, nu = STEEL
    plane = modulus / (1.0 - nu**2)
    if isinstance(row, RollerRow):
        gamma = row.diameter * np.cos(row.contact_angle) / row.pitch_diameter
        return float(np.sqrt(load / row.length * plane / (np.pi * row.diameter * (1.0 - gamma))))
    highest = 0.0
    for along, across in _ball_radii(row):
        ellipticity, _, second = _ellipse(across / along)
        mean = along * across / (along + across)
        of_unit = (6.0 * ellipticity**2 * second * mean / (np.pi * plane)) ** (1.0 / 3.0)
        highest = max(highest, 1.5 * ellipticity / (np.pi * of_unit**2))
    return float(highest * load ** (1.0 / 3.0))


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


def answer(bearing: BallRow | RollerRow | BearingRows, moved: Float[Array, "5"]) -> BearingState:
    """What a bearing answers to a displacement of the shaft."""
    if isinstance(bearing, BearingRows):
        if bearing.sliding:
            return _sliding(bearing.rows, moved)
        return _together([answer(row, moved) for row in bearing.rows])
    return _of_balls(bearing, moved) if isinstance(bearing, BallRow) else _of_rollers(bearing, moved)


def _together(states: Sequence[BearingState]) -> BearingState:
    """Rows side by side; their elements one row after the other."""
    slices = [state.slice_load for state in states if state.slice_load is not None]
    return BearingState(
        np.sum([state.force for state in states], axis=0),
        np.sum([state.stiffness for state in states], axis=0),
        sum(state.energy for state in states),
        np.concatenate([state.element_load for state in states]),
        np.concatenate(slices) if slices else None,
    )


def _sliding(rows: Sequence[BallRow | RollerRow], moved: Float[Array, "5"]) -> BearingState:
    """Rows whose rings stand where the energy is lowest along z: the force there is zero, z condensed."""
    from scipy.optimize import brentq  # heavy, and most pairs have no such bearing

    def at(place: float) -> BearingState:
        placed = np.array([*moved[:2], place, *moved[3:]])
        return _together([answer(row, placed) for row in rows])

    def thrust(place: float) -> float:
        return float(at(place).force[2])

    start, reach = thrust(0.0), 1e-6
    while start != 0.0 and thrust(-np.sign(start) * reach) * start > 0.0:
        reach *= 2.0
    place = 0.0 if start == 0.0 else cast(float, brentq(thrust, 0.0, -np.sign(start) * reach, xtol=1e-15))
    state = at(place)
    along, stiffness = state.stiffness[2], state.stiffness
    if along[2] > 0.0:
        stiffness = stiffness - np.outer(along, along) / along[2]
    still = np.array([1.0, 1.0, 0.0, 1.0, 1.0])
    return state._replace(force=state.force * still, stiffness=stiffness * np.outer(still, still))


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
    """Balls: the groove centres of both rings stand A apart, and the ball is compressed by A − A_0.

    On a spherical outer raceway, by how far the inner groove's centre comes away from the sphere's.
    """
    constant = ball_constant(row)

    def law(extended: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
        load, pressed = ball_contact(extended, 0.0, constant)
        energy = float(np.sum(load * pressed)) / (1.0 + BALL_EXPONENT)
        return load, BALL_EXPONENT * constant * np.sqrt(pressed), energy

    return _along_lines(row, moved, groove_radius(row), centres_apart(row), law)


def groove_radius(row: BallRow) -> float:
    """Radius of the circle of the inner groove's centres, m."""
    return float(row.pitch_diameter / 2.0 + (row.conformity - 0.5) * row.diameter * np.cos(row.contact_angle))


def centres_apart(row: BallRow) -> float:
    """Distance between the centres of both raceways' profiles, on whose line a ball is pressed, m."""
    if row.aligning:
        return float(
            row.pitch_diameter / (2.0 * np.cos(row.contact_angle)) + (row.conformity - 0.5) * row.diameter
        )
    return (2.0 * row.conformity - 1.0) * row.diameter


def _along_lines(
    row: BallRow | RollerRow,
    moved: Float[Array, "5"],
    radius: float,
    apart: float,
    law: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, float]],
) -> BearingState:
    """Elements pressed along the line between two centres that stand so far apart at rest.

    The line turns with the displacement; infinitely far centres keep it. A spherical raceway lets the shaft
    tilt: the line goes through the bearing's middle (radius and offset, second order left out). `law` gives
    load, its slope and the energy of all elements.
    """
    normal = np.array([np.cos(row.contact_angle), row.thrust * np.sin(row.contact_angle)])
    by = _movements(row.elements, np.array([radius]), np.array([row.offset]))[:, 0]
    if not row.located:
        by[:, 1, 2] = 0.0
    if row.aligning:
        by[:, :, 3:] = 0.0
    away = np.array([-row.clearance / 2.0, row.thrust * row.preload]) + by @ moved
    length = np.full(row.elements, np.inf)
    extended, normals = away @ normal, np.broadcast_to(normal, away.shape)
    if np.isfinite(apart):
        line = apart * normal + away
        length = np.hypot(line[:, 0], line[:, 1])
        extended, normals = length - apart, line / length[:, None]
    load, slope, energy = law(extended)
    along = np.einsum("ei,eij->ej", normals, by)
    # the load turns with its line: Q/A across it
    across = np.einsum("ei,eij->ej", np.stack([-normals[:, 1], normals[:, 0]], axis=1), by)
    stiffness = np.einsum("e,ei,ej->ij", np.where(extended > 0.0, slope, 0.0), along, along)
    stiffness += np.einsum("e,ei,ej->ij", load / length, across, across)
    return BearingState(load @ along, stiffness, energy, load)


def slices_of(row: RollerRow) -> tuple[Float[Array, " slice"], Float[Array, " slice"]]:
    """Middles of the slices along a roller, and how far their profiles stand back on both raceways, m."""
    place = ((np.arange(SLICES) + 0.5) / SLICES - 0.5) * row.length
    drop = row.crown * place**2 / 2.0
    if row.profiled:
        drop = drop - 2.0 * PROFILE * row.diameter * np.log(1.0 - (2.0 * place / row.length) ** 2)
    return place, drop


def _of_rollers(row: RollerRow, moved: Float[Array, "5"]) -> BearingState:
    """Rollers in slices, each pressed along the normal of the outer raceway; flanges carry nothing.

    Barrels align themselves: all of their slices are pressed alike, less what their profile drops.
    """
    place, drop = slices_of(row)
    constant = roller_constant(row) / SLICES
    if row.aligning:
        return _of_barrels(row, moved, drop, constant)
    sine, cosine = row.thrust * np.sin(row.contact_angle), np.cos(row.contact_angle)
    movements = _movements(row.elements, row.pitch_diameter / 2.0 - place * sine, row.offset + place * cosine)
    if not row.located:
        movements[:, :, 1, 2] = 0.0
    by = np.einsum("i,esij->esj", np.array([cosine, sine]), movements)
    rest = abs(sine) * row.preload - cosine * row.clearance / 2.0 - drop
    load, pressed = roller_contact(rest + by @ moved, constant)
    slope = ROLLER_EXPONENT * constant * pressed ** (ROLLER_EXPONENT - 1.0)
    stiffness = np.einsum("es,esi,esj->ij", np.where(pressed > 0.0, slope, 0.0), by, by)
    force = np.einsum("es,esj->j", load, by)
    energy = float(np.sum(load * pressed)) / (1.0 + ROLLER_EXPONENT)
    return BearingState(force, stiffness, energy, np.sum(load, axis=1), load)


def _of_barrels(
    row: RollerRow, moved: Float[Array, "5"], drop: Float[Array, " slice"], constant: float
) -> BearingState:
    slices = np.zeros((row.elements, SLICES))

    def law(extended: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
        slices[:], each = roller_contact(extended[:, None] - drop, constant)
        slope = ROLLER_EXPONENT * constant * each ** (ROLLER_EXPONENT - 1.0)
        energy = float(np.sum(slices * each)) / (1.0 + ROLLER_EXPONENT)
        return np.sum(slices, axis=1), np.sum(np.where(each > 0.0, slope, 0.0), axis=1), energy

    state = _along_lines(row, moved, row.pitch_diameter / 2.0, row.centres, law)
    return state._replace(slice_load=slices)
