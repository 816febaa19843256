"""The finite elements: patch test, beam theory, the cyclic sector against the whole ring, reciprocity."""

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve
from scipy.spatial import KDTree

from tests.support.twelve_teeth import GEAR, POISSON, TOOTH, few_cells, sector_mesh, whole_ring
from tribodyn.compliance.fem.gear import gear_compliance, gear_model
from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, ElasticGear
from tribodyn.compliance.fem.ring_mesh import graded
from tribodyn.compliance.fem.strips import curved_basis, plane_stiffness
from tribodyn.errors import InputError
from tribodyn.geometry.body import section_area_and_inertia, tooth_outline
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.tooth import cut_tooth, flank_point

DEEP = 1.5e-3  # twice that is beyond the tooth's axis


def block(columns: int, rows: int, length: float = 1.0, height: float = 1.0, bend: float = 0.0):
    """Nine-node cells of a block whose grid lines are bent inside."""
    lines = np.linspace(0, length, 2 * columns + 1), np.linspace(0, height, 2 * rows + 1)
    x, y = np.meshgrid(*lines, indexing="ij")
    bump = bend * np.sin(np.pi * x / length) * np.sin(np.pi * y / height)
    nodes = np.stack([(x + bump).ravel(), (y - bump).ravel()])
    number = np.arange(nodes.shape[1]).reshape(x.shape)
    around = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)]
    cells = [number[i : 2 * columns - 1 + i : 2, j : 2 * rows - 1 + j : 2].ravel() for i, j in around]
    return curved_basis(nodes, np.stack(cells))


def interleaved(x, y):
    return np.stack([x, y], axis=-1).ravel()


def solve_with_boundary(basis, field):
    """Displacement with the field's values on the whole boundary, and the field's everywhere."""
    place = basis.doflocs
    exact = interleaved(*field(*place))
    boundary = (2 * basis.get_dofs().flatten()[:, None] + np.arange(2)).ravel()
    matrix = plane_stiffness(basis, POISSON).tocsr()
    free = np.setdiff1d(np.arange(2 * basis.N), boundary)
    found = exact.copy()
    found[free] = spsolve(matrix[free][:, free].tocsc(), -matrix[free][:, boundary] @ exact[boundary])
    return found, exact


def test_patch_of_curved_cells_carries_a_constant_strain():
    basis = block(3, 3, bend=0.08)
    found, exact = solve_with_boundary(basis, lambda x, y: (1e-3 * x + 2e-3 * y, -3e-3 * x + 5e-4 * y))
    np.testing.assert_allclose(found, exact, atol=1e-15)


def test_strain_energy_of_constant_strain_and_none_of_rotation():
    basis = block(3, 2, bend=0.05)
    x, y = basis.doflocs
    matrix = plane_stiffness(basis, POISSON)
    stretch = interleaved(1e-3 * x, 0.0 * y)
    # plane strain: sigma_x = E (1 - nu)/((1 + nu)(1 - 2 nu)) eps_x
    expected = (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) * 1e-6
    assert stretch @ matrix @ stretch == pytest.approx(expected, rel=1e-12)
    turn = interleaved(-y, x)
    assert abs(turn @ matrix @ turn) < 1e-12


def cantilever(x, y):
    """Timoshenko's cantilever, unit modulus and load, half height 1/2, length 4, plane strain."""
    modulus, nu = 1.0 / (1 - POISSON**2), POISSON / (1 - POISSON)
    inertia, length, height = 1.0 / 12.0, 4.0, 1.0
    y = y - height / 2
    u = y / (6 * modulus * inertia) * ((6 * length - 3 * x) * x + (2 + nu) * (y**2 - height**2 / 4))
    v = -(3 * nu * y**2 * (length - x) + (4 + 5 * nu) * height**2 * x / 4 + (3 * length - x) * x**2)
    return u, v / (6 * modulus * inertia)


def test_cantilever_converges_with_the_third_power():
    # S. Timoshenko, J. N. Goodier, Theory of Elasticity, § 21: exact, a cubic that the elements do not hold
    errors = []
    for rows in (2, 4, 8):
        found, exact = solve_with_boundary(block(2 * rows, rows, length=4.0, bend=0.05), cantilever)
        errors.append(np.max(np.abs(found - exact)) / np.max(np.abs(exact)))
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(rates > 2.7), (errors, rates)
    assert errors[-1] < 1e-5


def test_slender_beam_under_end_load_bends_as_theory_says():
    basis = block(40, 2, length=20.0)
    x = basis.doflocs[0]
    matrix = plane_stiffness(basis, POISSON).tocsr()
    clamped = np.flatnonzero(np.repeat(x < 1e-9, 2))
    free = np.setdiff1d(np.arange(2 * basis.N), clamped)
    load = np.zeros(2 * basis.N)
    # how the resultant is spread over the end does not matter far from it (Saint-Venant)
    end = np.flatnonzero(x > 20.0 - 1e-9)
    load[2 * end + 1] = 1.0 / len(end)
    u = np.zeros(2 * basis.N)
    u[free] = spsolve(matrix[free][:, free].tocsc(), load[free])
    modulus = 1.0 / (1 - POISSON**2)
    bending = 20.0**3 / (3 * modulus / 12.0)
    shear = 1.2 * 20.0 / (0.5 / (1 + POISSON))
    assert np.mean(u[2 * end + 1]) == pytest.approx(bending + shear, rel=4e-3)  # Timoshenko's clamp may warp


@pytest.mark.parametrize("level", [1, 2])
def test_mesh_has_the_area_of_the_outline(level):
    mesh = sector_mesh(TOOTH, 12, 8e-3, level)
    basis = curved_basis(mesh.nodes, mesh.cells)
    assert np.all(basis.mapping.detDF(basis.X) > 0)
    area, _ = section_area_and_inertia(tooth_outline(TOOTH, 400, 400), 12, 8e-3)
    assert np.sum(basis.dx) * 12 == pytest.approx(area, rel=2e-4 / level**2)
    ends = np.hypot(*mesh.nodes[:, mesh.flank])[[0, -1]]
    assert ends == pytest.approx([TOOTH.form_radius, TOOTH.tip_radius])


@pytest.mark.parametrize("teeth", [10, 17, 40, 150])
@pytest.mark.parametrize("bore", [0.2, 0.6, 0.9])
@pytest.mark.parametrize("fillet", [0.1, 0.38])
def test_no_cell_is_folded(teeth, bore, fillet):
    body = GearBody(teeth, 0.4 if teeth < 17 else 0.0, 1.0, 1.25, fillet, 0.02, 1e-3)
    tooth = cut_tooth(FAMILY, Drive(3e-3, np.radians(20.0), body, body), "pinion")
    mesh = sector_mesh(tooth, teeth, bore * tooth.root_radius, 1)
    basis = curved_basis(mesh.nodes, mesh.cells)
    assert np.all(basis.mapping.detDF(basis.X) > 0)


def test_rim_too_thin_for_the_mesh_is_refused():
    body = GearBody(8, -0.3, 1.0, 1.25, 0.05, 0.02, 1e-3)  # deeply undercut
    tooth = cut_tooth(FAMILY, Drive(3e-3, np.radians(20.0), body, body), "pinion")
    with pytest.raises(InputError, match="too thin"):
        gear_compliance(ElasticGear(tooth, 8, 0.97 * tooth.root_radius, POISSON, 0.75e-3, 1))


def solved_ring(teeth):
    """A gear, a basis of its whole ring, loaded at the middle of the flank, and all displacements."""
    gear = gear_compliance(GEAR._replace(teeth=teeth, depth=DEEP, held=True))
    basis, mesh = whole_ring(1, teeth)
    place = basis.doflocs
    flank = mesh.nodes[:, mesh.flank]
    r = np.linspace(TOOTH.form_distance, TOOTH.tip_distance, 400_001)
    x, y = flank_point(TOOTH, r)
    middle = len(mesh.flank) // 2
    # the outward normal of the flank, from its tangent, at a position in the middle
    at = np.argmin(np.abs(np.hypot(x, y) - gear.radius[middle]))
    tangent = np.array([x[at + 1] - x[at - 1], y[at + 1] - y[at - 1]])
    inward = np.array([tangent[1], -tangent[0]]) / np.hypot(*tangent)
    node = np.argmin(np.hypot(*(place - flank[:, [middle]])))
    load = np.zeros(2 * basis.N)
    load[2 * node : 2 * node + 2] = inward
    held = np.hypot(*place) < 8e-3 * (1 + 1e-9)
    free = np.flatnonzero(np.repeat(~held, 2))
    matrix = plane_stiffness(basis, POISSON).tocsr()
    u = np.zeros(2 * basis.N)
    u[free] = spsolve(matrix[free][:, free].tocsc(), load[free])
    return gear, place, u, flank, inward


@pytest.fixture(scope="module")
def few():
    with pytest.MonkeyPatch.context() as patch:
        few_cells(patch)
        return 5, gear_model(GEAR._replace(teeth=5, depth=DEEP)), *solved_ring(5)


def test_a_ring_is_held_at_its_bore_and_gives_way_to_the_load(few):
    _, _, _, place, u, flank, inward = few
    moved = u.reshape(-1, 2)
    assert moved[np.argmin(np.hypot(*(place - flank[:, [flank.shape[1] // 2]])))] @ inward > 0
    assert not np.any(moved[np.hypot(*place) < 8e-3 * (1 + 1e-9)])


def test_one_sector_of_few_cells_is_the_whole_ring(few):
    check_teeth(*few)
    check_inside(*few)


def test_one_sector_with_cyclic_symmetry_is_the_whole_ring():
    check_teeth(12, None, *solved_ring(12))


def check_teeth(teeth, _, gear, place, u, flank, inward):
    """Read the flanks of five teeth in the middle."""
    middle = flank.shape[1] // 2
    for tooth in (-2, -1, 0, 1, 2):
        angle = 2 * np.pi * tooth / teeth
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s], [s, c]])
        node = np.argmin(np.hypot(*(place - (turn @ flank)[:, [middle]])))
        expected = u[2 * node : 2 * node + 2] @ (turn @ inward)
        assert gear.between[NEIGHBOURS + tooth, middle, middle] == pytest.approx(expected, rel=1e-5)


def check_inside(_, model, gear, place, u, flank, __):
    """Read at the depths below the load, by the half sector's functions on the ring's own displacements."""
    middle, count = flank.shape[1] // 2, len(gear.radius)
    assert model.beyond[[middle, count + middle]].tolist() == [False, True]
    for which, mirror in enumerate(([1.0, 1.0], [1.0, -1.0])):
        half = model.basis.doflocs * np.array(mirror)[:, None]
        numbers = KDTree(place.T).query(half.T)[1]
        moved = u.reshape(-1, 2)[numbers] * mirror
        expected = model.inner[which * count + middle] @ moved.ravel()
        assert gear.inside[which, middle] == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("held", [True, False])
def test_compliances_are_reciprocal_and_fall_with_distance(held):
    """Held teeth all give way to the same side; free ones, whose mean motion is none, to both."""
    gear = gear_compliance(GEAR._replace(held=held))
    for k in range(NEIGHBOURS + 1):
        np.testing.assert_allclose(
            gear.between[NEIGHBOURS + k], gear.between[NEIGHBOURS - k].T, rtol=1e-9, atol=1e-12
        )
    middle = len(gear.radius) // 2
    near = gear.between[NEIGHBOURS:, middle, middle]
    assert near[0] > near[1] > near[2]
    assert (near[2] > 0) == held
    assert np.all(gear.inside[0] > gear.inside[1])  # the nearer to the load, the more it gives way


@pytest.mark.parametrize("ratio", [0.2, 1.0, 3.0])
def test_cells_grow_evenly_from_one_end_to_the_other(ratio):
    places = graded(6, ratio)
    widths = np.diff(places)
    assert (places[0], places[-1]) == (0.0, pytest.approx(1.0, abs=1e-14))
    # the given ratio is that of both ends of the row, half a cell beyond the middles of the outer cells
    grown = max(ratio, 1.0 / ratio) ** (1.0 / 6.0)
    np.testing.assert_allclose(widths[1:] / widths[:-1], grown, rtol=1e-12)
