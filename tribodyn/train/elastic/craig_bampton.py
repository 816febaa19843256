"""Reduction of a finite-element model to its bearing seats, with modes of fixed seats behind them.

R. R. Craig & M. C. C. Bampton, AIAA J. 6 (1968) 1313. A seat moves as a rigid ring, u_b = W u: either
the nodes of its bore move with it, or it is their mean and loads them alike. u = Ψ u_b + Φ q with

    K Ψ + Wᵀ Λ = 0, W Ψ = 1;    K φ + Wᵀ λ = ω² M φ, W φ = 0
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.train.elastic.beam_matrices import SIX
from tribodyn.train.elastic.superelement import rigid_motions

#: Modes that are looked for at first; twice as many again, until one is above the highest frequency.
_FIRST_MODES = 12
#: Most modes of a reduction.
MOST_MODES = 300


class ReducedModel(NamedTuple):
    """A reduced model: seats' six directions first, then modes in the order of their frequencies."""

    mass: Float[Array, "coordinate coordinate"]
    stiffness: Float[Array, "coordinate coordinate"]
    basis: Float[Array, "dof coordinate"]  # displacements of the whole model from the coordinates
    frequency: Float[Array, " mode"]  # Hz, with fixed seats


def averaged(
    places: Float[Array, "node 3"],
    nodes: Int[Array, " ring"],
    dofs: Int[Array, "node 3"],
    centre: Float[Array, " 3"],
    weights: Float[Array, " ring"] | None = None,
) -> Any:
    """Rows (6, dof), sparse, that give a seat's motion as the weighted mean of the nodes of its bore.

    The least squares of Σ w |u − t − ω × (x − centre)|², so that a load on the seat is spread over the nodes
    and stiffens nothing.
    """
    motions = rigid_motions(places[nodes], 0, about=centre).reshape(len(nodes), SIX, SIX)[:, :3]
    weight = np.ones(len(nodes)) if weights is None else np.asarray(weights)
    normal = np.einsum("n,nij,nik->jk", weight, motions, motions)
    rows = np.linalg.solve(normal, np.einsum("n,nij->jni", weight, motions).reshape(SIX, -1))
    columns = np.tile(dofs[nodes].ravel(), SIX)
    count = int(dofs.max()) + 1
    return sparse.csr_matrix(
        (rows.ravel(), (np.repeat(np.arange(SIX), rows.shape[1]), columns)), (SIX, count)
    )


def with_rigid_bores(
    places: Float[Array, "node 3"],
    rings: Sequence[Int[Array, " ring"]],
    dofs: Int[Array, "node 3"],
    centres: Float[Array, "seat 3"],
) -> Any:
    """Displacements (dof, kept + 6 seats), sparse, of a model in which the nodes of bores move rigidly.

    The kept dofs are those of no ring in their order, then come the six directions of every seat.
    """
    count = int(dofs.max()) + 1
    tied = np.unique(np.concatenate([dofs[ring].ravel() for ring in rings]))
    kept = np.setdiff1d(np.arange(count), tied)
    parts = [sparse.csr_matrix((np.ones(len(kept)), (kept, np.arange(len(kept)))), (count, len(kept)))]
    for ring, centre in zip(rings, centres, strict=True):
        motions = rigid_motions(places[ring], 0, about=centre).reshape(len(ring), SIX, SIX)[:, :3]
        rows = np.repeat(dofs[ring].ravel(), SIX)
        columns = np.tile(np.arange(SIX), 3 * len(ring))
        parts.append(sparse.csr_matrix((motions.ravel(), (rows, columns)), (count, SIX)))
    return sparse.hstack(parts).tocsc()


def reduced(stiffness: Any, mass: Any, seats: Any, highest: float, modes: int | None = None) -> ReducedModel:
    """Reduce sparse matrices to seats, with the modes of fixed seats up to a frequency.

    Parameters
    ----------
    stiffness, mass : sparse, symmetric (dof, dof); the structure may be free
    seats : sparse rows (6 seats, dof) that give the seats' motion, see `averaged`; at least three points
    highest : frequency, Hz, of the modes that are kept
    modes : their number, in place of those below `highest`
    """
    stiffness, mass, seats = (sparse.csc_matrix(matrix) for matrix in (stiffness, mass, seats))
    count, held = stiffness.shape[0], seats.shape[0]
    scale = float(np.mean(stiffness.diagonal()))  # rows of the constraints are as large as the others
    saddle = sparse.bmat([[stiffness, scale * seats.T], [scale * seats, None]], format="csc")
    solver = splu(saddle)
    right = np.zeros((count + held, held))
    right[count:] = scale * np.eye(held)
    static = solver.solve(right)[:count]
    frequency, fixed = _fixed_modes(solver, mass, highest, modes, count, held)
    basis = np.hstack([static, fixed])
    small = [basis.T @ (matrix @ basis) for matrix in (stiffness, mass)]
    whole = small[0]
    whole[:held, held:] = whole[held:, :held] = 0.0  # but for rounding
    whole[held:, held:] = np.diag((2.0 * np.pi * frequency) ** 2)
    return ReducedModel((small[1] + small[1].T) / 2.0, (whole + whole.T) / 2.0, basis, frequency)


def _fixed_modes(
    solver: Any, mass: Any, highest: float, modes: int | None, count: int, held: int
) -> tuple[Float[Array, " mode"], Float[Array, "dof mode"]]:
    """Frequencies (Hz) and mass-normalised shapes of modes with fixed seats."""
    if modes == 0 or (modes is None and highest <= 0.0):
        return np.zeros(0), np.zeros((count, 0))
    free = count - held

    def flexibility(load: Any) -> Any:
        return solver.solve(np.concatenate([np.ravel(load), np.zeros(held)]))[:count]

    # M^-1-free form: largest 1/ω² of (M A M) φ = M φ / ω², with A the flexibility of fixed seats
    wanted = min(modes or _FIRST_MODES, free - 1)
    linear: Any = LinearOperator
    operator = linear((count, count), matvec=lambda v: mass @ flexibility(mass @ v), dtype=float)
    inverse_mass = splu(mass)
    minv = linear((count, count), matvec=inverse_mass.solve, dtype=float)
    while True:
        start = np.random.default_rng(1).standard_normal(count)
        inverse, shapes = eigsh(operator, wanted, M=mass, Minv=minv, which="LA", v0=start)
        order = np.argsort(-inverse)
        frequency = 1.0 / (2.0 * np.pi * np.sqrt(inverse[order]))
        if modes is not None or frequency[-1] > highest or wanted >= min(free - 1, MOST_MODES):
            break
        wanted = min(2 * wanted, free - 1, MOST_MODES)
    kept = slice(None) if modes is not None else frequency <= highest
    shapes = shapes[:, order][:, kept]
    shapes = shapes / np.sqrt(np.einsum("dm,dm->m", shapes, mass @ shapes))
    signs = np.sign(shapes[np.argmax(np.abs(shapes), axis=0), np.arange(shapes.shape[1])])
    return frequency[kept], shapes * signs
