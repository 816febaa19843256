"""Constant stiffness, no friction: the model is linear in each segment, and its solution known."""

import numpy as np
import pytest
from scipy.linalg import expm

from tribodyn.dynamics.parameters import (
    SLIP,
    STATES,
    VX_G,
    VX_P,
    VY_G,
    VY_P,
    X_G,
    X_P,
    XI,
    XI_RATE,
    Y_G,
    Y_P,
)
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.transient import Chunk, Settings, transient

STIFFNESS = 2.7e8
OVERRIDES = {
    "mesh.compliance": "constant",
    "mesh.stiffness": f"{STIFFNESS} N/m",
    "friction.law": "none",
    "operating.pinion_speed": "300 rad/s",
}
POSITIONS = [X_P, Y_P, X_G, Y_G, XI]
VELOCITIES = [VX_P, VY_P, VX_G, VY_G, XI_RATE]


@pytest.fixture(scope="module")
def case(prepared):
    return prepared("involute-23-47", **OVERRIDES)


def matrices(case, pairs):
    """M, C, K and load of the five free coordinates, assembled by hand from the pair's direction."""
    m, t = case.model.mechanics, case.model.table
    alpha = float(case.cycle.pressure_angle[0, 0, 0])
    h = np.array([np.cos(alpha), np.sin(alpha), -np.cos(alpha), -np.sin(alpha), np.cos(alpha)])
    # ξ = r_p θ_p − r_g θ_g with the pinion prescribed: mass J_g/r_g² moves with −ξ, loaded by T_g/r_g
    mass = np.diag([m.pinion_mass] * 2 + [m.gear_mass] * 2 + [m.gear_inertia / t.gear_pitch_radius**2])
    bearings = [m.pinion_stiffness_x, m.pinion_stiffness_y, m.gear_stiffness_x, m.gear_stiffness_y, 0.0]
    dampers = [m.pinion_damping_x, m.pinion_damping_y, m.gear_damping_x, m.gear_damping_y, 0.0]
    c = m.mesh_damping * np.sqrt(STIFFNESS)
    stiffness = np.diag(bearings) + pairs * STIFFNESS * np.outer(h, h)
    damping = np.diag(dampers) + pairs * c * np.outer(h, h)
    load = np.array([0, 0, 0, 0, m.load_torque / t.gear_pitch_radius])
    return mass, damping, stiffness, load


def test_modes_are_the_eigenvalues_of_the_assembled_matrices(case):
    for segment, pairs in ((0, 2), (1, 1)):
        mass, damping, stiffness, _ = matrices(case, pairs)
        inverse = np.linalg.inv(mass)
        system = np.block([[np.zeros((5, 5)), np.eye(5)], [-inverse @ stiffness, -inverse @ damping]])
        expected = np.sort_complex(np.linalg.eigvals(system))
        phase = float(np.mean(case.model.table.boundary[segment : segment + 2]))
        y = static_equilibrium(case.model, phase, segment)
        rate = case.model.table.pitch_angle / case.model.mechanics.nominal_speed
        free = POSITIONS + VELOCITIES
        columns = []
        for i in free:
            step = 1e-9 if i in POSITIONS else 1e-5
            up, down = y.copy(), y.copy()
            up[i] += step
            down[i] -= step
            column = accelerations(up, phase, segment, case.model) - accelerations(
                down, phase, segment, case.model
            )
            columns.append(column[free] / (2 * step) / rate)
        ours = np.sort_complex(np.linalg.eigvals(np.stack(columns, axis=1)))
        assert np.all(ours.real < 0)
        # a double eigenvalue (both bodies move freely across the mesh) splits in the last digits
        np.testing.assert_allclose(np.sort(np.abs(ours)), np.sort(np.abs(expected)), rtol=2e-5)
        np.testing.assert_allclose(np.sort(ours.real), np.sort(expected.real), rtol=2e-4)


def test_run_follows_the_matrix_exponential(case):
    """Two cycles, both segments, against exact propagation of the linear system."""
    samples = 100
    y = static_equilibrium(case.model)
    chunks = [
        part
        for part in transient(case.model, y, Settings("dopri5", 1e-10, 2, 100000, samples), "dopri5")
        if isinstance(part, Chunk)
    ]
    states = np.concatenate([c.states for c in chunks])
    boundary = np.asarray(case.model.table.boundary)
    rate = float(case.model.table.pitch_angle) / case.model.mechanics.nominal_speed
    free = POSITIONS + VELOCITIES
    z = y[free]
    generators = {}
    for segment, pairs in ((0, 2), (1, 1)):
        mass, damping, stiffness, load = matrices(case, pairs)
        inverse = np.linalg.inv(mass)
        top = np.zeros((11, 11))
        top[:5, 5:10] = np.eye(5)
        top[5:10, :5] = -inverse @ stiffness
        top[5:10, 5:10] = -inverse @ damping
        top[5:10, 10] = inverse @ load
        generators[segment] = top * rate
    expected = []
    for _ in range(2):
        for segment in (0, 1):
            at = np.arange(samples) / samples
            start, end = boundary[segment : segment + 2]
            for phase in at[(at >= start) & (at < end)]:
                expected.append((expm(generators[segment] * (phase - start)) @ np.append(z, 1.0))[:10])
            z = (expm(generators[segment] * (end - start)) @ np.append(z, 1.0))[:10]
    expected.append(z)
    ours = states[:, free]
    assert ours.shape == (2 * samples + 1, 10)
    scale = np.ptp(np.array(expected), axis=0)
    assert np.max(np.abs(ours - np.array(expected)) / scale) < 1e-7
    assert np.all(states[:, SLIP] == 0.0)
    assert states.shape[1] == STATES
