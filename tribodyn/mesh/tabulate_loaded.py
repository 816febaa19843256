"""The mesh cycle by the load contact model: compliances at the operating load, contact of the tips' corners.

What `tabulate` does with formulas, from finite elements and Hertz. A pair is tabulated beyond its path of
contact, as far as corners can touch, with the gap between them. The contact's deflection is not proportional
to the load; the table holds its secant at the load which the model finds in slow rotation without friction,
so that the quasi-static mesh at the operating torque is the load contact model's. Faces in slices are
condensed to one compliance and gap per pair (`sharing.condensed`). Back flanks are driving flanks of the
mirrored world, modified as `flanks.modification.back_flanks` says and tabulated at the same torque.
"""

import math

import numpy as np

from tribodyn.compliance.fem.gear_compliance import without_neighbours
from tribodyn.compliance.sharing.condensed import Condensed, condense
from tribodyn.compliance.sharing.flank_gap import flank_gap, relief_rolls
from tribodyn.compliance.sharing.load_sharing import flexibility, share_load
from tribodyn.compliance.sharing.loaded_contact import reach
from tribodyn.compliance.sharing.loaded_flanks import LoadedFlanks
from tribodyn.compliance.sharing.loaded_rules import check_contact, check_resolved, check_torque
from tribodyn.compliance.sharing.pair_flexibility import PairFlexibility
from tribodyn.compliance.sharing.slices import face_positions
from tribodyn.compliance.table import check_cover, interpolate
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.flanks.corner_contact import pair_geometry
from tribodyn.geometry.flanks.modification import Modifications, back_flanks, uneven_teeth
from tribodyn.geometry.material import MaterialData
from tribodyn.geometry.pitch_point import pitch_point
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.data import MeshData
from tribodyn.mesh.rules import check_backlash, check_bores
from tribodyn.mesh.tabulate import opening
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
    """Tabulate the mesh cycle of a drive at an operating torque.

    Parameters
    ----------
    assembly, materials, mesh, back
        As in `tabulate.tabulate`, of plain numbers.
    gear_torque : float
        T_g ≠ 0 at whose magnitude the compliances are taken, N m.

    Raises
    ------
    InputError
        If a body has no bore, or the torque drives nothing.
    """
    check_bores(assembly.drive)
    torque = abs(gear_torque)
    check_torque(torque)
    for broken in uneven_teeth(mesh.modifications):
        raise broken
    check_backlash(mesh, back)
    flexible, modifications, *_ = flanks_of(assembly, materials, mesh)
    behind = back_flanks(modifications, float(assembly.path.pressure_angle(0.0)))
    flanks = (modifications, behind) if back else (modifications,)
    for one in flanks:
        check_contact(flexible, one, torque, mesh.slices)
    # where the mesh vibrates by more than this reach, contact begins too late in the model
    reaches = [reach(flexible, one, torque, mesh.slices, mesh.slice_coupling) for one in flanks]
    limits = min(start for start, _ in reaches), max(end for _, end in reaches)
    pitch = assembly.pitch_angle
    span = (limits[1] - limits[0]) / pitch
    pairs = math.ceil(span)
    marks = [0.0, span, *((roll - limits[0]) / pitch for roll in assembly.roll_limits)]
    marks += [(roll - limits[0]) / pitch for one in flanks for roll in relief_rolls(assembly, one)]
    if assembly.family.corner:
        marks.append(-limits[0] / pitch)
    boundary, phase, position = phases_of_pairs(
        marks, pairs, mesh.points, back, enter=0.5 - 2.0 * limits[0] / pitch
    )
    middle = position[:, mesh.points // 2]
    in_contact = np.where((middle > 0.0) & (middle < span), 1.0, 0.0)
    roll = np.clip(limits[0] + pitch * position, *limits)

    slots = position.shape[-1]
    geometry = pair_geometry(assembly, roll.reshape(-1, slots))
    error = _transmission_error(mesh, phase, roll, assembly.roll_limits, begin=marks[2])
    full = torque / pair_geometry(assembly, np.zeros(1)).motion.gear_normal_arm[0]
    compliance, gap = np.zeros_like(geometry.gap), np.zeros_like(geometry.gap)
    coupling = np.zeros((*gap.shape, slots))
    uneven, peak = np.ones_like(gap), np.ones_like(gap)
    side = np.where(np.arange(slots) < pairs, 1.0, -1.0)
    behind_by = (mesh.backlash or 0.0) * opening(assembly.path, geometry.motion.pressure_angle)
    apart = np.where(side > 0, error.reshape(-1, slots), behind_by)
    for number, one in enumerate(flanks):
        own = slice(number * pairs, (number + 1) * pairs)
        at = roll[..., own].reshape(-1, pairs)
        pressed = _pressed(flexible, mesh, one, torque, _MINIMUM_SHARE * full, at, apart[:, own])
        compliance[:, own], gap[:, own] = pressed.compliance, pressed.gap
        coupling[:, own, own] = pressed.coupling
        uneven[:, own], peak[:, own] = pressed.line_load_friction, pressed.line_load_peak
    motion, vanishing = geometry.motion, pitch_point(assembly.path)
    return MeshCycle(
        boundary=boundary,
        in_contact=in_contact,
        side=side,
        phase=phase,
        pressure_angle=motion.pressure_angle.reshape(roll.shape),
        signed_distance=motion.signed_distance.reshape(roll.shape),
        equivalent_radius=1.0 / motion.relative_curvature.reshape(roll.shape),
        pinion_speed=motion.pinion_speed.reshape(roll.shape),
        gear_speed=motion.gear_speed.reshape(roll.shape),
        compliance=compliance.reshape(roll.shape),
        gap=gap.reshape(roll.shape),
        coupling=coupling.reshape(*roll.shape, slots),
        hertz_coefficient=0.0,
        pinion_pitch_radius=assembly.path.pinion_pitch_radius,
        gear_pitch_radius=assembly.path.gear_pitch_radius,
        pinion_teeth=assembly.drive.pinion.teeth,
        face_width=flexible.width,
        contact_ratio=assembly.contact_ratio,
        pitch_point_phase=-limits[0] / pitch,
        roll_start=limits[0],
        roll_end=limits[1],
        pitch_point_length=vanishing.length,
        pitch_point_rate=vanishing.speed_per_radius,
        line_load_friction=uneven.reshape(roll.shape),
        line_load_peak=peak.reshape(roll.shape),
    )


def flanks_of(
    assembly: Assembly, materials: tuple[MaterialData, MaterialData], mesh: MeshData
) -> LoadedFlanks:
    """The flanks that the load contact model presses together, as a scenario's mesh describes them."""
    flexible = flexibility(assembly, materials, lead=mesh.slice_coupling and mesh.slices > 1)
    if not mesh.foundation_coupling:
        apart = [without_neighbours(gear) for gear in flexible.gears]
        flexible = flexible._replace(gears=(apart[0], apart[1]))
    return LoadedFlanks(flexible, mesh.modifications, mesh.slices, mesh.slice_coupling)


def _pressed(
    flexible: PairFlexibility,
    mesh: MeshData,
    modifications: Modifications,
    gear_torque: float,
    minimum_load: float,
    roll: Float[Array, "position pair"],
    error: Float[Array, "position pair"],
) -> Condensed:
    """Pairs (position, pair) of one side, its flanks so modified, at the operating torque."""
    slices = mesh.slices
    geometry = pair_geometry(flexible.assembly, roll)
    face = face_positions(flexible.width, slices)
    gap = error[..., None] + flank_gap(flexible.assembly, modifications, geometry, face)
    shared = share_load(flexible, roll, gear_torque, 0.0, gap, slices, mesh.slice_coupling)
    check_resolved(flexible.assembly, shared, modifications, gear_torque)
    whole = geometry.gap[..., None] + gap
    return condense(flexible, geometry, whole, shared, minimum_load, mesh.slice_coupling)


def phases_of_pairs(
    marks: list[float], pairs: int, points: int, back: bool, enter: float
) -> tuple[Float[Array, " boundary"], Float[Array, "segment node"], Float[Array, "segment node pair"]]:
    """Boundaries (S + 1,), phases (S, N) and positions (S, N, Q) of all slots, in pitches since entering.

    A segment begins wherever a pair passes one of the marks (pitches since entering), for there the table has
    a kink. Back pairs as in `tabulate`: they live in the mirrored world, and enter at the phase `enter`.
    """
    enter = enter % 1.0
    phases = [mark % 1.0 for mark in marks] + ([(enter - mark) % 1.0 for mark in marks] if back else [])
    inner = np.array(sorted(phases))
    inner = inner[(inner > 1e-9) & (inner < 1.0 - 1e-9)]
    inner = inner[np.concatenate([[True], np.diff(inner) > 1e-9])] if len(inner) else inner
    boundary = np.concatenate([[0.0], inner, [1.0]])
    lower, upper = boundary[:-1, None], boundary[1:, None]
    phase = lower + (upper - lower) * np.linspace(0.0, 1.0, points)
    ages = np.arange(pairs - 1.0, -1.0, -1.0)
    position = phase[..., None] + ages
    if back:
        wrapped = np.where((lower + upper) / 2.0 > enter, 1.0, 0.0)
        position = np.concatenate([position, (enter - phase + wrapped)[..., None] + ages], axis=-1)
    return boundary, phase, position


def _transmission_error(
    mesh: MeshData,
    phase: Float[Array, "segment node"],
    roll: Float[Array, "segment node pair"],
    limits: tuple[float, float],
    begin: float,
) -> Float[Array, "segment node pair"]:
    """Errors of the flanks (S, N, Q), m; those given over roll angle stay at their ends beyond the path.

    Harmonics are in step with the beginning of the path, at the phase `begin`, as they are in `tabulate`.
    """
    error = 0.0 * roll
    for order, amplitude, angle in mesh.error_harmonics:
        error = error + (amplitude * np.cos(2.0 * np.pi * order * (phase - begin) + angle))[..., None]
    if mesh.error_table is not None:
        at, values = mesh.error_table
        check_cover(at, *limits, "mesh.transmission_error.table")
        error = error + interpolate(at, values, np.clip(roll, max(at[0], limits[0]), min(at[-1], limits[1])))
    return error
