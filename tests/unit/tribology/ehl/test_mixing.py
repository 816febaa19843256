"""Anderson's mixing: exact for linear maps, the secant in one dimension, a fresh beginning."""

import numpy as np
import pytest

from tribodyn.tribology.ehl.coupled import MEMORY, Mixing


def test_a_linear_map_is_solved_in_as_many_steps_as_it_has_dimensions(rng):
    """And one more: x = A x + b, far from contracting; as GMRES does (Walker & Ni 2011)."""
    size = MEMORY
    matrix, right = 1.5 * rng.standard_normal((size, size)), rng.standard_normal(size)
    exact = np.linalg.solve(np.eye(size) - matrix, right)
    mixing, x = Mixing(), np.zeros(size)
    departures = []
    for _ in range(size + 2):
        departures.append(np.abs(x - exact).max())
        x = mixing.next(x, matrix @ x + right)
    assert departures[-1] < 1e-9 * np.abs(exact).max()
    assert min(departures[:-2]) > 1e-6


def test_the_first_step_goes_to_what_was_found_and_the_second_is_the_secant():
    mixing = Mixing()
    assert mixing.next(np.array([1.0]), np.array([3.0])) == 3.0
    # g(1) = 3, g(3) = 2: g − x falls from 2 to −1
    assert mixing.next(np.array([3.0]), np.array([2.0])) == pytest.approx(1 + 2 * 2 / 3)


def test_a_shorter_way_forgets_what_was_before():
    mixing, fresh = Mixing(), Mixing()
    for tried, found in ((0.0, 5.0), (5.0, -1.0), (2.0, 2.6)):
        mixing.next(np.array([tried]), np.array([found]))
    assert mixing.shorter(0.25) == pytest.approx(2.0 + 0.25 * 0.6)
    assert mixing.shorter(0.125) == pytest.approx(2.0 + 0.125 * 0.6)
    fresh.next(np.array([2.0]), np.array([2.6]))
    second = np.array([2.15]), np.array([2.45])
    assert mixing.next(*second) == pytest.approx(fresh.next(*second))


def test_only_the_last_steps_are_remembered(rng):
    """A sudden other map is found after as many steps as are remembered."""
    mixing = Mixing()
    for _ in range(20):
        mixing.next(rng.standard_normal(1), rng.standard_normal(1))
    x = np.array([0.3])
    for _ in range(MEMORY + 2):
        x = mixing.next(x, 4.0 - 3.0 * x)
    assert x == pytest.approx(1.0, abs=1e-9)
