"""Super-elements: a housing or carrier by matrices at its bearing seats, with modes behind them.

Coordinates: of every seat x, y, z (m) and the right-handed rotations about x, y and z (rad) in the axes of
the train, z along its shafts; behind them modal coordinates that do not move the seats (Craig & Bampton, AIAA
J. 6 (1968) 1313). A rigid motion of the structure is one of its seats alone.
"""

from hashlib import sha256
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.beam_matrices import SIX

#: Directions of a seat.
DIRECTIONS = ("x", "y", "z", "tilt_x", "tilt_y", "turn")
#: Of the square root of the product of their diagonals: difference of two elements that must be equal, and a
#: negative eigenvalue that is rounding; eigenvalue of a mass that still is one. Punched files have 7 digits.
ROUNDING, MASSLESS = 1e-6, 1e-12
#: Frequency of a rigid motion over the lowest elastic one: of printed digits, which are then mended.
RIGID = 1e-3
#: Square of a frequency over that of the highest one: 0 but for rounding.
ROUNDED_OFF = 1e-12
#: Difference of the mass in x, y and z, over the mass.
SAME_MASS = 1e-3
#: Lowest elastic frequency times the distance of the seats, m/s: longitudinal waves in steel have 5100. Mass
#: over the cube of that distance, kg/m³: of housings 100 and more.
FASTEST, LIGHTEST, HEAVIEST = 6000.0, 1.0, 1e8


class Radiation(NamedTuple):
    """What a structure radiates by, as quadratic forms of the rates of its coordinates; see `radiated`."""

    #: ∫ n φ_i n φ_j dS over the surface that radiates, n its normal, φ the shape of a coordinate; m² for
    #: displacements
    area: Float[Array, "coordinate coordinate"]
    frequency: Float[Array, " line"] = np.zeros(0)  # Hz, increasing; none: the estimate by area alone
    #: real part of the radiation impedance, N s/m for displacements
    resistance: Float[Array, "line coordinate coordinate"] = np.zeros((0, 0, 0))

    def at(self, rows: list[int]) -> "Radiation":
        """That of some of the coordinates."""
        both = np.ix_(rows, rows)
        lines = np.array([one[both] for one in self.resistance])
        return self._replace(area=self.area[both], resistance=lines.reshape(-1, len(rows), len(rows)))


class SuperElement(NamedTuple):
    """A structure by matrices in SI units over its seats' six directions and modal coordinates."""

    seats: tuple[str, ...]
    places: Float[Array, "seat 3"]  # m, in the axes of the train
    modes: int  # modal coordinates, behind those of the seats
    mass: Float[Array, "coordinate coordinate"]
    stiffness: Float[Array, "coordinate coordinate"]
    damping: Float[Array, "coordinate coordinate"]
    points: tuple[str, ...] = ()  # names of further places whose motion is known
    recovery: Float[Array, "point 3 coordinate"] = np.zeros((0, 3, 0))  # their displacements in x, y, z
    radiation: Radiation | None = None

    @property
    def coordinates(self) -> int:
        """Number of all coordinates."""
        return SIX * len(self.seats) + self.modes

    @property
    def digest(self) -> bytes:
        """Of all its numbers: what tells two structures apart."""
        parts = self.mass, self.stiffness, self.damping, self.places, self.recovery, *(self.radiation or ())
        return sha256(b"".join(np.ascontiguousarray(part).tobytes() for part in parts)).digest()

    def seat(self, name: str) -> int:
        """Place of the first coordinate of a seat."""
        return SIX * self.seats.index(name)

    def motion_of(self, place: str) -> Float[Array, "3 coordinate"]:
        """Displacement in x, y and z of a point or a seat from the coordinates."""
        if place in self.points:
            return self.recovery[self.points.index(place)]
        first = self.seat(place)
        return np.eye(self.coordinates)[first : first + 3]


class Soundness(NamedTuple):
    """What the checks of a super-element found."""

    mass: float  # kg, of a free structure; NaN of one that is held
    lowest: float  # lowest elastic frequency with free seats, Hz; ∞ where the structure is rigid
    highest: float  # highest one of its coordinates, Hz
    free: bool  # six rigid motions; else it is held


def name_of(coordinate: int, element: SuperElement) -> str:
    """How messages call a coordinate."""
    seat, direction = divmod(coordinate, SIX)
    if seat < len(element.seats):
        return f"{DIRECTIONS[direction]} of seat {element.seats[seat]}"
    return f"mode {coordinate - SIX * len(element.seats) + 1}"


def rigid_motions(
    places: Float[Array, "seat 3"], modes: int, about: Float[Array, " 3"] | None = None
) -> Float[Array, "coordinate 6"]:
    """Coordinates of the six rigid motions: shifts along x, y, z; turns about them through the point `about`.

    By default that is the mean of the places. u = t + ω × (place − about).
    """
    places = np.asarray(places, dtype=float)
    motions = np.zeros((SIX * len(places) + modes, SIX))
    for seat, (x, y, z) in enumerate(places - (places.mean(axis=0) if about is None else about)):
        rows = motions[SIX * seat : SIX * (seat + 1)]
        rows[:] = np.eye(SIX)
        rows[:3, 3:] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
    return motions


def frequencies(element: SuperElement) -> Float[Array, " coordinate"]:
    """Natural frequencies with free seats, Hz, increasing; rigid motions of a free structure are 0."""
    from scipy.linalg import eigh  # heavy, and most gearboxes need none

    squares = eigh(element.stiffness, element.mass, eigvals_only=True)
    return np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi)


def sound(element: SuperElement, key: str = "housing.matrices") -> tuple[SuperElement, Soundness]:
    """The element made exactly symmetric and, if it is free, exactly free of rigid motions; what was found.

    Raises InputError at `key` for matrices whose shapes differ, that are not finite, not symmetric, not
    positive (semi-)definite, with some but not six rigid motions, with rigid motions that do not fit the
    places of the seats, with different masses in x, y and z, or with frequencies beyond those of any metal.
    """
    from scipy.linalg import eigh  # heavy, and most gearboxes need none

    element = _symmetric(element, key)
    squares = np.asarray(eigh(element.stiffness, element.mass, eigvals_only=True))
    lowest = np.append(squares, np.inf)[: SIX + 1]
    gaps = [k for k in range(1, SIX + 1) if np.max(np.abs(lowest[:k])) <= RIGID**2 * lowest[k]]
    rigid = gaps[-1] if gaps else 0
    if rigid not in (0, SIX):
        rule = (
            f"stiffness has {rigid} rigid motion{'s' if rigid > 1 else ''}, and a structure has six or none"
        )
        raise InputError(key, None, rule, "free it wholly, or hold it, and reduce it again")
    elastic = float(np.sqrt(lowest[rigid]) / (2.0 * np.pi))
    mass = np.nan
    if rigid:
        element, mass = _free(element, float(lowest[SIX]), key)
    _plausible(element, mass, elastic, key)
    return element, Soundness(mass, elastic, float(np.sqrt(squares[-1]) / (2.0 * np.pi)), rigid == SIX)


def _symmetric(element: SuperElement, key: str) -> SuperElement:
    count = element.coordinates
    matrices = {}
    for name in ("mass", "stiffness", "damping"):
        matrix = np.asarray(getattr(element, name), dtype=float)
        if matrix.shape != (count, count):
            shown = " by ".join(map(str, matrix.shape))
            rule = (
                f"{name} is {shown}, and {len(element.seats)} seats of six directions with "
                f"{element.modes} modes have {count} coordinates"
            )
            raise InputError(key, None, rule, "check the seats and the number of modes")
        if not np.all(np.isfinite(matrix)):
            raise InputError(key, None, f"{name} has elements that are no numbers", "reduce it again")
        matrices[name] = _semidefinite(matrix, name, element, key)
    if (by := element.radiation) is not None:
        area = _semidefinite(by.area, "area", element, key)
        lines = zip(by.frequency.tolist(), by.resistance, strict=True)
        resistance = [_semidefinite(one, f"radiation at {f:g} Hz", element, key) for f, one in lines]
        by = by._replace(area=area, resistance=np.array(resistance).reshape(by.resistance.shape))
        matrices["radiation"] = by
    return element._replace(**matrices)


def _semidefinite(
    matrix: Float[Array, "coordinate coordinate"], name: str, element: SuperElement, key: str
) -> Float[Array, "coordinate coordinate"]:
    """A matrix that is symmetric and has no negative eigenvalue, but for rounding."""
    from scipy.linalg import eigh  # heavy, and most gearboxes need none

    scale = np.sqrt(np.abs(np.diag(matrix)))
    scale[scale == 0.0] = np.max(scale, initial=0.0) or 1.0
    scaled = matrix / np.outer(scale, scale)
    apart = np.abs(scaled - scaled.T)
    if np.max(apart) > ROUNDING:
        i, j = map(int, np.unravel_index(np.argmax(apart), apart.shape))
        rule = (
            f"{name} is not symmetric: {matrix[i, j]:.6g} and {matrix[j, i]:.6g} between "
            f"{name_of(i, element)} and {name_of(j, element)}"
        )
        raise InputError(key, None, rule, "check the order of rows and columns, and that the file is whole")
    least, shape = eigh((scaled + scaled.T) / 2.0, subset_by_index=[0, 0])
    if least[0] < (MASSLESS if name == "mass" else -ROUNDING):
        where = name_of(int(np.argmax(np.abs(shape[:, 0]))), element)
        lack = "has no inertia" if least[0] > -ROUNDING else "is negative"
        lack = lack if name == "mass" else "gives energy away"
        rule = (
            f"{name} is not positive {'' if name == 'mass' else 'semi-'}definite: a motion of {where} {lack}"
        )
        raise InputError(key, None, rule, "check signs and units, and that the mass is a consistent one")
    return (matrix + matrix.T) / 2.0


def _free(element: SuperElement, elastic: float, key: str) -> tuple[SuperElement, float]:
    """A free structure without what rounding strains in its rigid motions, and its mass, kg."""
    from scipy.linalg import eigh  # heavy, and most gearboxes need none

    motions = rigid_motions(element.places, element.modes)
    inertia = motions.T @ element.mass @ motions
    strained = motions.T @ element.stiffness @ motions
    squares, shapes = eigh(strained, inertia)
    if squares[-1] > RIGID**2 * elastic:
        worst = int(np.argmax(np.abs(shapes[:, -1]) * np.sqrt(np.diag(inertia))))
        moved = f"a rigid {'shift along' if worst < 3 else 'turn about'} {'xyz'[worst % 3]}"
        frequency, lowest = np.sqrt([squares[-1], elastic]) / (2.0 * np.pi)
        rule = (
            f"stiffness resists {moved} of its seats (as {frequency:.4g} Hz beside the lowest elastic "
            f"{lowest:.4g} Hz), and elsewhere is free"
        )
        remedy = "check the places of the seats, their unit of length, and the order of directions"
        raise InputError(key, None, rule, remedy)
    masses = np.diag(inertia)[:3]
    if np.ptp(masses) > SAME_MASS * np.max(masses):
        shown = ", ".join(f"{mass:.6g}" for mass in masses)
        rule = f"mass is {shown} kg in x, y and z, and of one structure it is the same"
        raise InputError(key, None, rule, "check the order of directions and modes")
    lean = np.eye(len(motions)) - motions @ np.linalg.solve(inertia, motions.T @ element.mass)
    stiffness = lean.T @ element.stiffness @ lean
    return element._replace(stiffness=(stiffness + stiffness.T) / 2.0), float(np.mean(masses))


def _plausible(element: SuperElement, mass: float, lowest: float, key: str) -> None:
    """Refuse units with which no metal has such a mass or such a frequency."""
    apart = element.places[:, None] - element.places[None]
    size = float(np.max(np.linalg.norm(apart, axis=-1)))
    if not size:
        return
    found = f"lowest elastic frequency {lowest:.4g} Hz with seats {size:.4g} m apart"
    remedy = 'check units: of a file in millimetres, tonnes and newtons they are "mm, t, s"'
    if np.isfinite(lowest) and lowest * size > FASTEST:
        raise InputError(key, None, f"{found}: waves would travel faster than in any metal", remedy)
    weight = "lighter than foam" if mass < LIGHTEST * size**3 else "heavier than lead"
    if np.isfinite(mass) and not LIGHTEST <= mass / size**3 <= HEAVIEST:
        raise InputError(key, None, f"{mass:.4g} kg with seats {size:.4g} m apart: {weight}", remedy)


def modal_damping(
    mass: Float[Array, "coordinate coordinate"],
    stiffness: Float[Array, "coordinate coordinate"],
    ratios: float | Float[Array, " coordinate"],
    rounding: float = ROUNDED_OFF,
) -> Float[Array, "coordinate coordinate"]:
    """Damping with which every mode has a ratio; rigid motions have none.

    M Φ diag(2 ζ ω) Φᵀ M with mass-normalised modes Φ; ζ is the mean of the coordinates' `ratios`, weighted by
    their kinetic energy in the mode. Squared frequencies below `rounding` of the largest are 0.
    """
    from scipy.linalg import eigh  # heavy, and most gearboxes need none

    squares, modes = eigh(stiffness, mass)
    moved = mass @ modes
    squares[squares < rounding * squares[-1]] = 0.0
    ratio = np.einsum("im,im,i->m", modes, moved, np.broadcast_to(ratios, len(moved)))
    damping = (moved * (2.0 * ratio * np.sqrt(np.maximum(squares, 0.0)))) @ moved.T
    return (damping + damping.T) / 2.0
