"""What the film stores over time: the squeeze term of Reynolds' equation, on nodes that move.

The nodes stand at x = b(t) (X_e(t) + ξ), so that they widen with Hertz's contact and follow the end of the
film. Between a face i and the end of the film

    d/dt ∫ ρ h dx + (q − ρ h v)_end − (q − ρ h v)_i = 0

v = dx/dt of a face: mass is conserved to rounding. The end meets a full gap where it moves outwards. Time
derivatives of masses and of places are the same differences, so that nodes that move through a uniform film
make no flow.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.grid import FilmGrid


class Squeeze(NamedTuple):
    """Time derivatives in Hertz's units of the instant: `rate` times what is, less what was."""

    rate: float  # c b/(Δt u), c the difference formula's weight of the instant itself
    mass: Array  # of the masses ρ H ΔX that nodes up to the end held before, in the same measure (nodes,)
    place: Array  # of the places of the faces and, last, of the end (faces + 1,)


class Snapshot(NamedTuple):
    """What nodes and faces were at an instant: s, m² (∫ ρ/ρ0 h dx about the nodes up to the end), m."""

    time: float
    mass: Array
    place: Array


def cells(grid: FilmGrid) -> Array:
    """Lengths about the nodes up to the end of the film, from face to face."""
    length = grid.weight[: grid.end + 1].copy()
    length[-1] = 0.5 * grid.step[grid.end - 1]
    return length


def faces(grid: FilmGrid) -> Array:
    """Places ξ of the faces of the film and, last, of its end, relative to the end."""
    node = grid.node[: grid.end + 1]
    return np.append(0.5 * (node[1:] + node[:-1]), 0.0)


def squeeze_of(
    time: float, before: list[Snapshot], half_width: float, speed: float, film_unit: float
) -> Squeeze:
    """Return the difference formula at a time, s, from the last one or two instants, the latest last.

    Backward differences of second order over unequal steps; of first order (Euler) from one instant.
    """
    last = before[-1]
    step = time - last.time
    if len(before) == 1:
        own, mass, place = 1.0, last.mass, last.place
    else:
        ratio = step / (last.time - before[-2].time)
        older = ratio * ratio / (1.0 + ratio)
        own = (1.0 + 2.0 * ratio) / (1.0 + ratio)
        mass, place = (
            (1.0 + ratio) * new - older * old for new, old in zip(last[1:], before[-2][1:], strict=True)
        )
    way = step * speed
    return Squeeze(own * half_width / way, mass / (way * film_unit), place / way)


def mesh_speed(squeeze: Squeeze, end: float, grid: FilmGrid) -> Array:
    """Speed of the faces and, last, of the end, over u."""
    return squeeze.rate * (end + faces(grid)) - squeeze.place


def stored(squeeze: Squeeze, grid: FilmGrid, mass: Array) -> Array:
    """Rate at which mass is stored between each face and the end, over u ρ0 b²/R; `mass` is ρ H at nodes."""
    return behind(squeeze.rate * cells(grid) * mass - squeeze.mass)


def behind(value: Array) -> Array:
    """Sum, for each face, over the nodes between it and the end: over the first axis."""
    return np.cumsum(value[::-1], axis=0)[-2::-1]
