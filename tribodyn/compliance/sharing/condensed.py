"""The face condensed to one load per pair: what the dynamics see of slices that touch.

At the operating load the slices that touch, with their local deflections as secants s, are a linear system.
Pair j alone has the stiffness K_j = (Λ_jj + s_j)⁻¹ between its slices, hence

    compliance c_j = 1/(1ᵀ K_j 1), distribution p_j = c_j K_j 1, coupling C_jk = p_jᵀ Λ_jk p_k,

and the gap G_j is what makes ξ cos α_j − G_j = c_j F_j + Σ_k C_jk F_k hold for the loads of the load contact
model. c is thus the pair's tangent where its face touches in part: the part of the face in contact stays as
it is at the operating load while the load vibrates. One slice gives the secant and the gap themselves.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.compliance.sharing.load_sharing import SharedLoad, contact_deflection, in_batches, press_slices
from tribodyn.compliance.sharing.slices import PairFlexibility, friction_ratio, peak_ratio, slice_compliance
from tribodyn.geometry.corner_contact import PairGeometry, part_of
from tribodyn.numerics.shapes import Array, Float

# A slice joins in over this share of the mean slice load, so that compliances do not step while the edge of
# the contact moves along the face: neighbouring slices there differ by about as much.
_JOINING = 0.2
# Slices that carry less than this share of the mean are linearised there.
_MINIMUM_SLICE = 1e-3


def press_pairs(
    flexible: PairFlexibility,
    curvature: Float[Array, "position pair"],
    compliance: Float[Array, "position pair slice pair slice"],
    arm: Float[Array, "position pair"],
    lever: Float[Array, "position pair"],
    gap: Float[Array, "position pair slice"],
    torque: Float[Array, " position"],
) -> SharedLoad:
    """Share torques (position,) among pairs of slices; arrays (position, pair), the gap (…, slice).

    `compliance` (position, pair, slice, pair, slice) as made by `slices.slice_compliance`.
    """
    even = np.ones(gap.shape)
    slices = gap.shape[-1]
    width = flexible.width / slices * even
    bent, arms, levers = (field[..., None] * even for field in (curvature, arm, lever))
    return press_slices(flexible, bent, width, compliance, arms, levers, gap, torque)


class Condensed(NamedTuple):
    """Compliance and gap (position, pair), coupling (position, pair, pair; zero diagonal), m/N and m.

    The ratios of the line load (position, pair) are those of the loads at which the pairs are linearised.
    """

    compliance: Float[Array, "position pair"]
    coupling: Float[Array, "position pair pair"]
    gap: Float[Array, "position pair"]
    line_load_friction: Float[Array, "position pair"]
    line_load_peak: Float[Array, "position pair"]


def condense(
    flexible: PairFlexibility,
    geometry: PairGeometry,
    gap: Float[Array, "position pair slice"],
    shared: SharedLoad,
    minimum_load: float,
    coupled: bool = True,
) -> Condensed:
    """Condense the state of the mesh to pairs; the gap (m) is all of it.

    A pair that carries less than `minimum_load` (N), or nothing, is linearised with that: pressed alone, as
    the others' loads leave its flank. `coupled`: whether slices hold each other.
    """
    parts = [
        _condensed(
            flexible,
            geometry.motion.relative_curvature[rows],
            slice_compliance(flexible, part_of(geometry, rows), gap.shape[-1], coupled),
            gap[rows],
            shared.slice_load[rows],
            minimum_load,
        )
        for rows in in_batches(gap.shape)
    ]
    return Condensed(*(np.concatenate(field) for field in zip(*parts, strict=True)))


def _condensed(
    flexible: PairFlexibility,
    curvature: Float[Array, "position pair"],
    matrix: Float[Array, "position pair slice pair slice"],
    gap: Float[Array, "position pair slice"],
    load: Float[Array, "position pair slice"],
    minimum_load: float,
) -> Condensed:
    """Condense pairs under loads (position, pair, slice) with Λ (position, pair, slice, pair, slice)."""
    positions, pairs, slices = load.shape
    total = np.sum(load, axis=-1)
    pair_compliance = np.einsum("tjmjn->tjmn", matrix)
    across = matrix * ~np.eye(pairs, dtype=bool)[:, None, :, None]
    moved = np.einsum("tjmkn,tkn->tjm", across, load)
    level = np.hypot(total, minimum_load)
    unit = np.ones((positions * pairs, 1))
    alone = press_pairs(
        flexible,
        curvature.reshape(-1, 1),
        pair_compliance.reshape(-1, 1, slices, 1, slices),
        unit,
        unit,
        (gap + moved).reshape(-1, 1, slices),
        level.ravel(),
    ).slice_load.reshape(load.shape)

    at = np.maximum(alone, (_MINIMUM_SLICE / slices * level)[..., None])
    width = flexible.width / slices
    secant = contact_deflection(flexible, curvature[..., None], at / width)[0] / at
    compliance, share = _stiff_together(pair_compliance, secant, alone)
    coupling = np.einsum("tjm,tjmkn,tkn->tjk", share, across, share, optimize=True)

    touching = np.argmin(gap + moved, axis=-1)[..., None] == np.arange(slices)
    weight = np.where(total[..., None] > 0, load / np.maximum(total, 1e-300)[..., None], touching)
    reached = gap + moved + np.einsum("tjmn,tjn->tjm", pair_compliance, load) + secant * load
    open_gap = (
        np.sum(weight * reached, axis=-1) - compliance * total - np.einsum("tjk,tk->tj", coupling, total)
    )
    return Condensed(compliance, coupling, open_gap, friction_ratio(alone), peak_ratio(alone))


def _stiff_together(
    slice_compliance: Float[Array, "position pair slice slice"],
    secant: Float[Array, "position pair slice"],
    load: Float[Array, "position pair slice"],
) -> tuple[Float[Array, "position pair"], Float[Array, "position pair slice"]]:
    """Compliance (position, pair), m/N, of slices that touch under the loads, and their shares of a load."""
    slices = load.shape[-1]
    joined = np.clip(load / (_JOINING * np.mean(load, axis=-1, keepdims=True)), 0.0, 1.0)
    joined = joined**2 * (3.0 - 2.0 * joined)
    # A x = 1 with A = Λ + s/j, as (j Λ + s) x = j, which holds for j = 0 too
    matrix = slice_compliance * joined[..., None] + np.eye(slices) * secant[..., None]
    stiffness = np.linalg.solve(matrix, joined[..., None])[..., 0]
    whole = np.sum(stiffness, axis=-1)
    return 1.0 / whole, stiffness / whole[..., None]
