"""The two-stage history that others are compared with, against its matrices' exponential and statics."""

import numpy as np
import pytest
from scipy.linalg import expm

from tests.support.train_matrices import (
    damping_matrix,
    free_coordinates,
    mass_matrix,
    senses,
    stiffness_matrix,
)
from tests.support.two_stage_histories import (
    LOAD,
    PRESSURE_ANGLE,
    output_load,
    pitch_radii,
    step_response,
    two_stage,
)


def loads(train, factors=(1.0, 1.0)):
    before, after = np.multiply(factors, LOAD)
    return output_load(train, before), output_load(train, after)


@pytest.mark.parametrize("rigid", [False, True])
def test_the_history_is_that_of_the_matrix_exponential(rigid):
    train = two_stage(rigid)
    times = np.linspace(0.0, 10e-3, 101)
    found = step_response(train, *loads(train), times)
    chosen = free_coordinates(train, (0,))
    inside, count = np.ix_(chosen, chosen), len(chosen)
    inverse = np.linalg.inv(mass_matrix(train)[inside])
    stiffness, damping = stiffness_matrix(train)[inside], damping_matrix(train)[inside]
    flow = np.block([[np.zeros_like(inverse), np.eye(count)], [-inverse @ stiffness, -inverse @ damping]])
    before, after = (np.linalg.solve(stiffness, load[chosen]) for load in loads(train))
    step = np.append(before - after, np.zeros(count))
    expected = np.array([(expm(flow * time) @ step)[:count] for time in times]) + after
    error = np.abs(found.displacement[:, chosen] - expected) / np.abs(expected).max(axis=0)
    assert error.max() < 1e-8


@pytest.mark.parametrize("rigid", [False, True])
def test_before_and_long_after_the_step_the_meshes_carry_the_torque(rigid):
    """The load's torque over the base radius, and by the ratio upstream; the input's torque holds it."""
    train = two_stage(rigid)
    chosen = np.ix_(*2 * [free_coordinates(train, (0,))])
    mass, damping, stiffness = (of(train)[chosen] for of in (mass_matrix, damping_matrix, stiffness_matrix))
    zero, one, inverse = np.zeros_like(mass), np.eye(len(mass)), np.linalg.inv(mass)
    decay = -np.linalg.eigvals(np.block([[zero, one], [-inverse @ stiffness, -inverse @ damping]])).real
    history = step_response(train, *loads(train), np.array([0.0, 13.0 / decay.min()]))
    (r_1, r_2), (r_3, r_4) = pitch_radii(0), pitch_radii(1)
    for sample, torque in enumerate(LOAD):
        second = torque / (r_4 * np.cos(PRESSURE_ANGLE))
        np.testing.assert_allclose(history.mesh_force[sample], [second * r_3 / r_2, second], rtol=1e-5)
    held = history.held_torque[:, 0]
    assert held[1] == pytest.approx(train.meshes[0].sense * LOAD[1] * r_1 * r_3 / (r_2 * r_4), rel=1e-5)


def test_a_history_in_which_flanks_part_is_refused():
    train = two_stage()
    with pytest.raises(ValueError, match="a mesh pulls"):
        step_response(train, *loads(train, (4.0, 0.05)), np.linspace(0.0, 3e-3, 301))


def test_senses_follow_meshes_and_shafts():
    assert senses(two_stage()) == [-1, 1, 1, -1]
    assert senses(two_stage(rigid_shaft=True)) == [-1, 1, -1]
