"""Constant stiffness, no friction: the model is linear in each segment, and its solution known."""

import numpy as np
import pytest
from scipy.linalg import expm

from tests.support.linear_mesh import FREE, OVERRIDES, SEGMENTS, generator, matrices
from tests.support.states import PAIR, SLIP, sampled
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.transient import TransientSettings
from tribodyn.train.structure import displacements


@pytest.fixture(scope="module")
def case(prepared):
    return prepared("involute-23-47", **OVERRIDES)


def test_modes_are_the_eigenvalues_of_the_assembled_matrices(case):
    for segment, pairs in SEGMENTS:
        mass, damping, stiffness, _ = matrices(case, pairs)
        inverse = np.linalg.inv(mass)
        system = np.block([[np.zeros((5, 5)), np.eye(5)], [-inverse @ stiffness, -inverse @ damping]])
        expected = np.sort_complex(np.linalg.eigvals(system))
        phase = float(np.mean(case.model.meshes[0].table.boundary[segment : segment + 2]))
        y = static_equilibrium(case.model, phase, segment)
        rate = case.model.operation.pitch_angle / case.model.operation.nominal_speed
        columns = []
        for i in FREE:
            step = 1e-9 if i in displacements(PAIR) else 1e-5
            up, down = y.copy(), y.copy()
            up[i] += step
            down[i] -= step
            column = accelerations(up, phase, segment, case.model) - accelerations(
                down, phase, segment, case.model
            )
            columns.append(column[FREE] / (2 * step) / rate)
        ours = np.sort_complex(np.linalg.eigvals(np.stack(columns, axis=1)))
        assert np.all(ours.real < 0)
        # a double eigenvalue (both bodies move freely across the mesh) splits in the last digits
        np.testing.assert_allclose(np.sort(np.abs(ours)), np.sort(np.abs(expected)), rtol=2e-5)
        np.testing.assert_allclose(np.sort(ours.real), np.sort(expected.real), rtol=2e-4)


def test_run_follows_the_matrix_exponential(case):
    """Two cycles, both segments, against exact propagation of the linear system."""
    samples = 100
    y = static_equilibrium(case.model)
    _, states = sampled(case.model, TransientSettings("dopri5", 1e-10, 2, 100000, samples), y)
    boundary = np.asarray(case.model.meshes[0].table.boundary)
    z = y[FREE]
    generators = {segment: generator(case, pairs) for segment, pairs in SEGMENTS}
    expected = []
    for _ in range(2):
        for segment in (0, 1):
            at = np.arange(samples) / samples
            start, end = boundary[segment : segment + 2]
            for phase in at[(at >= start) & (at < end)]:
                expected.append((expm(generators[segment] * (phase - start)) @ np.append(z, 1.0))[:10])
            z = (expm(generators[segment] * (end - start)) @ np.append(z, 1.0))[:10]
    expected.append(z)
    ours = states[:, FREE]
    assert ours.shape == (2 * samples + 1, 10)
    scale = np.ptp(np.array(expected), axis=0)
    assert np.max(np.abs(ours - np.array(expected)) / scale) < 1e-7
    assert np.all(states[:, SLIP] == 0.0)
    assert states.shape[1] == PAIR.states
