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

from typing import Any

import numpy as np

from tribodyn.compliance.energy import LoadedTooth, loaded_tooth, tooth_compliance, under_uneven_load
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData
from tribodyn.geometry.helix import normal_module
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import normal_arms
from tribodyn.mesh.slices.helical import SliceLayout, tabulate_slices
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import RollCurve, body_coupling
from tribodyn.numerics.elementary import absolute, cos, is_jax, maximum, namespace, sqrt, within
from tribodyn.numerics.iteration import by_rows, newton
from tribodyn.numerics.processes.libraries import one_blas_thread
from tribodyn.numerics.shapes import Array, Float

#: ℓ_t and ℓ_b over the normal module.
TEETH_LENGTH, BODIES_LENGTH = 1.4, 3.0
# Loads, over the mean, below which the contact is linearised there; and the least part of an approach that
# a slice's own contact takes, and leaves.
_SMALL, _LEAST = 0.05, 0.02
_STEPS = 15
_ROWS = 32  # nodes that are solved at a time
_WAVES = 4  # waves of the face per slice


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
    fronts, slices = cycle.front_slots, cycle.slices
    front = np.s_[0, :, :fronts]
    r = cycle.signed_distance[front]
    loaded = [loaded_tooth(assembly, side, mesh.held) for side in SIDES]
    teeth, even, even_between = _parts(assembly, materials, mesh, loaded, r, slices)
    contact_compliance = cycle.compliance[front] - slices * (teeth + even)  # of the contact alone
    uneven = loaded if mesh.held else [under_uneven_load(tooth) for tooth in loaded]
    _, bodies, between = _parts(assembly, materials, mesh, uneven, r, slices)
    arms = normal_arms(cycle)[front]
    force = absolute(gear_torque / cycle.gear_pitch_radius)
    share = cycle.share[front]
    width = assembly.common_width / cos(assembly.drive.helix_angle)
    wave = np.pi * np.arange(_WAVES * slices) / width * normal_module(assembly.drive)
    falling = 1.0 / (1.0 + (TEETH_LENGTH * wave) ** 2), 1.0 / (1.0 + BODIES_LENGTH * wave)
    xp = namespace(*cycle, force, wave)
    # a slice touches with its early part while it enters, with its late part while it leaves
    middle = (np.arange(share.shape[1]) % slices + 0.5 + xp.sign(r) * (1.0 - share) / 2.0) / slices

    def at_nodes(rows: Any) -> list[Any]:
        slot, between, even_between, compliance, gaps, *fields = rows
        at = np.arange(len(slot))[:, None]
        gap, line, body, whole, contact, arm, part, place = (field[at, slot] for field in (gaps, *fields))
        along = spread(place, part, falling, slices)
        matrix = slices * _matrix(line, body, between, along, slot)
        if not mesh.held:  # what a load over the whole face does not meet
            over_face, same = _by_slots(even_between - between, slot)
            bodies_over_face = whole - body
            matrix = matrix + (
                over_face + same * (bodies_over_face[:, :, None] + bodies_over_face[:, None, :]) / 2.0
            )
        lumped = _lumped(matrix, contact, arm, gap, part, force, cycle.hertz_coefficient)
        table = compliance, gaps
        return [_put(xp, field, at, slot, value) for field, value in zip(table, lumped, strict=True)]

    near, gap = _near_contact(share, touching), cycle.gap[front]
    fields = (
        near,
        between,
        even_between,
        cycle.compliance[front],
        gap,
        teeth,
        bodies,
        even,
        contact_compliance,
        arms,
        share,
        middle,
    )
    parts = by_rows(at_nodes, fields, _ROWS)
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


def spread(
    middle: Float[Array, "*node slot"],
    share: Float[Array, "*node slot"],
    factors: tuple[Float[Array, " wave"], ...],
    slices: int,
) -> list[Float[Array, "*node slot slot"]]:
    """Share of what a slice's load moves at another, of compliances that fall by factors with the wave.

    The waves are the cosines of the face, from the even one on; middles of the parts that touch are over its
    width. Of slices that touch over their whole width the shares of all loads sum up to 1.
    """
    xp, number = namespace(middle, share, *factors), np.arange(len(factors[0]))
    if xp is np and middle.ndim > 1:  # slices that touch over their whole width are the same at all nodes
        parts, place = np.unique(middle + 1j * share, return_inverse=True)
        place = place.reshape(middle.shape)
        at = place[..., :, None], place[..., None, :]
        return [one[at] for one in spread(np.real(parts), np.imag(parts), factors, slices)]
    basis = xp.cos(np.pi * number * middle[..., None]) * xp.sinc(number * share[..., None] / (2.0 * slices))
    weight = np.where(number > 0, 2.0, 1.0) / slices
    return [(basis * (weight * factor)) @ xp.swapaxes(basis, -1, -2) for factor in factors]


def _parts(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    tooth: list[LoadedTooth],
    r: Float[Array, "node slot"],
    slices: int,
) -> tuple[Float[Array, "node slot"], Float[Array, "node slot"], Float[Array, "node slice pair pair"]]:
    """Compliance of teeth and of bodies (N, Q) under a load over the whole face, and between pairs, m/N."""
    curve = RollCurve(*assembly.roll_limits)
    width = assembly.common_width
    nodes = assembly.path.signed_distance(curve.nodes())
    parts = [
        tooth_compliance(t, m, width, nodes, mesh.foundation) for t, m in zip(tooth, materials, strict=True)
    ]
    bodies = parts[0].foundation + parts[1].foundation
    teeth = parts[0].total + parts[1].total - bodies
    loads = [part.root_load for part in parts]
    together = namespace(teeth, bodies, *loads).concatenate(
        [teeth[..., None], bodies[..., None], *loads], axis=-1
    )
    channels = curve.interpolate(together, assembly.path.rotation(r))
    pairs = r.shape[1] // slices
    between = np.zeros((r.shape[0], slices, pairs, pairs))
    if mesh.foundation_coupling:
        load = channels[..., 2:].reshape(r.shape[0], pairs, slices, 6).swapaxes(1, 2)
        between = between + body_coupling(tooth, materials, load[..., :3], load[..., 3:], pairs)
    return channels[..., 0], channels[..., 1], between


def _matrix(
    teeth: Float[Array, "node place"],
    bodies: Float[Array, "node place"],
    between: Float[Array, "node slice pair pair"],
    along: list[Float[Array, "node place place"]],
    slot: Any,
) -> Float[Array, "node place place"]:
    """Deflection of slots per load on slots over the number of slices, without the contact.

    `slot` (node, place): the slots' numbers.
    """
    matrix, same = _by_slots(between, slot)
    matrix = matrix * along[1]
    for part, spreading in zip((teeth, bodies), along, strict=True):
        root = sqrt(part)
        matrix = matrix + same * root[:, :, None] * spreading * root[:, None, :]
    return matrix


def _by_slots(between: Float[Array, "node slice pair pair"], slot: Any) -> tuple[Any, Any]:
    """What couples pairs in a slice as between slots, in the mean of both slices; and whether of one pair."""
    _, slices, pairs, _ = between.shape
    pair, part = slot // slices, slot % slices
    # places in the array laid out flat: to take them is faster than by four indices
    at = (np.arange(len(slot))[:, None] * slices + part) * pairs**2
    one, other = pair[:, :, None], pair[:, None, :]
    both = one * pairs + other
    flat = between.reshape(-1)
    matrix = flat[at[:, :, None] + both] + flat[at[:, None, :] + both]
    return matrix / 2.0, one == other


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
    identity = np.eye(contact.shape[1])
    left = active[:, :, None] * (weighed + identity * contact[:, :, None]) * active[:, None, :]
    left = left + identity * (1.0 - active)[:, :, None]
    return namespace(left, right).linalg.solve(left, active[..., None] * right)
