"""Gaps between unloaded slices along the face: transmission error, backlash, modifications, misalignment."""

from typing import Any

import numpy as np

from tribodyn.compliance.sharing.flank_gap import oblique_gap
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.flanks.corner_contact import PairGeometry
from tribodyn.geometry.flanks.modification import UNMODIFIED, Modifications, back_flanks, uneven_teeth
from tribodyn.geometry.helix import normal_slope
from tribodyn.geometry.path import Kinematics, kinematics
from tribodyn.mesh import table
from tribodyn.numerics.elementary import namespace, sqrt
from tribodyn.numerics.shapes import Array, Float


def face_positions(width: Any, slices: int) -> Float[Array, " slice"]:
    """Middles of the slices (K,), m from the middle of the face."""
    return ((np.arange(slices) + 0.5) / slices - 0.5) * width


def slice_gap(
    assembly: Assembly,
    mesh: table.MeshData,
    at: table.Slots,
    motion: Kinematics,
    slope: Any,
    layout: Any,
) -> Float[Array, "segment node slot"]:
    """Gap between the unloaded slices along the true normal, m.

    A given transmission error is along the true normal; the backlash is that at the pitch point.
    """
    gap = table.unloaded_gap(assembly, mesh, at, motion.pressure_angle)
    if layout.back:
        # conjugate back flanks touch after the same rotation: the distance goes like the arm cos α cos β_n
        pitch_point = normal_slope(slope, assembly.path.pressure_angle(0.0 * assembly.r_start))
        leaning = normal_slope(slope, motion.pressure_angle)
        turned = sqrt((1.0 + pitch_point**2) / (1.0 + leaning**2))
        gap = namespace(gap, turned).where(at.side > 0, gap, gap * turned)
    return modified(assembly, mesh, gap, motion.signed_distance, slope, layout)


def modified(
    assembly: Assembly, mesh: table.MeshData, gap: Any, r: Any, slope: Any, layout: Any
) -> Float[Array, "segment node slot"]:
    """Add to a gap of slices at the signed distances r (m) what is taken off the flanks, and misalignment.

    Raises InputError where teeth differ.
    """
    if mesh.modifications == UNMODIFIED:
        return gap
    for broken in uneven_teeth(mesh.modifications):
        raise broken
    fronts = layout.pairs * layout.slices
    behind = back_flanks(mesh.modifications, float(assembly.path.pressure_angle(0.0)))
    for side, own, flanks in (
        (1, np.s_[..., :fronts], mesh.modifications),
        (-1, np.s_[..., fronts:], behind),
    ):
        if r[own].size:
            gap[own] += modified_gap(assembly, flanks, r[own], slope, layout.slices, side)
    return gap


def modified_gap(
    assembly: Assembly,
    modifications: Modifications,
    r: Float[Array, "segment node slot"],
    slope: float,
    slices: int,
    side: int,
) -> Float[Array, "segment node slot"]:
    """What modifications and misalignment leave open at slices of one side, m along the true normal.

    Plain numbers; r is the signed distance (m).
    """
    z = np.tile(face_positions(float(assembly.common_width), slices), r.shape[-1] // slices)
    place = PairGeometry(kinematics(assembly.path, r), np.zeros_like(r), r, r, r, r)
    return oblique_gap(assembly, modifications, place, z, slope, side)
