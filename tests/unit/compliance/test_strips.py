"""Finite strips: against solid elements, plate theory and strains written out."""

import numpy as np
import pytest
from scipy.sparse.linalg import spsolve
from skfem import Basis, ElementHex2, ElementVector, MeshHex

from tests.support.solid_elements import POISSON, node_at, plate, solid_energy
from tribodyn.compliance.fem.free_ends import openings
from tribodyn.compliance.fem.strips import edge_points, plane_stiffness, stress_rows, strip_stiffness


def solve_strip(basis, k, load):
    """Amplitudes (node, 3) of a body clamped at x = 0 under the nodes' loads (node, 3)."""
    constant, linear, square = strip_stiffness(basis, POISSON)
    free = np.flatnonzero(np.repeat(basis.doflocs[0] > 1e-9, 3))
    matrix = (constant + k * linear + k**2 * square).tocsc()[free][:, free]
    found = np.zeros(3 * basis.N)
    found[free] = spsolve(matrix, load.ravel()[free])
    return found.reshape(-1, 3)


def solid_compliance(section, k, slices, node):
    """Work of the load -cos kz along the section's node, over a quarter wave's, in a block 0 < z < pi/k.

    The block of solid elements is cut as the strips' section is; w = 0 on both of its ends.
    """
    corners = section.mesh.p[:, np.unique(section.mesh.t)]
    cells = [np.unique(np.round(corners[axis], 12)) for axis in (0, 1)]
    mesh = MeshHex.init_tensor(*cells, np.linspace(0, np.pi / k, slices + 1))
    basis = Basis(mesh, ElementVector(ElementHex2()), intorder=5)
    place, component = basis.doflocs, np.tile([0, 1, 2], basis.N // 3)
    ends = (place[2] < 1e-9) | (place[2] > np.pi / k - 1e-9)
    free = np.flatnonzero((place[0] > 1e-9) & ~((component == 2) & ends))
    line = np.flatnonzero((np.hypot(*(place[:2] - section.doflocs[:, [node]])) < 1e-9) & (component == 1))
    line = line[np.argsort(place[2, line])]
    # nodal forces of the line load on quadratic shape functions
    load = np.zeros(basis.N)
    points, weights = np.polynomial.legendre.leggauss(8)
    half = np.pi / k / slices / 2
    for start in range(0, len(line) - 2, 2):
        at = place[2, line[start + 1]] + points * half
        for offset, shape in enumerate((points * (points - 1) / 2, 1 - points**2, points * (points + 1) / 2)):
            load[line[start + offset]] -= np.sum(weights * shape * np.cos(k * at)) * half
    stiffness = solid_energy.assemble(basis).tocsc()
    return load[free] @ spsolve(stiffness[free][:, free], load[free]) / (np.pi / k / 2)


@pytest.mark.parametrize("k", [0.7, 2.5])
def test_strips_are_the_limit_of_solid_elements_with_the_fourth_power(k):
    section = plate(2, 1, 1.5, 1.0)
    node = node_at(section.doflocs, 1.5, 0.5)
    load = np.zeros((section.N, 3))
    load[node, 1] = -1.0
    strip = np.sum(load * solve_strip(section, k, load))
    errors = np.array([1 - solid_compliance(section, k, slices, node) / strip for slices in (1, 2, 4)])
    assert np.all(errors > 0)  # fewer shape functions are stiffer
    rates = np.log2(errors[:-1] / errors[1:])
    assert np.all(rates > 3.5), (errors, rates)
    assert errors[-1] < 2e-3


def kirchhoff(length, k):
    """Deflection X(x) cos kz of a clamped plate of unit rigidity D, free at x = length under cos kz there.

    S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells, § 22: X'''' - 2k²X'' + k⁴X = 0 with
    no edge moment and the edge's shear -(X''' - (2 - nu) k² X') equal to the load.
    """

    # X = (a + b x) cosh kx + (c + d x) sinh kx with X(0) = X'(0) = 0, hence a = 0 and b + kc = 0
    def terms(x):
        """Value and three derivatives of x cosh kx, sinh kx, x sinh kx."""
        c, s = np.cosh(k * x), np.sinh(k * x)
        return np.array(
            [
                [x * c, c + k * x * s, 2 * k * s + k**2 * x * c, 3 * k**2 * c + k**3 * x * s],
                [s, k * c, k**2 * s, k**3 * c],
                [x * s, s + k * x * c, 2 * k * c + k**2 * x * s, 3 * k**2 * s + k**3 * x * c],
            ]
        )

    end = terms(length)
    basis = np.stack([end[0] - end[1] / k, end[2]])
    moment = basis[:, 2] - POISSON * k**2 * basis[:, 0]
    shear = -(basis[:, 3] - (2 - POISSON) * k**2 * basis[:, 1])
    b, d = np.linalg.solve([moment, shear], [0.0, 1.0])

    def shape(x):
        first, second, third = terms(x)
        return b * (first - second / k) + d * third

    return shape


@pytest.mark.parametrize("k", [0.5, 1.5, 3.0])
def test_thin_cantilever_plate_bends_as_kirchhoff_says(k):
    # the free edge's effective shear is right to first order in the thickness
    rigidity = 1.0 / (12 * (1 - POISSON**2))
    exact, misses = kirchhoff(1.0, k)(1.0)[0], []
    for thickness in (0.05, 0.025, 0.0125):
        basis = plate(24, 1, 1.0, thickness)
        load = np.zeros((basis.N, 3))
        load[node_at(basis.doflocs, 1.0, 0.0), 1] = 1.0
        tip = solve_strip(basis, k, load)[node_at(basis.doflocs, 1.0, -thickness / 2), 1]
        misses.append(tip * rigidity * thickness**3 / exact - 1)
    assert abs(misses[2]) < 4e-3
    assert abs(2 * misses[2] - misses[1]) < 5e-3  # of vanishing thickness


def test_surface_stress_of_a_plate_is_that_of_its_moment():
    # σ = 6 M/t², M = -D (X'' - ν k² X): the part that bends along the clamp counts through w alone
    k, thickness = 2.0, 0.0125
    basis = plate(60, 1, 1.0, thickness)
    load = np.zeros((basis.N, 3))
    load[node_at(basis.doflocs, 1.0, 0.0), 1] = 1.0
    found = solve_strip(basis, k, load).ravel()
    top = np.flatnonzero(np.abs(basis.doflocs[1] - thickness / 2) < 1e-9)
    top = top[np.argsort(basis.doflocs[0, top])]
    place = basis.doflocs[:, top]
    stress = stress_rows(place, top, 3 * basis.N, POISSON, k) @ found
    x = edge_points(place)[0]
    shape = [kirchhoff(1.0, k)(at) for at in x]
    moment = np.array([-(shape_of[2] - POISSON * k**2 * shape_of[0]) for shape_of in shape])
    away = (x > 0.1) & (x < 0.9)
    np.testing.assert_allclose(
        stress[away], 6 * moment[away] / thickness**2, atol=0.01 * 6 * abs(moment[0]) / thickness**2
    )


def quadratic(coefficients, x, y):
    """Values and slopes along x and y, (3, point), of three quadratic functions of (3, 6) coefficients."""
    ones, none = np.ones_like(x), np.zeros_like(x)
    terms = (
        [ones, x, y, x * x, x * y, y * y],
        [none, ones, none, 2 * x, y, none],
        [none, none, ones, none, x, 2 * y],
    )
    return [coefficients @ np.stack(rows) for rows in terms]


@pytest.mark.parametrize("poisson", [0.3, 0.18])
@pytest.mark.parametrize("k", [0.0, 1.7])
def test_work_of_one_field_on_another_is_that_of_their_strains(rng, k, poisson):
    """Strains written out and integrated point by point, of displacements that the cells hold."""
    basis = plate(2, 1, 1.3, 0.8)
    nodes, weights = np.polynomial.legendre.leggauss(5)
    x, y = 0.65 * (1 + nodes[:, None]) + 0 * nodes, 0.4 * nodes + 0 * nodes[:, None]
    x, y, weight = x.ravel(), y.ravel(), np.outer(0.65 * weights, 0.4 * weights).ravel()
    shear, lame = 0.5 / (1 + poisson), poisson / ((1 + poisson) * (1 - 2 * poisson))
    fields, strains = [], []
    for _ in range(2):
        coefficients = rng.normal(size=(3, 6))
        value, _, _ = quadratic(coefficients, *basis.doflocs)
        fields.append(value.T.ravel())
        (u, v, w), (u_x, v_x, w_x), (u_y, v_y, w_y) = quadratic(coefficients, x, y)
        strains.append((u_x, v_y, k * w, u_y + v_x, w_x - k * u, w_y - k * v))
    first, second = strains
    work = lame * sum(first[:3]) * sum(second[:3])
    work = work + 2 * shear * sum(a * b for a, b in zip(first[:3], second[:3], strict=True))
    work = work + shear * sum(a * b for a, b in zip(first[3:], second[3:], strict=True))
    constant, linear, square = strip_stiffness(basis, poisson)
    found = fields[0] @ (constant + k * linear + k**2 * square) @ fields[1]
    assert found == pytest.approx(weight @ work, rel=1e-10)
    # the opening of an end face that is linear in the cells: stress across it times the opening
    opening = openings(basis, poisson)
    slope = rng.normal(size=3)
    open_by = slope @ [np.ones_like(opening.place[0]), *opening.place]
    at_points = slope @ [np.ones_like(x), x, y]
    stress = lame * sum(first[:3]) + 2 * shear * first[2]
    assert fields[0] @ opening.forces(k) @ open_by == pytest.approx(weight @ (stress * at_points), rel=1e-10)
    stiffness = (lame + 2 * shear) * weight @ at_points**2
    assert open_by @ opening.stiffness @ open_by == pytest.approx(stiffness, rel=1e-10)
    if k == 0.0:
        flat = np.delete(fields[0], np.s_[2::3]), np.delete(fields[1], np.s_[2::3])
        plane = lame * (first[0] + first[1]) * (second[0] + second[1]) + shear * first[3] * second[3]
        plane = plane + 2 * shear * (first[0] * second[0] + first[1] * second[1])
        assert flat[0] @ plane_stiffness(basis, poisson) @ flat[1] == pytest.approx(weight @ plane, rel=1e-10)
