"""The face condensed to one load a pair: what the dynamics see of slices that touch.

At the operating load the slices that touch, with their local deflections as secants s, are a linear system.
Pair j alone has the stiffness K_j = (Λ_jj + s_j)⁻¹ between its slices, hence

    compliance c_j = 1/(1ᵀ K_j 1), distribution p_j = c_j K_j 1, coupling C_jk = p_jᵀ Λ_jk p_k,

and the gap G_j is what makes ξ cos α_j − G_j = c_j F_j + Σ_k C_jk F_k hold for the loads of the load contact
model. c is thus the pair's tangent where its face touches in part: the part of the face in contact stays as
it is at the operating load while the load vibrates. One slice gives the secant and the gap themselves.
"""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.line_load import friction_ratio, peak_ratio
from tribodyn.compliance.load_sharing import PairFlexibility, SharedLoad, contact_deflection, press_pairs
from tribodyn.compliance.slices import by_slices, modes
from tribodyn.geometry.corner_contact import PairGeometry

Array = Any

# A slice joins in over this share of the mean slice load, so that compliances do not step while the edge of
# the contact moves along the face: neighbouring slices there differ by about as much.
_JOINING = 0.2
# Slices that carry less than this share of the mean are linearised there.
_LEAST_SLICE = 1e-3


class Condensed(NamedTuple):
    """Compliance and gap (position, pair), coupling (position, pair, pair; zero diagonal), m/N and m.

    The ratios of `line_load` (position, pair) are those of the loads at which the pairs are linearised.
    """

    compliance: Array
    coupling: Array
    gap: Array
    line_load_friction: Array
    line_load_peak: Array


def condense(
    flexible: PairFlexibility,
    geometry: PairGeometry,
    harmonics: Array,
    gap: Array,
    shared: SharedLoad,
    least_load: float,
) -> Condensed:
    """Condense the state of the mesh to pairs.

    Parameters
    ----------
    flexible : PairFlexibility
    geometry : PairGeometry
        Of the pairs (position, pair).
    harmonics : (n, position, pair, pair)
        `slices.pair_harmonics`.
    gap : (position, pair, slice)
        All of it, m.
    shared : SharedLoad
        The state.
    least_load : float
        Load, N, with which a pair is linearised that carries less or nothing: pressed alone, as the others'
        loads leave its flank.
    """
    load, total = shared.slice_load, shared.normal_load
    positions, pairs, slices = load.shape
    across = harmonics * ~np.eye(pairs, dtype=bool)
    moved = _deflection(across, load)
    own = np.einsum("ntjj->ntj", harmonics)
    curvature = geometry.motion.relative_curvature
    level = np.hypot(total, least_load)
    one = np.ones((positions * pairs, 1))
    alone = press_pairs(
        flexible,
        curvature.reshape(-1, 1),
        own.reshape(len(own), -1, 1, 1),
        one,
        one,
        (gap + moved).reshape(-1, 1, slices),
        level.ravel(),
    ).slice_load.reshape(load.shape)

    at = np.maximum(alone, (_LEAST_SLICE / slices * level)[..., None])
    width = flexible.width / slices
    secant = contact_deflection(flexible, curvature[..., None], at / width)[0] / at
    compliance, share = _stiff_together(own, secant, alone)
    basis = modes(len(harmonics), slices)
    parts = share @ basis.T
    coupling = np.einsum(
        "ntjk,tjn,tkn->tjk", np.broadcast_to(across, (slices, *across.shape[1:])), parts, parts
    )

    touching = np.argmin(gap + moved, axis=-1)[..., None] == np.arange(slices)
    weight = np.where(total[..., None] > 0, load / np.maximum(total, 1e-300)[..., None], touching)
    reached = gap + moved + _deflection(harmonics * np.eye(pairs), load) + secant * load
    left = np.sum(weight * reached, axis=-1) - compliance * total - np.einsum("tjk,tk->tj", coupling, total)
    return Condensed(compliance, coupling, left, friction_ratio(alone), peak_ratio(alone))


def _deflection(harmonics: Array, load: Array) -> Array:
    """Λ f (position, pair, slice), m, of loads of that shape."""
    slices = load.shape[-1]
    basis = modes(len(harmonics), slices)
    every = np.broadcast_to(harmonics, (slices, *harmonics.shape[1:]))
    return np.einsum("ntjk,tkn->tjn", every, load @ basis.T) @ basis


def _stiff_together(own: Array, secant: Array, load: Array) -> tuple[Array, Array]:
    """Compliance (position, pair), m/N, of slices that touch under the loads, and their shares of a load."""
    slices = load.shape[-1]
    joined = np.clip(load / (_JOINING * np.mean(load, axis=-1, keepdims=True)), 0.0, 1.0)
    joined = (joined**2 * (3.0 - 2.0 * joined)).reshape(-1, slices)
    matrix = by_slices(own.reshape(len(own), -1, 1, 1), slices).reshape(-1, slices, slices)
    # A x = 1 with A = Λ + s/j, as (j Λ + s) x = j, which holds for j = 0 too
    matrix = matrix * joined[..., None] + np.eye(slices) * secant.reshape(-1, slices)[..., None]
    stiffness = np.linalg.solve(matrix, joined[..., None])[..., 0].reshape(load.shape)
    whole = np.sum(stiffness, axis=-1)
    return 1.0 / whole, stiffness / whole[..., None]
