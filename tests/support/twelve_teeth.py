"""A gear of twelve teeth, small enough for finite elements of all of it."""

import numpy as np

from tribodyn.compliance.fem import ring_mesh
from tribodyn.compliance.fem.gear_compliance import ElasticGear
from tribodyn.compliance.fem.ring_mesh import SectorMesh, half_blocks, joined
from tribodyn.compliance.fem.strips import curved_basis
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.tooth import Tooth, cut_tooth

POISSON = 0.3
BODY = GearBody(12, 0.3, 1.0, 1.25, 0.25, 0.02, 8e-3)
TOOTH = cut_tooth(FAMILY, Drive(3e-3, np.radians(20.0), BODY, BODY), "pinion")
GEAR = ElasticGear(TOOTH, 12, BODY.bore_radius, POISSON, 0.75e-3, 1)


def sector_mesh(tooth: Tooth, teeth: int, bore_radius: float, level: int) -> SectorMesh:
    """Mesh the whole sector of one tooth, the half that is computed with and its mirror image."""
    blocks = half_blocks(tooth, teeth, bore_radius, level)
    return joined([*blocks, *(block * np.array([1.0, -1.0]) for block in blocks)], level)


def whole_ring(level: int, teeth: int = 12):
    """Basis of all teeth, or of fewer of the same teeth; mesh of one sector."""
    mesh = sector_mesh(TOOTH, teeth, 8e-3, level)
    parts = []
    for k in range(teeth):
        c, s = np.cos(2 * k * np.pi / teeth), np.sin(2 * k * np.pi / teeth)
        parts.append(np.array([[c, -s], [s, c]]) @ mesh.nodes)
    points = np.concatenate(parts, axis=1)
    _, index, merged = np.unique(np.round(points * 1e9).T, axis=0, return_index=True, return_inverse=True)
    cells = np.concatenate([mesh.cells + k * mesh.nodes.shape[1] for k in range(teeth)], axis=1)
    return curved_basis(points[:, index], merged.reshape(-1)[cells]), mesh


def few_cells(monkeypatch):
    """Let meshes have ten cells per half sector: what holds for any mesh is quickly tried on them."""
    for name, cells in (("FLANK", 2), ("FILLET", 1), ("ROOT", 1), ("LAYER", 1), ("ACROSS", 1), ("DEPTH", 1)):
        monkeypatch.setattr(ring_mesh, f"_{name}", cells)
