"""A shaft on its bearings under the load of its gear: where it settles, and how stiff it is there.

The shaft is linear, bearings are not: the equilibrium is the minimum of the potential energy, which is convex
and so has one. About it the gear's displacement is linear in what its load changes by; leaving out all other
nodes, which carry no load, is exact.
"""

from collections.abc import Sequence
from typing import NamedTuple, NoReturn

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.links.beam import DIRECTIONS, ShaftMetal, ShaftSection, stiffness_between
from tribodyn.train.links.rolling_bearing import BallRow, BearingState, RollerRow, answer

#: Stiffness matrix of a support, five by five, N/m, N, N m/rad, as rows: hashable.
Matrix = tuple[tuple[float, ...], ...]
#: Residual over the load at which the equilibrium is settled; steps at most.
SETTLED, MOST_STEPS = 1e-10, 300
#: Least stiffness over the greatest, lengths by the shaft's, below which a gear is not held.
LOOSE = 1e-9


class Support(NamedTuple):
    """A bearing: its place along the shaft, m from its start, and what it is."""

    position: float
    held: BallRow | RollerRow | Matrix


class SupportedShaft(NamedTuple):
    """A shaft as drawn; m."""

    sections: tuple[ShaftSection, ...]
    gear_position: float  # of the middle of its gear's face
    supports: tuple[Support, ...]
    metal: ShaftMetal


class UnderLoad(NamedTuple):
    """A shaft under the load of its gear."""

    displacement: Float[Array, "5"]  # of the gear
    stiffness: Float[Array, "5 5"]  # at the gear, about this load
    bearings: tuple[BearingState, ...]  # their forces are those of the shaft on them


class NotHeld(ValueError):
    """No equilibrium: the bearings do not hold the gear in a direction; the text says in which."""

    point = 0  # number of what is not held, of several


def _state(held: BallRow | RollerRow | Matrix, moved: Float[Array, "5"]) -> BearingState:
    if isinstance(held, BallRow | RollerRow):
        return answer(held, moved)
    matrix = np.array(held)
    force = matrix @ moved
    return BearingState(force, matrix, float(force @ moved) / 2.0, np.zeros(0))


def under_load(shaft: SupportedShaft, load: Sequence[float]) -> UnderLoad:
    """Settle a shaft under a load on its gear: forces (N) along x, y, z, moments (N m) about x and y.

    Newton's method, damped where a step raises the energy. Raises NotHeld.
    """
    places = [shaft.gear_position, *(support.position for support in shaft.supports)]
    apart, at = np.unique(places, return_inverse=True)
    beam = stiffness_between(shaft.sections, shaft.metal, apart.tolist())
    length = sum(section.length for section in shaft.sections)
    scale = np.tile([1.0, 1.0, 1.0, 1.0 / length, 1.0 / length], len(apart))  # all unknowns in m
    beam = beam * np.outer(scale, scale)
    rows = [slice(DIRECTIONS * node, DIRECTIONS * (node + 1)) for node in at]
    outer = np.zeros(len(beam))
    outer[rows[0]] += load
    outer *= scale

    def look(u: np.ndarray) -> tuple[float, np.ndarray, np.ndarray, list[BearingState]]:
        energy, force, tangent, states = u @ beam @ u / 2.0 - outer @ u, beam @ u - outer, beam.copy(), []
        for support, at_node in zip(shaft.supports, rows[1:], strict=True):
            state = _state(support.held, (u * scale)[at_node])
            energy += state.energy
            force[at_node] += state.force * scale[at_node]
            tangent[at_node, at_node] += state.stiffness * np.outer(scale[at_node], scale[at_node])
            states.append(state)
        return energy, force, tangent, states

    here = np.zeros(len(beam))
    seen = look(here)
    damping = 1e-6 * float(np.mean(np.diag(beam)))
    least = 1e-6 * damping  # without effect on what is held, and finite steps where nothing holds
    size = max(float(np.linalg.norm(outer)), 1.0)  # N: preload alone settles too
    for _ in range(MOST_STEPS):
        energy, force, tangent, states = seen
        if np.linalg.norm(force) <= SETTLED * size or np.max(np.abs(here)) > length:
            break
        step = np.linalg.solve(tangent + damping * np.eye(len(beam)), -force)
        trial = look(here + step)
        closer = np.linalg.norm(trial[1]) < np.linalg.norm(force)
        if trial[0] < energy or closer:  # energies of small steps differ by rounding alone
            here, seen, damping = here + step, trial, max(damping / 10.0, least)
        else:
            damping *= 10.0
    _, _, tangent, states = seen
    gear = rows[0]
    others = np.setdiff1d(np.arange(len(beam)), np.arange(len(beam))[gear])
    _refuse_loose(tangent, gear)
    if not np.linalg.norm(seen[1]) <= 1e3 * SETTLED * size:  # NaN neither
        if np.max(np.abs(here)) > length:  # it runs away, whatever stiffness it meets there
            _refuse(here[gear])
        raise NotHeld("the equilibrium of shaft and bearings is not found")
    held = tangent[gear, gear].copy()
    if len(others):
        inner = np.linalg.solve(tangent[np.ix_(others, others)], tangent[others, gear])
        held -= tangent[gear, others] @ inner
    held /= np.outer(scale[gear], scale[gear])
    return UnderLoad((here * scale)[gear], (held + held.T) / 2.0, tuple(states))


def displacement_on(stiffness: Float[Array, "5 5"], load: Float[Array, "5"]) -> Float[Array, "5"]:
    """Where a gear on a stiffness matrix settles under a load; raises NotHeld where that does not hold it.

    Forces along x, y, z (N) and moments about x and y (N m) to displacements, m and rad.
    """
    moved, *_ = np.linalg.lstsq(stiffness, load, rcond=None)
    if np.max(np.abs(stiffness @ moved - load)) > 1e-6 * np.max(np.abs(load)):
        raise NotHeld(
            "does not hold the gear against the load of its mesh: it is zero in some direction of that"
        )
    return moved


def mesh_loads(
    tangential: float, radii: tuple[float, float], pressure_slope: float, helix_slope: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Load of a mesh on pinion and gear: forces along x, y, z (N), moments about x and y (N m).

    F_r = F_t tan α_t, F_a = F_t tan β, all in the middle of the face at the pitch `radii` (m). A negative
    tangential force loads the back flanks, which press the gears apart all the same. The pinion turns
    clockwise, seen from +z; its flanks move along +x at the pitch point, and y is from its centre to the
    gear's.
    """
    on_pinion = np.array([-tangential, -abs(tangential) * pressure_slope, -tangential * helix_slope])
    pinion, gear = (
        (*map(float, force), arm * float(force[2]), 0.0)
        for force, arm in ((on_pinion, radii[0]), (-on_pinion, -radii[1]))
    )
    return pinion, gear


def _refuse_loose(tangent: np.ndarray, gear: slice) -> None:
    """Refuse a direction in which nothing holds the shaft: it moves as a whole there."""
    values, vectors = np.linalg.eigh(tangent)
    if values[0] <= LOOSE * values[-1]:
        _refuse(vectors[gear, 0])


def _refuse(motion: np.ndarray) -> NoReturn:
    """Refuse a shaft whose gear is free to move so."""
    names = ("along x", "along y", "along its axis", "against tilts about x", "against tilts about y")
    raise NotHeld(f"nothing holds it {names[int(np.argmax(np.abs(motion)))]}")
