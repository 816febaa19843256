"""Free end faces of a prism: exact states, and blocks of solid elements whose ends are free."""

import numpy as np
import pytest
from scipy.sparse.linalg import splu, spsolve
from skfem import Basis, ElementHex2, ElementVector, MeshHex

from tests.support.solid_elements import node_at, plate, solid_energy
from tribodyn.compliance.fem.free_ends import openings, parity_weights
from tribodyn.compliance.fem.gear_compliance import spline_weights, wave_numbers
from tribodyn.compliance.fem.strips import edge_points, edge_values, stress_rows, strip_stiffness

POISSON = 0.3


class Prism:
    """A block whose displacements are known at some wave numbers; the openings that are not held."""

    def __init__(self, basis, held, loads, held_face=None, poisson=POISSON, solved=None):
        self.basis, self.opening = basis, openings(basis, poisson)
        self.solved = wave_numbers(1.0, 4.0) if solved is None else solved
        moving = np.setdiff1d(np.arange(3 * basis.N), held)
        faces = np.ones(self.opening.place.shape[1], dtype=bool)
        if held_face is not None:
            faces = ~held_face(self.opening.place)
        self.own, self.reached, self.stiffness, self.opened = [], [], [], []
        matrices = strip_stiffness(basis, poisson)
        for k in self.solved:
            # without waves w is by itself, and nothing loads it
            free = moving if k > 0 else moving[moving % 3 < 2]
            matrix = (matrices[0] + k * matrices[1] + k**2 * matrices[2]).tocsc()[free][:, free]
            forces = self.opening.forces(k)[:, faces]
            solver = splu(matrix)
            by_loads, by_opening = solver.solve(loads[free]), np.zeros_like(forces)
            by_opening[free] = solver.solve(forces[free])
            self.own.append(loads[free].T @ by_loads)
            self.reached.append(forces[free].T @ by_loads)
            self.stiffness.append(self.opening.stiffness[np.ix_(faces, faces)] - forces.T @ by_opening)
            self.opened.append(by_opening)

    def uniform(self, width):
        """What a uniform line load of 1 opens the ends by: the opening of both together."""
        even = np.tensordot(parity_weights(self.solved, width)[0], np.array(self.stiffness), 1)
        return np.linalg.solve(even, -self.reached[0])

    def held_and_free(self, width, place, load):
        """At slices' middles under an even line load's values at `place`; with symmetric and free ends."""
        number = np.arange(int(self.solved[-1] * width / np.pi) + 1)
        count = np.where(number > 0, 2.0, 1.0) / width
        slices = len(place)
        wave = np.cos(number * np.pi / width * place[:, None]) * np.sinc(number / (2 * slices))
        amplitude = count * (load * width / slices @ wave)
        weights = spline_weights(self.solved, number * np.pi / width)
        own, reached = np.array(self.own), np.array(self.reached)
        symmetric = wave @ (np.einsum("nk,kab->nab", weights, own)[:, 0, 1] * amplitude)
        added = np.zeros(slices)
        for parity, weight in zip((0, 1), parity_weights(self.solved, width), strict=True):
            part = slice(parity, None, 2)
            stress = np.einsum("nk,kjl->njl", weights[part], reached)
            opening = np.linalg.solve(
                np.tensordot(weight, np.array(self.stiffness), 1), amplitude[part] @ stress[:, :, 0]
            )
            added += wave[:, part] @ (count[part] * (stress[:, :, 1] @ opening))
        return symmetric, symmetric + added


BAR_WIDTH = 3.0


def stretched_bar(poisson=POISSON):
    """A bar 0 < x < 2 under a tension of 1 at its end, on rollers at x = 0."""
    basis = plate(4, 2, 2.0, 1.0)
    x, y = basis.doflocs
    end = np.flatnonzero(np.abs(x - 2) < 1e-9)
    end = end[np.argsort(y[end])]
    load = np.zeros((3 * basis.N, 1))
    load[3 * end, 0] = np.array([1, 4, 2, 4, 1]) / 12  # Simpson's rule over two quadratic edges
    rollers = 3 * np.flatnonzero(np.abs(x) < 1e-9)
    held = np.append(rollers, 3 * node_at(basis.doflocs, 0.0, 0.0) + 1)
    # what the bar answers jumps at k = 0, for nothing holds it along z: no splines between wave numbers
    return Prism(basis, held, load, poisson=poisson, solved=np.arange(12) * np.pi / BAR_WIDTH)


def test_stretched_bar_with_free_ends_is_in_plane_stress():
    bar = stretched_bar()
    opening = bar.uniform(BAR_WIDTH)
    # ε_z = −ν σ/E all over
    np.testing.assert_allclose(opening, -POISSON * BAR_WIDTH, rtol=1e-9)
    deflection = bar.own[0] - bar.reached[0].T @ opening / BAR_WIDTH
    assert bar.own[0] == pytest.approx(2 * (1 - POISSON**2), rel=1e-9)
    assert deflection == pytest.approx(2.0, rel=1e-9)


def test_stress_along_a_stretched_bar_is_that_of_plane_strain():
    bar, width = stretched_bar(), 3.0
    top = np.flatnonzero(np.abs(bar.basis.doflocs[1] - 0.5) < 1e-9)
    top = top[np.argsort(bar.basis.doflocs[0, top])]
    place = bar.basis.doflocs[:, top]
    corners = np.array([node_at(bar.opening.place, *point) for point in place[:, ::2].T])
    own = edge_values(corners, bar.opening.place.shape[1]) * POISSON / (1 - POISSON**2)
    opening = bar.uniform(width)
    for k, opened in zip(bar.solved, bar.opened, strict=True):
        rows = stress_rows(place, top, 3 * bar.basis.N, POISSON, k)
        np.testing.assert_allclose((own - rows @ opened) @ opening, 0.0, atol=1e-9)
    np.testing.assert_allclose(own @ bar.opening.place[0] * (1 - POISSON**2) / POISSON, edge_points(place)[0])


def test_harmonics_beyond_those_solved_fall_with_the_fourth_power():
    """Sums over even and odd numbers of half waves, the uniform one counted once, in a plain loop."""
    width, values = 1.7, np.array([2.0, -1.0, 0.5, 3.0, 1.5])
    solved = np.array([0.0, 2.0, 5.0, 9.0, 14.0])
    expected = np.zeros(2)
    for n in range(200):
        k = n * np.pi / width
        value = spline_weights(solved, np.array([min(k, 14.0)]))[0] @ values
        expected[n % 2] += (2.0 if n else 1.0) / width * value * min(1.0, (14.0 / max(k, 1.0)) ** 4)
    np.testing.assert_allclose(parity_weights(solved, width) @ values, expected, rtol=1e-3)


def test_without_poisson_s_ratio_a_uniform_load_does_not_notice_the_ends():
    bar = stretched_bar(poisson=0.0)
    assert np.max(np.abs(bar.reached[0])) < 1e-15
    assert bar.own[0] == pytest.approx(2.0, rel=1e-9)


WIDTH, SLICES = 10.0, 10


def solid_block(layers):
    """Deflections opposite to a line load that rises from 0 to twice its mean, ends free and symmetric.

    A block like a tooth on its body, 10 modules wide, clamped at x = 0; at the middles of `SLICES` slices.
    """
    mesh = MeshHex.init_tensor(
        np.linspace(0, 4.2, 8), np.linspace(-1, 1, 3), np.linspace(0, WIDTH, layers + 1)
    )
    basis = Basis(mesh, ElementVector(ElementHex2()), intorder=4)
    place, component = basis.doflocs, np.tile([0, 1, 2], basis.N // 3)
    column = (np.abs(place[0] - 3.6) < 1e-9) & (component == 1)
    line, other = (np.flatnonzero(column & (np.abs(place[1] - y) < 1e-9)) for y in (1.0, -1.0))
    line, other = (nodes[np.argsort(place[2, nodes])] for nodes in (line, other))
    load = np.zeros(basis.N)
    for start in range(0, len(line) - 2, 2):  # Simpson's rule
        three = line[start : start + 3]
        load[three] -= WIDTH / layers * np.array([1, 4, 1]) / 6 * 2 * place[2, three] / WIDTH
    stiffness = solid_energy.assemble(basis).tocsc()
    ends = (component == 2) & ((place[2] < 1e-9) | (place[2] > WIDTH - 1e-9))
    deflection = []
    for held in (place[0] < 1e-9, (place[0] < 1e-9) | ends):
        free = np.flatnonzero(~held)
        found = np.zeros(basis.N)
        found[free] = np.asarray(spsolve(stiffness[free][:, free], load[free]))
        deflection.append(np.interp(MIDDLES, place[2, other], -found[other]))
    return deflection


MIDDLES = (np.arange(SLICES) + 0.5) * WIDTH / SLICES


@pytest.fixture(scope="module")
def block():
    """The same by harmonics."""
    basis = plate(7, 4, 4.2, 2.0)
    loads = np.zeros((3 * basis.N, 2))
    for column, y in enumerate((1.0, -1.0)):
        loads[3 * node_at(basis.doflocs, 3.6, y) + 1, column] = -1.0
    clamped = np.flatnonzero(np.repeat(basis.doflocs[0] < 1e-9, 3))
    return Prism(basis, clamped, loads, held_face=lambda place: place[0] < 1e-9)


def test_block_with_free_ends_is_that_of_solid_elements(block):
    symmetric, free = block.held_and_free(WIDTH, MIDDLES, 2 * MIDDLES / WIDTH)
    solid_free, solid_symmetric = solid_block(8)
    np.testing.assert_allclose(symmetric, solid_symmetric, atol=0.01 * np.max(symmetric))
    np.testing.assert_allclose(free, solid_free, atol=0.01 * np.max(symmetric))
    # what the ends are worth is a sixth of that
    worth, solid = free - symmetric, solid_free - solid_symmetric
    np.testing.assert_allclose(worth, solid, atol=0.02 * np.max(np.abs(solid)))
    assert np.max(np.abs(solid)) > 0.12 * np.mean(solid_symmetric) / 1.6


def test_the_middle_of_a_long_face_does_not_notice_its_ends(block):
    width, slices = 60.0, 60
    place = (np.arange(slices) + 0.5) * width / slices
    load = np.where(np.abs(place - width / 2) < 2.0, 1.0, 0.0)
    symmetric, free = block.held_and_free(width, place, load)
    assert np.max(np.abs(free - symmetric)) < 1e-3 * np.max(symmetric)
    even = block.held_and_free(width, place, np.ones(slices))
    inside = slice(slices // 2 - 5, slices // 2 + 5)
    np.testing.assert_allclose(even[1][inside], even[0][inside], rtol=2e-3)
