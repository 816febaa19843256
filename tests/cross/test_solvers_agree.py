"""All solvers on the same right-hand side: one answer."""

import numpy as np
import pytest

from tests.support.states import TURN_G, sampled
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.methods import METHODS, Runs
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import TransientSettings, make_integrator

CYCLES, SAMPLES = 6, 100


def solve(model, method, rtol):
    _, states = sampled(model, TransientSettings(method, rtol, CYCLES, 100000, SAMPLES))
    assert states.shape[0] == CYCLES * SAMPLES + 1
    return states


@pytest.fixture(scope="module", params=["10 rad/s", "300 rad/s"])
def reference(request, prepared):
    model = prepared("crc-23-47", **{"operating.pinion_speed": request.param}).model
    return model, solve(model, "dop853", 1e-11)


QUICK = [name for name, entry in METHODS.items() if entry.runs is Runs.NATIVE]


@pytest.mark.slow
@pytest.mark.parametrize(
    "method",
    [*QUICK, *(pytest.param(name, marks=pytest.mark.soak) for name in METHODS if name not in QUICK)],
)
def test_dte_agrees_to_1e_4_of_its_range_at_rtol_1e_7(reference, method):
    model, exact = reference
    ours = solve(model, method, 1e-7)
    error = np.max(np.abs(ours[:, TURN_G] - exact[:, TURN_G])) / np.ptp(exact[:, TURN_G])
    assert error < 1e-4


@pytest.mark.parametrize("method", ["dop853", pytest.param("tsit5", marks=pytest.mark.slow)])
def test_independent_codes_agree(method, prepared):
    """The short part of the same: the native method, SciPy's and diffrax's at a tight tolerance."""
    model = prepared("crc-23-47", **{"operating.pinion_speed": "300 rad/s"}).model
    native, other = solve(model, "dopri5", 1e-9), solve(model, method, 1e-9)
    assert np.max(np.abs(native[:, TURN_G] - other[:, TURN_G])) / np.ptp(other[:, TURN_G]) < 1e-6


@pytest.mark.slow
def test_what_a_run_costs_is_the_sum_of_its_parts(prepared):
    """In one call or in two; every step of Tsitouras' method, refused ones too, has six evaluations."""
    model = prepared("crc-23-47", **{"operating.pinion_speed": "300 rad/s"}).model
    state = static_equilibrium(model)
    tolerances = tolerances_from(model, state, 1e-9, 10**6)
    whole, parts = (make_integrator("tsit5", model, SAMPLES, tolerances) for _ in range(2))
    cost = whole.integrate(state, 0, 2)
    first = parts.integrate(state, 0, 1)
    second = parts.integrate(first.state, 1, 1)
    assert cost.steps == first.steps + second.steps
    assert cost.evaluations == first.evaluations + second.evaluations
    assert cost.evaluations % 6 == 0
    assert 1.0 <= cost.evaluations / (6 * cost.steps) < 1.2
    # as many steps may be taken as the longer of the cycles takes, in all segments together
    most = max(first.steps, second.steps)
    for limit, status in ((most, Status.DONE), (most - 1, Status.TOO_MANY_STEPS)):
        limited = make_integrator("tsit5", model, SAMPLES, tolerances._replace(max_steps=limit))
        assert limited.integrate(state, 0, 2).status == status
