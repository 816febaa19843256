"""A gear of twelve teeth, small enough for finite elements of all of it."""

import numpy as np

from tribodyn.compliance.ring_mesh import sector_mesh
from tribodyn.compliance.strips import curved_basis
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.tooth import cut_tooth

POISSON = 0.3
BODY = GearBody(12, 0.3, 1.0, 1.25, 0.25, 0.02, 8e-3)
TOOTH = cut_tooth(FAMILY, Drive(3e-3, np.radians(20.0), BODY, BODY), "pinion")


def whole_ring(level: int):
    """Nodes and cells of all teeth, and the flanks' nodes of tooth 0 and its neighbour towards +y."""
    mesh = sector_mesh(TOOTH, 12, 8e-3, level)
    parts = []
    for k in range(12):
        c, s = np.cos(k * np.pi / 6), np.sin(k * np.pi / 6)
        parts.append(np.array([[c, -s], [s, c]]) @ mesh.nodes)
    points = np.concatenate(parts, axis=1)
    _, index, merged = np.unique(np.round(points * 1e9).T, axis=0, return_index=True, return_inverse=True)
    cells = np.concatenate([mesh.cells + k * mesh.nodes.shape[1] for k in range(12)], axis=1)
    return curved_basis(points[:, index], merged.reshape(-1)[cells]), mesh
