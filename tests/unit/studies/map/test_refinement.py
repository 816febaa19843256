"""The adaptive grid of a map, on functions whose error of interpolation is known in closed form."""

import numpy as np
import pytest

from tribodyn.record.loss_map import GridValues
from tribodyn.studies.map.refinement import FLOOR, nodes_of, refined


def only(first: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Axes of which the first has several nodes."""
    return first, np.array([2.0]), np.array([3.0])


def test_what_is_linear_along_each_axis_needs_no_further_node():
    axes = np.linspace(0.0, 4.0, 3), np.linspace(1.0, 2.0, 2), np.linspace(5.0, 6.0, 2)
    grid = refined(axes, lambda p: 1.0 + p[:, 0] * p[:, 1] + p[:, 2], 1e-6, 1000)
    assert [len(axis) for axis in grid.axes] == [3, 2, 2]
    assert grid.error_max < 1e-12
    assert grid.checked >= 60


@pytest.mark.parametrize("accuracy", [0.1, 0.01, 0.001])
def test_a_parabola_is_halved_as_often_as_its_second_derivative_says(accuracy: float):
    """Of 1 + x² linear interpolation misses (b − a)²/4 in the middle of an interval."""
    grid = refined(only(np.array([0.0, 1.0])), lambda p: 1.0 + p[:, 0] ** 2, accuracy, 1000)
    x = grid.axes[0]
    miss = (x[1:] - x[:-1]) ** 2 / 4.0 / (1.0 + (0.5 * (x[1:] + x[:-1])) ** 2)
    assert 0.1 * accuracy < miss.max() <= accuracy
    assert grid.error_max <= 1.04 * miss.max()  # relative to the value the worst place is beside the middle
    assert grid.error_mean < grid.error_max


def test_the_nodes_that_were_asked_for_stay():
    asked = np.array([0.0, 0.3, 1.7]), np.array([1.0, 8.0]), np.array([2.0, 4.0])
    grid = refined(asked, lambda p: np.exp(p[:, 0]) + p[:, 1] ** 1.5 + 1.0 / p[:, 2], 0.01, 10_000)
    for axis, before in zip(grid.axes, asked, strict=True):
        assert set(before) <= set(axis)
        assert (np.diff(axis) > 0.0).all()
        assert len(axis) > len(before)


def test_the_estimate_is_that_of_a_dense_comparison():
    """Maximum and mean at points of its own are those of 40 000 others within a few tens of per cent."""

    def drag(p):
        bearing = 2.0 * np.exp(-(p[:, 2] - 300.0) / 30.0) * (0.3 + (p[:, 1] / 100.0) ** (2.0 / 3.0))
        return 0.02 * np.abs(p[:, 0]) ** 1.1 + bearing

    axes = np.linspace(-500.0, 500.0, 5), np.linspace(0.0, 300.0, 4), np.array([300.0, 340.0, 360.0])
    grid = refined((np.union1d(axes[0], 0.0), *axes[1:]), drag, 0.02, 20_000)
    points = np.random.default_rng(7).uniform([a[0] for a in axes], [a[-1] for a in axes], (40_000, 3))
    values = drag(nodes_of(grid.axes)).reshape([len(axis) for axis in grid.axes])
    missed = np.abs(GridValues(grid.axes, values)(*points.T) / drag(points) - 1.0)
    assert grid.error_max <= 0.02
    assert missed.max() < 0.03
    assert grid.error_mean == pytest.approx(missed.mean(), rel=0.6)


def test_a_grid_has_no_more_points_than_it_may():
    """What is left over is in the estimate."""
    axes = np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.array([0.0, 1.0])
    grid = refined(axes, lambda p: 1.0 + np.sum(p**4, axis=1), 1e-4, 100)
    assert np.prod([len(axis) for axis in grid.axes]) <= 100
    assert grid.error_max > 1e-4


def test_without_an_accuracy_the_axes_stay_and_the_error_is_told():
    """1 + x² between 0 and 1 misses (x − x²)/(1 + x²), at most (√2 − 1)/2 at x = √2 − 1."""
    grid = refined(only(np.array([0.0, 1.0])), lambda p: 1.0 + p[:, 0] ** 2, 0.0, 1000)
    assert len(grid.axes[0]) == 2
    assert grid.error_max == pytest.approx((np.sqrt(2.0) - 1.0) / 2.0, rel=1e-3)


def test_a_drag_that_vanishes_counts_as_a_share_of_the_largest():
    """|T|^1.5 through 0: relative to itself the first interval misses 41 % however short it is."""
    grid = refined(only(np.array([0.0, 100.0])), lambda p: p[:, 0] ** 1.5, 0.01, 1000)
    assert grid.error_max <= 0.01
    first = grid.axes[0][1]
    assert (0.5 - 0.5**1.5) * first**1.5 <= 0.01 * FLOOR * 100.0**1.5


def test_a_jump_ends_the_halving_and_is_told():
    grid = refined(only(np.array([0.0, 1.0])), lambda p: 1.0 + (p[:, 0] > 0.37), 0.01, 1000)
    assert len(grid.axes[0]) < 15
    assert np.diff(grid.axes[0]).min() == 2.0**-10
    assert 0.1 < grid.error_max < 1.0


def test_a_single_point_is_a_grid():
    grid = refined((np.array([1.0]),) * 3, lambda p: np.full(len(p), 2.0), 0.01, 10)
    assert (grid.error_max, grid.error_mean, grid.checked) == (0.0, 0.0, 0)


def test_the_same_call_gives_the_same_grid():
    axes = np.array([0.0, 2.0]), np.array([0.0, 1.0]), np.array([0.0, 3.0])
    first, again = (refined(axes, lambda p: np.exp(p.sum(axis=1)), 0.01, 5000) for _ in range(2))
    assert all(np.array_equal(a, b) for a, b in zip(first.axes, again.axes, strict=True))
    assert (first.error_max, first.error_mean) == (again.error_max, again.error_mean)
