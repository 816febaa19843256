"""Matrices of the linear gear pair that the model becomes at constant stiffness without friction."""

import numpy as np
from scipy.linalg import expm

from tests.support.states import PAIR
from tribodyn.train.layout import displacements, velocities
from tribodyn.train.structure import (
    TURN,
)

STIFFNESS = 2.7e8
#: What makes a shipped involute scenario linear in each segment.
OVERRIDES = {
    "mesh.compliance": "constant",
    "mesh.stiffness": f"{STIFFNESS} N/m",
    "friction.law": "none",
    "operating.pinion_speed": "300 rad/s",
}
FREE = [*displacements(PAIR), *velocities(PAIR)]
#: Pairs in contact in the segments of a mesh cycle with a contact ratio between one and two.
SEGMENTS = ((0, 2), (1, 1))


def matrices(case, pairs):
    """M, C, K and load of the five free coordinates, assembled by hand from the pair's direction."""
    mesh, bodies, links = case.model.meshes[0], case.model.bodies, case.model.links
    alpha = float(case.cycle.pressure_angle[0, 0, 0])
    lever = mesh.driven_radius * np.cos(alpha)
    h = np.array([np.cos(alpha), np.sin(alpha), -np.cos(alpha), -np.sin(alpha), -lever])
    mass = np.diag([*np.repeat(bodies.mass, 2), bodies.inertia[1]])
    bearings, dampers = ([*each[:, :TURN].ravel(), 0.0] for each in (links.stiffness, links.damping))
    c = mesh.damping * np.sqrt(STIFFNESS)
    stiffness = np.diag(bearings) + pairs * STIFFNESS * np.outer(h, h)
    damping = np.diag(dampers) + pairs * c * np.outer(h, h)
    load = np.array([0, 0, 0, 0, -bodies.load[1]])
    return mass, damping, stiffness, load


def generator(case, pairs):
    """Generator (11, 11) of the flow of (displacements, velocities, 1) over the mesh's phase."""
    mass, damping, stiffness, load = matrices(case, pairs)
    operation = case.model.operation
    rate = operation.pitch_angle / operation.nominal_speed
    inverse = np.linalg.inv(mass)
    top = np.zeros((11, 11))
    top[:5, 5:10] = np.eye(5)
    top[5:10, :5] = -inverse @ stiffness
    top[5:10, 5:10] = -inverse @ damping
    top[5:10, 10] = inverse @ load
    return top * rate


def over_a_cycle(case):
    """Exact map (11, 11) of (displacements, velocities, 1) over a mesh cycle."""
    boundary = np.asarray(case.model.meshes[0].table.boundary)
    whole = np.eye(11)
    for segment, pairs in SEGMENTS:
        whole = expm(generator(case, pairs) * (boundary[segment + 1] - boundary[segment])) @ whole
    return whole
