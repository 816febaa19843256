"""The dynamic run at creeping speed carries the loads of the load contact model, corners included."""

import numpy as np

from tribodyn.compliance.load_sharing import flexibility, share_load
from tribodyn.dynamics.outputs import outputs
from tribodyn.geometry.assembly import assemble
from tribodyn.scenario.load import family
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import Chunk, Settings, transient

SAMPLES = 100


def test_creeping_run_is_the_load_contact_model(prepared):
    slow = {"operating.pinion_speed": "0.01 rad/s", "friction.coefficient": 0.0}
    run = prepared("involute-18-36-fem", **slow)
    settings = Settings("radau", 1e-8, 1, 100000, SAMPLES)
    chunks = [
        part
        for part in transient(run.model, static_equilibrium(run.model), settings, "radau")
        if isinstance(part, Chunk)
    ]
    cycles = np.concatenate([chunk.cycles for chunk in chunks])
    found = outputs(cycles, np.concatenate([chunk.states for chunk in chunks]), run.model)["normal_load"]

    case, cycle = run.case, run.cycle
    flexible = flexibility(assemble(family(case.family), case.drive), case.materials)
    pitch = cycle.pitch_angle
    phase = np.arange(SAMPLES) / SAMPLES
    roll = cycle.roll_start + pitch * (phase[:, None] + np.array([1.0, 0.0]))
    shared = share_load(flexible, np.minimum(roll, cycle.roll_end), case.operating.gear_torque)
    expected = shared.normal_load
    np.testing.assert_allclose(found[:SAMPLES], expected, atol=0.01 * expected.max())
    # early and late contact: some load outside the theoretical path
    outside = (roll < -0.2954 - 1e-3) | ((roll > 0.2670 + 1e-3) & (roll < cycle.roll_end))
    assert np.any(found[:SAMPLES][outside] > 0.01 * expected.max())
