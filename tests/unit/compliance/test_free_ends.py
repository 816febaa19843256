"""Free end faces of a gear: half a sector against a whole one, and what slices of the face make of them."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.sparse import csc_matrix, diags, kron
from scipy.sparse.linalg import splu
from scipy.spatial import KDTree

from tests.support.twelve_teeth import BODY, GEAR, TOOTH, few_cells, sector_mesh
from tribodyn.compliance.fem.free_ends import (
    at_phase,
    face_of,
    free_ends,
    harmonic_of,
    openings,
    parity_weights,
)
from tribodyn.compliance.fem.gear import gear_model
from tribodyn.compliance.fem.gear_compliance import without_neighbours
from tribodyn.compliance.fem.strips import (
    curved_basis,
    edge_parameters,
    edge_values,
    stress_rows,
    strip_stiffness,
)
from tribodyn.compliance.sharing.slices import pair_harmonics, slice_compliance
from tribodyn.geometry.corner_contact import pair_geometry

TEETH, POISSON = 6, 0.3  # of the teeth of twelve


def tied(place, components, phase, turned):
    """Whole sector's values by the free ones: 0 at the bore, edge +π/Z the phase times edge −π/Z."""
    radius, angle = np.hypot(*place), np.arctan2(place[1], place[0])
    held = radius < BODY.bore_radius * (1 + 1e-9)
    upper = np.flatnonzero(~held & (np.abs(angle - np.pi / TEETH) < 1e-9))
    turn = np.array([[np.cos(t := 2 * np.pi / TEETH), -np.sin(t)], [np.sin(t), np.cos(t)]])
    lower = np.asarray(KDTree(place.T).query((turn.T @ place[:, upper]).T)[1])
    node = np.eye(components, dtype=complex)
    if turned:
        node[:2, :2] = turn
    unit = diags((~held).astype(complex)).tolil()
    unit[upper, upper] = 0
    link = csc_matrix((np.full(len(upper), phase), (upper, lower)), shape=unit.shape)
    whole = kron(unit, np.eye(components)) + kron(link, node)
    free = np.setdiff1d(np.flatnonzero(~held), upper)
    return csc_matrix(whole)[:, (components * free[:, None] + np.arange(components)).ravel()]


class Sector:
    """A whole sector of a gear, its end faces held or opened."""

    def __init__(self):
        mesh = sector_mesh(TOOTH, TEETH, BODY.bore_radius, 1)
        self.basis = curved_basis(mesh.nodes, mesh.cells)
        self.opening, self.matrices = openings(self.basis, POISSON), strip_stiffness(self.basis, POISSON)

    def under(self, model, wave_number, phase):
        """Stiffness of the openings, stress that flank loads make on the held face, and along both roots."""
        basis, opening, matrices = self.basis, self.opening, self.matrices
        nodes = KDTree(basis.doflocs.T)
        stiffness = matrices[0] + wave_number * matrices[1] + wave_number**2 * matrices[2]
        body, face = tied(basis.doflocs, 3, phase, True), tied(opening.place, 1, phase, False)
        loads = np.zeros((3 * basis.N, model.loads.shape[1]))
        flank = model.loads.reshape(-1, 2, loads.shape[1])
        at, column = np.nonzero(np.any(flank != 0, axis=1))
        near = nodes.query(model.basis.doflocs[:, at].T)[1]
        for component in (0, 1):
            loads[3 * near + component, column] = flank[at, component, column]
        forces = opening.forces(wave_number) @ face
        solver = splu(csc_matrix(body.conj().T @ stiffness @ body))
        by_opening = body @ solver.solve(np.asarray(body.conj().T @ forces))
        by_loads = body @ solver.solve(np.asarray(body.conj().T @ loads.astype(complex)))
        held = face.conj().T @ opening.stiffness @ face - forces.conj().T @ by_opening
        stresses = []
        for sign in (1.0, -1.0):
            place = model.root_position * np.array([[1.0], [sign]])
            root = np.asarray(nodes.query(place.T)[1])
            corners = np.asarray(KDTree(opening.place.T).query(place[:, ::2].T)[1])
            own = edge_values(corners, opening.place.shape[1]) * POISSON / (1 - POISSON**2)
            rows = stress_rows(place, root, 3 * basis.N, POISSON, wave_number)
            stresses.append(rows @ by_opening - own @ face)
        return np.asarray(held), forces.conj().T @ by_loads, np.concatenate(stresses)


def half_and_whole():
    """Model, face, matrices and whole sector of one mesh."""
    model = gear_model(GEAR._replace(teeth=TEETH))
    face = face_of(model, openings(model.basis, POISSON))
    return model, face, strip_stiffness(model.basis, POISSON), Sector()


@pytest.fixture(scope="module")
def few():
    with pytest.MonkeyPatch.context() as patch:
        few_cells(patch)
        return half_and_whole()


@pytest.mark.parametrize(("harmonic", "wave_number"), [(1, 0.0), (0, 300.0), (1, 300.0), (3, 300.0)])
def test_half_a_sector_of_few_cells_stands_for_a_whole_one(few, harmonic, wave_number):
    check_half_a_sector(few, harmonic, wave_number)


def test_half_a_sector_stands_for_a_whole_one():
    check_half_a_sector(half_and_whole(), 1, 300.0)


def check_half_a_sector(parts, harmonic, wave_number):
    """Compare what openings and loads do, on a half and on a whole sector."""
    model, face, matrices, sector = parts
    half = harmonic_of(model, face.openings, matrices, POISSON, wave_number)
    phase = complex(np.exp(2j * np.pi * harmonic / TEETH))
    held, reached, seen = at_phase([half], face, phase)
    whole = sector.under(model, wave_number, phase)
    opened, expected = np.linalg.solve(held[0], reached), np.linalg.solve(whole[0], whole[1])
    more = whole[1].conj().T @ expected
    np.testing.assert_allclose(reached.conj().T @ opened, more, atol=1e-8 * np.max(np.abs(more)))
    stress = whole[2] @ expected
    np.testing.assert_allclose(seen @ opened, stress, atol=1e-7 * np.max(np.abs(stress)))


def test_a_load_on_one_tooth_is_all_harmonics_around_the_ring(monkeypatch, few):
    """Every harmonic by itself, none by its conjugate; openings that leave the ends free on the whole."""
    few_cells(monkeypatch)
    width, waves = 20e-3, np.array([0.0, 90.0, 600.0, 1900.0])
    found = free_ends(GEAR._replace(teeth=TEETH, level=2), waves, width)
    model, face, matrices, _ = few
    harmonics = [harmonic_of(model, face.openings, matrices, POISSON, k) for k in waves]
    count, flank, roots = len(waves), len(found.radius), harmonics[0].on_root.shape[0]
    weights = parity_weights(waves, width)
    flanks = np.zeros((2, count, count, 5, flank, flank), complex)
    stress = np.zeros((2, count, count, 5, 2, roots, flank), complex)
    for n in range(TEETH):
        phase = complex(np.exp(2j * np.pi * n / TEETH))
        held, reached, seen = at_phase(harmonics, face, phase)
        reached, seen = reached.reshape(-1, count, flank), seen.reshape(count, 2, roots, -1)
        for parity in (0, 1):
            opened = np.einsum(
                "oq,qlm->olm",
                np.linalg.inv(sum(w * matrix for w, matrix in zip(weights[parity], held, strict=True))),
                reached,
            )
            for sector in range(-2, 3):
                turn = phase**sector / TEETH
                flanks[parity, :, :, sector + 2] += turn * np.einsum("okm,oln->klmn", reached.conj(), opened)
                stress[parity, :, :, sector + 2] += turn * np.einsum("kspo,olm->klspm", seen, opened)
    scale = np.abs(flanks).max()
    np.testing.assert_allclose(found.between, flanks, rtol=1e-9, atol=1e-11 * scale)
    np.testing.assert_allclose(found.own, np.einsum("pklmm->pklm", flanks[..., 2, :, :]), atol=1e-11 * scale)
    np.testing.assert_allclose(found.radius, np.hypot(*model.position))
    # along the root a cubic through the points of the elements, read at those of a mesh twice as fine
    edges = roots // 2
    at = CubicSpline(edge_parameters(edges, 1), stress, axis=5)(edge_parameters(edges, 2))
    np.testing.assert_allclose(found.root_stress, at, rtol=1e-9, atol=1e-10 * np.abs(at).max())


def added(pair, roll, slices):
    """What free ends add to the slices' compliances, as a matrix over pairs and slices."""
    geometry = pair_geometry(pair.assembly, roll)
    held = pair._replace(gears=tuple(gear._replace(ends=None) for gear in pair.gears))
    free, symmetric = (slice_compliance(flexible, geometry, slices) for flexible in (pair, held))
    size = roll.shape[1] * slices
    return (free - symmetric).reshape(-1, size, size), symmetric.reshape(-1, size, size)


def test_free_ends_only_give_way_more_and_answer_each_other(pair):
    roll = np.array([[0.15, 0.15 - 2 * np.pi / 18], [0.3, 0.3 - 2 * np.pi / 18]])
    slices = 21
    more, symmetric = added(pair, roll, slices)
    np.testing.assert_allclose(more, more.swapaxes(1, 2), atol=1e-12 * np.max(more))
    assert np.min(np.linalg.eigvalsh(more)) > -1e-9 * np.max(more)
    assert np.min(np.linalg.eigvalsh(symmetric)) > 0
    own = more[:, :slices, :slices]
    np.testing.assert_allclose(own, own[:, ::-1, ::-1], atol=1e-9 * np.max(own))


def test_slices_in_one_give_way_like_one_wide_slice(pair):
    """Even loads on all parts of a slice are an even load on it, and its mean deflection is theirs."""
    means = []
    for slices in (6, 48):
        more = added(pair, np.zeros((1, 1)), slices)[0][0]
        means.append(more.reshape(6, slices // 6, 6, slices // 6).mean(axis=(1, 3)))
    np.testing.assert_allclose(means[1], means[0], rtol=1e-9, atol=1e-12 * np.max(means[0]))


def test_one_slice_and_slices_apart_are_plane_strain(pair):
    geometry = pair_geometry(pair.assembly, np.array([[0.1, -0.2]]))
    plane = pair_harmonics(pair, geometry)[0]
    np.testing.assert_array_equal(slice_compliance(pair, geometry)[:, :, 0, :, 0], plane)
    apart = slice_compliance(pair, geometry, 7, coupled=False)
    np.testing.assert_allclose(apart.sum(axis=4) / 7, plane[:, :, None, :] * np.ones((7, 1)), rtol=1e-12)


def test_a_wide_face_is_in_plane_strain_but_for_its_ends(pair):
    """Bodies as wide as their own diameter notice an even load's free ends by a few per cent only."""
    more, symmetric = added(pair, np.zeros((1, 1)), 21)
    assert 0.0 < np.sum(more) / np.sum(symmetric) < 0.05


def test_without_neighbours_teeth_do_not_know_of_each_other_s_ends(pair):
    alone = pair._replace(gears=tuple(without_neighbours(gear) for gear in pair.gears))
    geometry = pair_geometry(pair.assembly, np.array([[0.1, -0.2]]))
    both, single = (slice_compliance(flexible, geometry, 5) for flexible in (pair, alone))
    assert not np.any(single[:, 0, :, 1])
    np.testing.assert_array_equal(single[:, 0, :, 0], both[:, 0, :, 0])
