"""Markers on the edge of their axes are drawn whole, and lines that leave their axes are not drawn beyond."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from tribodyn.post.figures.drawing import with_whole_markers
from tribodyn.post.style import painted


def blue_below(ylim: tuple[float, float], marker: str) -> int:
    """Pixels of a line at y = 0 and 1 that are drawn outside the axes."""
    figure = Figure(figsize=(2, 2), dpi=100)
    axes = figure.add_axes((0.25, 0.25, 0.5, 0.5))
    axes.axis("off")
    axes.plot([0, 1], [0, 1], marker=marker, markersize=12, color="blue")
    axes.set(xlim=(0, 1), ylim=ylim)
    pixels = painted(with_whole_markers(figure), 100)
    outside = np.ones(pixels.shape[:2], bool)
    outside[50:151, 50:151] = False
    return int(np.sum((pixels[..., 2] > 200) & (pixels[..., 0] < 100) & outside))


def test_a_marker_on_the_edge_is_whole():
    half_a_marker = 0.5 * np.pi * (0.5 * 12 * 100 / 72) ** 2
    # three quarters of each of two markers at corners stand outside
    assert blue_below((0, 1), "o") == pytest.approx(2 * 1.5 * half_a_marker, rel=0.1)


@pytest.mark.parametrize(("ylim", "marker"), [((0.25, 1), "o"), ((0, 1), "")])
def test_lines_stay_inside(ylim: tuple[float, float], marker: str):
    assert blue_below(ylim, marker) == 0
