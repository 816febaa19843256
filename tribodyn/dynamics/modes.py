"""Modes of the model linearised at its mean stiffness under load: what the orders of the mesh can meet."""

import numpy as np

from tribodyn.dynamics.parameters import DRIVE_SHAFT, DRIVE_SPEED, Model
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.numerics.shapes import Array, Float

#: Modes without a compliant shaft, and with one.
MODES, MODES_WITH_SHAFT = 5, 6


def natural_frequencies(model: Model, cycle: MeshCycle) -> Float[Array, " mode"]:
    """Undamped natural frequencies, lowest first, Hz.

    The coordinates are x_p, y_p, x_g, y_g, ξ and, with a compliant shaft, its twist; the rigid rotation is
    not among them. Stiffness is the tangent at the static load, the mean over the mesh cycle that the model
    was made from: at every phase of those driving pairs that carry when the load is shared by compliances,
    gaps and the bearings' give, each at its own load where the Hertz contact stiffens with it. No friction.
    """
    m, t = model.mechanics, model.table
    rp, rg = float(t.pinion_pitch_radius), float(t.gear_pitch_radius)
    mesh = _mean_stiffness(model, cycle)  # of (x_p − x_g + ξ, y_p − y_g)
    # a force along x and a turning of ξ are one: ξ stands where x_p does
    to_mesh = np.array([[1.0, 0.0, -1.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0, 0.0]])
    force = to_mesh.T @ mesh @ to_mesh
    force[[0, 1, 2, 3], [0, 1, 2, 3]] += [
        m.pinion_stiffness_x,
        m.pinion_stiffness_y,
        m.gear_stiffness_x,
        m.gear_stiffness_y,
    ]
    free = 0.0 if model.options.drive == DRIVE_SPEED else rp**2 / m.pinion_inertia
    mobility = np.array([1 / m.pinion_mass] * 2 + [1 / m.gear_mass] * 2 + [free + rg**2 / m.gear_inertia])
    system = mobility[:, None] * force  # accelerations q'' = −system q
    if model.options.drive == DRIVE_SHAFT:
        shaft = float(m.shaft_stiffness)
        wide = np.zeros((6, 6))
        wide[:5, :5] = system
        # the shaft drives the pinion, whose acceleration enters ξ'' by r_p and the twist's by −1
        wide[4, 5] = -rp * shaft / m.pinion_inertia
        wide[5, :5] = -rp / m.pinion_inertia * force[4]
        wide[5, 5] = shaft * (1 / m.drive_inertia + 1 / m.pinion_inertia)
        system = wide
    squared = np.linalg.eigvals(system).real
    return np.sqrt(np.sort(np.maximum(squared, 0.0))) / (2 * np.pi)


def _mean_stiffness(model: Model, cycle: MeshCycle) -> Float[Array, "2 2"]:
    """Mean over the mesh cycle of Σ_ij k_ij n_i n_jᵀ of the pairs that carry, n = (cos α, sin α); N/m."""
    if model.mechanics.load_torque < 0.0:  # it presses the back flanks together, in the mirrored world
        cycle = cycle._replace(side=-cycle.side)
    still = np.sin(cycle.pressure_angle)
    mechanics = model.mechanics
    # what a load on one pair moves the axes apart, it takes from the others: one more compliance they share
    bearings = 1.0 / mechanics.pinion_stiffness_y + 1.0 / mechanics.gear_stiffness_y
    shared = bearings * still[..., :, None] * still[..., None, :]
    own = np.einsum("...ii->...i", shared)
    moving = cycle._replace(
        compliance=cycle.compliance + own,
        coupling=cycle.coupling + shared - own[..., None] * np.eye(own.shape[-1]),
    )
    # N m; 1 N on the pitch circle where there is no load
    torque = max(abs(float(mechanics.load_torque)), float(model.table.gear_pitch_radius))
    load = quasi_static(moving, torque).normal_load
    carrying = np.where(load > 0.0, 1.0, 0.0)
    contact = carrying * 0.9 * float(cycle.hertz_coefficient) * np.maximum(load, 1e-6) ** -0.1
    both = carrying[..., :, None] * carrying[..., None, :]
    tangent = cycle.coupling * both + np.eye(own.shape[-1]) * (cycle.compliance + contact)[..., None]
    scale = float(np.mean(cycle.compliance))
    stiffness = np.linalg.inv(tangent / scale) / scale * both
    normal = np.stack([np.cos(cycle.pressure_angle), np.sin(cycle.pressure_angle)], axis=-1)
    matrix = np.einsum("snij,snik,snjl->snkl", stiffness, normal, normal)
    inside = (matrix[:, 1:] + matrix[:, :-1]).mean(axis=1) / 2.0
    return np.tensordot(np.diff(cycle.boundary), inside, axes=1)
