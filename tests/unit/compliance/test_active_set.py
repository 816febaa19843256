"""Loads of places that touch, against every set of places that could; a local deflection that stiffens."""

from itertools import combinations

import numpy as np
import pytest

from tribodyn.compliance.sharing.active_set import _worst_only, press

PLACES, POSITIONS = 4, 3


@pytest.fixture
def problem(rng):
    half = rng.uniform(-1e-9, 1e-9, (POSITIONS, PLACES, PLACES))
    matrix = half @ np.swapaxes(half, -1, -2) / 1e-9 + 2e-9 * np.eye(PLACES)
    arm = rng.uniform(0.8, 1.0, (POSITIONS, PLACES))
    lever = rng.uniform(0.03, 0.05, (POSITIONS, PLACES))
    gap = rng.uniform(-2e-6, 12e-6, (POSITIONS, PLACES))
    return matrix, arm, lever, gap, np.array([3.0, 60.0, 400.0])


def own(load, hertz):
    """Local deflection h F^0.9, and its slope."""
    return hertz * load**0.9, 0.9 * hertz * load**-0.1


def carried_by(places, n, problem, hertz):
    """ξ and loads where these places touch; None where one would pull, or another would be passed through."""
    matrix, arm, lever, gap, torque = (field[n] for field in problem)
    count, load = len(places), np.full(len(places), 500.0)
    for _ in range(15):
        value, slope = own(np.maximum(load, 1e-9), hertz)
        system = np.zeros((count + 1, count + 1))
        system[:count, :count] = matrix[np.ix_(places, places)] + np.diag(slope)
        system[:count, count], system[count, :count] = -arm[places], lever[places]
        right = np.append(slope * load - value - gap[places], torque)
        solution = np.linalg.solve(system, right)
        if np.allclose(solution[:count], load, rtol=1e-13, atol=0.0):
            break
        load = np.maximum(solution[:count], 1e-9)
    load, deflection = solution[:count], solution[count]
    left = deflection * arm - gap - matrix[:, places] @ load
    idle = [i for i in range(PLACES) if i not in places]
    if load.min() <= 0 or any(left[i] > 0 for i in idle):
        return None
    # T grows with ξ by the loads of the places that touch
    stiffness = lever[places] @ np.linalg.solve(system[:count, :count], arm[places])
    return deflection, load, left, stiffness


def test_only_one_set_of_places_can_carry(problem):
    hertz = 1e-8
    found = press(problem[0], lambda _, load: own(load, hertz), *problem[1:])
    counts = set()
    for n in range(POSITIONS):
        sets = [list(some) for k in range(1, PLACES + 1) for some in combinations(range(PLACES), k)]
        states = [(some, carried_by(some, n, problem, hertz)) for some in sets]
        [(places, state)] = [(some, state) for some, state in states if state is not None]
        deflection, load, left, stiffness = state
        counts.add(len(places))
        wanted = np.zeros(PLACES)
        wanted[places] = load
        np.testing.assert_allclose(found.load[n], wanted, rtol=1e-9, atol=1e-9)
        assert found.deflection[n] == pytest.approx(deflection, rel=1e-10)
        assert found.stiffness[n] == pytest.approx(stiffness, rel=1e-8)
        # what a place's own load takes up: its share of the flexibility, and the local deflection
        takes = left + np.diag(problem[0][n]) * wanted
        np.testing.assert_allclose(found.overlap[n], takes, rtol=1e-8, atol=1e-15)
        assert problem[2][n] @ found.load[n] == pytest.approx(problem[4][n], rel=1e-12)
    assert len(counts) > 1


def test_loads_do_not_depend_on_the_other_positions(problem):
    def local(rows, load):
        assert len(rows) == len(load)
        return own(load, 1e-9 * (1.0 + rows[:, None]))

    whole = press(problem[0], local, *problem[1:])
    for n in (0, 2):
        alone = press(
            problem[0][[n]],
            lambda rows, load, n=n: own(load, 1e-9 * (1.0 + n + rows[:, None])),
            *(field[[n]] for field in problem[1:]),
        )
        np.testing.assert_allclose(alone.load[0], whole.load[n], rtol=1e-12)


def test_of_places_on_the_wrong_side_only_the_worst_changes():
    active = np.array([[True, True, False, False], [True, False, False, True]])
    load = np.array([[-5.0, 40.0, 0.0, 0.0], [80.0, 0.0, 0.0, 20.0]])
    overlap = np.array([[1.0, 1.0, 2.0, -9.0], [1.0, 3.0, 4.0, 8.0]])
    touching = np.array([[False, True, True, False], [True, True, True, True]])
    # the first pulls with 5 of 40, the third overlaps by 2 of 9; of the second row the third by 4 of 8
    changed = _worst_only(active, touching, load, overlap)
    assert changed.tolist() == [[True, True, True, False], [True, False, True, True]]
    right = np.array([[True, True, False, False]])
    assert _worst_only(right, right, load[:1], overlap[:1]).tolist() == right.tolist()
