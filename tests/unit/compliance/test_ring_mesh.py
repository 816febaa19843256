"""The mesh of half a sector: cells that meet edge on edge inside the outline, whatever the gear."""

from collections import Counter

import numpy as np
import pytest

from tribodyn.compliance.fem.ring_mesh import half_sector_cells, half_sector_mesh
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.tooth import cut_tooth, fillet_point, flank_point

MODULE = 3e-3


def cut(teeth, shift, bore):
    body = GearBody(teeth, shift, 1.0, 1.25, 0.3, 0.02, 1e-3)
    tooth = cut_tooth(FAMILY, Drive(MODULE, np.radians(20.0), body, body), "pinion")
    return tooth, bore * tooth.root_radius


@pytest.mark.parametrize(
    ("teeth", "shift", "bore", "level"), [(12, 0.4, 0.5, 1), (31, -0.1, 0.9, 1), (17, 0, 0.3, 2)]
)
def test_cells_meet_edge_on_edge_and_fill_the_outline(teeth, shift, bore, level):
    tooth, bore_radius = cut(teeth, shift, bore)
    mesh = half_sector_mesh(tooth, teeth, bore_radius, level)
    assert mesh.cells.shape[1] == half_sector_cells(level)[0]
    assert sorted(np.unique(mesh.cells)) == list(range(mesh.nodes.shape[1]))
    edges = Counter()
    for cell in mesh.cells.T:
        for k in range(4):
            first, last = sorted((cell[k], cell[(k + 1) % 4]))
            edges[first, cell[4 + k], last] += 1
    assert set(edges.values()) == {1, 2}
    radius, angle = np.hypot(*mesh.nodes), np.arctan2(*mesh.nodes[::-1])
    half = np.pi / teeth
    tip_angle = np.arctan2(*np.array(flank_point(tooth, np.array(tooth.tip_distance)))[::-1])
    # the layer, less than a third of the tip, stands on a chord of the tip circle
    exact = np.where(angle > 0.65 * tip_angle, 1e-3, 1e-9)
    on = {
        "axis": (np.abs(angle) < 1e-9, radius, tooth.tip_radius - bore_radius),
        "edge": (np.abs(angle - half) < 1e-9, radius, tooth.root_radius - bore_radius),
        "bore": (np.abs(radius / bore_radius - 1) < 1e-9, angle, half),
        "tip": (np.abs(radius / tooth.tip_radius - 1) < exact, angle, float(tip_angle)),
    }
    profile = set(mesh.root) | {n for edge in edges for n in edge if {edge[0], edge[2]} <= set(mesh.flank)}
    covered = dict.fromkeys(on, 0.0)
    free = 0
    for edge in (edge for edge, cells in edges.items() if cells == 1):
        nodes = list(edge)
        where = [name for name, (stands, _, _) in on.items() if np.all(stands[nodes])]
        if where:
            along = on[where[0]][1][nodes]
            assert abs(along[1] - along[0]) + abs(along[2] - along[1]) == pytest.approx(
                abs(along[2] - along[0])
            )
            covered[where[0]] += abs(along[2] - along[0])
        else:
            assert set(nodes) <= profile
            free += 1
    assert covered == pytest.approx({name: length for name, (_, _, length) in on.items()}, rel=1e-6)
    assert free == len(mesh.flank) - 1 + (len(mesh.root) - 1) // 2


@pytest.mark.parametrize(("teeth", "shift", "level"), [(12, 0.4, 1), (31, -0.1, 2)])
def test_the_profile_is_the_tooth_s(teeth, shift, level):
    """Nodes lie on root circle, fillet and flank, in even steps of their lengths."""
    tooth, bore_radius = cut(teeth, shift, 0.6)
    mesh = half_sector_mesh(tooth, teeth, bore_radius, level)
    nodes = np.concatenate([mesh.nodes[:, mesh.root], mesh.nodes[:, mesh.flank[1:]]], axis=1)
    fillet = fillet_point(tooth, np.linspace(np.pi / 2, tooth.form_angle, 20_001))
    flank = flank_point(tooth, np.linspace(tooth.form_distance, tooth.tip_distance, 20_001))
    gap = tooth.root_radius * np.exp(
        1j * np.linspace(np.pi / teeth, np.angle(complex(*np.array(fillet)[:, 0])), 20_001)
    )
    curve = np.concatenate([gap, fillet[0] + 1j * fillet[1], flank[0] + 1j * flank[1]])
    gone = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(curve)))])
    near = np.array([np.argmin(np.abs(curve - complex(*node))) for node in nodes.T])
    assert np.max(np.abs(curve[near] - (nodes[0] + 1j * nodes[1]))) < 1e-4 * MODULE
    steps = np.diff(gone[near])
    _, along_flank, along_root, _ = half_sector_cells(level)
    assert (len(mesh.root), len(mesh.flank)) == (2 * along_root + 1, along_flank + 1)
    assert (near[0], near[-1]) == (0, len(curve) - 1)
    assert gone[near[2 * along_root]] == pytest.approx(gone[40_002], abs=1e-3 * MODULE)
    np.testing.assert_allclose(steps[2 * along_root :], np.mean(steps[2 * along_root :]), rtol=5e-3)
    # the upper half of the fillet has as many nodes as a third of the root
    half = along_root * 2 // 3 * 2
    assert gone[near[half]] == pytest.approx((gone[20_001] + gone[40_001]) / 2, rel=5e-3)
    for part in (steps[:half], steps[half : 2 * along_root]):
        np.testing.assert_allclose(part, np.mean(part), rtol=1e-2)


@pytest.mark.parametrize(("bore", "thin"), [(0.3, False), (0.6, False), (0.9, True)])
@pytest.mark.parametrize(("teeth", "shift"), [(14, 0.3), (40, 0.0)])
def test_three_blocks_share_the_straight_angle_under_the_fillet(teeth, shift, bore, thin):
    """About a third each, where five cells meet; over a thin rim the seam ends at least half way up."""
    tooth, bore_radius = cut(teeth, shift, bore)
    mesh = half_sector_mesh(tooth, teeth, bore_radius, 1)
    numbers, counts = np.unique(mesh.cells[:4], return_counts=True)
    [corner] = numbers[counts == 5]
    angles = []
    for cell in mesh.cells[:4, np.any(mesh.cells[:4] == corner, axis=0)].T:
        k = cell.tolist().index(corner)
        before, at, after = (mesh.nodes[:, cell[(k + n) % 4]] for n in (-1, 0, 1))
        ahead, behind = after - at, before - at
        angles.append(np.degrees(np.arctan2(ahead[0] * behind[1] - ahead[1] * behind[0], ahead @ behind)))
    assert sum(angles) == pytest.approx(360.0)
    narrow = sorted(angles)[:3]
    assert sum(narrow) == pytest.approx(180.0, abs=25.0)
    if not thin:
        assert narrow == pytest.approx([60.0] * 3, abs=26.0)
    corners = np.unique(mesh.cells[:4])
    axis = np.sort(mesh.nodes[0, corners[np.abs(mesh.nodes[1, corners]) < 1e-12]])
    _, _, _, edge = half_sector_cells(1)
    seam_end = axis[edge - 1]  # one cell less than on the edge, where the layer is
    assert seam_end >= (bore_radius + np.hypot(*mesh.nodes[:, corner])) / 2 * (1 - 1e-9)
    assert seam_end < mesh.nodes[0, corner]
