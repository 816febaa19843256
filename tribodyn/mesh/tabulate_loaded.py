"""The mesh cycle by the load contact model: compliances at the operating load, contact of the tips' corners.

What `tabulate` does with formulas, from finite elements and Hertz. A pair is tabulated beyond its path of
contact, as far as corners can touch, with the gap between them. The contact's deflection is not proportional
to the load; the table holds its secant at the load which the model finds in slow rotation without friction,
so that the quasi-static mesh at the operating torque is the load contact model's. Faces in slices are
condensed to one compliance and gap per pair (`sharing.condensed`), those of helical pairs to one per slice
(`loaded_slices`). Back flanks are driving flanks of the
mirrored world, modified as `flanks.modification.back_flanks` says and tabulated at the same torque.
"""

import math
from collections.abc import Sequence

import numpy as np

from tribodyn.compliance.fem.gear_compliance import without_neighbours
from tribodyn.compliance.sharing.condensed import Condensed, condense
from tribodyn.compliance.sharing.flank_gap import relief_rolls
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.compliance.sharing.loaded_contact import check_contact, check_resolved, check_torque, reach
from tribodyn.compliance.sharing.section import is_helical
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.corner_contact import PairGeometry, pair_geometry, part_of
from tribodyn.geometry.drive import MaterialData
from tribodyn.geometry.modification import back_flanks, uneven_teeth
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.slices.loaded import tabulate_loaded_slices
from tribodyn.mesh.table import (
    Elasticity,
    MeshData,
    back_entry,
    check_backlash,
    check_bores,
    mesh_table,
    slots,
    unloaded_gap,
)
from tribodyn.numerics.shapes import Array, Float

# Share of a single pair's load below which the secant no longer follows the load: the contact's compliance
# grows without bound, like a logarithm, as the load vanishes.
_MINIMUM_SHARE = 0.05


def tabulate_loaded(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    gear_torque: float,
    back: bool = False,
) -> MeshCycle:
    """Tabulate the mesh cycle of a drive of plain numbers at an operating torque T_g ≠ 0, N m.

    Raises InputError if a body has no bore, or the torque drives nothing; else as `tabulate.tabulate`.
    """
    check_bores(assembly.drive, mesh.held)
    torque = abs(gear_torque)
    check_torque(torque)
    for broken in uneven_teeth(mesh.modifications):
        raise broken
    check_backlash(mesh, back)
    front = flanks_of(assembly, materials, mesh)
    behind = back_flanks(mesh.modifications, float(assembly.path.pressure_angle(0.0)))
    sides = [front, front._replace(modifications=behind)] if back else [front]
    for flanks in sides:
        check_contact(flanks, torque)
    if is_helical(assembly):
        return tabulate_loaded_slices(front, mesh, torque, back)
    # where the mesh vibrates by more than this reach, contact begins too late in the model
    reaches = [reach(flanks, torque, early=mesh.early) for flanks in sides]
    limits = min(start for start, _ in reaches), max(end for _, end in reaches)
    pitch = assembly.pitch_angle
    kinks = [0.0] if assembly.family.corner else []
    kinks += [roll for flanks in sides for roll in relief_rolls(assembly, flanks.modifications)]
    marks = [(roll - limits[0]) / pitch for roll in (*limits, *assembly.roll_limits, *kinks)]
    pairs = math.ceil(marks[1])
    enter = back_entry(limits[0], pitch) if back else None
    at = slots(segments(marks, enter), limits, pitch, pairs, mesh.points, back)

    shape = at.roll.shape
    roll = at.roll.reshape(-1, shape[-1])
    geometry = pair_geometry(assembly, roll)
    motion = geometry.motion._make(field.reshape(shape) for field in geometry.motion)
    error = unloaded_gap(assembly, mesh, at, motion.pressure_angle, begin=marks[2]).reshape(roll.shape)
    pressed, coupling = [], np.zeros((*shape, shape[-1]))
    for number, flanks in enumerate(sides):
        slot = slice(number * pairs, (number + 1) * pairs)
        of_slot = np.s_[:, slot]
        part = _pressed(flanks, torque, part_of(geometry, of_slot), roll[of_slot], error[of_slot])
        coupling[..., slot, slot] = part.coupling.reshape(*shape[:2], pairs, pairs)
        pressed.append(part)
    fields = {
        name: np.concatenate([getattr(part, name) for part in pressed], axis=1).reshape(shape)
        for name in ("compliance", "gap", "line_load_friction", "line_load_peak")
    }
    return mesh_table(assembly, at, motion, Elasticity(coupling=coupling, **fields))


def flanks_of(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData
) -> LoadedFlanks:
    """The flanks that the load contact model presses together, as a scenario's mesh describes them."""
    lead = mesh.slice_coupling and mesh.slices > 1
    flexible = flexibility(assembly, materials, lead=lead, held=mesh.held)
    if not mesh.foundation_coupling:
        apart = [without_neighbours(gear) for gear in flexible.gears]
        flexible = flexible._replace(gears=(apart[0], apart[1]))
    return LoadedFlanks(flexible, mesh.modifications, mesh.slices, mesh.slice_coupling)


def segments(marks: Sequence[float], enter: float | None) -> Float[Array, " boundary"]:
    """Phases (S + 1,) at which a pair passes one of the marks (pitches since entering): kinks of the table.

    Those of back pairs too, which enter at the phase `enter`, where there are any.
    """
    phases = [mark % 1.0 for mark in marks]
    if enter is not None:
        phases += [(enter - mark) % 1.0 for mark in marks]
    inner = np.array(sorted(phases))
    inner = inner[(inner > 1e-9) & (inner < 1.0 - 1e-9)]
    inner = inner[np.diff(inner, prepend=-1.0) > 1e-9]
    return np.concatenate([[0.0], inner, [1.0]])


def _pressed(
    flanks: LoadedFlanks,
    gear_torque: float,
    geometry: PairGeometry,
    roll: Float[Array, "position pair"],
    error: Float[Array, "position pair"],
) -> Condensed:
    """Pairs (position, pair) of one side at the operating torque."""
    flexible = flanks.flexible
    gap = error[..., None] + flanks.gap(geometry)
    shared = flanks.share(roll, gear_torque, 0.0, gap)
    check_resolved(flanks, shared, gear_torque)
    full = abs(gear_torque / pair_geometry(flexible.assembly, np.zeros(1)).motion.gear_normal_arm[0])
    whole = geometry.gap[..., None] + gap
    return condense(flexible, geometry, whole, shared, _MINIMUM_SHARE * full, flanks.coupled)
