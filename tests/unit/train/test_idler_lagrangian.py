"""The idler derived from its energies, against matrices assembled by hand and the kinematics of flanks."""

import numpy as np
import pytest

from tests.support.idler_lagrangian import (
    ENDS,
    SAMPLE,
    accelerations,
    approach,
    friction_forces,
    normal,
    sliding,
    wound,
)
from tests.support.soak_parameters import all_in_soak
from tests.support.train_matrices import (
    Bearing,
    Body,
    Mesh,
    Train,
    approach_rows,
    damping_matrix,
    mass_matrix,
    stiffness_matrix,
)
from tests.support.train_matrices import normal as assembled_normal

PLACES = [(0.7, -1.1, 1.0), (2.9, 2.2, -1.0), (-3.1, 3.1, 1.0), (-1.0, -1.0, -1.0)]


def placed(first, second, sense):
    return SAMPLE._replace(azimuth=np.array([first, second]), sense=sense)


def train(idler):
    """The same by `train_matrices`."""
    meshes = tuple(
        Mesh(
            ENDS[m],
            tuple(idler.base_radii[m] / np.cos(idler.pressure_angle[m])),
            idler.azimuth[m],
            idler.pressure_angle[m],
            int(idler.sense) * (-1) ** m,
            idler.stiffness[m],
            idler.damping[m],
        )
        for m in range(2)
    )
    bodies = tuple(Body(*both) for both in zip(idler.mass, idler.inertia, strict=True))
    bearings = tuple(
        Bearing(i, *both)
        for i, both in enumerate(zip(idler.bearing_stiffness, idler.bearing_damping, strict=True))
    )
    return Train(bodies, bearings, meshes=meshes)


@pytest.mark.parametrize("place", all_in_soak(PLACES, PLACES[:2]))
def test_the_approach_of_involutes_is_that_along_the_line_of_action(place):
    idler, rng = placed(*place), np.random.default_rng(3)
    q = rng.normal(size=(3, 3)) * 1e-5
    expected = approach_rows(train(idler)) @ q.ravel()
    for mesh in range(2):
        assert approach(q, idler, mesh) == pytest.approx(expected[mesh], rel=1e-10)
        np.testing.assert_allclose(
            normal(idler, mesh), assembled_normal(train(idler).meshes[mesh]), atol=1e-12
        )
        whole = wound(q, idler, mesh) - wound(0 * q, idler, mesh)
        # what is left out is of the order of q² over the centre distance
        assert abs(whole - expected[mesh]) < 20 * np.max(np.abs(q)) ** 2 / 0.07


@pytest.mark.parametrize("place", all_in_soak(PLACES, PLACES[:2]))
def test_lagranges_equations_are_those_of_the_assembled_matrices(place):
    """Without friction, which the matrices have not."""
    idler, rng = placed(*place)._replace(friction=np.zeros(2)), np.random.default_rng(5)
    q, v = rng.normal(size=(3, 3)) * 1e-5, rng.normal(size=(3, 3)) * 0.1
    assembled = train(idler)
    forces = -stiffness_matrix(assembled) @ q.ravel() - damping_matrix(assembled) @ v.ravel()
    forces[2::3] += idler.torque
    expected = np.linalg.solve(mass_matrix(assembled), forces).reshape(3, 3)
    np.testing.assert_allclose(accelerations(q, v, idler), expected, rtol=1e-9)


@pytest.mark.parametrize("place", all_in_soak(PLACES, PLACES[:2]))
def test_sliding_of_the_flanks_is_the_sum_of_the_speeds_times_the_distance(place):
    """v_s = (ω_1 + ω_2) r; the driver's flank slides along −tangent in recess."""
    idler, speed = placed(*place), 31.0
    base = idler.base_radii
    second = speed * base[0, 0] / base[0, 1]
    speeds = [speed, second, second * base[1, 0] / base[1, 1]]
    for mesh, (driver, driven) in enumerate(ENDS):
        expected = -(speeds[driver] + speeds[driven]) * idler.distance[mesh]
        assert sliding(idler, mesh, speed) == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("place", all_in_soak(PLACES, PLACES[:2]))
def test_friction_cancels_between_bodies_and_dissipates(place):
    """By the arms of physics: L = r + r_p sin α on the driver, r_g sin α − r on the driven gear."""
    idler, speed = placed(*place), 31.0
    forces = np.asarray(friction_forces(idler))
    np.testing.assert_allclose(forces[:, :2].sum(axis=0), 0.0, atol=1e-9 * np.abs(idler.friction).max())
    lever = idler.base_radii * np.tan(idler.pressure_angle)[:, None] + np.outer(idler.distance, [1.0, -1.0])
    senses, f = idler.sense * np.array([1, -1, 1]), idler.friction
    moments = [-f[0] * lever[0, 0], f[0] * lever[0, 1] - f[1] * lever[1, 0], f[1] * lever[1, 1]]
    np.testing.assert_allclose(forces[:, 2], senses * moments, rtol=1e-9)
    power = sum(f[mesh] * float(sliding(idler, mesh, speed)) for mesh in range(2))
    assert power < 0.0  # its sign is that of the distance, so that it dissipates
