"""A spur stage in a box of plates, reduced to its seats, beside all of its finite elements not reduced."""

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.sparse.linalg import eigsh

from tests.support.spur_in_box import (
    AXIAL,
    BEARING,
    PRESSURE_ANGLE,
    SPAN,
    frequencies,
    mean_stiffness,
    prepared,
    rotors,
    whole,
)

MODES = 9


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return prepared(tmp_path_factory.mktemp("box"))


def _moved(x: float, y: float, z: float) -> np.ndarray:
    """What the six directions of a body move a point of it by."""
    return np.hstack([np.eye(3), [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]])


def _not_reduced(made) -> np.ndarray:
    """Frequencies of all nodes with both gears and their shafts as rigid bodies on springs."""
    box, bodies = whole(), rotors(made)
    count = 3 * len(box.places)
    mass = [np.repeat([one.mass, one.transverse, one.polar], [3, 2, 1]) for one in bodies]
    springs = []
    for number, ring in enumerate(box.rings):
        gear, end = divmod(number, 2)
        row = np.zeros((3, count + 12))
        for direction in range(3):
            row[direction, 3 * ring + direction] = -1.0 / len(ring)
        row[:, count + 6 * gear : count + 6 * gear + 6] = _moved(0.0, 0.0, (end - 0.5) * SPAN)
        springs.append((row, np.diag([*BEARING, 0.0 if end else AXIAL])))
    normal = np.array([np.sin(PRESSURE_ANGLE), made.case.bodies[0].sense * np.cos(PRESSURE_ANGLE), 0.0])
    row = np.zeros((3, count + 12))
    row[:, count : count + 6] = _moved(bodies[0].radius, 0.0, 0.0)
    row[:, count + 6 :] = -_moved(-bodies[1].radius, 0.0, 0.0)
    springs.append((row, mean_stiffness(made) * np.outer(normal, normal)))
    stiffness = sparse.block_diag([box.stiffness, np.zeros((12, 12))]).tocsc()
    for row, own in springs:
        thin = sparse.csc_matrix(row)
        stiffness = stiffness + thin.T @ sparse.csc_matrix(own) @ thin
    whole_mass = sparse.block_diag([box.mass, sparse.diags(np.concatenate(mass))]).tocsc()
    held = np.append((3 * box.bolted[:, None] + np.arange(3)).ravel(), count + 5)
    free = np.setdiff1d(np.arange(count + 12), held)
    squares = eigsh(
        stiffness[free][:, free], MODES, whole_mass[free][:, free], sigma=0.0, return_eigenvectors=False
    )
    return np.sqrt(np.sort(squares)) / (2.0 * np.pi)


def test_the_reduced_housing_has_the_frequencies_of_the_whole(made):
    np.testing.assert_allclose(frequencies(made)[:MODES], _not_reduced(made), rtol=2e-3)


def test_exudyn_has_them_too(made):
    pytest.importorskip("exudyn")
    from tools.peers.exudyn_housing import exudyn_frequencies

    np.testing.assert_allclose(frequencies(made)[:MODES], exudyn_frequencies(made, MODES), rtol=0.01)
