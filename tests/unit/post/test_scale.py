"""Axes neither magnify rounding errors nor hide curves behind a spike."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from tribodyn.post.figures.panel import scale


def scaled(*curves, from_zero=False):
    axes = Figure().subplots()
    scale(axes, [np.asarray(curve, dtype=float) for curve in curves], from_zero)
    return axes.get_ylim(), [text.get_text() for text in axes.texts]


def test_zero_throughout_is_said():
    _, said = scaled(np.zeros(50))
    assert said == ["0 throughout"]


def test_a_constant_with_rounding_errors_is_a_level_line():
    (low, high), said = scaled(100.0 + 1e-9 * np.arange(50))
    assert (low, high) == pytest.approx((90.0, 110.0))
    assert said == []


def test_a_spike_does_not_hide_the_rest_and_is_said():
    wave = np.sin(np.linspace(0.0, 20.0, 400))
    spiked = wave.copy()
    spiked[200] = 50.0
    (low, high), said = scaled(spiked)
    assert -1.5 < low < -1.0
    assert 1.0 < high < 5.0
    assert said == ["▲ up to 50, cut off"]


def test_what_is_no_spike_is_shown_whole():
    (low, high), said = scaled(np.linspace(2.0, 7.0, 100), np.full(10, np.nan))
    assert low < 2.0
    assert high > 7.0
    assert said == []
    (low, high), _ = scaled(np.linspace(2.0, 7.0, 100), from_zero=True)
    assert low == 0.0


def test_nothing_is_said_to_be_nothing():
    _, said = scaled(np.full(5, np.nan))
    assert said == ["nothing to show"]
