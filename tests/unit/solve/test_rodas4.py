"""The stiff method step by step: its factors against NumPy's, its order on equations with known solutions."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.support.plain_kernels import make_plain, plain
from tests.support.states import PAIR
from tribodyn.solve.march.marching import ERROR, STATE, Place
from tribodyn.solve.methods import rodas4

STATES, MECHANICAL, HALF = PAIR.states, PAIR.mechanical, PAIR.half
MODEL = cast(Any, SimpleNamespace(options=SimpleNamespace(layout=PAIR)))


@pytest.fixture
def jacobian(rng):
    """Of displacements that follow velocities alone, and works that follow all."""
    matrix = np.zeros((STATES, MECHANICAL))
    matrix[:HALF, HALF:] = rng.normal(size=(HALF, HALF)) + 2.0 * np.eye(HALF)
    matrix[HALF:] = rng.normal(size=(STATES - HALF, MECHANICAL))
    return matrix


def test_the_equations_of_a_stage_are_solved(jacobian, rng):
    shift, right = 1.7, rng.normal(size=STATES)
    matrix, order, solution = np.zeros((HALF, STATES)), np.zeros(STATES), np.zeros(STATES)
    jacobian[HALF, HALF] = shift  # a first pivot near zero: rows must be exchanged
    plain(rodas4.factorise)(shift, jacobian, matrix, order, PAIR)
    whole = shift * np.eye(STATES)
    whole[:, :MECHANICAL] -= jacobian
    plain(rodas4.resolve)(shift, jacobian, matrix, order, right, solution, PAIR)
    np.testing.assert_allclose(solution, np.linalg.solve(whole, right), rtol=1e-9)
    assert np.any(order[:HALF] != np.arange(HALF))
    reduced = shift * np.eye(HALF) - jacobian[HALF:MECHANICAL, HALF:]
    reduced -= jacobian[HALF:MECHANICAL, :HALF] @ jacobian[:HALF, HALF:] / shift
    upper = np.triu(matrix[:, :HALF])
    assert abs(np.prod(np.diag(upper))) == pytest.approx(abs(np.linalg.det(reduced)), rel=1e-9)
    assert np.all(np.abs(np.tril(matrix[:, :HALF], -1)) <= 1.0)


def test_a_step_is_of_fourth_order_also_where_the_phase_drives(monkeypatch, rng, jacobian):
    """Vibrations that the phase pushes, and works that they do; errors fall by 2^5, samples inside by 2^4."""
    make_plain(monkeypatch, rodas4)
    push, phases = rng.normal(size=STATES), rng.uniform(0.0, 6.0, size=STATES)
    push[:HALF] = 0.0
    flow = 0.5 * jacobian

    def rates(phase, cycle, segment, y, model, work, out):
        out[:] = flow @ np.append(y[:HALF], np.sin(y[HALF:MECHANICAL])) + push * np.sin(3.0 * phase + phases)

    def exact_derivatives(place, y, f, scale, model, work, into):
        into.jacobian[:, :HALF] = flow[:, :HALF]
        into.jacobian[:, HALF:MECHANICAL] = flow[:, HALF:] * np.cos(y[HALF:MECHANICAL])
        into.slope[:] = 3.0 * push * np.cos(3.0 * place.phase + phases)
        return 17

    monkeypatch.setattr(rodas4, "rhs", rates)
    monkeypatch.setattr(rodas4, "differentiate", exact_derivatives)
    start, first = rng.normal(size=STATES), 0.3

    def slope(phase, y):
        out = np.zeros(STATES)
        rates(phase, 0.0, 0, y, None, None, out)
        return out

    ends, insides, embedded = [], [], []
    for step in (0.08, 0.04):
        buffer = rodas4.buffer(PAIR)
        control = cast(Any, SimpleNamespace(scale=np.ones(STATES)))
        place = Place(first, 0.0, 0, 1.0)
        count = rodas4.attempt(True, step, place, start, control, MODEL, cast(Any, None), buffer)
        assert count == 5 + 1 + 17
        exact = solve_ivp(
            slope, (first, first + step), start, "DOP853", [first + 0.4 * step, first + step], rtol=1e-12,
            atol=1e-13,
        ).y  # fmt: skip
        ends.append(np.abs(buffer[STATE] - exact[:, 1]).max())
        embedded.append(np.abs(buffer[ERROR]).max())
        inside = np.zeros(STATES)
        rodas4.sample(0.4, step, start, buffer, inside, PAIR)
        insides.append(np.abs(inside - exact[:, 0]).max())
        for share, end in ((0.0, start), (1.0, buffer[STATE])):
            rodas4.sample(share, step, start, buffer, inside, PAIR)
            np.testing.assert_allclose(inside, end)
        again = buffer.copy()
        count = rodas4.attempt(False, step, place, start, control, MODEL, cast(Any, None), buffer)
        assert count == 5
        np.testing.assert_array_equal(buffer[STATE], again[STATE])
    for errors, order in ((ends, 5.0), (insides, 4.0), (embedded, 4.0)):
        assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.6)
    assert ends[1] < 1e-5
    assert rodas4.accept(buffer, PAIR)


def test_stiffness_is_the_step_over_the_shortest_time(monkeypatch):
    """Of one fast oscillator: its angular frequency; of a strongly damped motion: its rate of decay."""
    buffer = rodas4.buffer(PAIR)
    matrix = buffer[rodas4._JACOBIAN :]
    matrix[2, HALF + 2], matrix[HALF + 2, 2] = 1.0, -400.0
    assert plain(rodas4.stiffness)(0.3, buffer, PAIR) == pytest.approx(0.3 * 20.0)
    matrix[HALF + 2, 2] = 0.0
    matrix[HALF + 4, HALF + 4] = -70.0
    assert plain(rodas4.stiffness)(0.3, buffer, PAIR) == pytest.approx(0.3 * 70.0)


def test_steps_stay_below_the_longest():
    adapted, longest = plain(rodas4.adapted), rodas4.LONGEST_STEP
    assert adapted(1e-3, 4.0, 1.0, None) == pytest.approx(1e-3 * 0.9 / 4.0**0.25)
    assert adapted(1e-3, 1.0, 1.0, None) == pytest.approx(0.8e-3)
    assert adapted(0.9 * longest, 1e-6, 1.0, None) == longest
    assert longest == pytest.approx(1 / 64)
