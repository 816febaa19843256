"""Stiffness of a single pair, out of the mesh cycle."""

import numpy as np

from tribodyn.mesh.cycle import MeshCycle


def single_pair_stiffness(cycle: MeshCycle, load: float) -> float:
    """Stiffness of one pair at the pitch point, N/m; with a load-dependent Hertz contact at `load` (N)."""
    roll = np.asarray(cycle.signed_distance)[:, :, : cycle.front_pairs]
    inside = np.asarray(cycle.in_contact)[:, None, : cycle.front_pairs] > 0
    distance = np.where(inside, np.abs(roll), np.inf)
    segment, _, slot = np.unravel_index(np.argmin(distance), distance.shape)
    near = roll[segment, :, slot]
    order = np.argsort(near)
    compliance = np.interp(0.0, near[order], np.asarray(cycle.compliance)[segment, order, slot])
    coefficient = float(cycle.hertz_coefficient)
    return float(1.0 / (compliance + 0.9 * coefficient * max(load, 1.0) ** -0.1))
