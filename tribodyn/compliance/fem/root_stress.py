"""Tangential stress along the root of a tooth from the displacements of its boundary.

The root's surface is free, so the stress along the profile follows from the strains in the surface alone,

    σ = E/(1 − ν²) (ε_t + ν ε_z),   ε_t = t · ∂u/∂s,   ε_z = ∂w/∂z.

ε_t is taken at the two Gauss points of each quadratic edge, where the derivative of an interpolated
displacement is right to one order more than elsewhere (J. Barlow, Int. J. Numer. Meth. Engng 10 (1976) 243).
"""

import numpy as np
from numpy.typing import NDArray

from tribodyn.numerics.shapes import Array, Float

_GAUSS = np.array([-1.0, 1.0]) / np.sqrt(3.0)


def edge_points(place: Float[Array, "2 node"]) -> Float[Array, "2 point"]:
    """Points (2, 2 R), m, at which `stress_rows` reads, of the boundary's nodes (2, 2 R + 1)."""
    shape = np.stack([_GAUSS * (_GAUSS - 1) / 2, 1 - _GAUSS**2, _GAUSS * (_GAUSS + 1) / 2])
    return np.einsum("dne,ng->deg", _by_edge(place), shape).reshape(2, -1)


def stress_rows(
    place: Float[Array, "2 node"], nodes: NDArray[np.int64], size: int, poisson_ratio: float, k: float
) -> Float[Array, "point dof"]:
    """Rows (2 R, dof) that take amplitudes of the displacement to the stress's, for unit Young's modulus.

    Parameters
    ----------
    place : (2, 2 R + 1), corner and middle nodes of R quadratic edges that follow each other, m
    nodes : (2 R + 1,), their numbers; u, v and w of a node follow each other in the degrees of freedom
    size : number of degrees of freedom
    poisson_ratio : ν
    k : wave number, rad/m
    """
    shape = np.stack([_GAUSS * (_GAUSS - 1) / 2, 1 - _GAUSS**2, _GAUSS * (_GAUSS + 1) / 2])
    slope = np.stack([_GAUSS - 0.5, -2 * _GAUSS, _GAUSS + 0.5])
    tangent = np.einsum("dne,ng->deg", _by_edge(place), slope)
    stretch = slope[None, :, None] * (tangent / np.sum(tangent**2, axis=0))[:, None]  # (2, node, edge, point)
    along = np.broadcast_to(poisson_ratio * k * shape[:, None], stretch.shape[1:])
    values = np.stack([*stretch, along]) / (1.0 - poisson_ratio**2)
    edges = values.shape[2]
    rows = np.zeros((edges, 2, size))
    for node in range(3):
        for component in range(3):
            at = 3 * nodes[node : node + 2 * edges - 1 : 2] + component
            rows[np.arange(edges), :, at] += values[component, node]
    return rows.reshape(2 * edges, size)


def edge_parameters(edges: int, refined: int) -> Float[Array, " point"]:
    """Where the points stand, in edges from the first one's beginning, when each is cut into `refined`."""
    return (np.arange(edges * refined)[:, None] + (1.0 + _GAUSS) / 2.0).ravel() / refined


def edge_values(corners: NDArray[np.int64], size: int) -> Float[Array, "point size"]:
    """Rows (2 R, size) that take values at R + 1 corners to the same points, linearly on each edge."""
    rows = np.zeros((len(corners) - 1, 2, size))
    edges = np.arange(len(corners) - 1)
    rows[edges, :, corners[:-1]] = (1.0 - _GAUSS) / 2.0
    rows[edges, :, corners[1:]] = (1.0 + _GAUSS) / 2.0
    return rows.reshape(-1, size)


def _by_edge(place: Float[Array, "2 node"]) -> Float[Array, "2 3 edge"]:
    """Nodes (2, 3, R) of every edge."""
    return np.stack([place[:, :-2:2], place[:, 1::2], place[:, 2::2]], axis=1)
