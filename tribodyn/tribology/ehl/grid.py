"""Nodes along the film: refined at the inlet and the outlet of the contact, wide where nothing happens."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array
from tribodyn.tribology.ehl.elasticity import influence

#: Steps between nodes over the distance from inlet and end of the film: h_c within 0.01 %, h_min 0.2 %.
STEP = 0.1
#: Length of the film before the contact over `film_width`; twice as much raises no film by 0.01 %.
FLOODED = 60.0


class FilmGrid(NamedTuple):
    """Nodes and what depends on them alone; faces are those between the nodes of the film."""

    node: Array  # places ξ relative to the end of the film, in half widths b
    end: int  # number of the node where the film ends, ξ = 0: the last one between smooth surfaces
    step: Array  # distances between nodes
    weight: Array  # of the pressures at the nodes in ∫ P dξ
    #: (3, faces) weights of the nodes i − 1, i, i + 1 in the value at face i + ½, third order, upwind
    upwind: Array
    deformation: Array  # (nodes, nodes) of the pressures in the film at nodes, −influence/π
    face_deformation: Array  # (faces, nodes) the same at the faces, by `upwind`


def film_width(film: float) -> float:
    """Length over which the gap outside the contact rises by the film, in b, of a film in b²/R.

    Beside a Hertz contact the gap is (2√2/3) ΔX^(3/2), under a rigid cylinder X²/2.
    """
    return max((1.06 * film) ** (2.0 / 3.0), np.sqrt(2.0 * film) if film > 1.0 else 0.0)


def placed(film: float, step: float, beyond: float = 0.0, thickest: float = 0.0) -> Array:
    """Places of the nodes for a central film in b²/R; `step` is the step over the distance from both ends.

    The density of nodes is Σ 1/√(δ² + (ξ − ξ_k)²)/step about the end of the film, ξ = 0, and the inlet two
    half widths before it, δ = `film_width`. The film begins 60 δ before the contact: where it is `FLOODED`.
    Nodes go on for `beyond` behind the film. For films between `film` and `thickest` the nodes are as dense
    as the thinner and reach as far as the thicker one needs.
    """
    width = film_width(film)
    extent = 3.0 + FLOODED * film_width(max(film, thickest))

    def number(place: Array) -> Array:
        return (np.arcsinh(place / width) + np.arcsinh((place + 2.0) / width)) / step

    near = np.geomspace(1e-3 * min(width, 1.0), 1.0, 400)
    fine = np.concatenate([-2.0 - near[::-1], [-2.0], -2.0 + near, -near[-2::-1], [0.0]])
    far = np.geomspace(3.0, extent, 400)[1:] * -1.0
    node = _spaced(np.concatenate([far[::-1], fine]), number)
    node[-1] = 0.0
    if beyond == 0.0:
        return node
    return np.concatenate([node, _spaced(np.concatenate([[0.0], near * beyond]), number)[1:]])


def _spaced(fine: Array, number: Callable[[Array], Array]) -> Array:
    """Places from the first to the last of `fine` at which `number` has gone on by equal parts, 1 at most."""
    known = number(fine)
    return np.interp(np.linspace(known[0], known[-1], int(np.ceil(known[-1] - known[0])) + 1), known, fine)


def made(node: Array) -> FilmGrid:
    """Return the grid of these nodes."""
    step = np.diff(node)
    weight = 0.5 * (np.concatenate([step, [0.0]]) + np.concatenate([[0.0], step]))
    deformation = influence(node, node) / -np.pi
    end = int(np.argmin(np.abs(node)))
    upwind, filled = _upwind(node[: end + 1]), deformation[: end + 1]
    face = upwind[1][:, None] * filled[:-1] + upwind[2][:, None] * filled[1:]
    face[1:] += upwind[0][1:, None] * filled[:-2]
    return FilmGrid(node, end, step, weight, upwind, deformation, face)


def _upwind(node: Array) -> Array:
    """Weights of the parabola through nodes i − 1, i, i + 1 at face i + ½; of the line at the first face."""
    weights = np.zeros((3, len(node) - 1))
    weights[1:, 0] = 0.5
    a, b, c = node[:-2], node[1:-1], node[2:]
    at = 0.5 * (b + c)
    weights[0, 1:] = (at - b) * (at - c) / ((a - b) * (a - c))
    weights[1, 1:] = (at - a) * (at - c) / ((b - a) * (b - c))
    weights[2, 1:] = (at - a) * (at - b) / ((c - a) * (c - b))
    return weights


def at_faces(grid: FilmGrid, value: Array) -> Array:
    """Values at the faces from those at the nodes."""
    face = grid.upwind[1] * value[:-1] + grid.upwind[2] * value[1:]
    face[1:] += grid.upwind[0][1:] * value[:-2]
    return face
