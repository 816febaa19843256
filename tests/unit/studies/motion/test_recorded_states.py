"""States that a sweep records, from which a neighbour continues, have the names that it gives them."""

import numpy as np
import pytest

from tribodyn.studies.motion.batch import BATCH
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.batch import Chunk
from tribodyn.studies.protocol.load import load_scenario

# a law under which sweeps of pairs and of trains have machine code
SPEED = {"operating.pinion_speed": "20 rad/s", "mesh.damping_ratio": 0.1, "friction.law": "none"}
SHAFT = {
    **SPEED,
    "operating.source": "torque",
    "operating.speed_regulation": "10 N*m*s/rad",
    "operating.gear_torque": "300 N*m",
    "operating.shaft_stiffness": "2e4 N*m/rad",
    "operating.drive_inertia": "0.02 kg*m**2",
    "operating.shaft_damping": "2 N*m*s/rad",
}


@pytest.mark.parametrize("keys", [SPEED, SHAFT], ids=["speed", "shaft"])
def test_names_of_the_recorded_state(keys):
    case = load_scenario("crc-23-47", keys)
    settings = BATCH.settings([case], None, "native")
    names = list(BATCH.layout(settings).scales["state_variable"][1])

    def at(rows):
        return dict(zip(names, rows["state"][0], strict=True))

    rows = BATCH.evaluate(Chunk(np.arange(1), (case,)), settings, None)
    state = at(rows)
    model = prepare(case).model
    radius = float(model.meshes[0].driven_radius)
    assert -radius * state["turn_g"] == pytest.approx(rows["poincare_error"][0, 0], rel=1e-5)
    assert -radius * state["spin_g"] == pytest.approx(rows["poincare_rate"][0, 0], rel=1e-4)
    # the pinion's bearing carries what the gear's carries
    stiffness = model.links.stiffness
    for i, axis in enumerate("xy"):
        loads = [stiffness[k, i] * state[f"{axis}_{gear}"] for k, gear in enumerate("pg")]
        assert loads[0] == pytest.approx(-loads[1], rel=0.05)
    assert [value for name, value in state.items() if name == "lag" or name.startswith("work")] == [0.0] * 7
    if keys is SPEED:
        assert state["slip"] == 0.0
        assert not {"turn_m", "spin_m"} & set(state)
    else:
        assert 2e4 * state["turn_m"] == pytest.approx(300.0 * 23 / 47, rel=0.1)
        assert state["slip"] < 0.0
    # a cycle that begins there begins there
    chunk = Chunk(np.arange(1), (case,), rows["state"])
    again = BATCH.evaluate(chunk, BATCH.settings([case], 1, "native"), None)
    for name in ("poincare_error", "poincare_rate"):
        assert again[name][0, 0] == pytest.approx(rows[name][0, 0], rel=1e-6)
