"""What it costs that meshes beside the reference are located by its rotation and the static twist.

Against motions in which every mesh is where its own driver's actual rotation puts it. They start at rest, so
that there is more vibration than in steady motion. The differences are over the range of each coordinate.
"""

import numpy as np
import pytest

from tests.support.located_meshes import located_motion
from tests.support.soak_parameters import all_in_soak
from tests.support.states import sampled
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import TransientSettings
from tribodyn.solve.twist import static_twist
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.layout import displacements

CYCLES, SAMPLES = 1, 40


def differences(name, share, overrides=None, bare=False):
    """Maximum difference between the package's motion and one located by a share of the actual twist.

    Of a share of 0 the phases are the package's, with its static twist, else those of the teeth. `bare` puts
    nominal rotation from the teeth alone in the place of the package.
    """
    prepared = prepare(load_scenario(name, {"friction.law": "none", **(overrides or {})}))
    model, teeth = prepared.model, np.array(prepared.phases.meshes)
    start = static_equilibrium(model)
    if bare:
        states = located_motion(model, start, teeth, CYCLES, SAMPLES, 0.0).states
    else:
        _, states = sampled(model, TransientSettings("dopri5", 1e-9, CYCLES, 10**6, SAMPLES), start)
    phases = teeth if share else np.asarray(model.schedule.offset)[0]
    located = located_motion(model, start, phases, CYCLES, SAMPLES, share).states
    places = displacements(model.layout)
    away = np.max(np.abs(located - states)[:, places], axis=0)
    return float(np.max(away / np.ptp(states[:, places], axis=0)))


def test_without_twist_the_places_are_the_packages():
    """The two ways to integrate agree, so that what differs below is the places."""
    assert differences("two-stage-reducer", 0.0) < 1e-6


def test_a_mesh_that_the_reference_drives_is_where_its_driver_is():
    assert differences("two-pinions-bull-gear", 1.0) < 1e-6
    prepared = prepare(load_scenario("two-pinions-bull-gear"))
    assert not np.any(static_twist(prepared.model, [mesh.rate for mesh in prepared.case.meshes]))


@pytest.mark.parametrize("name", all_in_soak(["two-stage-reducer", "idler-train"], ["two-stage-reducer"]))
def test_what_the_fluctuating_twist_does_is_small_and_falls_with_it(name):
    """In proportion to a small load, as all displacements are; the static twist would do much more."""
    torque = {"two-stage-reducer": 1770.0, "idler-train": 260.0}[name]
    # at the full load deflections change which teeth touch, and the motion is no longer in proportion
    half, quarter = ({"operating.output_torque": f"{share * torque} N*m"} for share in (0.5, 0.25))
    found = differences(name, 1.0, half)
    assert found < 5e-3
    assert found / differences(name, 1.0, quarter) == pytest.approx(2.0, rel=0.1)
    assert differences(name, 1.0, half, bare=True) > 10.0 * found


def test_a_shaft_that_gives_way_twists_the_stages_against_each_other():
    """By a seventh of a cycle at rest, which the phases have; what is left is a hundredth of the range."""
    soft = {"shaft.0.stiffness": "2e4 N*m/rad"}
    prepared = prepare(load_scenario("two-stage-reducer", soft))
    load = 1770.0 * 23 / 57
    expected = -load / 2e4 * 23 / (2.0 * np.pi)
    phases = np.asarray(prepared.model.schedule.offset)[0] - np.array(prepared.phases.meshes)
    assert (phases[1] + 0.5) % 1.0 - 0.5 == pytest.approx(expected, rel=0.05)
    assert differences("two-stage-reducer", 1.0, soft) < 0.03
