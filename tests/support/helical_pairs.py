"""Helical involute pairs of a given overlap, and closed forms of their lines of contact."""

import math

import numpy as np

from tribodyn.geometry.assembly import Assembly, assemble
from tribodyn.geometry.drive import Drive, GearBody, MaterialData
from tribodyn.geometry.families import involute
from tribodyn.geometry.helix import base_helix_angle
from tribodyn.mesh.slices.helical import SliceLayout, slice_layout, tabulate_slices
from tribodyn.mesh.table import MeshData

STEEL = MaterialData("steel", 206e9, 0.3, 7850.0, 46.0, 470.0, 6e9)
STIFFNESS = 4e8
WHOLE = 1.0 - 1e-9  # share of a slice that is on the path altogether
EVEN = MeshData("constant", 0.05, stiffness=STIFFNESS)
ENERGY = MeshData("energy", 0.05)
NORMAL_MODULE, NORMAL_ANGLE = 0.003, math.radians(20.0)


def helical_pair(
    overlap: float, helix: float = 0.35, addendum: float = 1.0, family=involute.FAMILY, shape=()
) -> Assembly:
    """23/47 pair with this overlap ratio; module and pressure angle of the rack in the normal section."""
    cosine = math.cos(helix)
    module = NORMAL_MODULE / cosine
    width = overlap * math.pi * NORMAL_MODULE / abs(math.sin(helix))
    pinion, gear = (
        GearBody(teeth, 0.0, addendum * cosine, 1.25 * cosine, 0.25 * cosine, width, bore)
        for teeth, bore in ((23.0, 0.015), (47.0, 0.03))
    )
    angle = math.atan(math.tan(NORMAL_ANGLE) / cosine)
    return assemble(family, Drive(module, angle, pinion, gear, shape, helix_angle=helix))


def sliced(
    assembly: Assembly, mesh: MeshData = EVEN, slices: int = 11, back: bool = False, nodes: int | None = None
):
    """Table with so many slices, and nodes."""
    layout: SliceLayout = slice_layout(assembly, mesh, slices, back)
    layout = layout if nodes is None else layout._replace(nodes=nodes)
    return tabulate_slices(assembly, (STEEL, STEEL), mesh, layout)


def base_angle(assembly: Assembly) -> float:
    return float(base_helix_angle(assembly.drive))


def line_lengths(assembly: Assembly, overlap: float) -> tuple[float, float, float]:
    """Minimum, maximum and mean of the length of all lines of contact together, m."""
    transverse = float(assembly.contact_ratio)
    base_pitch = (
        2.0
        * math.pi
        * assembly.path.pinion_pitch_radius
        * math.cos(float(assembly.path.pressure_angle(0.0)))
        / float(assembly.drive.pinion.teeth)
    )
    scale = base_pitch / math.sin(base_angle(assembly))
    parts = transverse % 1.0, overlap % 1.0
    common = transverse * overlap - parts[0] * parts[1]
    return (
        scale * (common + max(0.0, sum(parts) - 1.0)),
        scale * (common + min(parts)),
        float(assembly.common_width) * transverse / math.cos(base_angle(assembly)),
    )


def line_length(cycle) -> np.ndarray:
    """Length of the lines of contact (N,) by the shares of the table, m."""
    front = slice(None, cycle.front_slots)
    stretched = np.broadcast_to(cycle.share / cycle.line_load_peak, cycle.compliance.shape)
    return np.sum(stretched[0, :, front], axis=-1) * cycle.slice_width
