"""From tooth shape and elasticity to the mesh cycle.

Array code: NumPy for a drive of floats (JAX is not imported), JAX for a traced drive, so that a mesh cycle
can be differentiated in the drive's continuous parameters and a batch of drives tabulated by `vmap`.
Whatever is costly is evaluated at a few Chebyshev points on either side of the pitch point and interpolated.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.energy import (
    LoadedTooth,
    hertz_coefficient,
    hertz_linear,
    loaded_tooth,
    neighbour_coupling,
    tooth_compliance,
)
from tribodyn.compliance.table import check_cover, interpolate
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, Drive
from tribodyn.geometry.material import MaterialData
from tribodyn.geometry.path import Path, kinematics
from tribodyn.geometry.pitch_point import pitch_point
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.data import MeshData
from tribodyn.mesh.rules import check_backlash, check_bores, check_foundation
from tribodyn.numerics.elementary import cos, namespace
from tribodyn.numerics.iteration import chebyshev_basis
from tribodyn.numerics.shapes import Array, Float

# Degree of the interpolation over each half of the contact; test_tabulate shows what it leaves.
_DEGREE = 16
# Mesh cycles; far below anything that is resolved, far above rounding.
_MINIMUM_SEGMENT = 1e-11
_POINTS = -np.cos(np.pi * np.arange(_DEGREE + 1) / _DEGREE)
_TO_SERIES = np.linalg.inv(np.polynomial.chebyshev.chebvander(_POINTS, _DEGREE))


def pair_slots(assembly: Assembly) -> int:
    """Maximum number of pairs in contact at once: the contact ratio rounded up. Plain numbers only."""
    return math.ceil(assembly.contact_ratio)


def tabulate(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    pairs: int,
    back: bool = False,
) -> MeshCycle:
    """Tabulate the mesh cycle of a drive.

    Parameters
    ----------
    assembly : Assembly
        The gear pair; every number of the drive may be traced.
    materials : (MaterialData, MaterialData)
        Of pinion and gear.
    mesh : MeshData
        Source of the compliance, transmission error, backlash and number of nodes.
    pairs : int
        Front slots, `pair_slots(assembly)`.
    back : bool
        Whether to add as many slots for the back flanks, `mesh.backlash` away.

    Raises
    ------
    InputError
        If a table does not cover the contact, an option lacks its numbers, or options contradict each other.
    """
    drive, path, corner = assembly.drive, assembly.path, assembly.family.corner
    _check_options(drive, mesh, back)
    start, end = assembly.roll_limits
    boundary, phase, in_contact, roll = _phases(assembly, pairs, mesh.points, back)
    if corner:  # which side of the pitch point a node there is on must not depend on rounding
        xp = namespace(roll)
        roll = xp.where(xp.abs(roll) < _MINIMUM_SEGMENT, 0.0, roll)
    curve = _RollCurve(start, end)

    r_nodes = path.signed_distance(curve.nodes())
    r = curve.interpolate(r_nodes, roll)
    if corner:  # paths that may be steep at their ends: one of Newton's steps from the series
        r = r - (path.rotation(r) - roll) * path.pinion_pitch_radius * cos(path.pressure_angle(r))
    motion = kinematics(path, r)
    vanishing = pitch_point(path)
    width = assembly.common_width
    compliance, coupling = _compliance(assembly, materials, mesh, curve, r_nodes, roll, pairs)
    gap = _transmission_error(mesh, phase, roll, curve)
    side = np.ones(pairs)
    if back:
        side = np.concatenate([side, -side])
        gap = namespace(gap).where(side > 0, gap, mesh.backlash * opening(path, motion.pressure_angle))
    linear = mesh.compliance != "energy" or mesh.hertz == "linear"
    return MeshCycle(
        boundary=boundary,
        in_contact=in_contact,
        side=side,
        phase=phase,
        pressure_angle=motion.pressure_angle,
        signed_distance=r,
        equivalent_radius=1.0 / motion.relative_curvature,
        pinion_speed=motion.pinion_speed,
        gear_speed=motion.gear_speed,
        compliance=compliance,
        gap=gap,
        coupling=coupling,
        hertz_coefficient=0.0 if linear else hertz_coefficient(*materials, width),
        pinion_pitch_radius=path.pinion_pitch_radius,
        gear_pitch_radius=path.gear_pitch_radius,
        pinion_teeth=drive.pinion.teeth,
        face_width=width,
        contact_ratio=assembly.contact_ratio,
        pitch_point_phase=-start / assembly.pitch_angle,
        roll_start=start,
        roll_end=end,
        pitch_point_length=vanishing.length,
        pitch_point_rate=vanishing.speed_per_radius,
    )


def _check_options(drive: Drive, mesh: MeshData, back: bool) -> None:
    if mesh.compliance == "energy":
        check_bores(drive)
    if mesh.compliance == "constant" and mesh.stiffness is None:
        raise InputError(
            "mesh.stiffness", rule="is needed for compliance = 'constant'", remedy="give one pair's"
        )
    if mesh.compliance == "table" and mesh.table is None:
        raise InputError("mesh.table", rule="is needed for compliance = 'table'", remedy="name a CSV file")
    if mesh.compliance != "energy" and mesh.hertz == "load-dependent":
        raise InputError(
            "mesh.hertz",
            mesh.hertz,
            f"compliance = '{mesh.compliance}' already contains the contact",
            "use 'linear', or compliance = 'energy'",
        )
    check_backlash(mesh, back)


def opening(path: Path, pressure_angle: Float[Array, "..."]) -> Float[Array, "..."]:
    """Normal distance of back flanks over that at the pitch point.

    Conjugate flanks all touch after the same rotation: the distance along a normal goes like cos α.
    """
    return cos(pressure_angle) / cos(path.pressure_angle(0.0))


def _phases(
    assembly: Assembly, pairs: int, points: int, back: bool
) -> tuple[
    Float[Array, " boundary"],
    Float[Array, "segment node"],
    Float[Array, "segment pair"],
    Float[Array, "segment node pair"],
]:
    """Boundaries (S + 1,), phases (S, N), contact (S, Q) and roll angles (S, N, Q) of all slots.

    Positions count pitches since a pair's first contact. A back pair lives in the mirrored world, where the
    phase runs backwards: the back flank of a pinion tooth crosses the pitch point half a pitch after its
    front flank, so that its roll angle there is π/Z_p − φ. Where the path has a corner at the pitch point a
    segment also begins when a pair passes it, for no spline may run across.
    """
    (start, end), ratio, pitch = assembly.roll_limits, assembly.contact_ratio, assembly.pitch_angle
    xp = namespace(start, ratio)
    leave = ratio - (pairs - 1)
    ages = np.arange(pairs - 1.0, -1.0, -1.0)
    enter = (0.5 - 2.0 * start / pitch) % 1.0
    boundary = [0.0 * leave, leave, 1.0 + 0.0 * leave]
    if back:
        boundary += [enter, (enter - leave) % 1.0]
    if assembly.family.corner:
        passes = -start / pitch
        boundary += [passes % 1.0] + ([(passes + 0.5) % 1.0] if back else [])
    boundary = _apart(xp.sort(xp.stack(boundary)))
    lower, upper = boundary[:-1, None], boundary[1:, None]
    phase = lower + (upper - lower) * np.linspace(0.0, 1.0, points)
    middle = (lower + upper) / 2
    position, centre = phase[:, :, None] + ages, middle + ages
    if back:
        wrapped = xp.where(middle > enter, 1.0, 0.0)
        mirrored = (enter - phase + wrapped)[:, :, None] + ages
        position = xp.concatenate([position, mirrored], axis=-1)
        centre = xp.concatenate([centre, enter - middle + wrapped + ages], axis=-1)
    in_contact = xp.where(centre < ratio, 1.0, 0.0)
    roll = start + pitch * position
    return boundary, phase, in_contact, xp.clip(roll, start, end)


def _apart(boundary: Float[Array, " boundary"]) -> Float[Array, " boundary"]:
    """Move boundaries that fall together, as at a whole contact ratio, so that every segment has a length."""
    xp = namespace(boundary)
    phases = [boundary[0]]
    for value in boundary[1:-1]:
        phases.append(xp.maximum(value, phases[-1] + _MINIMUM_SEGMENT))
    phases.append(boundary[-1])
    for i in range(len(phases) - 2, 0, -1):
        phases[i] = xp.minimum(phases[i], phases[i + 1] - _MINIMUM_SEGMENT)
    return xp.stack(phases)


class _RollCurve(NamedTuple):
    """Interpolation over the roll angle, by a Chebyshev series on either side of the pitch point.

    Two pieces, because the paths of some families have a kink there.
    """

    start: Any
    end: Any

    def nodes(self) -> Float[Array, "2 17"]:
        """Roll angles of the nodes, (2, 17), rad."""
        xp = namespace(self.start, self.end)
        unit = 0.5 + 0.5 * _POINTS
        return xp.stack([self.start * (1.0 - unit), self.end * unit])

    def interpolate(self, values: Float[Array, "2 17 ..."], roll: Float[Array, "..."]) -> Float[Array, "..."]:
        """Values (…, k) at the roll angles (…), from values (2, 17, k) at the nodes; k may be missing."""
        xp = namespace(values, roll)
        approach = roll < 0
        at = xp.where(approach, 1.0 - 2.0 * roll / self.start, 2.0 * roll / self.end - 1.0)
        basis = chebyshev_basis(at, _DEGREE) @ _TO_SERIES
        if values.ndim == 3:
            approach = approach[..., None]
        return xp.where(approach, basis @ values[0], basis @ values[1])


def _compliance(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    curve: _RollCurve,
    r_nodes: Float[Array, "2 17"],
    roll: Float[Array, "segment node pair"],
    pairs: int,
) -> tuple[Float[Array, "segment node pair"], Float[Array, "segment node pair pair"]]:
    """Compliance (S, N, Q) of single pairs and coupling (S, N, Q, Q)."""
    xp = namespace(roll)
    uncoupled = xp.zeros((*roll.shape, roll.shape[-1]))
    if mesh.compliance == "constant" and mesh.stiffness is not None:
        return xp.full_like(roll, 1.0 / mesh.stiffness), uncoupled
    if mesh.compliance == "table" and mesh.table is not None:
        angle, stiffness = mesh.table
        check_cover(angle, curve.start, curve.end, "mesh.table")
        return 1.0 / interpolate(angle, stiffness, xp.clip(roll, angle[0], angle[-1])), uncoupled

    width = assembly.common_width
    teeth = [loaded_tooth(assembly, side) for side in SIDES]
    parts = [
        tooth_compliance(t, m, width, r_nodes, mesh.foundation) for t, m in zip(teeth, materials, strict=True)
    ]
    for side, part in zip(SIDES, parts, strict=True):
        check_foundation(side, part.foundation)
    pair = parts[0].total + parts[1].total
    if mesh.hertz == "linear":
        pair = pair + hertz_linear(*materials, width)
    loads = [part.root_load for part in parts]
    together = namespace(pair, *loads).concatenate([pair[..., None], *loads], axis=-1)
    channels = curve.interpolate(together, roll)
    coupling = uncoupled
    if mesh.foundation_coupling:
        coupling = _coupling(teeth, materials, channels[..., 1:4], channels[..., 4:7], pairs)
    return channels[..., 0], coupling


def _coupling(
    teeth: list[LoadedTooth],
    materials: tuple[MaterialData, MaterialData],
    pinion_load: Float[Array, "segment node pair 3"],
    gear_load: Float[Array, "segment node pair 3"],
    pairs: int,
) -> Float[Array, "segment node pair pair"]:
    """Deflection of one pair per load on another through both bodies, (S, N, Q, Q).

    Front and back flanks never carry at the same time while there is backlash, so they are left uncoupled.
    """
    slots = pinion_load.shape[-2]
    zero = 0.0 * pinion_load[..., 0, 0]
    entries = [[zero] * slots for _ in range(slots)]
    for pitches in range(1, pairs):
        matrices = [neighbour_coupling(t, m, pitches) for t, m in zip(teeth, materials, strict=True)]
        for later in range(slots):
            earlier = later - pitches
            if earlier < 0 or earlier // pairs != later // pairs:
                continue
            entry = zero
            for matrix, load in zip(matrices, (pinion_load, gear_load), strict=True):
                xp = namespace(matrix, load)
                entry = entry + xp.einsum(
                    "...i,ij,...j->...", load[..., later, :], matrix, load[..., earlier, :]
                )
            entries[later][earlier] = entries[earlier][later] = entry
    xp = namespace(entries)
    return xp.stack([xp.stack(row, axis=-1) for row in entries], axis=-1)


def _transmission_error(
    mesh: MeshData,
    phase: Float[Array, "segment node"],
    roll: Float[Array, "segment node pair"],
    curve: _RollCurve,
) -> Float[Array, "segment node pair"]:
    """Compute the transmission error (S, N, Q), m: harmonics of the mesh phase, table over roll angle."""
    gap = 0.0 * roll
    for order, amplitude, angle in mesh.error_harmonics:
        gap = gap + (amplitude * cos(2.0 * np.pi * order * phase + angle))[..., None]
    if mesh.error_table is not None:
        at, error = mesh.error_table
        check_cover(at, curve.start, curve.end, "mesh.transmission_error.table")
        gap = gap + interpolate(at, error, namespace(roll).clip(roll, at[0], at[-1]))
    return gap
