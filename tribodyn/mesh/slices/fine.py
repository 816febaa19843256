"""Slices that are integrated over finer ones: loads of contact lines that do not depend on the slices.

The load of a line of contact varies within a slice where the line ends, where a relief begins and where
slices that hold each other pass a load on: over a module's length. The equilibrium at the operating torque is
therefore found for finer slices. Their loads, the growth of these with the rotation, their moment about the
middle of the face and, where the pitch line crosses a slice, the sign of their sliding are summed up over
each slice:

    F = Σ F_i,   F' = Σ F_i',   z = Σ F_i z_i/F,   sign = Σ F_i sign_i/F.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData
from tribodyn.geometry.helix import normal_module, overlap_ratio
from tribodyn.geometry.modification import UNMODIFIED
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import normal_arms, quasi_static, sliding_side
from tribodyn.mesh.slices.coupled import near_contact, tabulate_helical
from tribodyn.mesh.slices.helical import SliceLayout, slice_layout
from tribodyn.mesh.table import MeshData
from tribodyn.numerics.elementary import absolute, cos, maximum, namespace
from tribodyn.numerics.shapes import Array, Float

#: Maximum width of fine slices along the tooth, normal modules, and minimum number of them per mesh cycle.
WIDTH, PER_CYCLE = 0.35, 20.0
# Least part of a slice's compliance, of the sum with its contact's.
_LEAST = 0.02


def parts_of_slices(
    assembly: Assembly, slices: int, width: float = WIDTH, per_cycle: float = PER_CYCLE
) -> int:
    """In how many fine ones each of so many slices of a helical pair is cut."""
    length = float(assembly.common_width) / math.cos(float(assembly.drive.helix_angle))
    along = length / (width * float(normal_module(assembly.drive)))
    return math.ceil(max(along, per_cycle * float(overlap_ratio(assembly))) / slices)


def tabulate_integrated(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    gear_torque: float,
    back: bool = False,
    nodes: int | None = None,
) -> MeshCycle:
    """Tabulate a pair of plain numbers as `coupled_slices.tabulate_helical`, integrated over fine slices.

    With as many nodes as the fine slices take, unless their number is given.
    """
    layout, parts = fine_layout(assembly, mesh, gear_torque, back)
    layout = layout if nodes is None else layout._replace(nodes=nodes)
    return tabulate_fine(assembly, materials, mesh, layout, parts, gear_torque)


def fine_layout(
    assembly: Assembly, mesh: MeshData, gear_torque: float, back: bool = False
) -> tuple[SliceLayout, int]:
    """Lay out the fine slices of a pair of plain numbers, so many for each of its slices."""
    held = mesh.compliance == "energy" and mesh.slice_coupling
    slice_layout(assembly, mesh, mesh.slices)  # refuses too few
    parts = 1
    if assembly.drive.helix_angle and gear_torque and (held or mesh.modifications != UNMODIFIED):
        parts = parts_of_slices(assembly, mesh.slices)
    return slice_layout(assembly, mesh, mesh.slices * parts, back), parts


def tabulate_fine(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    layout: SliceLayout,
    parts: int,
    gear_torque: Any,
    phase: Float[Array, " node"] | None = None,
) -> MeshCycle:
    """Tabulate slices of so many fine ones each, which are laid out; may be traced as `tabulate_helical`."""
    fine = tabulate_helical(assembly, materials, mesh, layout, gear_torque, phase)
    if parts == 1:
        return fine
    # of the slices themselves only where they stand counts
    apart = replace(mesh, modifications=UNMODIFIED, slice_coupling=False)
    whole = layout._replace(slices=layout.slices // parts)
    fine_table = tabulate_helical(assembly, materials, apart, whole, gear_torque, phase)
    return summed_up(fine_table, fine, gear_torque)


def summed_up(cycle: MeshCycle, fine: MeshCycle, gear_torque: Any) -> MeshCycle:
    """A table of slices with the loads of one of finer slices at the same nodes.

    Exact at the operating torque T_g ≠ 0 (N m) in slow rotation without friction; to first order elsewhere.
    """
    xp = namespace(*cycle, *fine, gear_torque)
    torque = cycle.gear_sense * absolute(gear_torque)
    solved, arms = quasi_static(fine, torque), normal_arms(cycle)
    load, deflection = solved.normal_load, solved.deflection[..., None] + 0.0 * cycle.compliance
    if np.any(np.asarray(fine.side) < 0):  # back flanks at the same torque
        behind = quasi_static(fine._replace(side=-fine.side), torque)
        load = load + behind.normal_load
        deflection = xp.where(cycle.side > 0, deflection, behind.deflection[..., None])
    shape = (*cycle.compliance.shape, fine.slices // cycle.slices)
    load, share, compliance, gap, place = (
        xp.broadcast_to(field, fine.compliance.shape).reshape(shape)
        for field in (load, fine.share, fine.compliance, fine.gap, fine.face_place)
    )
    carried, part = load.sum(axis=-1), share.mean(axis=-1)
    carries = (carried > 0.0) & (part > 0.0)
    whole = xp.where(part > 0.0, part, 1.0)

    # what does not carry lies as far away and is as soft as its parts together, or as those that are next
    near = xp.ones_like(share, dtype=bool)
    if xp is np:
        near_path = near_contact(share[0].reshape(shape[1], -1)).reshape(shape)
        near = near_path | ~np.any(near_path, axis=-1, keepdims=True)
    weight = xp.where(part[..., None] > 0.0, share, near) / compliance
    stiffness = weight.sum(axis=-1)
    soft = xp.where(part > 0.0, part, near.mean(axis=-1)) / stiffness
    away = (weight * gap).sum(axis=-1) / stiffness

    mean = xp.where(carries, carried, 1.0) / whole
    each = xp.where(load > 0.0, load, 1.0) / xp.where(share > 0.0, share, 1.0)
    contact = fine.hertz_coefficient * each**-0.1
    growth = (xp.where(load > 0.0, share, 0.0) / (compliance + 0.9 * contact)).sum(axis=-1)
    together = whole / xp.where(carries, growth, 1.0)
    contact = cycle.hertz_coefficient * mean**-0.1
    tangent = maximum(together - 0.9 * contact, _LEAST * together)
    reached = deflection * arms
    middle = cycle.face_place
    all_of_it = xp.where(carries, carried, 1.0)
    at = (load * place).sum(axis=-1) / all_of_it
    # while the pitch line crosses a slice it stands where the sign of its sliding is that of its load's parts
    sign = (load * sliding_side(fine).reshape(shape)).sum(axis=-1) / all_of_it
    cosine = cos(cycle.pressure_angle)
    half = 0.5 * part * cycle.slice_width * cycle.pitch_slope * cosine
    crossed = carries & (xp.abs(sign) < 1.0 - 1e-9)
    moved = xp.where(crossed, sign * half - cycle.signed_distance, 0.0)
    across = moved * cycle.line_load_friction * cosine / arms  # speeds are across the line of contact
    return cycle._replace(
        signed_distance=cycle.signed_distance + moved,
        pinion_speed=cycle.pinion_speed + across,
        gear_speed=cycle.gear_speed - across * cycle.pinion_pitch_radius / cycle.gear_pitch_radius,
        compliance=xp.where(carries, tangent, soft),
        gap=xp.where(carries, reached - (tangent + contact) * mean, away),
        face_place=xp.where(carries, at, middle),
    )
