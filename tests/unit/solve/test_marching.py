"""How the march of a native method ends where it cannot go on."""

import numpy as np
import pytest

from tests.support.states import SLIP
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.march.step_control import MINIMUM_STEP, STANDSTILL
from tribodyn.solve.methods import integrator_class
from tribodyn.solve.tolerances import tolerances_from


def ended(model, state, method, max_steps=1000, step=None):
    integrator = integrator_class(method)(method, model, 8, tolerances_from(model, state, 1e-6, max_steps))
    if step is not None:
        integrator.step = step
    return integrator.integrate(state, 0, 1)


@pytest.mark.parametrize("method", ["dopri5", "rodas4"])
def test_steps_that_vanish_are_told_from_a_pinion_that_stops(prepared, method):
    """The same step: at speed it is too small, near standstill it is the standstill that is said."""
    model = prepared("crc-23-47", **{"operating.source": "torque"}).model
    state = static_equilibrium(model)
    tiny = 0.5 * MINIMUM_STEP
    at_speed = ended(model, state, method, step=tiny)
    assert at_speed.status == Status.STEP_TOO_SMALL
    slow = state.copy()
    slow[SLIP] = -(1.0 - 0.5 * STANDSTILL) * model.operation.nominal_speed
    stopping = ended(model, slow, method, step=tiny)
    assert stopping.status == Status.STALLED
    for found in (at_speed, stopping):
        assert found.steps == found.evaluations == 0
        assert found.reached == 0.0
    # the limit of steps is said first, whatever else is wrong
    assert ended(model, slow, method, max_steps=0, step=tiny).status == Status.TOO_MANY_STEPS


def test_a_pinion_that_turns_back_has_come_to_rest(prepared):
    model = prepared("crc-23-47", **{"operating.source": "torque", "operating.pinion_torque": "20 N*m"}).model
    state = np.zeros_like(static_equilibrium(prepared("crc-23-47").model))
    found = ended(model, state, "dopri5", 100000)
    assert found.status in (Status.STALLED, Status.DONE)
    for _ in range(3):
        if found.status == Status.DONE:
            found = ended(model, found.state, "dopri5", 100000)
    assert found.status == Status.STALLED


def test_a_stage_that_turns_the_pinion_back_is_no_standstill(prepared):
    """Started slowly by a strong motor: a first stage of DOP853 goes back, no accepted step does."""
    overrides = {"operating.source": "torque", "operating.pinion_torque": "500 N*m", "friction.law": "none"}
    model = prepared("crc-23-47", **overrides).model
    state = static_equilibrium(model)
    state[SLIP] = -0.97 * model.operation.nominal_speed
    found = {method: ended(model, state, method, 100000) for method in ("dopri5", "dop853")}
    for result in found.values():
        assert result.status == Status.DONE
    speeds = [result.state[SLIP] for result in found.values()]
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-4)


def test_switching_leaves_the_explicit_method_that_jumps_across_the_reversal(prepared):
    """A velocity's tolerance is wider than the reversal: the stages find friction constant, nothing stiff."""
    bearings = {
        f"bearings.{gear}.stiffness_{axis}": "1e6 N/m" for gear in ("pinion", "gear") for axis in "xy"
    }
    overrides = {"friction.sliding": "dynamic", "operating.pinion_speed": "1 rad/s"} | bearings
    model = prepared("crc-23-47", **overrides).model
    state = static_equilibrium(model)
    tolerances = tolerances_from(model, state, 1e-5, 20_000)
    for method in ("rodas4", "switching"):
        found = integrator_class(method)(method, model, 8, tolerances).integrate(state, 0, 1)
        assert found.status == Status.DONE
