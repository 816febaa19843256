"""Shafts on bearings in a housing: where loads bring them, and what is left of them to what they carry.

Shafts and housing are linear, rolling bearings are not: the equilibrium is the minimum of the potential
energy. About it the system is linear; all that no mesh acts on is condensed (R. J. Guyan, AIAA J. 3 (1965)
380), with the modes that it has while the rest is held, on request (R. R. Craig, M. C. C. Bampton, AIAA J. 6
(1968) 1313).
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.elastic.beam import DIRECTIONS, ShaftMetal, ShaftSection
from tribodyn.train.elastic.beam_matrices import SIX, matrices
from tribodyn.train.elastic.in_time import InTime, kept_in_time
from tribodyn.train.elastic.rolling_bearing import BallRow, BearingRows, BearingState, RollerRow, answer

#: Stiffness matrix of a support, five by five, N/m, N, N m/rad, as rows: hashable.
Matrix = tuple[tuple[float, ...], ...]
#: Residual over the load at which the equilibrium is settled; steps at most.
SETTLED, MOST_STEPS = 1e-10, 300
#: Least stiffness over the greatest, lengths by the shaft's, below which a point is not held.
LOOSE = 1e-9


class NotHeld(ValueError):
    """No equilibrium: the bearings do not hold a point in a direction; the text says in which."""

    point = 0  # its number


class PlacedBearing(NamedTuple):
    """A bearing of a shaft."""

    position: float  # along the shaft, m
    held: BallRow | RollerRow | BearingRows | Matrix
    seat: str | None = None  # of the housing; None: it stands still
    in_time: bool = False  # whether its force is evaluated in time: no matrix stands for it


class PlacedShaft(NamedTuple):
    """A shaft as drawn; m."""

    sections: tuple[ShaftSection, ...]
    metal: ShaftMetal
    density: float  # kg/m³
    points: tuple[float, ...]  # places of what it carries
    bearings: tuple[PlacedBearing, ...]
    spin: float  # rad/s, counter-clockwise


class ShaftSystem(NamedTuple):
    """Shafts in a housing, a `superelement.SuperElement`; None: it is stiff."""

    shafts: tuple[PlacedShaft, ...]
    housing: Any = None


class SystemMatrices(NamedTuple):
    """Linear matrices over all nodes of all shafts, six coordinates each, and those of the housing behind."""

    stiffness: Float[Array, "coordinate coordinate"]
    mass: Float[Array, "coordinate coordinate"]
    damping: Float[Array, "coordinate coordinate"]  # gyroscopic, and that of the housing
    points: tuple[int, ...]  # first coordinate of each point, shaft by shaft
    nodes: tuple[int, ...]  # of each bearing's node
    seats: tuple[int, ...]  # of each bearing's seat; -1: the ground
    bearings: tuple[PlacedBearing, ...]
    turns: tuple[int, ...]  # coordinates of the rotation of shafts about z
    nodal: int  # coordinates that are six of a node or a seat; behind them those of the housing's modes
    length: float  # of the longest shaft, m
    along: tuple[tuple[float, ...], ...]  # of every shaft the places of its nodes along it, m


class Settled(NamedTuple):
    """A system under loads."""

    structure: SystemMatrices
    moved: Float[Array, " coordinate"]
    bearings: tuple[BearingState, ...]  # forces of the shafts on them
    load: Float[Array, " coordinate"]

    @property
    def points(self) -> Float[Array, "point 6"]:
        """Displacements of the points."""
        return np.array([self.moved[first : first + SIX] for first in self.structure.points])

    def tangent(self) -> Float[Array, "coordinate coordinate"]:
        """Stiffness about the equilibrium."""
        return _tangent(self.structure, self.bearings)


class Reduced(NamedTuple):
    """What is left of a system: coordinates are six of each point, and behind them some of no body, in m.

    These are five of each node and seat of bearings in time that is no point, tilts times a length, and then
    the modal ones. What these bearings do is in `in_time` and nowhere else.
    """

    mass: Float[Array, "coordinate coordinate"]
    stiffness: Float[Array, "coordinate coordinate"]
    damping: Float[Array, "coordinate coordinate"]  # gyroscopic, and that of the housing
    force: Float[Array, " coordinate"]  # constant, so that −K q + f are the forces about the equilibrium
    modes: int  # coordinates of no body
    frequencies: tuple[float, ...]  # of the modes kept, the other coordinates held, Hz
    next_frequency: float  # of the lowest that is left out, Hz
    recovery: Float[Array, "whole coordinate"]  # displacement of all coordinates of the structure
    reaction: Float[Array, "bearing 5 coordinate"]  # forces of shafts on bearings, x, y, z and moments
    reaction_at_rest: Float[Array, "bearing 5"]
    in_time: tuple[InTime, ...] = ()


def structure_of(system: ShaftSystem, elements: int = 1) -> SystemMatrices:
    """Put shafts and housing together, of so many elements to each shaft at least."""
    parts, points, nodes, bearings, turns, along, count = [], [], [], [], [], [], 0
    for shaft in system.shafts:
        ends = np.cumsum([0.0, *(section.length for section in shaft.sections)])
        finest = ends[-1] / elements
        own = np.unique([*ends, *shaft.points, *(bearing.position for bearing in shaft.bearings)])
        places = [own[0]]
        for start, end in pairwise(own.tolist()):
            places += np.linspace(start, end, max(1, int(np.ceil((end - start) / finest - 1e-9))) + 1)[
                1:
            ].tolist()
        whole = np.zeros((3, SIX * len(places), SIX * len(places)))
        for first, (start, end) in enumerate(pairwise(places)):
            section = shaft.sections[int(np.searchsorted(ends, (start + end) / 2.0)) - 1]
            at = slice(SIX * first, SIX * (first + 2))
            stiffness, mass, gyroscopic = matrices(section, end - start, shaft.metal, shaft.density)
            whole[:, at, at] += np.array([stiffness, mass, shaft.spin * gyroscopic])
        parts.append(whole)
        points += [count + SIX * int(np.argmin(np.abs(np.subtract(places, point)))) for point in shaft.points]
        nodes += [
            count + SIX * int(np.argmin(np.abs(np.subtract(places, bearing.position))))
            for bearing in shaft.bearings
        ]
        bearings += shaft.bearings
        turns += [count + SIX * node + 5 for node in range(len(places))]
        along.append(tuple(map(float, places)))
        count += SIX * len(places)
    housing = system.housing
    if housing is not None:
        parts.append(np.array([housing.stiffness, housing.mass, housing.damping]))
    size = sum(part.shape[1] for part in parts)
    whole, at = np.zeros((3, size, size)), 0
    for part in parts:
        end = at + part.shape[1]
        whole[:, at:end, at:end] = part
        at = end
    seats = [
        count + housing.seat(one.seat) if housing is not None and one.seat is not None else -1
        for one in bearings
    ]
    length = max(sum(section.length for section in shaft.sections) for shaft in system.shafts)
    places = tuple(points), tuple(nodes), tuple(seats), tuple(bearings), tuple(turns)
    nodal = count if housing is None else count + SIX * len(housing.seats)
    return SystemMatrices(whole[0], whole[1], whole[2], *places, nodal, length, tuple(along))


def _answers(structure: SystemMatrices, moved: Float[Array, " coordinate"]) -> tuple[BearingState, ...]:
    states = []
    for bearing, node, seat in zip(structure.bearings, structure.nodes, structure.seats, strict=True):
        apart = moved[node : node + DIRECTIONS].copy()
        if seat >= 0:
            apart -= moved[seat : seat + DIRECTIONS]
        states.append(_state(bearing.held, apart))
    return tuple(states)


def _state(held: BallRow | RollerRow | BearingRows | Matrix, moved: Float[Array, "5"]) -> BearingState:
    if isinstance(held, BallRow | RollerRow | BearingRows):
        return answer(held, moved)
    matrix = np.array(held)
    force = matrix @ moved
    return BearingState(force, matrix, float(force @ moved) / 2.0, np.zeros(0))


def _rows(node: int, seat: int, size: int) -> Float[Array, "5 coordinate"]:
    """What the coordinates move a bearing's rings against each other by."""
    rows = np.zeros((DIRECTIONS, size))
    rows[:, node : node + DIRECTIONS] = np.eye(DIRECTIONS)
    if seat >= 0:
        rows[:, seat : seat + DIRECTIONS] -= np.eye(DIRECTIONS)
    return rows


def _tangent(
    structure: SystemMatrices, states: Sequence[BearingState], among: Sequence[bool] | None = None
) -> Float[Array, "coordinate coordinate"]:
    """Stiffness with all bearings, or with those that are `among` them."""
    tangent = structure.stiffness.copy()
    for number, (state, node, seat) in enumerate(zip(states, structure.nodes, structure.seats, strict=True)):
        if among is None or among[number]:
            rows = _rows(node, seat, len(tangent))
            tangent += rows.T @ state.stiffness @ rows
    return tangent


def settled(structure: SystemMatrices, loads: Sequence[Sequence[float]]) -> Settled:
    """Settle a structure under loads on its points: forces along x, y, z (N), moments (N m) about x and y.

    What else a load has twists shafts and is left out here. Newton's method, damped where a step raises the
    energy. Raises NotHeld.
    """
    size = len(structure.stiffness)
    free = np.setdiff1d(np.arange(size), structure.turns)
    scale = np.ones(size)  # all unknowns in m
    coordinates = np.arange(structure.nodal)
    scale[coordinates[coordinates % SIX > 2]] = 1.0 / structure.length
    outer = np.zeros(size)
    for first, load in zip(structure.points, loads, strict=True):
        outer[first : first + DIRECTIONS] += load[:DIRECTIONS]
    linear = structure.stiffness

    def look(moved: np.ndarray) -> tuple[float, np.ndarray, tuple[BearingState, ...]]:
        states = _answers(structure, moved)
        energy = moved @ linear @ moved / 2.0 - outer @ moved + sum(state.energy for state in states)
        force = linear @ moved - outer
        for state, node, seat in zip(states, structure.nodes, structure.seats, strict=True):
            force[node : node + DIRECTIONS] += state.force
            if seat >= 0:
                force[seat : seat + DIRECTIONS] -= state.force
        return float(energy), (force * scale)[free], states

    def stiffness(states: tuple[BearingState, ...]) -> np.ndarray:
        return (_tangent(structure, states) * np.outer(scale, scale))[np.ix_(free, free)]

    here = np.zeros(size)
    seen = look(here)
    tangent = stiffness(seen[2])
    damping = 1e-6 * float(np.mean(np.diag(tangent)))
    least = 1e-6 * damping  # without effect on what is held, and finite steps where nothing holds
    wanted = SETTLED * max(float(np.linalg.norm((outer * scale)[free])), 1.0)
    for _ in range(MOST_STEPS):
        energy, force, _ = seen
        if np.linalg.norm(force) <= wanted or np.max(np.abs(here)) > structure.length:
            break
        step = np.zeros(size)
        step[free] = np.linalg.solve(tangent + damping * np.eye(len(free)), -force)
        trial = look(here + step * scale)
        closer = np.linalg.norm(trial[1]) < np.linalg.norm(force)
        if trial[0] < energy or closer:  # energies of small steps differ by rounding alone
            here, seen, damping = here + step * scale, trial, max(damping / 10.0, least)
            tangent = stiffness(seen[2])
        else:
            damping *= 10.0
    values, vectors = np.linalg.eigh(tangent)
    if values[0] <= LOOSE * values[-1] or np.max(np.abs(here)) > structure.length:
        loose = vectors[:, 0] if values[0] <= LOOSE * values[-1] else (here / scale)[free]
        raise _not_held(structure, free, loose)
    if not np.linalg.norm(seen[1]) <= 1e3 * wanted:  # NaN neither
        raise NotHeld("the equilibrium of shafts and bearings is not found")
    return Settled(structure, here, seen[2], outer)


def _not_held(structure: SystemMatrices, free: np.ndarray, motion: np.ndarray) -> NotHeld:
    """What a motion that nothing holds is, by its largest share at a point, whose number it has."""
    names = ("along x", "along y", "along its axis", "against tilts about x", "against tilts about y")
    shares = {int(place): abs(float(value)) for place, value in zip(free, motion, strict=True)}
    moves = [(point, i) for point in range(len(structure.points)) for i in range(DIRECTIONS)]
    point, direction = max(moves, key=lambda move: shares[structure.points[move[0]] + move[1]])
    error = NotHeld(f"nothing holds it {names[direction]}")
    error.point = point
    return error


def reduced(state: Settled, modes_up_to: float = 0.0) -> Reduced:
    """Condense a settled system to its points and bearings in time.

    With the modes up to a frequency (Hz) while these are held.
    """
    from scipy.linalg import eigh  # heavy, and most gearboxes need none

    structure = state.structure
    size = len(structure.stiffness)
    of_points = [first + direction for first in structure.points for direction in range(SIX)]
    ends = zip(structure.bearings, structure.nodes, structure.seats, strict=True)
    scale_of = kept_in_time([end for end in ends if end[0].in_time], of_points)
    kept = np.array([*of_points, *scale_of])
    scale = np.array([*(1.0 for _ in of_points), *scale_of.values()])
    rest = np.setdiff1d(np.arange(size), kept)
    tangent = _tangent(structure, state.bearings, [not bearing.in_time for bearing in structure.bearings])
    inner = np.ix_(rest, rest)
    follows = np.zeros((size, len(kept)))
    follows[kept, np.arange(len(kept))] = scale
    # what turns without any spring, behind the last point of a shaft, turns with it
    follows[rest] = -np.linalg.solve(tangent[inner], tangent[np.ix_(rest, kept)] * scale)
    frequencies, shapes, beyond = [], np.zeros((size, 0)), np.inf
    mass_inside = structure.mass[inner]
    if modes_up_to > 0.0:
        squared, vectors = eigh(tangent[inner], mass_inside)
        found = np.sqrt(np.maximum(squared, 0.0)) / (2.0 * np.pi)
        count = int(np.searchsorted(found, modes_up_to))
        frequencies, beyond = found[:count].tolist(), float(found[count]) if count < len(found) else np.inf
        shapes = np.zeros((size, count))
        shapes[rest] = vectors[:, :count] * np.sqrt(_translating_mass(structure))
    recovery = np.hstack([follows, shapes])
    mass, damping = (recovery.T @ each @ recovery for each in (structure.mass, structure.damping))
    stiffness = recovery.T @ tangent @ recovery
    count = shapes.shape[1]
    stiffness[len(kept) :, : len(kept)], stiffness[: len(kept), len(kept) :] = 0.0, 0.0  # rounding
    at = np.concatenate([state.moved[kept] / scale, np.zeros(count)])
    load = np.concatenate([state.load[kept], np.zeros(count)])
    reaction = np.zeros((len(structure.bearings), DIRECTIONS, len(at)))
    in_time = []
    force = stiffness @ at - load
    for number, bearing in enumerate(state.bearings):
        rows = _rows(structure.nodes[number], structure.seats[number], size)
        if structure.bearings[number].in_time:
            own = np.zeros((DIRECTIONS, len(at)))
            own[:, : len(kept)] = rows[:, kept] * scale
            in_time.append(InTime(number, own, bearing, at))
            force = force + own.T @ bearing.force
        else:
            reaction[number] = bearing.stiffness @ rows @ recovery
    at_rest = np.array([bearing.force for bearing in state.bearings]) - reaction @ at
    symmetric = [(each + each.T) / 2.0 for each in (mass, stiffness)]
    return Reduced(
        symmetric[0],
        symmetric[1],
        damping,
        force,
        len(at) - len(of_points),
        tuple(frequencies),
        beyond,
        recovery,
        reaction,
        at_rest,
        tuple(in_time),
    )


def _translating_mass(structure: SystemMatrices) -> float:
    """Mass of the structure along x, kg: of shafts and the housing's seats."""
    along = np.zeros(len(structure.mass))
    along[: SIX * len(structure.turns) : SIX] = 1.0
    return float(along @ structure.mass @ along)
