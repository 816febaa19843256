"""Slices of one tooth that hold each other, lumped into a table of slices at the operating load.

A load that varies along the tooth like cos kz is met by less compliance than an even one. Of the energy
method's parts the teeth answer as a string on an elastic foundation (Pasternak; for teeth M. Ajmi, P. Velex,
Mech. Mach. Theory 40 (2005) 677-693), the bodies as a half-space, whose compliance falls with the wave:

    λ_teeth(k) = C_teeth/(1 + (ℓ_t k)²),  λ_bodies(k) = C_bodies/(1 + ℓ_b k),

k along the tooth. Both lengths are shares of the normal module that are fitted to this package's finite
elements: they meet the harmonics of `compliance.sharing.slices.pair_harmonics` within 0.055 of λ(0)
(test_helical_coupling). A free body's C_bodies is that of k = 0 alone, where the load has a resultant that
accelerates it; C_bodies of k > 0 is a held one's (`energy.under_uneven_load`). The end faces are planes of
symmetry: what free ends add is left out. Slices at different heights of the tooth take the geometric mean of
their compliances; two pairs on one body hold each other section by section, spread like the bodies. The
contact is each slice's own.

Lumping: at the operating load the slices that touch are solved together. Each slot of the table then has the
compliance and the gap that give it the same load, and the same change of load while the gears turn.
"""

import dataclasses
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData
from tribodyn.geometry.modification import UNMODIFIED
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import normal_arms
from tribodyn.mesh.slices.held import ROWS, FrontSlots, kept_matrices, matrices
from tribodyn.mesh.slices.helical import SliceLayout, tabulate_slices
from tribodyn.mesh.table import MeshData
from tribodyn.numerics.elementary import absolute, is_jax, maximum, namespace, within
from tribodyn.numerics.iteration import by_rows, newton
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array, Float

# Loads, over the mean, below which the contact is linearised there; and the least part of an approach that
# a slice's own contact takes, and leaves.
_SMALL, _LEAST = 0.05, 0.02
_STEPS = 15
_KEPT_SIZE = 7_000_000  # entries of matrices that are kept at most


def tabulate_helical(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    layout: SliceLayout,
    gear_torque: float,
    phase: Float[Array, " node"] | None = None,
) -> MeshCycle:
    """Tabulate a pair in slices, which hold each other where the mesh says so.

    Every number may be traced, unless flanks are modified; a traced torque is not zero. Only the energy
    method knows how slices hold each other, and only at a torque (N m).
    """
    cycle = tabulate_slices(assembly, materials, mesh, layout, phase)
    held = mesh.compliance == "energy" and mesh.slice_coupling
    if not held or not (is_jax(gear_torque) or gear_torque):
        return cycle
    if len(cycle.compliance) == 1:
        return couple_slices(assembly, materials, mesh, cycle, gear_torque, layout.touching)
    coupled = [
        couple_slices(assembly, materials, mesh, _segment(cycle, number), gear_torque, layout.touching)
        for number in range(len(cycle.compliance))
    ]
    both = {name: np.concatenate([getattr(part, name) for part in coupled]) for name in ("compliance", "gap")}
    return cycle._replace(**both)


def _segment(cycle: MeshCycle, number: int) -> MeshCycle:
    """One segment alone of a spur pair's table."""
    shape = cycle.compliance.shape
    fields = {name: value for name, value in cycle._asdict().items() if np.shape(value)[:3] == shape}
    return cycle._replace(**{name: value[number : number + 1] for name, value in fields.items()})


@one_blas_thread()
def couple_slices(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    cycle: MeshCycle,
    gear_torque: float,
    touching: int = 0,
) -> MeshCycle:
    """Lump slices that hold each other at a torque T_g ≠ 0 (N m) into a table of uncoupled ones.

    Driving flanks at the torque. Back flanks keep the compliance of slices by themselves. Of a traced table
    `touching` is the greatest number of slots that touch at once, 0: all may.
    """
    fronts = cycle.front_slots
    front = np.s_[0, :, :fronts]
    along, compliance, share = cycle.signed_distance[front], cycle.compliance[front], cycle.share[front]
    near = _near_contact(share, touching)
    seen = FrontSlots(along, compliance, share, normal_arms(cycle)[front], cycle.slices)
    force = absolute(gear_torque / cycle.gear_pitch_radius)
    xp = namespace(*cycle, force)

    def lumped(rows: Any) -> list[Any]:
        slot, compliance, gaps, *held = rows
        at = np.arange(len(slot))[:, None]
        matrix, contact, arm, part = held
        found = _lumped(matrix, contact, arm, gaps[at, slot], part, force, cycle.hertz_coefficient)
        table = compliance, gaps
        return [_put(xp, field, at, slot, value) for field, value in zip(table, found, strict=True)]

    fields = near, seen.compliance, cycle.gap[front]
    plain = dataclasses.replace(mesh, modifications=UNMODIFIED)
    if xp is np and near.size * near.shape[1] <= _KEPT_SIZE:
        parts = by_rows(lumped, (*fields, *kept_matrices(assembly, materials, plain, seen, near)), ROWS)
    else:
        makers, made_of = matrices(assembly, materials, plain, seen, near)
        parts = by_rows(
            lambda rows: lumped([*rows[:3], *makers([rows[0], *rows[3:]])]), (*fields, *made_of), ROWS
        )
    whole = {
        name: xp.concatenate([part, getattr(cycle, name)[0, :, fronts:]], axis=1)[None]
        for name, part in zip(("compliance", "gap"), parts, strict=True)
    }
    return cycle._replace(**whole)


def near_contact(share: Float[Array, "node slot"]) -> Array:
    """Where slots touch, or do at the node before or after."""
    touching = np.asarray(share) > 0.0
    near = touching.copy()
    near[1:] |= touching[:-1]
    near[:-1] |= touching[1:]
    return near


def _near_contact(share: Float[Array, "node slot"], touching: int) -> Array:
    """Numbers of the slots that are `near_contact`, and of as many others as make rows alike."""
    if is_jax(share):
        xp = namespace(share)
        return xp.sort(xp.argsort(share <= 0.0, axis=-1)[:, : touching or share.shape[1]], axis=-1)
    near = near_contact(share)
    most = int(np.max(near.sum(axis=-1)))
    return np.sort(np.argsort(~near, axis=-1, kind="stable")[:, :most], axis=-1)


def _put(xp: Any, whole: Any, at: Any, slot: Any, value: Any) -> Any:
    if xp is not np:
        return whole.at[at, slot].set(value)
    result = np.array(whole)
    result[at, slot] = value
    return result


def _lumped(
    matrix: Float[Array, "node slot slot"],
    local: Float[Array, "node slot"],
    arms: Float[Array, "node slot"],
    gap: Float[Array, "node slot"],
    share: Float[Array, "node slot"],
    force: Any,
    hertz: Any,
) -> tuple[Float[Array, "node slot"], Float[Array, "node slot"]]:
    """Compliances and gaps of slots alone that carry what the slots together do.

    Loads g = F/share are those of slices which touch over their whole width.
    """
    weighed = matrix * share[:, None, :]
    mean = force / (share * arms).sum(axis=-1, keepdims=True)
    start = mean + 0.0 * share, np.ones(local.shape)
    load, active = newton(_touching, start, _STEPS, weighed, local, arms, gap, share, force, hertz, mean)
    at = maximum(load, _SMALL * mean)
    contact = local + 0.9 * hertz * at**-0.1
    turned = _solve(weighed, contact, active, arms[..., None])[..., 0]
    left_over = arms - (weighed @ turned[..., None])[..., 0]
    left_over = within(left_over, _LEAST * arms, (1.0 - _LEAST) * arms)
    compliance = contact * arms / left_over - 0.9 * hertz * at**-0.1
    reached = (weighed @ load[..., None])[..., 0] + local * load
    return compliance, gap + reached - compliance * load


def _touching(
    state: tuple[Float[Array, "node slot"], Float[Array, "node slot"]],
    weighed: Float[Array, "node slot slot"],
    compliance: Float[Array, "node slot"],
    arms: Float[Array, "node slot"],
    gap: Float[Array, "node slot"],
    share: Float[Array, "node slot"],
    force: Any,
    hertz: Any,
    mean: Float[Array, "node 1"],
) -> tuple[Float[Array, "node slot"], Float[Array, "node slot"]]:
    """Newton's step of the loads that the force makes of all slots, and which slots touch (1 or 0)."""
    load, active = state
    xp = namespace(load, weighed, compliance, force)
    bent = load > _SMALL * mean
    each = hertz * maximum(load, _SMALL * mean) ** -0.1
    slope, ahead = compliance + xp.where(bent, 0.9, 1.0) * each, xp.where(bent, 0.1, 0.0) * each * load
    solved = _solve(weighed, slope, active, xp.stack([arms, gap + ahead], axis=-1))
    moved, held = solved[..., 0], solved[..., 1]
    pushing = share * arms
    total = (force + (pushing * held).sum(axis=-1)) / (pushing * moved).sum(axis=-1)
    load = moved * total[:, None] - held
    overlap = arms * total[:, None] - gap - (weighed @ load[..., None])[..., 0]
    return load, xp.where(xp.where(active > 0.0, load, overlap) > 0.0, 1.0, 0.0)


def _solve(
    weighed: Float[Array, "node slot slot"],
    contact: Float[Array, "node slot"],
    active: Float[Array, "node slot"],
    right: Float[Array, "node slot side"],
) -> Float[Array, "node slot side"]:
    """Loads under which the active slots, each with its contact, deflect so far; of the others 0."""
    xp = namespace(weighed, contact, active)
    alone = xp.where(active > 0.0, xp.diagonal(weighed, axis1=-2, axis2=-1) + contact, 1.0)
    among = weighed * (active[:, :, None] * active[:, None, :])
    left = xp.where(np.eye(contact.shape[1], dtype=bool), alone[:, :, None], among)
    return namespace(left, right).linalg.solve(left, active[..., None] * right)
