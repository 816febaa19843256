"""When no step is possible any more, and why; and when a motion has grown without bound."""

from types import SimpleNamespace

import numpy as np
import pytest

from tests.support.states import PAIR, TURN_G
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.step_control import MINIMUM_STEP, refusal, unbounded
from tribodyn.train.structure import displacements

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
