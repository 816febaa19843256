"""Slices of one tooth that hold each other, lumped into a table of slices at the operating load.

A load that varies along the tooth like cos kz is met by less compliance than an even one. Of the energy
method's parts the teeth answer as a string on an elastic foundation (Pasternak; for teeth M. Ajmi, P. Velex,
Mech. Mach. Theory 40 (2005) 677-693), the bodies as a half-space, whose compliance falls with the wave:

    λ_teeth(k) = C_teeth/(1 + (ℓ_t k)²),  λ_bodies(k) = C_bodies/(1 + ℓ_b k),

k along the tooth. Both lengths are shares of the normal module that are fitted to this package's finite
elements: they meet the harmonics of `compliance.sharing.slices.pair_harmonics` within 0.055 of λ(0)
(test_helical_coupling). The end faces are planes of symmetry: what free ends add is left out. Slices at
different heights of the tooth take the geometric mean of their compliances; two pairs on one body hold each
other section by section, spread like the bodies. The contact is each slice's own.

Lumping: at the operating load the slices that touch are solved together. Each slot of the table then has the
compliance and the gap that give it the same load, and the same change of load while the gears turn.
"""

import numpy as np

from tribodyn.compliance.energy import loaded_tooth, tooth_compliance
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData
from tribodyn.geometry.helix import normal_module
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.helical import SliceLayout, tabulate_slices
from tribodyn.mesh.quasi_static import normal_arms
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.tabulate import RollCurve, body_coupling
from tribodyn.numerics.shapes import Array, Float

#: ℓ_t and ℓ_b over the normal module.
TEETH_LENGTH, BODIES_LENGTH = 1.4, 3.0
# Loads, over the mean, below which the contact is linearised there; and the least part of an approach that
# a slice's own contact takes, and leaves.
_SMALL, _LEAST = 0.05, 0.02
_STEPS, _SETTLED = 20, 1e-9
_ROWS = 32  # nodes that are solved at a time
_WAVES = 6  # waves of the face per slice


def tabulate_helical(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    layout: SliceLayout,
    gear_torque: float,
) -> MeshCycle:
    """Tabulate a pair in slices, which hold each other where the mesh says so.

    Plain numbers. Only the energy method knows how slices hold each other, and only at a torque (N m).
    """
    cycle = tabulate_slices(assembly, materials, mesh, layout)
    held = mesh.compliance == "energy" and mesh.slice_coupling and assembly.drive.helix_angle
    return couple_slices(assembly, materials, mesh, cycle, gear_torque) if held and gear_torque else cycle


def couple_slices(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    cycle: MeshCycle,
    gear_torque: float,
) -> MeshCycle:
    """Lump slices that hold each other at a torque T_g ≠ 0 (N m) into a table of uncoupled ones.

    Plain numbers; driving flanks at the torque. Back flanks keep the compliance of slices by themselves.
    """
    fronts, slices = cycle.front_slots, cycle.slices
    front = np.s_[0, :, :fronts]
    r = cycle.signed_distance[front]
    teeth, bodies, between = _parts(assembly, materials, mesh, r, slices)
    own = cycle.compliance[front] - slices * (teeth + bodies)  # of the contact alone
    arms = normal_arms(cycle)[front]
    force = abs(gear_torque) / cycle.gear_pitch_radius
    share = cycle.share[front]
    width = float(assembly.common_width) / float(np.cos(assembly.drive.helix_angle))
    wave = np.pi * np.arange(_WAVES * slices) / width * float(normal_module(assembly.drive))
    falling = 1.0 / (1.0 + (TEETH_LENGTH * wave) ** 2), 1.0 / (1.0 + BODIES_LENGTH * wave)
    # a slice touches with its early part while it enters, with its late part while it leaves
    middle = (np.arange(share.shape[1]) % slices + 0.5 + np.sign(r) * (1.0 - share) / 2.0) / slices
    compliance, gap = cycle.compliance.copy(), cycle.gap.copy()
    for first in range(0, r.shape[0], _ROWS):
        rows = np.s_[first : first + _ROWS]
        along = [spread(middle[rows], share[rows], factor, slices) for factor in falling]
        matrix = slices * _matrix(teeth[rows], bodies[rows], between[rows], along)
        compliance[0, rows, :fronts], gap[0, rows, :fronts] = _lumped(
            matrix,
            own[rows],
            arms[rows],
            cycle.gap[front][rows],
            share[rows],
            force,
            float(cycle.hertz_coefficient),
        )
    return cycle._replace(compliance=compliance, gap=gap)


def spread(
    middle: Float[Array, "node slot"],
    share: Float[Array, "node slot"],
    factor: Float[Array, " wave"],
    slices: int,
) -> Float[Array, "node slot slot"]:
    """Share of what a slice's load moves at another, of a compliance that falls by a factor with the wave.

    The waves are the cosines of the face, from the even one on; middles of the parts that touch are over its
    width. Of slices that touch over their whole width the shares of all loads sum up to 1.
    """
    number = np.arange(len(factor))
    basis = np.cos(np.pi * number * middle[..., None]) * np.sinc(number * share[..., None] / (2.0 * slices))
    weight = np.where(number > 0, 2.0, 1.0) * factor / slices
    return (basis * weight) @ np.swapaxes(basis, -1, -2)


def _parts(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    r: Float[Array, "node slot"],
    slices: int,
) -> tuple[Float[Array, "node slot"], Float[Array, "node slot"], Float[Array, "node slice pair pair"]]:
    """Compliance of teeth and of bodies (N, Q) under a load over the whole face, and between pairs, m/N."""
    curve = RollCurve(*assembly.roll_limits)
    width, tooth = assembly.common_width, [loaded_tooth(assembly, side) for side in SIDES]
    nodes = assembly.path.signed_distance(curve.nodes())
    parts = [
        tooth_compliance(t, m, width, nodes, mesh.foundation) for t, m in zip(tooth, materials, strict=True)
    ]
    bodies = parts[0].foundation + parts[1].foundation
    teeth = parts[0].total + parts[1].total - bodies
    loads = [part.root_load for part in parts]
    channels = curve.interpolate(
        np.concatenate([teeth[..., None], bodies[..., None], *loads], axis=-1), assembly.path.rotation(r)
    )
    pairs = r.shape[1] // slices
    between = np.zeros((r.shape[0], slices, pairs, pairs))
    if mesh.foundation_coupling:
        load = np.swapaxes(channels[..., 2:].reshape(r.shape[0], pairs, slices, 6), 1, 2)
        between = between + body_coupling(tooth, materials, load[..., :3], load[..., 3:], pairs)
    return channels[..., 0], channels[..., 1], between


def _matrix(
    teeth: Float[Array, "node slot"],
    bodies: Float[Array, "node slot"],
    between: Float[Array, "node slice pair pair"],
    along: list[Float[Array, "node slot slot"]],
) -> Float[Array, "node slot slot"]:
    """Deflection of slots per load on slots over the number of slices, without the contact."""
    slices, pairs = between.shape[1:3]
    mean = (between[:, :, None] + between[:, None, :]) / 2.0  # (node, slice, slice, pair, pair)
    matrix = np.transpose(mean, (0, 3, 1, 4, 2)).reshape(along[1].shape) * along[1]
    number = np.arange(pairs * slices) // slices
    for part, spreading in zip((teeth, bodies), along, strict=True):
        root = np.sqrt(part)
        matrix += (number[:, None] == number) * root[:, :, None] * spreading * root[:, None, :]
    return matrix


def _lumped(
    matrix: Float[Array, "node slot slot"],
    own: Float[Array, "node slot"],
    arms: Float[Array, "node slot"],
    gap: Float[Array, "node slot"],
    share: Float[Array, "node slot"],
    force: float,
    hertz: float,
) -> tuple[Float[Array, "node slot"], Float[Array, "node slot"]]:
    """Compliances and gaps of slots alone that carry what the slots together do.

    Loads g = F/share are those of slices which touch over their whole width.
    """
    weighed = matrix * share[:, None, :]
    identity = np.eye(share.shape[1])
    mean = force / np.sum(share * arms, axis=-1, keepdims=True)
    load, active = mean + 0.0 * share, np.ones_like(share)
    total = mean[:, 0]
    for _ in range(_STEPS):
        secant = own + hertz * np.maximum(load, _SMALL * mean) ** -0.1
        left = active[:, :, None] * (weighed + identity * secant[:, :, None]) * active[:, None, :]
        left = left + identity * (1.0 - active)[:, :, None]
        right = np.stack([active * arms, active * gap], axis=-1)
        moved, held = np.moveaxis(np.linalg.solve(left, right), -1, 0)
        pushing = share * arms
        total = (force + np.sum(pushing * held, axis=-1)) / np.sum(pushing * moved, axis=-1)
        load = active * (moved * total[:, None] - held)
        overlap = arms * total[:, None] - gap - np.einsum("nij,nj->ni", weighed, load)
        before, active = active, np.where(np.where(active > 0.0, load, overlap) > 0.0, 1.0, 0.0)
        change = np.max(np.abs(secant - own - hertz * np.maximum(load, _SMALL * mean) ** -0.1) / secant)
        if np.all(active == before) and change < _SETTLED:
            break
    at = np.maximum(load, _SMALL * mean)
    contact = own + 0.9 * hertz * at**-0.1
    left = active[:, :, None] * (weighed + identity * contact[:, :, None]) * active[:, None, :]
    left = left + identity * (1.0 - active)[:, :, None]
    turned = np.linalg.solve(left, (active * arms)[..., None])[..., 0]
    left_over = arms - np.einsum("nij,nj->ni", weighed, turned)
    left_over = np.clip(left_over, _LEAST * arms, (1.0 - _LEAST) * arms)
    compliance = contact * arms / left_over - 0.9 * hertz * at**-0.1
    reached = np.einsum("nij,nj->ni", weighed, load) + own * load
    return compliance, gap + reached - compliance * load
