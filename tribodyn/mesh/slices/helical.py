"""From tooth shape and elasticity to the mesh cycle of helical gears: pairs in slices along the face.

Every slice is a spur pair of its own that is late by z tan β_w/r_w of pinion rotation. It counts with the
part of its width that is on the path of contact, its *share*: the force of a slice is share · δ_n/C, with the
approach δ_n along the flanks' true normal. The share rises from 0 to 1 while the slice enters and nothing
jumps, so one segment is enough; its nodes resolve the ramps. Errors go with the square of the slices' width.

The mesh is at phase 0 where the earliest edge of the face enters B_g. `roll_start`, `roll_end` and
`pitch_point_phase` of the table are of the middle of the face: roll_start is where it stands at phase 0, half
an overlap before the path of contact, and (roll_end − roll_start)/pitch is the total contact ratio ε_γ.
`contact_ratio` is ε_α.

Back flanks. Whatever happens in one section happens in the section at z by z tan β_w/r_w later, whichever
flanks touch. In the mirrored world, where a pair's roll angle decreases, the section at z is therefore
further on by as much: mirrored, the hand of the helix is the other one.
"""

import dataclasses
import math
from collections.abc import Callable
from functools import cache, lru_cache, partial
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.energy import hertz_coefficient, hertz_linear
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData
from tribodyn.geometry.helix import (
    curvature_share,
    face_positions,
    line_stretch,
    normal_slope,
    overlap_ratio,
    pitch_slope,
    speed_share,
)
from tribodyn.geometry.modification import UNMODIFIED
from tribodyn.geometry.path import kinematics
from tribodyn.mesh import table
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.slices.gaps import SeenPart, TouchingPart, modified_gap, seen_parts, slice_gap
from tribodyn.mesh.tabulate import (
    RollCurve,
    check_options,
    distance_at_roll,
    pair_compliance,
    tabulate,
)
from tribodyn.numerics.elementary import absolute, is_jax, maximum, minimum, namespace, within
from tribodyn.numerics.remembered import remembered
from tribodyn.numerics.shapes import Array, Float

#: Nodes over which a slice comes into contact; fewer where a table would grow beyond `MAXIMUM_NODES`.
NODES_PER_RAMP = 12
MAXIMUM_NODES = 1025
#: Minimum number of slices of a helical pair.
MINIMUM_SLICES = 3
_BESIDE = 1e-6  # pitches by which nodes for extremes stand off the kinks
_KEPT = 6  # tables without modifications, whose gaps alone a relief changes
_POINTS, _FEWEST = 300, 8  # nodes of a mean altogether, about, and between two kinks at least


class SliceLayout(NamedTuple):
    """Numbers of slots and nodes of a table of slices: plain, while the drive may be traced."""

    slices: int
    nodes: int
    pairs: int  # of driving flanks that can be in contact at once, ⌈ε_γ⌉
    back: range = range(0)  # pitches by which back pairs stand apart from the one that enters
    touching: int = 0  # slots that touch at once at most, where the drive is traced; 0: not counted


def minimum_slices(assembly: Assembly) -> int:
    """Minimum number of slices: a slice is late against the next by half the path of contact at most."""
    return max(
        MINIMUM_SLICES, math.ceil(2.0 * float(overlap_ratio(assembly)) / float(assembly.contact_ratio))
    )


def slice_layout(assembly: Assembly, mesh: table.MeshData, slices: int, back: bool = False) -> SliceLayout:
    """Lay out the table of a helical pair of plain numbers.

    Raises InputError for fewer slices than `minimum_slices`.
    """
    transverse, overlap = float(assembly.contact_ratio), float(overlap_ratio(assembly))
    least = minimum_slices(assembly)
    if slices < least:
        raise InputError(
            "mesh.slices",
            slices,
            f"too few for contact ratios of {transverse:.3g} (transverse) and {overlap:.3g} (overlap)",
            f'use at least {least}, or "auto"',
        )
    resolved = math.ceil(NODES_PER_RAMP * slices / overlap) + 1 if overlap > 0.0 else MAXIMUM_NODES
    nodes = max(mesh.points, min(resolved, MAXIMUM_NODES))
    behind = range(0)
    if back:
        enter = float(table.back_entry(assembly.roll_limits[0], assembly.pitch_angle))
        # a back pair n stands at enter − phase + n + (what the section adds, up to ε_β) pitches
        behind = range(math.floor(-overlap - enter) + 1, math.ceil(transverse - enter + 1.0))
    return SliceLayout(slices, nodes, math.ceil(transverse + overlap - 1e-9), behind)


def tabulate_slices(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: table.MeshData,
    layout: SliceLayout,
    phase: Float[Array, " node"] | None = None,
) -> MeshCycle:
    """Tabulate the mesh cycle of a helical pair whose slices do not hold each other.

    Every number of the drive may be traced, unless flanks are modified. A table at other phases than the even
    ones, as they are needed to integrate and interpolate, is of helical gears. Raises InputError as
    `tabulate.tabulate`.
    """
    check_options(assembly, mesh, bool(layout.back))
    if not is_jax(assembly.drive.helix_angle) and assembly.drive.helix_angle == 0.0:
        return _spur_slices(assembly, materials, mesh, layout)
    plain = dataclasses.replace(mesh, modifications=UNMODIFIED)
    cycle, seen = _unmodified(assembly, materials, plain, layout, phase)
    opened = modified_gap(assembly, mesh, seen, cycle.pitch_slope, cycle.compliance.shape)
    return cycle._replace(gap=cycle.gap + opened)


@remembered(_KEPT)
def _unmodified(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: table.MeshData,
    layout: SliceLayout,
    phase: Float[Array, " node"] | None,
) -> tuple[MeshCycle, Callable[[], list[SeenPart]]]:
    """The table of helical flanks without modifications, and what gives the places where these would be."""
    path = assembly.path
    at, share, place = _slots(assembly, layout, phase)
    slope = absolute(pitch_slope(assembly))
    curve = RollCurve(*assembly.roll_limits)
    r_nodes = path.signed_distance(curve.nodes())
    distance = partial(distance_at_roll, assembly, curve, r_nodes)
    r = distance(at.roll)
    motion = kinematics(path, r)
    faces = Faces(slope, normal_slope(slope, motion.pressure_angle), line_stretch(slope, path, r))
    speed = speed_share(slope, path, r)
    cycle = table.mesh_table(
        assembly,
        at,
        motion._replace(pinion_speed=motion.pinion_speed * speed, gear_speed=motion.gear_speed * speed),
        table.Elasticity(
            compliance_of_slices(assembly, materials, mesh, curve, r_nodes, at.roll, faces, layout),
            np.zeros((*at.phase.shape, 1, 1)),
            slice_gap(assembly, mesh, at, motion, slope, layout.back),
            _hertz_coefficient(assembly, materials, mesh, slope, layout.slices),
            line_load_friction=1.0 / faces.stretch,
            line_load_peak=1.0 / faces.stretch,
        ),
    )
    cycle = cycle._replace(
        equivalent_radius=cycle.equivalent_radius / curvature_share(slope, path, r),
        share=share,
        face_position=face_positions(assembly.common_width, layout.slices),
        face_place=place,
        pitch_slope=slope,
    )
    slots, extent = (layout.pairs * layout.slices, layout.slices), TouchingPart(at.roll, place, share)
    return cycle, cache(lambda: seen_parts(assembly, extent, distance, slots))


def _spur_slices(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: table.MeshData,
    layout: SliceLayout,
) -> MeshCycle:
    """Slices of a spur pair, all alike, in step with the pair's segments."""
    apart = dataclasses.replace(mesh, foundation_coupling=False)
    pair = tabulate(assembly, materials, apart, layout.pairs, bool(layout.back))
    shape, count = pair.compliance.shape, layout.slices
    fields = {
        name: np.repeat(value, count, axis=-1)
        for name, value in pair._asdict().items()
        if name in ("in_contact", "side") or np.shape(value) == shape
    }
    cycle = pair._replace(**fields, face_position=face_positions(assembly.common_width, count))
    even = np.ones_like(cycle.compliance)
    place = np.tile(cycle.face_position, even.shape[-1] // count) * even
    rolls = assembly.path.rotation(cycle.signed_distance)
    extent, slots = TouchingPart(rolls, place, even), (layout.pairs * count, count)
    seen = partial(seen_parts, assembly, extent, assembly.path.signed_distance, slots)
    gap = cycle.gap + modified_gap(assembly, mesh, seen, 0.0, rolls.shape)
    return cycle._replace(
        compliance=cycle.compliance * count,
        hertz_coefficient=pair.hertz_coefficient * count**0.9,
        coupling=np.zeros((*shape[:2], 1, 1)),
        gap=gap,
        share=even,
        face_place=place,
    )


class Faces(NamedTuple):
    """How the flanks lean at the contacts."""

    pitch_slope: Any  # tan β_w ≥ 0
    normal_slope: Any  # tan β_n, shaped like the contacts
    stretch: Any  # length of the line of contact per width of the face, like the contacts


class MeanNodes(NamedTuple):
    """Nodes for means over the mesh cycle and for extremes, which move with kinks of loads and friction."""

    phase: Float[Array, " node"]
    weight: Float[Array, " node"]  # of means; 0 of nodes for extremes


def mean_nodes(assembly: Assembly, slices: int) -> MeanNodes:
    """Gauss's points between the phases at which edges of slices come, pass the pitch point or go.

    Loads and friction have their kinks there. Extremes are at the kinks too: at the nodes just inside, every
    slice touches over its whole width for the first or the last time. Even nodes, which do not move with the
    slices, have derivatives that are percents off. May be traced.
    """
    start, end = assembly.roll_limits
    pitch, late = assembly.pitch_angle, overlap_ratio(assembly) * np.arange(slices + 1.0) / slices
    xp = namespace(late, start, end)
    comes, passes, goes = late, late - start / pitch, late + (end - start) / pitch
    kinks = xp.concatenate([late[:1], 1.0 + late[:1], _fraction(comes), _fraction(passes), _fraction(goes)])
    kinks = xp.sort(kinks)
    length = (kinks[1:] - kinks[:-1])[:, None]
    at, share, _ = _gauss(slices)
    points, weights = kinks[:-1, None] + length * at, length * share
    edges = _fraction(xp.concatenate([comes + _BESIDE, goes - _BESIDE]))
    return MeanNodes(xp.concatenate([points.ravel(), edges]), xp.concatenate([weights.ravel(), 0.0 * edges]))


def most_touching(assembly: Assembly, layout: SliceLayout) -> int:
    """How many slots touch at once at most at `mean_nodes`, rounded up to eights; of plain numbers."""
    phase = mean_nodes(assembly, layout.slices).phase
    return min(
        -(-int(np.max(np.sum(_slots(assembly, layout, phase)[1] > 0.0, axis=-1))) // 8) * 8,
        layout.pairs * layout.slices,
    )


def between_nodes(values: Float[Array, " node"], slices: int) -> Float[Array, " point"]:
    """Values at all `mean_nodes`, and so many more between two kinks that no smooth extreme is missed."""
    *_, between = _gauss(slices)
    pieces = values[: -2 * (slices + 1)].reshape(-1, len(between)) @ between
    return namespace(values).concatenate([pieces.ravel(), values])


@lru_cache(maxsize=8)
def _gauss(slices: int) -> tuple[Float[Array, " node"], Float[Array, " node"], Float[Array, "node point"]]:
    """Points and weights on 0 … 1, and the matrix from there to 65 even points between the outermost."""
    count = max(_FEWEST, -(-_POINTS // (3 * slices + 4)))
    points, weights = np.polynomial.legendre.leggauss(count)
    # not beyond the outermost points: there a kink between them would be overshot most
    basis, even = np.polynomial.legendre.legvander, np.linspace(points[0], points[-1], 65)
    between = basis(even, count - 1) @ np.linalg.inv(basis(points, count - 1))
    return 0.5 + 0.5 * points, 0.5 * weights, between.T


def _fraction(phase: Any) -> Any:
    return phase - namespace(phase).floor(phase)


def _slots(
    assembly: Assembly, layout: SliceLayout, phases: Float[Array, " node"] | None
) -> tuple[table.Slots, Float[Array, "segment node slot"], Float[Array, "segment node slot"]]:
    """Where the slices stand, in the middle of the part that touches, its share of the slice, and its z."""
    start, end = assembly.roll_limits
    pitch, count = assembly.pitch_angle, layout.slices
    xp = namespace(start, end, assembly.drive)
    whole = pitch * overlap_ratio(assembly)  # by which the one end of the face is late against the other
    late = whole * face_positions(1.0, count)
    phase = (np.linspace(0.0, 1.0, layout.nodes) if phases is None else phases)[None]
    begin = start - whole / 2.0
    ages = np.arange(layout.pairs - 1.0, -1.0, -1.0)
    middle = begin + pitch * (phase[..., None] + ages)
    rolls = [middle[..., None] - late]
    nodes = phase.shape[1]
    if layout.back:
        numbers = np.array(layout.back[::-1], dtype=float)
        # z = 0 is late by a half overlap against the edge that the phase counts from
        turned = start + pitch * (table.back_entry(start, pitch) - phase[..., None] + numbers) + whole / 2.0
        rolls.append(turned[..., None] + late)
    roll = xp.concatenate([part.reshape(1, nodes, -1) for part in rolls], axis=-1)
    width = whole / count  # negative of an internal pinion, like the pitch
    first, last = minimum(start, end), maximum(start, end)
    low, high = within(roll - width / 2.0, first, last), within(roll + width / 2.0, first, last)
    share = (high - low) / width
    side = np.repeat([1.0, -1.0], [layout.pairs * count, len(layout.back) * count])
    limits = begin, end + whole / 2.0
    present = np.ones((1, side.size))
    touched = (low + high) / 2.0
    offset = within((touched - roll) / width, -0.5, 0.5)  # slices, from the slice's middle
    z = face_positions(1.0, count)
    place = assembly.common_width * (np.tile(z, side.size // count) - side * offset / count)
    return table.Slots(np.array([0.0, 1.0]), phase, present, side, touched, limits), share, place


def compliance_of_slices(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: table.MeshData,
    curve: RollCurve,
    r_nodes: Any,
    roll: Float[Array, "segment node slot"],
    faces: Faces,
    layout: SliceLayout,
) -> Float[Array, "segment node slot"]:
    """Compliance of slices that touch over their whole width, along the true normal, m/N.

    A given stiffness is that of a pair which touches over its whole face, along the true normal. The energy
    method takes the normal section of the tooth (`compliance.energy`), the contact the line's true length.
    """
    teeth = dataclasses.replace(mesh, hertz="load-dependent", foundation_coupling=False)
    pair, _ = pair_compliance(assembly, materials, teeth, curve, r_nodes, roll, layout.pairs)
    if mesh.compliance == "energy" and mesh.hertz == "linear":
        pair = pair + hertz_linear(*materials, assembly.common_width) / faces.stretch
    return pair * layout.slices


def _hertz_coefficient(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: table.MeshData,
    slope: Any,
    slices: int,
) -> Any:
    """Coefficient of a slice's deflection: a slice deflects as the whole face under the same line load.

    With the length of the line of contact at the pitch point.
    """
    if mesh.compliance != "energy" or mesh.hertz == "linear":
        return 0.0
    stretch = line_stretch(slope, assembly.path, 0.0 * assembly.r_start)
    return hertz_coefficient(*materials, assembly.common_width * stretch) * slices**0.9
