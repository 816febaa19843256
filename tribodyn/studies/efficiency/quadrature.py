"""Gauss-Legendre quadrature on both sides of the pitch point, crowded towards it.

At the pitch point of a cycloidal or parabolic path radius, rolling speeds and film go to zero and the
friction coefficient runs through its whole range over a fraction of a millimetre. With ψ = ψ_max t³ the
nodes crowd there and the integrand becomes smooth in t.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def gauss_legendre(points: int) -> tuple[Array, Array]:
    """Nodes and weights on [0, 1]."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return (1.0 + nodes) / 2.0, weights / 2.0


def from_pitch_point(end: float, points: int) -> tuple[Array, Array]:
    """Nodes between the pitch point (0) and `end` (either sign), and positive weights that sum to |end|."""
    t, weights = gauss_legendre(points)
    return end * t**3, abs(end) * 3.0 * t**2 * weights


def piecewise(breaks: Array, pitch_points: Array, points: int) -> tuple[Array, Array]:
    """Nodes and weights between the first and the last break, crowded towards the pitch points.

    Parameters
    ----------
    breaks : (n,), increasing; where the integrand may jump, both ends included
    pitch_points : (m,), those inside are breaks as well; a piece between two of them is split in its middle
    points : nodes per piece
    """
    start, end = breaks[0], breaks[-1]
    pitch = pitch_points[(pitch_points >= start) & (pitch_points <= end)]
    edges = np.unique(np.concatenate([breaks, pitch]))
    t, weights = gauss_legendre(points)
    nodes, sizes = [], []
    for low, high in pairwise(edges):
        if high - low < 1e-12:
            continue
        at_low, at_high = low in pitch, high in pitch
        halves = [(low, high)]
        if at_low and at_high:
            middle = (low + high) / 2
            halves = [(low, middle), (high, middle)]
        elif at_high:
            halves = [(high, low)]
        for origin, far in halves:
            if at_low or at_high:
                place, weight = from_pitch_point(far - origin, points)
            else:
                place, weight = (far - origin) * t, (far - origin) * weights
            nodes.append(origin + place)
            sizes.append(weight)
    order = np.argsort(np.concatenate(nodes))
    return np.concatenate(nodes)[order], np.concatenate(sizes)[order]
