"""Modes of the model linearised at its mean mesh stiffness: what the orders of the mesh can meet."""

import numpy as np

from tribodyn.dynamics.parameters import DRIVE_SHAFT, DRIVE_SPEED, HERTZ_POWER_LAW, Model
from tribodyn.mesh_cycle import CHANNELS

#: Modes without a compliant shaft, and with one.
MODES, MODES_WITH_SHAFT = 5, 6


def mode_count(model: Model) -> int:
    """Number of modes: four translations, the mesh, and the drive shaft where it is compliant."""
    return MODES_WITH_SHAFT if model.options.drive == DRIVE_SHAFT else MODES


def natural_frequencies(model: Model) -> np.ndarray:
    """Undamped natural frequencies, lowest first, Hz.

    The coordinates are x_p, y_p, x_g, y_g, ξ and, with a compliant shaft, its twist; the rigid rotation is
    not among them. Stiffness is the mean over a mesh cycle of the driving pairs in contact, friction is left
    out, and a load-dependent Hertz contact is taken at the static load shared evenly.
    """
    m, t = model.mechanics, model.table
    rp, rg = float(t.pinion_pitch_radius), float(t.gear_pitch_radius)
    mesh = _mean_stiffness(model)  # of (x_p − x_g + ξ, y_p − y_g)
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


def _mean_stiffness(model: Model) -> np.ndarray:
    """Mean over the mesh cycle of Σ_ij k_ij n_i n_jᵀ of the driving flanks, n = (cos α, sin α); N/m."""
    table = model.table
    front = np.asarray(table.side) > 0
    width = np.diff(np.asarray(table.boundary))
    channel = np.asarray(table.channel)[:, :, front]
    stiffness = np.asarray(table.stiffness)[:, :, front][..., front, 0]
    normal = np.stack([channel[..., CHANNELS.index(name), 0] for name in ("cosine", "sine")], axis=-1)
    if model.options.hertz == HERTZ_POWER_LAW:
        stiffness = _at_static_load(model, channel, np.asarray(table.in_contact)[:, front])
    matrix = np.einsum("snij,snik,snjl->snkl", stiffness, normal, normal)
    return np.tensordot(width, matrix.mean(axis=1), axes=1)


def _at_static_load(model: Model, channel: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Stiffness of uncoupled pairs whose Hertz contact stiffens with the load, (S, N, Q, Q), N/m."""
    table = model.table
    load = abs(float(model.mechanics.load_torque)) / float(table.gear_pitch_radius)
    each = np.maximum(load / np.maximum(inside.sum(axis=1), 1.0), 1.0)[:, None, None]
    compliance = (
        channel[..., CHANNELS.index("compliance"), 0] + 0.9 * float(table.hertz_coefficient) * each**-0.1
    )
    return (inside[:, None, :] / compliance)[..., None] * np.eye(inside.shape[1])
