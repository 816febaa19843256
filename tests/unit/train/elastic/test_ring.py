"""A rim that bends: natural frequencies in closed form, deflection under planets by finite elements, pins."""

import numpy as np
import pytest
from scipy.linalg import eigh
from skfem import Basis, ElementQuad2, ElementVector, MeshQuad, condense, solve
from skfem.models.elasticity import lame_parameters, linear_elasticity

from tribodyn.train.elastic.ring import PER_ORDER, Rim, rim_matrices, rows_at

MODULUS, POISSON, DENSITY = 2.06e11, 0.3, 7850.0
RADIUS, WIDTH = 0.1, 0.03


def rim_of(thickness):
    ends = RADIUS - thickness / 2.0, RADIUS + thickness / 2.0
    return Rim(*ends, WIDTH, MODULUS, POISSON, DENSITY)


def test_a_thin_free_ring_has_the_frequencies_of_one_that_does_not_stretch():
    rim, orders = rim_of(0.5e-3), np.arange(2, 7)
    found = np.sqrt(eigh(*rim_matrices(rim, 6)[2::-2], eigvals_only=True))[: 2 * len(orders)]
    bending = np.sqrt(MODULUS * rim.thickness**2 / 12.0 / (DENSITY * RADIUS**4))
    expected = orders * (orders**2 - 1) / np.sqrt(orders**2 + 1) * bending
    np.testing.assert_allclose(found, np.repeat(expected, 2), rtol=5e-4)


def finite_elements(rim, angles, outwards, onwards):
    """Outward displacement of the centre line of a free ring in plane stress, at angles; N at its inside.

    A uniform shear at the outside balances the torque; what moves and turns the ring as a whole, and what
    widens it, is taken off.
    """
    around, through = 120, 4
    theta = 2.0 * np.pi * np.arange(around + 1) / around
    strip = MeshQuad.init_tensor(theta, np.linspace(rim.inside, rim.outside, through + 1))
    first, last = (np.flatnonzero(np.isclose(strip.p[0], end)) for end in (0.0, 2.0 * np.pi))
    number = np.arange(strip.p.shape[1])
    number[last[np.argsort(strip.p[1][last])]] = first[np.argsort(strip.p[1][first])]
    kept, packed = np.unique(number, return_inverse=True)
    turn, radius = strip.p[:, kept]
    mesh = MeshQuad(radius * np.array([np.cos(turn), np.sin(turn)]), packed[strip.t])
    lame, shear = lame_parameters(MODULUS, POISSON)
    lame = 2.0 * lame * shear / (lame + 2.0 * shear)  # plane stress
    basis = Basis(mesh, ElementVector(ElementQuad2()))
    stiffness = WIDTH * linear_elasticity(lame, shear).assemble(basis)
    force = np.zeros(basis.N)

    def node(angle, at):
        place = at * np.array([np.cos(angle), np.sin(angle)])
        return int(np.argmin(np.hypot(*(mesh.p - place[:, None]))))

    def push(angle, at, out, on):
        x, y = np.cos(angle), np.sin(angle)
        force[basis.nodal_dofs[:, node(angle, at)]] += out * np.array([x, y]) + on * np.array([-y, x])

    for angle in angles:
        push(angle, rim.inside, outwards, onwards)
    for angle in theta[:-1]:
        push(angle, rim.outside, 0.0, -onwards * len(angles) * rim.inside / rim.outside / around)
    one, other = node(0.0, rim.outside), node(np.pi, rim.outside)
    held = np.append(basis.nodal_dofs[:, one], basis.nodal_dofs[1, other])
    moved = solve(*condense(stiffness, force, D=held))
    at = np.array([node(angle, rim.radius) for angle in theta[:-1]])
    out = np.sum(moved[basis.nodal_dofs[:, at]] * [np.cos(theta[:-1]), np.sin(theta[:-1])], axis=0)
    waves = np.fft.rfft(out)
    waves[:2] = 0.0
    return theta[:-1], np.fft.irfft(waves, around)


@pytest.mark.parametrize("planets", [3, 4])
@pytest.mark.parametrize("thickness", [0.006, 0.014])
@pytest.mark.parametrize("push", [(1.0, 0.0), (0.4, 1.0)])
def test_planets_bend_it_as_finite_elements_have_it(planets, thickness, push):
    rim, angles = rim_of(thickness), 2.0 * np.pi * np.arange(planets) / planets
    theta, expected = finite_elements(rim, angles, *push)
    orders = 16
    force = sum(rows_at(rim, orders, angle, rim.inside).T @ push for angle in angles)
    amplitudes = np.linalg.solve(rim_matrices(rim, orders).stiffness, force)
    found = np.array([rows_at(rim, orders, angle, rim.radius)[0] @ amplitudes for angle in theta])
    np.testing.assert_allclose(found, expected, atol=0.02 * np.abs(expected).max())


def test_pins_hold_the_orders_below_half_their_number_as_a_fit_does():
    rim, orders, pins, stiffness = rim_of(0.01), 5, 11, 3e8
    free, fitted = (
        rim_matrices(rim, orders, held).stiffness for held in ((0.0, 0.0), (pins * stiffness,) * 2)
    )
    found = free.copy()
    for angle in 0.3 + 2.0 * np.pi * np.arange(pins) / pins:
        rows = rows_at(rim, orders, angle, rim.outside)
        found += stiffness * rows.T @ rows
    np.testing.assert_allclose(found, fitted, atol=1e-12 * np.abs(fitted).max())
    coupled = found.reshape(orders - 1, PER_ORDER, orders - 1, PER_ORDER)
    assert np.abs(coupled[0, :, 1]).max() < 1e-12 * np.abs(found).max()


def test_a_rim_that_turns_against_the_frame_has_waves_that_its_own_ones_carry_along():
    rim, passing = rim_of(0.01), 60.0
    still, moving = rim_matrices(rim, 3), rim_matrices(rim, 3, passing=passing)
    size = len(still.mass)
    state = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [
                -np.linalg.solve(moving.mass, moving.stiffness),
                -np.linalg.solve(moving.mass, moving.gyroscopic),
            ],
        ]
    )
    found = np.sort(np.abs(np.linalg.eigvals(state).imag))[::2][:4]
    own = np.sqrt(eigh(still.stiffness, still.mass, eigvals_only=True))[:4:2]
    expected = np.sort(
        [rate + sign * n * passing for n, rate in zip((2, 3), own, strict=True) for sign in (1, -1)]
    )
    np.testing.assert_allclose(found, expected, rtol=1e-9)
