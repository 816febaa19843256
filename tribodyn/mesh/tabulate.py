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
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import SIDES, MaterialData
from tribodyn.geometry.path import kinematics
from tribodyn.mesh import table
from tribodyn.mesh.cycle import MeshCycle
from tribodyn.numerics.curve import check_cover, interpolate
from tribodyn.numerics.elementary import cos, is_jax, maximum, minimum, namespace, sense, where, within
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
    mesh: table.MeshData,
    pairs: int,
    back: bool = False,
) -> MeshCycle:
    """Tabulate the mesh cycle of a drive.

    Every number of the drive may be traced. There are `pair_slots(assembly)` front slots and, with `back`,
    as many for the back flanks, `mesh.backlash` away. Raises InputError if a table does not cover the
    contact, an option lacks its numbers, or options contradict each other.
    """
    path = assembly.path
    check_options(assembly, mesh, back)
    at = _slots(assembly, pairs, mesh.points, back)
    if assembly.family.corner:  # which side of the pitch point a node there is on must not depend on rounding
        xp = namespace(at.roll)
        at = at._replace(roll=xp.where(xp.abs(at.roll) < _MINIMUM_SEGMENT, 0.0, at.roll))
    curve = RollCurve(*assembly.roll_limits)

    r_nodes = path.signed_distance(curve.nodes())
    r = distance_at_roll(assembly, curve, r_nodes, at.roll)
    motion = kinematics(path, r)
    compliance, coupling = pair_compliance(assembly, materials, mesh, curve, r_nodes, at.roll, pairs)
    gap = table.unloaded_gap(assembly, mesh, at, motion.pressure_angle)
    linear = mesh.compliance != "energy" or mesh.hertz == "linear"
    hertz = 0.0 if linear else hertz_coefficient(*materials, assembly.common_width)
    return table.mesh_table(assembly, at, motion, table.Elasticity(compliance, coupling, gap, hertz))


def check_options(assembly: Assembly, mesh: table.MeshData, back: bool) -> None:
    """Raise InputError where an option lacks its numbers, or options contradict each other."""
    if mesh.compliance == "energy":
        table.check_bores(assembly.drive, mesh.held)
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
    table.check_backlash(mesh, back)


def _slots(assembly: Assembly, pairs: int, points: int, back: bool) -> table.Slots:
    """Pairs on the path of contact.

    Where the path has a corner at the pitch point a segment also begins when a pair passes it, for no spline
    may run across.
    """
    (start, end), pitch = assembly.roll_limits, assembly.pitch_angle
    leave = assembly.contact_ratio - (pairs - 1)
    marks = [leave, (-start / pitch) % 1.0] if assembly.family.corner else [leave]
    mirrored = [(table.back_entry(start, pitch) - mark) % 1.0 for mark in (0.0, *marks)] if back else []
    xp = namespace(start, leave)
    boundary = _apart(xp.sort(xp.stack([0.0 * leave, 1.0 + 0.0 * leave, *marks, *mirrored])))
    return table.slots(boundary, (start, end), pitch, pairs, points, back)


def _apart(boundary: Float[Array, " boundary"]) -> Float[Array, " boundary"]:
    """Move boundaries that fall together, as at a whole contact ratio, so that every segment has a length."""
    xp = namespace(boundary)
    phases = [boundary[0]]
    for value in boundary[1:-1]:
        phases.append(maximum(value, phases[-1] + _MINIMUM_SEGMENT))
    phases.append(boundary[-1])
    for i in range(len(phases) - 2, 0, -1):
        phases[i] = minimum(phases[i], phases[i + 1] - _MINIMUM_SEGMENT)
    return xp.stack(phases)


class RollCurve(NamedTuple):
    """Interpolation over the roll angle, by a Chebyshev series on either side of the pitch point.

    Two pieces, because the paths of some families have a kink there; where the pitch point lies beyond an end
    of the path, as of some internal pairs, the one piece has no length.
    """

    start: Any
    end: Any

    @property
    def middle(self) -> Any:
        """Where the pieces meet: the pitch point, or the end of the path nearest to it."""
        return within(0.0, minimum(self.start, self.end), maximum(self.start, self.end))

    def nodes(self) -> Float[Array, "2 17"]:
        """Roll angles of the nodes, (2, 17), rad."""
        xp, middle = namespace(self.start, self.end), self.middle
        unit = 0.5 + 0.5 * _POINTS
        return xp.stack([middle + (self.start - middle) * (1.0 - unit), middle + (self.end - middle) * unit])

    def interpolate(self, values: Float[Array, "2 17 ..."], roll: Float[Array, "..."]) -> Float[Array, "..."]:
        """Values (…, k) at the roll angles (…), from values (2, 17, k) at the nodes; k may be missing."""
        xp = namespace(values, roll)
        middle = self.middle
        beyond = roll - middle
        approach = beyond * sense(self.end - self.start) < 0.0
        before = where(self.start == middle, -1.0, self.start - middle)
        after = where(self.end == middle, 1.0, self.end - middle)
        at = xp.where(approach, 1.0 - 2.0 * beyond / before, 2.0 * beyond / after - 1.0)
        basis = chebyshev_basis(at, _DEGREE) @ _TO_SERIES
        if values.ndim == 3:
            approach = approach[..., None]
        return xp.where(approach, basis @ values[0], basis @ values[1])


def distance_at_roll(assembly: Assembly, curve: RollCurve, r_nodes: Float[Array, "2 17"], roll: Any) -> Any:
    """Signed distance r (m) at roll angles (rad) of the contact, from its values at the curve's nodes."""
    path, r = assembly.path, curve.interpolate(r_nodes, roll)
    if assembly.family.corner:  # paths that may be steep at their ends: one of Newton's steps from the series
        r = r - (path.rotation(r) - roll) * path.pinion_pitch_radius * cos(path.pressure_angle(r))
    return r


def pair_compliance(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: table.MeshData,
    curve: RollCurve,
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
        limits = minimum(curve.start, curve.end), maximum(curve.start, curve.end)
        check_cover(angle, *limits, "mesh.table")
        return 1.0 / interpolate(angle, stiffness, within(roll, angle[0], angle[-1])), uncoupled

    width = assembly.common_width
    teeth = [loaded_tooth(assembly, side, mesh.held) for side in SIDES]
    parts = [
        tooth_compliance(t, m, width, r_nodes, mesh.foundation) for t, m in zip(teeth, materials, strict=True)
    ]
    for side, part in zip(SIDES, parts, strict=True):
        if not is_jax(part.foundation) and not np.all(part.foundation > 0):
            what = f"the fitted polynomials give the {side}'s body no positive compliance"
            rule = f"far outside their range, {what}"
            raise InputError("mesh.foundation", '"sainsot-velex"', rule, 'use "ring"')
    pair = parts[0].total + parts[1].total
    if mesh.hertz == "linear":
        pair = pair + hertz_linear(*materials, width)
    loads = [part.root_load for part in parts]
    together = namespace(pair, *loads).concatenate([pair[..., None], *loads], axis=-1)
    channels = curve.interpolate(together, roll)
    coupling = uncoupled
    if mesh.foundation_coupling:
        coupling = body_coupling(teeth, materials, channels[..., 1:4], channels[..., 4:7], pairs)
    return channels[..., 0], coupling


def body_coupling(
    teeth: list[LoadedTooth],
    materials: tuple[MaterialData, MaterialData],
    pinion_load: Float[Array, "segment node pair 3"],
    gear_load: Float[Array, "segment node pair 3"],
    pairs: int,
) -> Float[Array, "segment node pair pair"]:
    """Deflection of one pair per load on another through both bodies, (S, N, Q, Q).

    Front and back flanks never carry at the same time while there is backlash, so they are left uncoupled.
    """
    count = pinion_load.shape[-2]
    zero = 0.0 * pinion_load[..., 0, 0]
    entries = [[zero] * count for _ in range(count)]
    for pitches in range(1, pairs):
        matrices = [neighbour_coupling(t, m, pitches) for t, m in zip(teeth, materials, strict=True)]
        for later in range(count):
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
