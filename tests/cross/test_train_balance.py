"""What the meshes of the shipped trains do to their bodies, by vectors from what is evaluated, with friction.

Forces, moments and powers at every mesh and on every body, in one global frame.
"""

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import pytest

from tests.support.mesh_balance import forces_on_bodies, mesh_actions, residuals
from tests.support.states import sampled
from tests.support.train_matrices import Body, Mesh
from tribodyn.dynamics import approach
from tribodyn.dynamics.recorded.outputs import evaluated, mesh_outputs, train_outputs
from tribodyn.solve.initial import accelerations
from tribodyn.solve.transient import TransientSettings
from tribodyn.studies.motion.prepare import prepare
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.train.structure import shift_of, turn_of

TRAINS = ["two-stage-reducer", "idler-train", "two-pinions-bull-gear", "two-stage-reducer-hunting"]
CYCLES, SAMPLES = 3, 400  # of the reference mesh; in each


class Balanced(NamedTuple):
    """A run of a train with its record, and what others than the meshes do to the bodies."""

    model: Any
    meshes: list[Mesh]
    senses: np.ndarray
    bodies: list[Body]
    record: dict[str, np.ndarray]
    flanks: list[int]
    others: np.ndarray  # (time, body, 3)
    gained: np.ndarray  # mass times acceleration, likewise
    of_meshes: list[dict[str, np.ndarray]]
    of_train: dict[str, np.ndarray]


@lru_cache
def run(name: str) -> Balanced:
    prepared = prepare(load_scenario(name, {"friction.sliding": "dynamic"}))
    case, model = prepared.case, prepared.model
    layout = model.layout
    cycles, states = sampled(model, TransientSettings("dopri5", 1e-9, CYCLES, 10**6, SAMPLES))
    seen = evaluated(cycles, states, model)
    of_meshes = [mesh_outputs(m, seen) for m in range(layout.meshes)]
    of_train = train_outputs(seen, sum(each["sliding_loss"] for each in of_meshes))
    senses = np.array([case.bodies[body].sense for body in prepared.order])
    meshes = [
        Mesh(
            (driver, driven),
            (float(made.cycle.pinion_pitch_radius), float(made.cycle.gear_pitch_radius)),
            mesh.azimuth,
            np.nan,  # every pair has its own
            senses[driver],
            0.0,
        )
        for driver, driven, mesh, made in zip(
            layout.driver, layout.driven, case.meshes, prepared.tables, strict=True
        )
    ]
    record = {
        quantity: np.stack([each[quantity] for each in of_meshes], axis=1)
        for quantity in ("normal_load", "friction_force", "pressure_angle")
    }
    record["signed_distance"] = np.stack(
        [
            np.stack(
                [np.broadcast_to(work[approach.DISTANCE, i], len(cycles)) for i in range(model.pairs)],
                1,
            )
            for work in seen.work
        ],
        axis=1,
    )
    record["time"] = of_train["time"]
    record["velocity"] = np.stack([of_train[key] for key in ("x_rate", "y_rate", "speed")], axis=2)

    velocity = np.array(record["velocity"])
    rates = np.asarray(accelerations(states, seen.phase, seen.interval, model))
    seconds = model.operation.pitch_angle / velocity[:, 0, 2]
    places = np.array(
        [[shift_of(b), shift_of(b) + 1, turn_of(b, layout)] for b in range(layout.bodies)], dtype=int
    )
    at = states[:, places]
    at[:, 0, 2] = 0.0
    acceleration = rates[:, layout.half + places] / seconds[:, None, None]
    inertia = np.stack([model.bodies.mass, model.bodies.mass, model.bodies.inertia], axis=1)
    moved = np.array(velocity)
    moved[:, :, 2] = states[:, layout.half + places[:, 2]]
    others = np.zeros_like(at)
    for k, (one, two) in enumerate(zip(layout.first, layout.second, strict=True)):
        apart, apart_rate = (values[:, one] - (values[:, two] if two >= 0 else 0.0) for values in (at, moved))
        force = model.links.stiffness[k] * apart + model.links.damping[k] * apart_rate
        others[:, one] -= force
        if two >= 0:
            others[:, two] += force
    others[:, :, 2] -= model.bodies.load  # constant, no damping of the loads
    others[:, layout.input, 2] += of_train["drive_torque"]
    for values in (others, acceleration):
        values[:, :, 2] *= senses
    return Balanced(
        model,
        meshes,
        senses,
        [Body(mass, inertia) for mass, inertia in zip(model.bodies.mass, model.bodies.inertia, strict=True)],
        record,
        [int(side) for side in model.meshes[0].table.side],
        others,
        inertia * acceleration,
        of_meshes,
        of_train,
    )


def actions_of(balanced):
    return mesh_actions(balanced.record, balanced.meshes, balanced.senses, balanced.flanks)


@pytest.mark.parametrize("name", TRAINS)
def test_what_a_mesh_does_to_one_body_it_takes_from_the_other(name):
    balanced = run(name)
    assert all(np.max(np.abs(each["friction_force"])) > 50.0 for each in balanced.of_meshes)
    left = residuals(actions_of(balanced), balanced.meshes)
    assert left["force"] == 0.0
    assert left["moment"] < 1e-13
    assert left["power"] < 1e-10


@pytest.mark.parametrize("name", TRAINS)
def test_friction_takes_what_is_recorded_of_every_mesh(name):
    balanced = run(name)
    taken = actions_of(balanced).friction_power
    for m, of_mesh in enumerate(balanced.of_meshes):
        recorded = of_mesh["mesh_power_friction"]
        assert np.max(np.abs(taken[:, m] - recorded)) < 1e-9 * np.max(np.abs(recorded))
    np.testing.assert_allclose(
        taken.sum(axis=1), balanced.of_train["power_friction"], atol=1e-9 * np.max(taken)
    )


@pytest.mark.parametrize("name", TRAINS)
def test_forces_accelerate_the_bodies(name):
    """At every sample: of meshes, bearings, loads and drive together."""
    balanced = run(name)
    total = forces_on_bodies(actions_of(balanced), balanced.meshes, len(balanced.bodies)) + balanced.others
    scale = np.max(np.abs(balanced.others), axis=(0, 1))
    assert np.max(np.abs(total - balanced.gained) / scale) < 1e-11
    assert np.max(np.abs(total)[:, :, 2] / scale[2]) > 1e-3  # there is something to accelerate
