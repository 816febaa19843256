"""Root stress: its recovery at a curved boundary, its convergence, beam theory, and ISO 6336-3."""

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve

from tribodyn.compliance.fem.gear import lead_harmonics
from tribodyn.compliance.fem.gear_compliance import ElasticGear
from tribodyn.compliance.fem.ring_mesh import half_sector_mesh
from tribodyn.compliance.fem.strips import (
    COMPONENTS,
    curved_basis,
    edge_parameters,
    edge_points,
    edge_values,
    plane_stiffness,
    stress_rows,
    strip_stiffness,
)
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.tooth import cut_tooth

POISSON, MODULE, ANGLE = 0.3, 3e-3, np.radians(20.0)


def nine_node_cells(rows, columns):
    """Cells of a grid of nodes in order of rows."""
    number = np.arange((2 * rows + 1) * (2 * columns + 1)).reshape(2 * rows + 1, -1)
    ring = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]
    return np.stack([number[i : 2 * rows - 1 + i : 2, j : 2 * columns - 1 + j : 2].ravel() for i, j in ring])


def quarter_plate_with_a_hole(around, outwards):
    """Nodes and cells of 1 < r < 3; first the nodes on the hole, from the x to the y axis."""
    angle = np.linspace(0, np.pi / 2, 2 * around + 1)
    radius = 3.0 ** np.linspace(0, 1, 2 * outwards + 1)
    r, a = np.meshgrid(radius, angle, indexing="ij")
    return np.stack([(r * np.cos(a)).ravel(), (r * np.sin(a)).ravel()]), nine_node_cells(outwards, around)


def kirsch(x, y):
    """Displacement about a hole of radius 1 in an infinite plate under unit tension along x, plane strain.

    S. Timoshenko, J. N. Goodier, Theory of Elasticity, § 35: 3 at the hole's sides, -1 at its ends.
    """
    r, a = np.hypot(x, y), np.arctan2(y, x)
    shear, kappa = 0.5 / (1 + POISSON), 3 - 4 * POISSON
    radial = (kappa - 1) * r / 2 + 1 / r + np.cos(2 * a) * (r + (kappa + 1) / r - 1 / r**3)
    around = -np.sin(2 * a) * (r + (kappa - 1) / r + 1 / r**3)
    radial, around = radial / (4 * shear), around / (4 * shear)
    return radial * np.cos(a) - around * np.sin(a), radial * np.sin(a) + around * np.cos(a)


def hole_stress(around, outwards):
    nodes, cells = quarter_plate_with_a_hole(around, outwards)
    basis = curved_basis(nodes, cells)
    place = basis.doflocs
    exact = np.stack(kirsch(*place), axis=-1).ravel()
    held = [np.repeat(np.hypot(*place) > 3 - 1e-9, 2)]
    held += [np.stack([place[0] < 1e-9, place[1] < 1e-9], axis=-1).ravel()]
    fixed = np.any(held, axis=0)
    stiffness = plane_stiffness(basis, POISSON).tocsc()
    found = np.where(fixed, exact, 0.0)
    found[~fixed] = spsolve(stiffness[~fixed][:, ~fixed], -stiffness[~fixed][:, fixed] @ exact[fixed])
    rim = nodes[:, : 2 * around + 1]
    chain = np.array([np.argmin(np.hypot(*(place - point[:, None]))) for point in rim.T])
    rows = stress_rows(rim, chain, COMPONENTS * basis.N, POISSON, 0.0)
    in_space = np.pad(found.reshape(-1, 2), ((0, 0), (0, 1))).ravel()
    return np.arctan2(*edge_points(rim)[::-1]), rows @ in_space


def test_stress_at_a_hole_converges_with_the_third_power():
    # G. Kirsch (1898): σ = 1 - 2 cos 2a along the hole
    errors = []
    for cells in (3, 6, 12):
        angle, stress = hole_stress(2 * cells, 2 * cells)
        errors.append(np.max(np.abs(stress - (1 - 2 * np.cos(2 * angle)))))
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(rates > 2.7), (errors, rates)
    assert errors[-1] < 3e-3


def gear(teeth, shift=0.0, fillet=0.25, bore=0.6):
    body = GearBody(teeth, shift, 1.0, 1.25, fillet, 0.02, bore * teeth * MODULE / 2)
    return cut_tooth(FAMILY, Drive(MODULE, ANGLE, body, body), "pinion"), body


def solved(teeth, level, waves=(0.0,), **options):
    tooth, body = gear(teeth, **options)
    elastic = ElasticGear(tooth, teeth, body.bore_radius, POISSON, 0.25 * MODULE, level)
    return lead_harmonics(elastic, np.array(waves))


def maximum(stress):
    """Maximum of a stress along the root, with a parabola through the largest three."""
    at = int(np.argmax(stress))
    before, most, after = stress[at - 1 : at + 2]
    return most + (after - before) ** 2 / (8 * (2 * most - before - after))


@pytest.mark.soak
def test_maximum_root_stress_converges():
    # with the loads at the same places: every position of level 1 is one of the finer meshes'
    found = []
    for level in (1, 2, 3):
        own = solved(18, level, (0.0, 0.3 / MODULE)).root_stress[:, 2, :, :, 4 * level :: level]
        both = np.concatenate([own[:, 0], -own[:, 1]], axis=2)
        found.append([[maximum(stress) for stress in wave.T] for wave in both])
    coarse, used, fine = np.array(found)
    assert np.max(np.abs(used / fine - 1)) < 5e-3
    assert np.mean(np.abs(coarse / fine - 1)) > 2.5 * np.mean(np.abs(used / fine - 1))


def test_wedge_with_a_force_at_its_end():
    # J. H. Michell (Timoshenko & Goodier, § 38): σ_r = F sin a/(r (A - sin 2A/2)) in a wedge of half angle A
    half, rows, columns = np.radians(12.0), 4, 40
    r, a = np.meshgrid(
        8.0 ** np.linspace(0, 1, 2 * columns + 1), np.linspace(-half, half, 2 * rows + 1), indexing="ij"
    )
    nodes = np.stack([(r * np.cos(a)).ravel(), (r * np.sin(a)).ravel()])
    basis = curved_basis(nodes, nine_node_cells(columns, rows))
    place = basis.doflocs
    radius, angle = np.hypot(*place), np.arctan2(place[1], place[0])
    stiffness = strip_stiffness(basis, POISSON)[0].tocsc()
    free = np.flatnonzero(np.repeat(radius < 8 - 1e-9, COMPONENTS))
    end = np.flatnonzero(radius < 1 + 1e-9)
    end = end[np.argsort(angle[end])]
    # Simpson's rule makes nodal forces of the traction -σ_r on the small end
    share = np.zeros(len(end))
    for start in range(0, len(end) - 2, 2):
        share[start : start + 3] += np.array([1, 4, 1]) / 6 * (angle[end[start + 2]] - angle[end[start]])
    size = np.sin(angle[end]) / (half - np.sin(2 * half) / 2) * share
    load = np.zeros((basis.N, COMPONENTS))
    load[end, 0], load[end, 1] = -size * np.cos(angle[end]), -size * np.sin(angle[end])
    found = np.zeros(basis.N * COMPONENTS)
    found[free] = spsolve(stiffness[free][:, free], load.ravel()[free])
    edge = np.flatnonzero(np.abs(angle - half) < 1e-9)
    edge = edge[np.argsort(radius[edge])]
    rows_of = stress_rows(place[:, edge], edge, basis.N * COMPONENTS, POISSON, 0.0)
    at = np.hypot(*edge_points(place[:, edge]))
    away = (at > 2) & (at < 5)  # from the small end and from the clamp
    expected = np.sin(half) / (at * (half - np.sin(2 * half) / 2))
    np.testing.assert_allclose((rows_of @ found)[away], expected[away], rtol=5e-3)


def nominal_iso(teeth, shift, fillet, load_radius):
    """σ_F0 m b/F_n = Y_F Y_S cos α of ISO 6336-3:2006, method B, for a load at a radius of the flank."""
    depth, rounding = 1.25, fillet
    offset = np.pi / 4 - depth * np.tan(ANGLE) - (1 - np.sin(ANGLE)) * rounding / np.cos(ANGLE)
    g = rounding - depth + shift
    h = 2 / teeth * (np.pi / 2 - offset) - np.pi / 3
    theta = np.pi / 6
    for _ in range(50):
        theta = 2 * g / teeth * np.tan(theta) - h
    chord = teeth * np.sin(np.pi / 3 - theta) + np.sqrt(3) * (g / np.cos(theta) - rounding)
    radius = rounding + 2 * g**2 / (np.cos(theta) * (teeth * np.cos(theta) ** 2 - 2 * g))
    diameter = 2 * load_radius / MODULE
    alpha = np.arccos(teeth * np.cos(ANGLE) / diameter)
    involute = np.tan(ANGLE) - ANGLE - np.tan(alpha) + alpha
    gamma = (np.pi / 2 + 2 * shift * np.tan(ANGLE)) / teeth + involute
    load_angle = alpha - gamma
    arm = (np.cos(gamma) - np.sin(gamma) * np.tan(load_angle)) * diameter
    arm = 0.5 * (arm - teeth * np.cos(np.pi / 3 - theta) - g / np.cos(theta) + rounding)
    form = 6 * arm * np.cos(load_angle) / (chord**2 * np.cos(ANGLE))
    slenderness, notch = chord / arm, chord / (2 * radius)
    return form * (1.2 + 0.13 * slenderness) * notch ** (1 / (1.21 + 2.3 / slenderness)) * np.cos(ANGLE)


@pytest.mark.parametrize(
    ("teeth", "shift", "fillet"), [(18, 0.0, 0.25), (36, 0.0, 0.25), (25, 0.3, 0.38), (60, 0.0, 0.38)]
)
def test_tension_is_that_of_iso_6336_within_its_usual_scatter(teeth, shift, fillet):
    tooth, body = gear(teeth, shift=shift, fillet=fillet)
    lead = solved(teeth, 2, shift=shift, fillet=fillet)
    mesh = half_sector_mesh(tooth, teeth, body.bore_radius, 2)
    ratios = []
    for at in (10, 14, 18):
        radius = np.hypot(*mesh.nodes[:, mesh.flank[at]])
        tension = maximum(lead.root_stress[0, 2, 0, :, at]) * MODULE
        ratios.append(tension / nominal_iso(teeth, shift, fillet, radius))
    assert np.all(np.abs(np.array(ratios) - 1) < 0.15)


@pytest.mark.parametrize(("level", "accuracy"), [(2, 3e-2), (3, 1.1e-2)])
def test_neighbours_are_pressed_ahead_of_the_load_and_pulled_behind(level, accuracy):
    """Triangles over 19 of the teeth, of six nodes, refined until 0.2 % differ; by scikit-fem alone."""
    stress = solved(30, level).root_stress[0, :, :, :, 6 * level : 9 * level + 1 : 3 * level] * MODULE
    own = [maximum(course) for course in (*stress[2, 0].T, *-stress[2, 1].T)]
    np.testing.assert_allclose(own, [2.939, 3.678, 3.528, 4.470], rtol=3e-3)
    # the side towards the loaded tooth, then the other
    ahead, behind = np.min(stress[1], axis=1), np.max(stress[3, ::-1], axis=1)
    np.testing.assert_allclose(ahead, [[-0.936, -1.011], [-0.302, -0.284]], rtol=accuracy)
    np.testing.assert_allclose(behind, [[0.900, 0.937], [0.340, 0.333]], rtol=accuracy)


def test_stress_follows_from_the_strains_of_a_curved_surface(rng):
    """Displacements and shape interpolated by the parabola through three nodes, differentiated by steps."""
    edges, size, k = 2, 30, 2.7
    place, nodes = rng.normal(size=(2, 2 * edges + 1)), rng.permutation(size // 3)[: 2 * edges + 1]
    displacement = rng.normal(size=size)
    stress, points = [], []
    for edge in range(edges):
        three = slice(2 * edge, 2 * edge + 3)
        bent = np.polyfit([-1.0, 0.0, 1.0], place[:, three].T, 2)
        moved = np.polyfit([-1.0, 0.0, 1.0], displacement.reshape(-1, 3)[nodes[three]], 2)
        for at in (-np.sqrt(1 / 3), np.sqrt(1 / 3)):
            powers, rates = np.array([at**2, at, 1.0]), np.array([2 * at, 1.0, 0.0])
            along = rates @ bent
            length = np.hypot(*along)
            strain = (along / length) @ ((rates @ moved)[:2] / length)
            stress.append((strain + POISSON * k * (powers @ moved)[2]) / (1 - POISSON**2))
            points.append(powers @ bent)
    np.testing.assert_allclose(stress_rows(place, nodes, size, POISSON, k) @ displacement, stress, rtol=1e-9)
    np.testing.assert_allclose(edge_points(place), np.transpose(points), rtol=1e-9)


def test_points_of_an_edge_cut_into_more_stand_where_gauss_has_them():
    assert edge_parameters(1, 1) == pytest.approx([0.5 - 0.75**0.5 / 3, 0.5 + 0.75**0.5 / 3])
    whole, cut = edge_parameters(6, 1), edge_parameters(2, 3)
    np.testing.assert_allclose(cut, whole / 3, rtol=1e-14)


def test_values_at_corners_run_linearly_along_the_edges(rng):
    corners, size = np.array([4, 0, 3, 1]), 6
    value = rng.normal(size=size)
    at = edge_parameters(3, 1)
    expected = np.interp(at, np.arange(4), value[corners])
    np.testing.assert_allclose(edge_values(corners, size) @ value, expected, rtol=1e-12)
