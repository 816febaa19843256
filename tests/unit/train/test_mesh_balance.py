"""The balance of meshes from a record, on motions that others integrated in other coordinates."""

from typing import NamedTuple

import jax
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.support.idler_lagrangian import ENDS, SAMPLE, accelerations, mesh_forces, sliding, speeds
from tests.support.mesh_balance import forces_on_bodies, mesh_actions, momentum_residuals, residuals
from tests.support.train_matrices import (
    BACK,
    DRIVING,
    Bearing,
    Body,
    Mesh,
    Train,
    damping_matrix,
    in_own_senses,
    senses,
    stiffness_matrix,
)
from tests.support.two_stage_histories import LOAD, output_load, step_response, two_stage

SPEED = 40.0  # rad/s, of the input
#: Simpson's rule on samples that are this dense, over the greatest impulse.
DENSE = 1e-6


class Motion(NamedTuple):
    """A record, and the forces on bodies that do not come from meshes (time, body, 3)."""

    train: Train
    record: dict[str, np.ndarray]
    others: np.ndarray

    def with_meshes(self, record=None):
        actions = mesh_actions(record or self.record, self.train.meshes, np.array(senses(self.train)))
        return actions, forces_on_bodies(actions, self.train.meshes, len(self.train.bodies)) + self.others

    def momentum(self, record=None):
        _, forces = self.with_meshes(record)
        return momentum_residuals(self.record, forces, self.train.bodies, np.array(senses(self.train)))


def as_recorded(velocity, train, nominal):
    """(time, coordinate) about uniform rotation to (time, body, 3) with it."""
    found = in_own_senses(velocity, train)
    found[:, :, 2] += nominal
    return found


def without_meshes(train, displacement, velocity):
    """Forces of bearings and shafts, (time, body, 3)."""
    bare = train._replace(meshes=())
    forces = displacement @ stiffness_matrix(bare) + velocity @ damping_matrix(bare)
    return -forces.reshape(len(displacement), -1, 3)


def reducer():
    """The load step of the two-stage reducer, without friction; contacts pass along the lines of action."""
    train = two_stage()
    before, after = (output_load(train, torque) for torque in LOAD)
    history = step_response(train, before, after, np.linspace(0.0, 4e-3, 2001))
    first, second = (mesh.radii[0] / mesh.radii[1] for mesh in train.meshes)
    count = len(history.time)
    distance = np.linspace(-2e-3, 2e-3, count)
    record = {
        "time": history.time,
        "velocity": as_recorded(
            history.velocity, train, SPEED * np.array([1.0, first, first, first * second])
        ),
        "normal_load": history.mesh_force[:, :, None],
        "friction_force": np.zeros((count, 2, 1)),
        "pressure_angle": np.full((count, 2, 1), train.meshes[0].pressure_angle),
        "signed_distance": np.stack([distance, -distance], axis=1)[:, :, None],
    }
    others = without_meshes(train, history.displacement, history.velocity)
    others += after.reshape(4, 3)
    others[:, 0, 2] += history.held_torque[:, 0]
    return Motion(train, record, others)


def idler(sense):
    """An idler with friction from rest, by Lagrange's equations."""
    given = SAMPLE._replace(sense=float(sense), torque=sense * SAMPLE.torque)
    rates = jax.jit(lambda q, v: accelerations(q, v, given))

    def right_hand_side(_, y):
        return np.append(y[9:], np.ravel(rates(y[:9].reshape(3, 3), y[9:].reshape(3, 3))))

    times = np.linspace(0.0, 1e-3, 801)
    solution = solve_ivp(
        right_hand_side, (0.0, times[-1]), np.zeros(18), "DOP853", times, rtol=1e-9, atol=1e-12, max_step=1e-5
    )
    displacement, velocity = solution.y[:9].T, solution.y[9:].T
    load = jax.vmap(lambda q, v: mesh_forces(q, v, given))(
        displacement.reshape(-1, 3, 3), velocity.reshape(-1, 3, 3)
    )
    radii = given.base_radii / np.cos(given.pressure_angle)[:, None]
    train = Train(
        tuple(Body(*both) for both in zip(given.mass, given.inertia, strict=True)),
        tuple(Bearing(i, given.bearing_stiffness[i], given.bearing_damping[i]) for i in range(3)),
        meshes=tuple(
            Mesh(ENDS[m], tuple(radii[m]), given.azimuth[m], given.pressure_angle[m], sense * (-1) ** m, 0.0)
            for m in range(2)
        ),
    )
    ones = np.ones((len(times), 1, 1))
    record = {
        "time": times,
        "velocity": as_recorded(velocity, train, np.asarray(speeds(given, SPEED))),
        "normal_load": np.asarray(load)[:, :, None],
        "friction_force": given.friction[:, None] * ones,
        "pressure_angle": given.pressure_angle[:, None] * ones,
        "signed_distance": given.distance[:, None] * ones,
    }
    others = without_meshes(train, displacement, velocity)
    others[:, :, 2] += given.torque
    return Motion(train, record, others)


@pytest.fixture(scope="module", params=["reducer", "idler", "idler, clockwise"])
def motion(request):
    return {"reducer": reducer, "idler": lambda: idler(1), "idler, clockwise": lambda: idler(-1)}[
        request.param
    ]()


def test_what_the_meshes_do_is_the_bodies_momentum(motion):
    assert motion.momentum().max() < DENSE


def test_what_the_meshes_do_cancels(motion):
    actions, _ = motion.with_meshes()
    left = residuals(actions, motion.train.meshes)
    assert left["force"] == 0.0
    assert left["moment"] < 1e-12
    assert left["power"] < 1e-10


@pytest.mark.parametrize("name", ["normal_load", "friction_force", "pressure_angle", "signed_distance"])
def test_a_record_that_is_a_hundredth_off_has_momentum_over(motion, name):
    """Where it acts: without friction it does not matter where along its line a force does."""
    acts = np.any(motion.record["friction_force"]) or name in ("normal_load", "pressure_angle")
    wrong = motion.record | {name: 1.01 * motion.record[name]}
    assert motion.momentum(wrong).max() > 100 * DENSE if acts else motion.momentum(wrong).max() < DENSE


def test_the_friction_takes_its_force_times_the_sliding(motion):
    """At uniform rotation: (ω_1 + ω_2) r of every contact, dissipated whatever the sense."""
    uniform = motion.record["velocity"][0] * [0.0, 0.0, 1.0]
    record = motion.record | {"velocity": np.broadcast_to(uniform, motion.record["velocity"].shape)}
    actions, _ = motion.with_meshes(record)
    for m, mesh in enumerate(motion.train.meshes):
        slid = uniform[list(mesh.ends), 2].sum() * motion.record["signed_distance"][:, m, 0]
        expected = slid * motion.record["friction_force"][:, m, 0]
        np.testing.assert_allclose(actions.friction_power[:, m], expected, rtol=1e-10)
        # flanks roll on each other along the normal: the law of gearing
        assert np.max(np.abs(actions.deformation_power[:, m])) < 1e-9 * np.max(np.abs(actions.power[:, m]))


def test_the_slidings_of_both_derivations_are_one():
    """Of Lagrange's side along the tangent of its own, of the record's by vectors."""
    one = idler(1)
    uniform = {**one.record, "velocity": np.array(one.record["velocity"][:1] * [0.0, 0.0, 1.0])}
    uniform |= {name: one.record[name][:1] for name in uniform if name != "velocity"}
    actions, _ = one.with_meshes(uniform)
    for mesh in range(2):
        expected = -SAMPLE.friction[mesh] * float(sliding(SAMPLE, mesh, SPEED))
        assert actions.friction_power[0, mesh] == pytest.approx(expected, rel=1e-9)


def test_back_flanks_are_those_of_the_mirrored_world():
    """The mirror image turns the other way, on driving flanks, with the same loads."""
    mesh = Mesh((0, 1), (0.03, 0.05), np.pi / 2, 0.0, -1, 0.0)  # from below to above: the image is at −x
    record = {
        "time": np.zeros(1),
        "velocity": np.array([[[0.01, 0.02, 30.0], [-0.03, 0.015, 18.1]]]),
        "normal_load": np.array([[[1200.0]]]),
        "friction_force": np.array([[[-70.0]]]),
        "pressure_angle": np.array([[[0.41]]]),
        "signed_distance": np.array([[[2e-3]]]),
    }
    back = mesh_actions(record, [mesh], np.array([-1, 1]), [BACK])
    mirrored = record | {"velocity": record["velocity"] * [-1.0, 1.0, 1.0]}
    image = mesh_actions(mirrored, [mesh], np.array([1, -1]), [DRIVING])
    np.testing.assert_allclose(image.force, back.force * [-1.0, 1.0], rtol=1e-12)
    np.testing.assert_allclose(image.moment, -back.moment, rtol=1e-12)
    for name in ("power", "deformation_power", "friction_power"):
        np.testing.assert_allclose(getattr(image, name), getattr(back, name), rtol=1e-12)
    assert back.friction_power > 0.0
