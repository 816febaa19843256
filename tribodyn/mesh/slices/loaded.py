"""The mesh cycle of helical pairs by the load contact model: slices lumped at the operating load.

Slices hold each other through the tooth, slots do not. At a node the model finds the rotation Δ, the loads F
and, of the slices that touch, how their loads grow with the rotation, F'. A slot of its own has

    F = s (Δ h − g)/C,   C = s h/F',   g = Δ h − F C/s,

s the part of the slice on the path of contact, h the arm: load and tangent under a rotation of the pair are
those of the coupled slices. Where others relieve a slice as the rotation grows, F' ≤ 0, it gets its secant
and the true gap. A slice that carries nothing is as soft as one alone in plane strain, and as far away as the
model has it.
"""

import math
from typing import NamedTuple

import numpy as np

from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, SharedLoad, contact_deflection, in_batches
from tribodyn.compliance.sharing.loaded_contact import check_resolved, reach
from tribodyn.compliance.sharing.oblique import oblique_compliance
from tribodyn.compliance.sharing.section import ObliqueFaces, oblique_faces
from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.helix import pitch_slope, roll_shift, speed_share
from tribodyn.geometry.modification import back_flanks, turned_round
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.slices.fine import parts_of_slices, summed_up
from tribodyn.mesh.slices.helical import slice_layout
from tribodyn.mesh.table import Elasticity, MeshData, Slots, mesh_table, unloaded_gap
from tribodyn.numerics.shapes import Array, Float

# A slice's load grows at least by this share of what it would alone, or it gets its secant.
_LEAST_GROWTH = 0.02
# Share of the mean line load at which a slice that carries nothing is linearised.
_UNLOADED = 0.1

#: As in `fine_slices`.
WIDTH, PER_CYCLE = 0.3, 16.0


class LoadedSlots(NamedTuple):
    """Where slices stand at the nodes."""

    slots: Slots
    roll: tuple[
        Float[Array, "node pair"], ...
    ]  # of the pairs in mid-face, rad: of driving flanks, of back flanks
    face: Float[Array, " slice"]  # m
    start: float  # pinion angle of the newest pair in mid-face at phase 0, rad
    share: Float[Array, "node slot"]
    touched: Float[Array, "node slot"]  # z in the middle of the part that touches, m


def tabulate_loaded_slices(flanks: LoadedFlanks, mesh: MeshData, gear_torque: float, back: bool) -> MeshCycle:
    """Tabulate a helical pair at an operating torque T_g > 0, N m; the flanks are checked.

    As `helical.tabulate_slices`, but for the path of contact, which reaches as far out as corners can touch.
    """
    front = canonical(flanks)
    assembly = front.flexible.assembly
    sides = [front]
    if back:
        behind = back_flanks(front.modifications, float(assembly.path.pressure_angle(0.0)))
        # the phase of the mirrored world runs backwards: what is late there is early here
        sides.append(_with_helix(front, -float(assembly.drive.helix_angle))._replace(modifications=behind))
    reaches = [reach(side, gear_torque, early=mesh.early) for side in sides]
    first, last = (min, max) if reaches[0][0] < reaches[0][1] else (max, min)  # as the pinion turns
    limits = first(start for start, _ in reaches), last(end for _, end in reaches)
    parts = parts_of_slices(assembly, front.slices, WIDTH, PER_CYCLE)
    # every second of those nodes that resolve a slice's entry: each costs as much as all of the energy method
    nodes = slice_layout(assembly, mesh, max(front.slices, front.slices * parts // 4)).nodes
    fine = [side._replace(slices=parts * side.slices) for side in sides]
    loaded = _table(assembly, mesh, _places(assembly, limits, fine[0].face(), nodes, back), fine, gear_torque)
    if parts == 1:
        return loaded
    places = _places(assembly, limits, front.face(), nodes, back)
    return summed_up(_table(assembly, mesh, places), loaded, gear_torque)


def _table(
    assembly: Assembly,
    mesh: MeshData,
    places: LoadedSlots,
    sides: list[LoadedFlanks] | None = None,
    gear_torque: float = 0.0,
) -> MeshCycle:
    """The table of slices at their places; without flanks of unit compliance."""
    at = places.slots
    motion = pair_geometry(assembly, at.roll).motion
    compliance, gap = np.ones_like(at.roll), np.zeros_like(at.roll)
    if sides is not None:
        begin = (float(assembly.roll_limits[0]) - places.start) / float(assembly.pitch_angle)
        error = unloaded_gap(assembly, mesh, at, motion.pressure_angle, begin=begin)[0]
        first, parts = 0, []
        for side, roll in zip(sides, places.roll, strict=True):
            part = slice(first, first + roll.shape[1] * side.slices)
            parts.append(_lumped(side, gear_torque, roll, error[:, part], places.share[:, part]))
            first = part.stop
        compliance, gap = (np.concatenate(field, axis=1)[None] for field in zip(*parts, strict=True))
    seen = oblique_faces(assembly, at.roll)
    across = speed_share(pitch_slope(assembly), assembly.path, motion.signed_distance)
    elastic = Elasticity(
        compliance, np.zeros((*at.phase.shape, 1, 1)), gap, 0.0, 1.0 / seen.length, 1.0 / seen.length
    )
    return mesh_table(assembly, at, motion, elastic)._replace(
        equivalent_radius=1.0 / seen.curvature,
        pinion_speed=motion.pinion_speed * across,
        gear_speed=motion.gear_speed * across,
        share=places.share[None],
        face_position=places.face,
        face_place=places.touched[None],
        pitch_slope=float(pitch_slope(assembly)),
    )


def canonical(flanks: LoadedFlanks) -> LoadedFlanks:
    """The pair with a right-hand pinion: a left-hand one looked at from its other end face."""
    angle = float(flanks.flexible.assembly.drive.helix_angle)
    if angle > 0.0:
        return flanks
    return _with_helix(flanks, -angle)._replace(modifications=turned_round(flanks.modifications))


def _with_helix(flanks: LoadedFlanks, angle: float) -> LoadedFlanks:
    before = flanks.flexible.assembly
    assembly = assemble(before.family, before.drive._replace(helix_angle=angle))
    return flanks._replace(flexible=flanks.flexible._replace(assembly=assembly))


def _places(
    assembly: Assembly, limits: tuple[float, float], face: Float[Array, " slice"], points: int, back: bool
) -> LoadedSlots:
    """Slots over one segment; of back pairs, whose phase runs backwards, one more: none is renumbered."""
    pitch, slices = float(assembly.pitch_angle), len(face)
    half_face = float(roll_shift(assembly, assembly.common_width / 2.0))
    half_slice = half_face / slices
    start = limits[0] - half_face
    pairs = math.ceil((limits[1] - limits[0] + 2.0 * half_face) / pitch)
    phase = np.linspace(0.0, 1.0, points)
    rolls = [start + pitch * (phase[:, None] + np.arange(pairs - 1.0, -1.0, -1.0))]
    if back:
        enter = (0.5 - 2.0 * start / pitch) % 1.0
        rolls.append(start + pitch * (enter - phase[:, None] + np.arange(float(pairs), -1.0, -1.0)))
    late = np.asarray(roll_shift(assembly, face))
    ways = (1.0, -1.0)[: len(rolls)]
    each = [roll[..., None] - way * late for roll, way in zip(rolls, ways, strict=True)]
    middle = np.concatenate([roll.reshape(points, -1) for roll in each], axis=1)
    first, last = min(limits), max(limits)
    low, high = (np.clip(middle + way * half_slice, first, last) for way in (-1.0, 1.0))
    share = np.minimum((high - low) / (2.0 * half_slice), 1.0)
    side = np.where(np.arange(middle.shape[1]) < pairs * slices, 1.0, -1.0)
    touching = np.where(np.any(share > 0.0, axis=0), 1.0, 0.0)[None]
    at = Slots(
        np.array([0.0, 1.0]),
        phase[None],
        touching,
        side,
        (0.5 * (low + high))[None],
        (start, limits[1] + half_face),
    )
    offset = np.clip(((low + high) / 2.0 - middle) / half_slice, -1.0, 1.0)  # half slices
    touched = np.tile(face, len(side) // slices) - side * offset * float(assembly.common_width) / (
        2.0 * slices
    )
    return LoadedSlots(at, tuple(rolls), face, start, share, touched)


def _lumped(
    flanks: LoadedFlanks,
    gear_torque: float,
    roll: Float[Array, "node pair"],
    error: Float[Array, "node slot"],
    share: Float[Array, "node slot"],
) -> tuple[Float[Array, "node slot"], Float[Array, "node slot"]]:
    """Compliance (m/N) and gap (m) of slots; the error (m) adds to the gap of the flanks."""
    flexible = flanks.flexible
    faces = oblique_faces(flexible.assembly, flanks.rolls(roll))
    shape = faces.arm.shape
    extra = flanks.gap(faces.geometry) + error.reshape(shape)
    shared = flanks.share(roll, gear_torque, 0.0, extra)
    check_resolved(flanks, shared, gear_torque)
    growth, alone = _growth(flanks, faces, shared)
    load, part = shared.slice_load, share.reshape(shape)
    turned = shared.deflection[:, None, None] * faces.arm
    touching = (load > 0.0) & (part > 0.0)
    growing = touching & (growth > _LEAST_GROWTH * faces.arm / alone)
    open_gap = faces.corner_gap + extra
    with np.errstate(divide="ignore", invalid="ignore"):
        secant = part * (turned - open_gap) / load
        tangent = part * faces.arm / growth
        compliance = np.where(growing, tangent, np.where(touching, secant, alone))
        lumped = np.where(touching, turned - load * compliance / part, turned - shared.overlap)
    gap = np.where(growing | ~touching, lumped, open_gap)
    return compliance.reshape(share.shape), gap.reshape(share.shape)


def _growth(
    flanks: LoadedFlanks, faces: ObliqueFaces, shared: SharedLoad
) -> tuple[Float[Array, "node pair slice"], Float[Array, "node pair slice"]]:
    """dF/dΔ (N/m) of the slices that touch, 0 of the others; compliance (m/N) of slices in plane strain."""
    flexible, load = flanks.flexible, shared.slice_load
    length = flexible.width / flanks.slices * faces.length
    slope = contact_deflection(flexible, faces.curvature, load / length)[1] / length
    active = (load > 0.0).reshape(len(load), -1)
    growth, plane = np.zeros(active.shape), np.zeros(load.shape)
    for rows in in_batches(load.shape):
        count, places = active[rows].shape
        matrix = oblique_compliance(flexible, faces.at(rows), flanks.coupled).reshape(count, places, places)
        both = active[rows, :, None] & active[rows, None, :]
        diagonal = np.where(active[rows], slope[rows].reshape(count, -1), 1.0)
        system = np.where(both, matrix, 0.0) + diagonal[..., None] * np.eye(places)
        arm = active[rows] * faces.arm[rows].reshape(count, -1)
        growth[rows] = np.linalg.solve(system, arm[..., None])[..., 0]
        apart = oblique_compliance(flexible, faces.at(rows), coupled=False)
        plane[rows] = np.einsum("tjsjs->tjs", apart)
    mean = np.sum(load, axis=(1, 2), keepdims=True) / np.maximum(np.sum(active, axis=1), 1)[:, None, None]
    at = np.maximum(load, _UNLOADED * mean) / length
    local = contact_deflection(flexible, faces.curvature, at)[0] / (at * length)
    return growth.reshape(load.shape), plane + local
