"""Deformation of a half space under a pressure that is linear between nodes."""

import math

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
