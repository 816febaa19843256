"""A ring of equal sectors of any stiffness: from half a sector, and assembled and solved as a whole."""

import numpy as np
import pytest
from scipy.sparse import csr_matrix

from tribodyn.compliance.fem.cyclic_symmetry import half_sector, phases, ring_response

BORE = 0.7


def places(teeth):
    """Nodes (2, 12) of half a sector: on four circles, on the axis, between and on the edge."""
    radius, angle = np.meshgrid([BORE, 1.0, 1.3, 1.9], np.array([0.0, 0.4, 1.0]) * np.pi / teeth)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)]).reshape(2, -1)


def half_matrix(teeth, sector, side, components, numbers, size):
    """What takes the displacements of all nodes of the ring to those of a half, in the half's own frame."""
    turn = 2.0 * np.pi * sector / teeth
    to_frame = np.eye(components)
    to_frame[:2, :2] = [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
    if side < 0:
        to_frame[1] *= -1.0
    matrix = np.zeros((len(numbers) * components, size * components))
    for node, number in enumerate(numbers):
        rows = slice(node * components, (node + 1) * components)
        matrix[rows, number * components : (number + 1) * components] = to_frame
    return matrix


def whole_ring(place, teeth, stiffness, components):
    """Flexibility of the whole ring, held at its bore, and the matrices of its halves by sector and side."""
    numbers, found = {}, {}
    for sector in range(teeth):
        for side in (1, -1):
            angle = side * np.arctan2(place[1], place[0]) + 2.0 * np.pi * sector / teeth
            radius = np.hypot(*place)
            keys = zip(
                np.round(radius * np.cos(angle), 6) + 0.0,
                np.round(radius * np.sin(angle), 6) + 0.0,
                strict=True,
            )
            numbers[sector, side] = [found.setdefault(key, len(found)) for key in keys]
    halves = {
        key: half_matrix(teeth, *key, components, number, len(found)) for key, number in numbers.items()
    }
    ring = sum(half.T @ stiffness @ half for half in halves.values())
    free = np.repeat([np.hypot(*key) > BORE * 1.001 for key in found], components)
    flexibility = np.zeros_like(ring)
    flexibility[np.ix_(free, free)] = np.linalg.inv(ring[np.ix_(free, free)])
    return flexibility, halves


@pytest.mark.parametrize("components", [2, 3])
@pytest.mark.parametrize("teeth", [5, 6])
def test_half_a_sector_stands_for_the_whole_ring(rng, teeth, components):
    place = places(teeth)
    size = place.shape[1] * components
    root = rng.normal(size=(size, size))
    stiffness = root @ root.T + np.eye(size)
    loads, readers = rng.normal(size=(size, 5)), rng.normal(size=(4, size))
    mirrored = np.array([False, True, False, True])
    sectors = np.array([-2, 0, 1, 2])
    flexibility, halves = whole_ring(place, teeth, stiffness, components)
    displacement = flexibility @ halves[0, 1].T @ loads
    expected = [
        [
            row @ halves[sector % teeth, -1 if there else 1] @ displacement
            for row, there in zip(readers, mirrored, strict=True)
        ]
        for sector in sectors
    ]
    half = half_sector(place, teeth, BORE)
    seen = ring_response(half, csr_matrix(stiffness), loads, readers, mirrored, sectors)
    np.testing.assert_allclose(seen, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("teeth", [5, 6, 17])
def test_nodes_are_found_by_where_they_stand(teeth):
    place = places(teeth)[:, ::-1]
    half = half_sector(place, teeth, BORE)
    radius, angle = np.hypot(*place), np.arctan2(place[1], place[0])
    assert (half.teeth, half.nodes) == (teeth, 12)
    for nodes, at in ((half.axis, 0.0), (half.edge, np.pi / teeth)):
        assert sorted(radius[nodes]) == pytest.approx([1.0, 1.3, 1.9])
        assert angle[nodes] == pytest.approx([at] * 3)
    assert radius[half.held] == pytest.approx([BORE] * 3)


@pytest.mark.parametrize("teeth", [5, 6])
def test_phases_with_their_weights_pick_one_sector(teeth):
    for sector in range(teeth):
        total = sum(weight * np.real(z**sector) for z, weight in phases(teeth))
        assert total == pytest.approx(float(sector == 0), abs=1e-14)
