"""Matrices of the linear gear pair that the model becomes at constant stiffness without friction."""

import numpy as np
from scipy.linalg import expm

from tribodyn.dynamics.parameters import DISPLACEMENTS, VELOCITIES

STIFFNESS = 2.7e8
#: What makes a shipped involute scenario linear in each segment.
OVERRIDES = {
    "mesh.compliance": "constant",
    "mesh.stiffness": f"{STIFFNESS} N/m",
    "friction.law": "none",
    "operating.pinion_speed": "300 rad/s",
}
FREE = [*DISPLACEMENTS, *VELOCITIES]
#: Pairs in contact in the segments of a mesh cycle with a contact ratio between one and two.
SEGMENTS = ((0, 2), (1, 1))


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


def generator(case, pairs):
    """Generator (11, 11) of the flow of (displacements, velocities, 1) over the mesh's phase."""
    mass, damping, stiffness, load = matrices(case, pairs)
    rate = float(case.model.table.pitch_angle) / case.model.mechanics.nominal_speed
    inverse = np.linalg.inv(mass)
    top = np.zeros((11, 11))
    top[:5, 5:10] = np.eye(5)
    top[5:10, :5] = -inverse @ stiffness
    top[5:10, 5:10] = -inverse @ damping
    top[5:10, 10] = inverse @ load
    return top * rate


def over_a_cycle(case):
    """Exact map (11, 11) of (displacements, velocities, 1) over a mesh cycle."""
    boundary = np.asarray(case.model.table.boundary)
    whole = np.eye(11)
    for segment, pairs in SEGMENTS:
        whole = expm(generator(case, pairs) * (boundary[segment + 1] - boundary[segment])) @ whole
    return whole
