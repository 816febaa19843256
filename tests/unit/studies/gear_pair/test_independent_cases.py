"""What a case of a sweep starts from does not depend on the cases done before it in the same process."""

import importlib

import numpy as np
import pytest

from tribodyn.dynamics.parameters import frictionless
from tribodyn.solve.initial import initial_state, static_equilibrium
from tribodyn.studies.gear_pair.batch import GearPairs
from tribodyn.studies.protocol.load import load_scenario

evaluate = importlib.import_module("tribodyn.studies.gear_pair.batch.evaluate")

MOVING_ERROR = {
    "harmonics": [{"order": 1, "amplitude": "8 um", "phase": "90 deg"}],
}


@pytest.mark.parametrize("torque", ["100 N*m", "500 N*m"])
def test_a_moving_error_does_not_carry_one_speed_over_to_another(torque: str, monkeypatch):
    keys = {"mesh.transmission_error": MOVING_ERROR, "operating.gear_torque": torque}
    cases = [
        load_scenario("jump-involute-23-47", {**keys, "operating.pinion_speed": f"{speed} rad/s"})
        for speed in (300, 500)
    ]
    settings = GearPairs().settings(cases, None, "native")

    def starts(order: list[int]) -> dict[int, bytes]:
        monkeypatch.setattr(evaluate, "_equilibria", type(evaluate._equilibria)())
        ready = {i: evaluate.prepare(cases[i], evaluate.tabulated(cases[i])) for i in order}
        return {i: evaluate._start(ready[i], settings).tobytes() for i in order}

    assert starts([0, 1]) == starts([1, 0]) == {**starts([0]), **starts([1])}
    assert np.all(np.isfinite(np.frombuffer(starts([1])[1])))


def test_where_cases_of_steady_states_and_of_marches_begin():
    """A steady state without friction and in creep, a march as its scenario says."""
    keys = {"mesh.transmission_error": MOVING_ERROR, "friction.law": "coulomb", "friction.coefficient": 0.1}
    for initial in ("static", "unloaded"):
        case = load_scenario("jump-involute-23-47", {**keys, "solver.initial": initial})
        prepared = evaluate.prepare(case, evaluate.tabulated(case))
        as_said = initial_state(prepared.model, initial)
        steady, marched = (GearPairs().settings([case], cycles, "native") for cycles in (None, 8))
        np.testing.assert_array_equal(evaluate._start(prepared, marched), as_said)
        begun = evaluate._start(prepared, steady)
        if initial == "unloaded":
            assert not np.any(begun)
            continue
        creeping = prepared.model._replace(
            mechanics=prepared.model.mechanics._replace(nominal_speed=evaluate.CREEP)
        )
        np.testing.assert_array_equal(begun, static_equilibrium(frictionless(creeping)))
        assert np.any(begun != as_said)
