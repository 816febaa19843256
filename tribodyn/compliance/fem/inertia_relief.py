"""A ring that nothing but its inertia holds: what its rotation and shift take off a deflection.

Of a load f, f − M φ (φᴴ f)/(φᴴ M φ) excites no rigid motion φ, M the mass; the rest accelerates the ring. A
reading counts from the mean motion, weighted by M, and loses the same. So with G the response of the ring
held at its bore, where such loads leave no torque and no force, and b = M φ/(φᴴ M φ)

    G_free = (1 − φ bᴴ) G (1 − b φᴴ).

Of loads that differ by a phase from sector to sector (`cyclic_symmetry`) order 0 turns the ring and order 1
shifts it, with φ = (1, i) in every sector's own frame; all other orders leave it at rest.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from skfem import Basis, BilinearForm

from tribodyn.numerics.shapes import Array, Complex, Float

# What mirroring does to rotation and shift along x and y; how much of each moves in orders 0 and 1.
_MIRROR = np.array([-1.0, 1.0, -1.0])
_MOTION = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 1.0j]])


class Inertia(NamedTuple):
    """Rigid motions of half a sector, y ≥ 0, in plane: rotation (per rad), shift along x and y."""

    motion: Float[Array, "dof 3"]  # u and v of a node follow each other
    momentum: Float[Array, "dof 3"]  # mass times motion, for unit density


def inertia_of(basis: Basis) -> Inertia:
    """Inertia of a half sector, with the nodes of `strips.curved_basis`."""
    mass = csr_matrix(BilinearForm(lambda u, v, _: u * v).assemble(basis))
    x, y = basis.doflocs
    motion = np.zeros((basis.N, 2, 3))
    motion[:, 0, 0], motion[:, 1, 0] = -y, x
    motion[:, 0, 1] = motion[:, 1, 2] = 1.0
    momentum = np.stack([mass @ motion[:, component] for component in (0, 1)], axis=1)
    return Inertia(motion.reshape(-1, 3), momentum.reshape(-1, 3))


def relieved(
    order: int,
    reading: Complex[Array, "reader load"],
    opposite: Complex[Array, "reader load"],
    inertia: Inertia,
    loads: Float[Array, "dof load"],
    readers: Float[Array, "reader dof"],
    mirrored: NDArray[np.bool_],
) -> Complex[Array, "kept_reader kept_load"]:
    """Readings of the free ring, of those of the held one at the phase of an order.

    The last three loads, and readers, are the half's momentum; what is returned has them no more. `opposite`
    are the readings with all readers on the other half.
    """
    readings, across = np.s_[:-3], np.s_[-3:]
    if order >= len(_MOTION):
        return reading[readings, readings]
    motion = _MOTION[order]
    # a load on the other half does to a reader what the mirrored load does to the mirrored reader, with the
    # conjugate phase
    both = reading[:, across] + opposite[:, across].conj() * _MIRROR
    flipped = opposite[across, across] + reading[across, across].conj() * _MIRROR
    moved = reading[across, readings] + _MIRROR[:, None] * opposite[across, readings]
    inner = motion.conj() @ (both[across] + _MIRROR[:, None] * flipped) @ motion
    mass = 2.0 * np.einsum("dk,dk,k->", inertia.motion, inertia.momentum, np.abs(motion) ** 2)
    force = motion.conj() @ (inertia.motion.T @ loads[:, readings]) / mass
    side = np.where(mirrored[readings, None], _MIRROR, 1.0)
    shift = (readers[readings] @ inertia.motion * side) @ motion
    return (
        reading[readings, readings]
        - np.outer(both[readings] @ motion, force)
        - np.outer(shift, motion.conj() @ moved / mass - inner / mass * force)
    )
