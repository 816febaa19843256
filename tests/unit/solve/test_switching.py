"""When switching within the mesh cycle changes its method, and how it tells stiffness."""

import numpy as np
import pytest

from tests.support.plain_kernels import make_plain, plain
from tests.support.states import PAIR
from tribodyn.solve.march.marching import SCRATCH
from tribodyn.solve.methods import dopri5, rodas4, switching
from tribodyn.solve.methods.switching import COUNT, EXPLICIT_RUN, STIFFNESS, WHICH


@pytest.fixture(autouse=True)
def plainly(monkeypatch):
    make_plain(monkeypatch, switching, dopri5, rodas4)


def stages(rates, step):
    """Rates of the stages of an explicit step of y' = f(y) from ones."""
    y, k, stage = np.ones(PAIR.states), np.zeros((7, PAIR.states)), np.ones(PAIR.states)
    k[0] = rates(y)
    for s in range(1, 7):
        dopri5.stage_state(s, step, y, k, stage, PAIR)
        stage[PAIR.mechanical :] = 0.0
        k[s] = rates(stage)
    return k


@pytest.mark.parametrize("fastest", [7.0, 40.0])
def test_stiffness_of_one_decay_is_its_rate_times_the_step(fastest):
    """All velocities decay alike: the last two stages tell it exactly; displacements say nothing."""
    decay = np.zeros(PAIR.states)
    decay[PAIR.half : PAIR.mechanical] = -fastest
    k = stages(lambda y: decay * y, 0.2)
    # both stages stand at the same phase: f(y7) − f(y6) = −λ (y7 − y6), and y7 − y6 = h Σ (a7 − a6) k
    assert np.sqrt(switching.explicit_stiffness(k, PAIR)) == pytest.approx(0.2 * fastest, rel=1e-9)
    k[:, : PAIR.half] = 1e9
    assert np.sqrt(switching.explicit_stiffness(k, PAIR)) == pytest.approx(0.2 * fastest, rel=1e-9)
    assert switching.explicit_stiffness(np.zeros((7, PAIR.states)), PAIR) == 0.0


def after(steps, stiffness, which=0.0):
    """Row of the choice after so many accepted steps, and whether the last begins fresh."""
    buffer = switching.buffer(PAIR)
    buffer[-1, WHICH] = which
    fresh = None
    for value in np.broadcast_to(stiffness, steps):
        buffer[-1, STIFFNESS] = value
        fresh = switching.accept(buffer, PAIR)
    return buffer[-1], fresh


def test_twelve_stiff_steps_in_a_row_hand_over():
    """Above 3 time constants a step, of which the square is kept; any other step begins the count anew."""
    mode, fresh = after(11, 9.1)
    assert (mode[WHICH], mode[COUNT], fresh) == (0.0, 11.0, False)
    mode, fresh = after(12, 9.1)
    assert (mode[WHICH], mode[COUNT], mode[EXPLICIT_RUN], fresh) == (1.0, 0.0, 0.0, True)
    mode, _ = after(12, 8.9)
    assert (mode[WHICH], mode[COUNT]) == (0.0, 0.0)
    mode, _ = after(20, [9.1] * 11 + [8.9] + [9.1] * 8)
    assert (mode[WHICH], mode[COUNT]) == (0.0, 8.0)


def test_five_hundred_explicit_steps_hand_over_for_a_try():
    assert after(499, 1.0)[0][WHICH] == 0.0
    mode, fresh = after(500, 1.0)
    assert (mode[WHICH], mode[EXPLICIT_RUN], fresh) == (1.0, 0.0, True)


def test_three_steps_that_are_not_stiff_hand_back():
    mode, fresh = after(2, 11.9, which=1.0)
    assert (mode[WHICH], mode[COUNT], fresh) == (1.0, 2.0, True)
    mode, fresh = after(3, 11.9, which=1.0)
    assert (mode[WHICH], mode[COUNT], fresh) == (0.0, 0.0, True)
    assert after(3, 12.1, which=1.0)[0][WHICH] == 1.0
    mode, _ = after(5, [11.0, 11.0, 12.5, 11.0, 11.0], which=1.0)
    assert (mode[WHICH], mode[COUNT]) == (1.0, 2.0)


def test_the_explicit_methods_last_rates_are_the_next_steps_first(rng):
    buffer = dopri5.buffer(PAIR)
    buffer[:] = rng.normal(size=buffer.shape)
    last = buffer[SCRATCH + 6].copy()
    assert dopri5.accept(buffer, PAIR) is False
    np.testing.assert_array_equal(buffer[SCRATCH], last)
    assert plain(rodas4.METHOD.accept)(buffer, PAIR) is True
