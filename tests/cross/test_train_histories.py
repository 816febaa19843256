"""A two-stage reducer of constant mesh stiffness after a step of its load: linear equations in another frame.

The package marches over mesh cycles in the bodies' own senses of rotation, with every mesh in its own frame.
"""

from typing import NamedTuple

import numpy as np
import pytest

from tests.support.spring_trains import Gears, in_global_frame, scenario_of, spring_model
from tests.support.states import sampled
from tests.support.two_stage_histories import (
    DAMPING_RATIO,
    LOAD,
    MODULES,
    TEETH,
    output_load,
    step_response,
    two_stage,
)
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import TransientSettings

DURATION, CYCLES, SAMPLES = 10e-3, 20, 10


class Motion(NamedTuple):
    """Times, displacements (time, coordinate), their rates, and forces (time, mesh)."""

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    mesh_force: np.ndarray
    torque: np.ndarray  # of the drive


def package_history(rigid, method, rtol, share=1.0):
    """From the equilibrium before the step, over mesh cycles that take the duration."""
    train = two_stage(rigid)
    gears = [Gears(*each) for each in zip(TEETH, MODULES, strict=True)]
    speed = 2.0 * np.pi / TEETH[0][0] * CYCLES / DURATION
    before, after = (
        spring_model(
            scenario_of(
                train,
                gears,
                DAMPING_RATIO,
                {"input_speed": f"{speed} rad/s", "output_torque": f"{share * torque} N*m"},
            )
        )
        for torque in LOAD
    )
    settings = TransientSettings(method, rtol, CYCLES, 10**6, SAMPLES)
    cycles, states = sampled(after.model, settings, static_equilibrium(before.model))
    seen = evaluated(cycles, states, after.model)
    loads = [mesh_outputs(m, seen)["normal_load"].sum(axis=1) for m in range(2)]
    return Motion(
        cycles * DURATION / CYCLES,
        in_global_frame(states, after),
        in_global_frame(states, after, rates=True),
        np.stack(loads, axis=1),
        seen.powers["drive_torque"],
    )


def worst(found, expected):
    """Maximum difference of any column over the column's maximum; nothing moves where nothing is due."""
    scale = np.max(np.abs(expected), axis=0)
    assert np.all(found[:, scale == 0.0] == 0.0)
    return np.max(np.max(np.abs(found - expected), axis=0)[scale > 0.0] / scale[scale > 0.0])


@pytest.mark.parametrize("rigid", [False, True])
@pytest.mark.parametrize(("method", "rtol"), [("dopri5", 1e-6), ("dopri5", 1e-10), ("rodas4", 1e-8)])
def test_the_motion_is_that_of_the_linear_equations(rigid, method, rtol):
    """Within what the tolerances of all steps add up to, of each coordinate's maximum."""
    found = package_history(rigid, method, rtol)
    train = two_stage(rigid)
    before, after = (output_load(train, torque) for torque in LOAD)
    expected = step_response(train, before, after, found.time)
    held = train.meshes[0].sense * expected.held_torque
    assert worst(found.displacement, expected.displacement) < 10.0 * rtol
    assert worst(found.velocity, expected.velocity) < 100.0 * rtol
    assert worst(found.mesh_force, expected.mesh_force) < 10.0 * rtol
    assert worst(found.torque[:, None], held) < 10.0 * rtol


@pytest.mark.parametrize("rigid", [False, True])
def test_a_multibody_program_finds_the_same_motion(rigid):
    """Against EXUDYN itself: its bodies' displacements change its geometry, less at less load."""
    pytest.importorskip("exudyn")
    from tools.peers.exudyn_train import exudyn_history

    for share, limit in ((1.0, 1e-3), (0.1, 1.2e-4)):
        found = package_history(rigid, "dopri5", 1e-8, share)
        theirs = exudyn_history(two_stage(rigid), share * LOAD[0], share * LOAD[1], found.time)
        moving = np.delete(np.arange(found.displacement.shape[1]), 2)  # all but the held rotation
        assert worst(theirs.displacement[:, moving], found.displacement[:, moving]) < limit
        assert worst(theirs.mesh_force, found.mesh_force) < limit
