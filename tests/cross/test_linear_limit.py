"""Constant stiffness, no friction: the model is linear in each segment, and its solution known."""

import numpy as np
import pytest
from scipy.linalg import expm

from tests.support.linear_mesh import FREE, OVERRIDES, SEGMENTS, generator
from tests.support.states import PAIR, SLIP, sampled
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import TransientSettings


@pytest.fixture(scope="module")
def case(prepared):
    return prepared("involute-23-47", **OVERRIDES)


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
