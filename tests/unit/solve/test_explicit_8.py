"""Steps of the native explicit methods against SciPy's, on equations that the phase drives."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from scipy.integrate import DOP853, RK45

from tests.support.plain_kernels import plain
from tests.support.states import PAIR
from tribodyn.solve.march import explicit_8
from tribodyn.solve.march.marching import ERROR, SCRATCH, STATE, Place, scratch_buffer
from tribodyn.solve.methods import dopri5

NONE = cast(Any, None)
STATES, MECHANICAL = PAIR.states, PAIR.mechanical


@pytest.mark.parametrize(("method", "theirs"), [(dopri5, RK45), (explicit_8, DOP853)])
def test_a_step_is_that_of_scipy(monkeypatch, rng, method, theirs):
    matrix = rng.normal(size=(STATES, STATES))
    matrix[:, MECHANICAL:] = 0.0
    start, first, step = rng.normal(size=STATES), 0.35, 0.2

    def slope(phase, y):
        return np.sin(matrix @ y) + np.cos(3.0 * phase + np.arange(STATES))

    def derivatives(phase, cycle, segment, y, model, work, out):
        assert (cycle, segment) == (4.0, 1)
        out[:] = slope(phase, y)

    monkeypatch.setattr(method, "derivatives", derivatives)
    stages = {dopri5: 7, explicit_8: 13}[method]
    buffer = method.buffer(PAIR)
    assert buffer.shape == scratch_buffer(stages, PAIR).shape == (SCRATCH + stages, STATES)
    model = cast(Any, SimpleNamespace(options=SimpleNamespace(layout=PAIR)))
    attempt, place = plain(method.attempt), Place(first, 4.0, 1, 1.0)
    assert attempt(True, step, place, start.copy(), NONE, model, NONE, buffer) == stages
    solver = theirs(slope, first, start, 9.0, first_step=step, rtol=1e3, atol=1e3)
    solver.step()
    assert solver.t == pytest.approx(first + step)
    np.testing.assert_allclose(buffer[STATE], solver.y, rtol=1e-12)
    if method is dopri5:
        error = np.abs(solver._estimate_error(solver.K, step))
        inside = np.zeros(STATES)
        for share in (0.0, 0.3, 0.6, 1.0):
            plain(method.sample)(share, step, start, buffer, inside, PAIR)
            np.testing.assert_allclose(inside, solver.dense_output()(first + share * step), rtol=1e-10)
    else:
        k = solver.K[:13]
        fifth, third = (np.abs(weights @ k) for weights in (solver.E5, solver.E3))
        error = step * fifth**2 / np.sqrt(fifth**2 + 0.01 * third**2)
        inside = np.zeros(STATES)
        plain(method.sample)(0.3, step, start, buffer, inside, PAIR)
        np.testing.assert_allclose(inside, 0.7 * start + 0.3 * buffer[STATE], rtol=1e-12)
    np.testing.assert_allclose(np.abs(buffer[ERROR]), error, rtol=1e-8, atol=1e-15)
    # the next step begins with the last rates
    middle = buffer[STATE].copy()
    assert plain(method.accept)(buffer, PAIR) is False
    further = Place(first + step, 4.0, 1, 1.0)
    assert attempt(False, 0.1, further, middle.copy(), NONE, model, NONE, buffer) == stages - 1
    solver = theirs(slope, first + step, middle, 9.0, first_step=0.1, rtol=1e3, atol=1e3)
    solver.step()
    np.testing.assert_allclose(buffer[STATE], solver.y, rtol=1e-12)
    adapted = plain(method.adapted)
    assert adapted(0.1, 1.0, 1.0, NONE) < 0.1 * 1.01
    order = 5 if method is dopri5 else 8
    assert adapted(0.1, 1.5, 1.0, NONE) == pytest.approx(0.09 * 1.5 ** (-1.0 / order))
    assert adapted(0.1, 1e-3, 1.0, NONE) > 0.1
