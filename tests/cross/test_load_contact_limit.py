"""The dynamic run at creeping speed carries the loads of the load contact model, corners included."""

import dataclasses

import numpy as np
import pytest

from tribodyn.compliance.flank_gap import flank_gap
from tribodyn.compliance.load_sharing import flexibility, share_load
from tribodyn.compliance.slices import face_positions
from tribodyn.dynamics.outputs import outputs
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.modification import UNMODIFIED, FlankModification, Misalignment, Modifications, Relief
from tribodyn.prepare import prepare
from tribodyn.scenario.load import family
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import Chunk, Settings, transient

SAMPLES = 100
TIP = FlankModification(tip=Relief(12e-6, 3e-3))


@pytest.mark.parametrize(
    ("modified", "slices"), [(UNMODIFIED, 1), (Modifications(TIP, TIP, Misalignment(5e-4)), 11)]
)
def test_creeping_run_is_the_load_contact_model(prepared, modified, slices):
    slow = {"operating.pinion_speed": "0.01 rad/s", "friction.coefficient": 0.0}
    case = prepared("involute-18-36-fem", **slow).case
    mesh = dataclasses.replace(case.mesh, modifications=modified, slices=slices)
    run = prepare(dataclasses.replace(case, mesh=mesh))
    settings = Settings("radau", 1e-8, 1, 100000, SAMPLES)
    chunks = [
        part
        for part in transient(run.model, static_equilibrium(run.model), settings, "radau")
        if isinstance(part, Chunk)
    ]
    cycles = np.concatenate([chunk.cycles for chunk in chunks])
    found = outputs(cycles, np.concatenate([chunk.states for chunk in chunks]), run.model)["normal_load"]

    case, cycle = run.case, run.cycle
    flexible = flexibility(assemble(family(case.family), case.drive), case.materials, lead=slices > 1)
    pitch = cycle.pitch_angle
    phase = np.arange(SAMPLES) / SAMPLES
    roll = cycle.roll_start + pitch * (phase[:, None] + np.array([1.0, 0.0]))
    gap = flank_gap(
        flexible.assembly,
        modified,
        pair_geometry(flexible.assembly, roll),
        face_positions(flexible.width, slices),
    )
    shared = share_load(flexible, roll, case.operating.gear_torque, 0.0, gap, slices)
    expected = shared.normal_load
    np.testing.assert_allclose(found[:SAMPLES], expected, atol=0.01 * expected.max())
    # early and late contact: some load outside the theoretical path, unless the tips are relieved
    outside = (roll < -0.2954 - 1e-3) | ((roll > 0.2670 + 1e-3) & (roll < cycle.roll_end))
    touches = np.any(found[:SAMPLES][outside] > 0.01 * expected.max())
    assert touches or modified != UNMODIFIED


def test_relieved_tips_quieten_the_running_pair(prepared):
    """Peak to peak of the dynamic transmission error at the relief's design torque, after 12 mesh cycles."""
    swings = []
    for name in ("involute-18-36-fem", "involute-18-36-tip-relief"):
        model = prepared(name).model
        settings = Settings("dopri5", 1e-6, 16, 100000, SAMPLES)
        chunks = [
            part
            for part in transient(model, static_equilibrium(model), settings, "dopri5")
            if isinstance(part, Chunk)
        ]
        cycles = np.concatenate([chunk.cycles for chunk in chunks])
        found = outputs(cycles, np.concatenate([chunk.states for chunk in chunks]), model)
        swings.append(np.ptp(found["transmission_error_rotational"][cycles > 12]))
    assert swings[1] < 0.2 * swings[0]
