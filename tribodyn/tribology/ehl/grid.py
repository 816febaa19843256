"""Nodes along the film, and how a half space deforms under pressures that are linear between them.

The nodes are refined at the inlet and the outlet of the contact, and wide where nothing happens.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array

#: Distance over cell size from which the kernel's expansion replaces the difference of its antiderivatives.
FAR = 30.0


def influence(place: Array, node: Array) -> Array:
    """∫ hat_j(x') ln|x − x'| dx' at places x for the hat functions of nodes; (places, nodes).

    Exact near the hat, by the second antiderivative x²/2 ln|x| − 3/4 x² of the logarithm; far from it, where
    differences of that lose digits, by the hat's moments up to the fourth.
    """
    step = np.diff(node)
    left = np.concatenate([[0.0], step])
    right = np.concatenate([step, [0.0]])
    away = place[:, None] - node[None, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        square = away * away
        second = np.where(square > 0.0, 0.25 * square * np.log(square), 0.0) - 0.75 * square
        slope = np.diff(second, axis=1) / step
        # first antiderivative, for the half hats at both ends
        first = np.where(square > 0.0, 0.5 * away * np.log(square), 0.0) - away
    near = np.empty_like(away)
    near[:, 1:-1] = np.diff(slope, axis=1)
    near[:, 0] = slope[:, 0] + first[:, 0]
    near[:, -1] = -slope[:, -1] - first[:, -1]
    size = np.maximum(left, right)
    far = np.abs(away) > FAR * size[None, :]
    return np.where(far, _expanded(away, left, right), near)


def _expanded(away: Array, left: Array, right: Array) -> Array:
    """The same by moments about the hat's centroid, to the fourth order of cell size over distance."""
    area = 0.5 * (left + right)
    centre = (right - left) / 3.0
    # moments about the node: ∫ hat s^k ds, s from −left to right
    m2 = (left**3 + right**3) / 12.0
    m3 = (right**4 - left**4) / 20.0
    m4 = (left**5 + right**5) / 30.0
    c2 = m2 - area * centre**2
    c3 = m3 - 3.0 * centre * m2 + 2.0 * area * centre**3
    c4 = m4 - 4.0 * centre * m3 + 6.0 * centre**2 * m2 - 3.0 * area * centre**4
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = 1.0 / (away - centre)
        square = inverse * inverse
        return (
            -0.5 * area * np.log(square)
            - 0.5 * c2 * square
            - c3 * square * inverse / 3.0
            - 0.25 * c4 * square * square
        )


def hertz_gap(x: Array) -> Array:
    """Gap of Hertz's line contact outside the half width 1, in units of b²/R; 0 inside."""
    beyond = np.maximum(np.abs(x), 1.0)
    root = np.sqrt(beyond * beyond - 1.0)
    return 0.5 * (beyond * root - np.log(beyond + root))


#: ∫ of Hertz's pressure √(1 − x²) over the half width 1.
HERTZ_LOAD = math.pi / 2.0


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
    count = number(fine)
    return np.interp(np.linspace(count[0], count[-1], int(np.ceil(count[-1] - count[0])) + 1), count, fine)


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
