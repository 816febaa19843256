"""When no step is possible any more, and why; how large steps are, and where they end as friction turns."""

from types import SimpleNamespace

import numpy as np
import pytest

from tests.support.states import PAIR, TURN_G
from tribodyn.solve.integrator import Status
from tribodyn.solve.march import explicit_8 as triple
from tribodyn.solve.march.step_control import (
    MINIMUM_STEP,
    NEAR,
    SHARES,
    UNLIMITED,
    next_share,
    refusal,
    unbounded,
)
from tribodyn.solve.methods import dopri5 as pair
from tribodyn.solve.methods import rodas4 as rosenbrock
from tribodyn.train.layout import displacements

SMALL, USUAL, LIMIT = MINIMUM_STEP / 2, 1e-3, 10


@pytest.mark.parametrize(
    ("steps", "step", "speed", "status"),
    [
        (0, USUAL, 1.0, Status.DONE),
        (LIMIT, USUAL, 1.0, Status.TOO_MANY_STEPS),
        (0, SMALL, 1.0, Status.STEP_TOO_SMALL),
        # steps vanish as the pinion stops; a light one still turns at a hundredth of its nominal speed then
        (0, SMALL, 0.01, Status.STALLED),
        (0, USUAL, 0.01, Status.DONE),
        # an engagement has taken all its kinetic energy
        (0, USUAL, 0.0, Status.STALLED),
    ],
)
def test_no_step_is_taken(steps, step, speed, status):
    """Speeds over a nominal 1 rad/s."""
    assert refusal(steps, LIMIT, step, speed, 1.0) == status


@pytest.mark.parametrize("place", range(PAIR.states))
def test_only_displacements_beyond_the_centre_distance_are_unbounded(place):
    """Of either sign, rotations at the pitch circle; speeds, the lag of time and the works have no bound."""
    mesh = SimpleNamespace(driver_radius=0.05, driven_radius=0.1, driver_sense=1.0, driven_sense=1.0)
    model = SimpleNamespace(meshes=(mesh,), options=SimpleNamespace(layout=PAIR))
    per_length = 10.0 if place == TURN_G else 1.0
    for value in (0.149, -0.149, 0.151, -0.151, 1e20):
        state = np.zeros(PAIR.states)
        state[place] = per_length * value
        assert unbounded(state, model) == (place in displacements(PAIR) and abs(value) > 0.15)


def test_steps_grow_and_shrink_as_their_error_says():
    """From an error e of order e^(1/p): 0.8 … 0.9 of the step that would have the error 1, within bounds."""
    assert pair.shrinkage(2.0) == pytest.approx(0.9 / 2.0 ** (1 / 5))
    assert pair.growth(0.5, 0.5) == pytest.approx(0.8 * 2.0**0.13)
    assert pair.growth(0.5, 1.0) == pytest.approx(0.8 * 2.0**0.17)
    assert (pair.growth(0.0, 1.0), pair.growth(1e9, 1.0), pair.shrinkage(1e9)) == (5.0, 0.2, 0.2)
    assert triple.shrinkage(2.0) == pytest.approx(0.9 / 2.0 ** (1 / 8))
    assert triple.growth(0.5) == pytest.approx(0.9 * 2.0 ** (1 / 8))
    assert (triple.growth(0.0), triple.growth(1e12), triple.shrinkage(1e12)) == (6.0, 0.3, 0.3)
    assert rosenbrock.shrinkage(2.0) == pytest.approx(0.9 / 2.0 ** (1 / 4))
    assert rosenbrock.growth(0.5, 0.5) == pytest.approx(0.8 * 2.0**0.16)
    assert rosenbrock.growth(0.5, 1.0) == pytest.approx(0.8 * 2.0**0.21)
    assert (rosenbrock.growth(0.0, 1.0), rosenbrock.growth(1e9, 1.0)) == (6.0, 0.2)
    assert rosenbrock.shrinkage(1e9) == 0.1


def test_steps_end_at_both_ends_of_the_width_at_a_fifth_of_it_and_where_sliding_vanishes():
    """The force is C1 at the ends of the width, 1 and -1; its coefficient has a kink at 0."""
    assert sorted(SHARES) == list(SHARES) == [-place for place in reversed(SHARES)]
    assert {-1.0, 0.0, 1.0} <= set(SHARES)
    for place, near in zip(SHARES, NEAR, strict=True):
        for direction in (1.0, -1.0):
            distance, allowed = next_share(place - 0.15 * direction, direction)
            assert distance == pytest.approx(0.15)
            assert allowed == near


def test_nothing_is_ahead_behind_the_last_place():
    assert next_share(1.5, 1.0)[0] == next_share(-1.5, -1.0)[0] == UNLIMITED
