"""Stiffness of a single pair that carries the whole torque, from the mesh cycle."""

from typing import NamedTuple

import numpy as np

from tribodyn.mesh.cycle import MeshCycle
from tribodyn.numerics.shapes import Array, Float


class SinglePair(NamedTuple):
    """One pair at the pitch point.

    Attributes
    ----------
    normal_load : float
        Load along the normal, N.
    stiffness : float
        dF/dδ along the normal, N/m; with a load-dependent Hertz contact the tangent at the load.
    """

    normal_load: float
    stiffness: float


def total_stiffness(
    stiffness: Float[Array, "sample pair"], pressure_angle: Float[Array, "sample pair"]
) -> Float[Array, " sample"]:
    """Stiffness of all pairs together along the pitch tangent, Σ k cos² α, N/m.

    The force along the pitch tangent per rotational transmission error, of a mesh whose pairs deflect apart.
    """
    return np.sum(stiffness * np.cos(np.nan_to_num(pressure_angle)) ** 2, axis=-1)


def single_pair(cycle: MeshCycle, gear_torque: float) -> SinglePair:
    """One pair at the pitch point under a gear torque, N m, of either sign, with the load T_g/(r_g cos α)."""
    roll = np.asarray(cycle.signed_distance)[:, :, : cycle.front_pairs]
    inside = np.asarray(cycle.in_contact)[:, None, : cycle.front_pairs] > 0
    distance = np.where(inside, np.abs(roll), np.inf)
    segment, _, slot = np.unravel_index(np.argmin(distance), distance.shape)
    near = roll[segment, :, slot]
    order = np.argsort(near)
    compliance = float(np.interp(0.0, near[order], np.asarray(cycle.compliance)[segment, order, slot]))
    # the cubic through the nearest nodes: the load has no error that a linear one would leave
    close = np.argsort(np.abs(near))[:4]
    step = np.ptp(near[close])
    angle = np.polyfit(near[close] / step, np.asarray(cycle.pressure_angle)[segment, close, slot], 3)[-1]
    load = abs(gear_torque) / (float(cycle.gear_pitch_radius) * float(np.cos(angle)))
    contact = 0.9 * float(cycle.hertz_coefficient) * max(load, 1.0) ** -0.1
    return SinglePair(load, 1.0 / (compliance + contact))
