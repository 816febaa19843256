"""Quadrature from pitch point to pitch point: cusps are integrated exactly."""

import numpy as np
import pytest

from tribodyn.studies.efficiency.mesh_positions import from_pitch_point, piecewise


def test_pieces_are_crowded_towards_the_pitch_points():
    """Cusps and jumps are integrated exactly: cube roots of the distance from the nearest pitch point."""
    breaks, pitch = np.array([0.1, 0.3, 0.8, 1.0]), np.array([-0.2, 0.45, 0.55, 1.4])
    nodes, weights = piecewise(breaks, pitch, 5)
    # six pieces, that between the pitch points in two halves
    assert len(nodes) == len(weights) == 30
    assert np.all(np.diff(nodes) > 0.0)
    assert np.all(weights > 0.0)

    def cusp(x: float) -> float:
        if x < 0.3:
            return 7.0 * x**2
        return 5.0 * x**3 if x > 0.8 else 2.0 + min(abs(x - 0.45), abs(x - 0.55)) ** (1.0 / 3.0)

    roots = sum(0.75 * length ** (4.0 / 3.0) for length in (0.15, 0.05, 0.05, 0.25))
    whole = 7.0 * (0.3**3 - 0.1**3) / 3.0 + 2.0 * 0.5 + roots + 5.0 * (1.0 - 0.8**4) / 4.0
    assert sum(w * cusp(float(x)) for x, w in zip(nodes, weights, strict=True)) == pytest.approx(
        whole, rel=1e-12
    )
    near = nodes[np.searchsorted(nodes, 0.45)] - 0.45
    assert 0.0 < near < 0.01 * 0.05
    # of two breaks that are one but for rounding nothing lies between
    doubled, _ = piecewise(np.sort([*breaks, 0.3 + 5e-13]), pitch, 5)
    assert len(doubled) == 30
    # a pitch point at either end
    nodes, weights = piecewise(np.array([0.0, 1.0]), np.array([1.0]), 4)
    assert weights @ (1.0 - nodes) ** (2.0 / 3.0) == pytest.approx(0.6, rel=1e-12)
    nodes, weights = piecewise(np.array([0.0, 1.0]), np.array([0.0]), 4)
    assert weights @ nodes ** (2.0 / 3.0) == pytest.approx(0.6, rel=1e-12)


@pytest.mark.parametrize("end", [0.7, -0.4])
def test_from_the_pitch_point_outwards(end: float):
    nodes, weights = from_pitch_point(end, 6)
    assert np.all(nodes * end > 0.0)
    assert weights.sum() == pytest.approx(abs(end), rel=1e-14)
    assert weights @ np.abs(nodes) ** (4.0 / 3.0) == pytest.approx(
        abs(end) ** (7.0 / 3.0) * 3.0 / 7.0, rel=1e-13
    )
