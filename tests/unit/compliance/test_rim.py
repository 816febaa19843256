"""Rims of internal gears: the plane ring by formulas for thin rings, pins by their reactions."""

import math

import numpy as np
import pytest

from tribodyn.compliance.foundation import _ring_receptance, ring_compliance
from tribodyn.compliance.rim import PIN, free_receptance, pinned_receptance

NU = 0.3
MODULUS = 1.0 + NU  # for 2 G = 1
THIN = 0.01
#: Radius of the thin ring's middle, and its bending stiffness per width.
MIDDLE, BENDING = 1.0 + THIN / 2.0, MODULUS * THIN**3 / 12.0


def test_a_thin_ring_bends_as_timoshenko_has_it():
    """Radial load p cos nθ without stretching: w = p R⁴/(E I (n² − 1)²), v' = −w.

    The inside, at −t/2, moves by v − t/2 (v − w')/R.
    """
    n = np.arange(2.0, 7.0)
    ring = MIDDLE**3 / (BENDING * (n**2 - 1.0) ** 2)  # p on the inside, R times shorter
    found = free_receptance(np.arange(7.0), 1.0 + THIN, NU)[2:]
    np.testing.assert_allclose(found[:, 0, 0], ring, rtol=2e-3)
    np.testing.assert_allclose(found[:, 2, 0], ring, rtol=2e-3)
    across = -ring / n * (1.0 + THIN / 2.0 * (n**2 - 1.0) / MIDDLE)
    np.testing.assert_allclose(found[:, 0, 1], across, rtol=2e-3)


def test_two_opposite_loads_open_a_ring_as_roark_has_it():
    """Diameter along the loads W: (π/4 − 2/π) W R³/(E I); across: (1/2 − 2/π)."""
    n = np.arange(2.0, 202.0, 2.0)
    radial = free_receptance(np.arange(201.0), 1.0 + THIN, NU)[2::2, 0, 0] * 2.0 / np.pi
    along, across = 2.0 * radial.sum(), 2.0 * (radial * np.cos(n * np.pi / 2)).sum()
    unit = MIDDLE**3 / BENDING
    assert along == pytest.approx((math.pi / 4 - 2 / math.pi) * unit, rel=2e-3)
    assert across == pytest.approx((0.5 - 2 / math.pi) * unit, rel=2e-3)


def test_receptances_of_the_free_ring_are_reciprocal_and_those_of_the_foundation():
    order = np.arange(60.0)
    found = free_receptance(order, 1.2, NU)
    np.testing.assert_allclose(found[2:], np.swapaxes(found, 1, 2)[2:], atol=1e-12)
    alone = _ring_receptance(order, 1.2, NU, free=True)[2:] / (1.0 + NU)
    np.testing.assert_allclose(found[2:, :2, :2], alone, rtol=1e-10)


def _space(amplitudes: np.ndarray, angle: float) -> np.ndarray:
    """Displacement (2, 2) radial and tangential at an angle from radial and tangential unit loads at 0."""
    n = np.arange(len(amplitudes))
    weight = np.where(n == 0, 0.5, 1.0) / np.pi
    even, odd = weight * np.cos(n * angle), weight * np.sin(n * angle)
    sums = np.einsum("n,nij->ij", even, amplitudes), np.einsum("n,nij->ij", odd, amplitudes)
    return np.array([[sums[0][0, 0], -sums[1][0, 1]], [sums[1][1, 0], sums[0][1, 1]]])


@pytest.mark.parametrize("pins", [3, 5])
def test_pins_by_their_reactions_one_by_one(pins: int):
    """Solved in space for loads everywhere between two pins, radial and tangential; then the mean."""
    outside, count = 1.15, 120
    order = np.arange(count + 1.0)
    half_angle = PIN * (outside - 1.0) / (2.0 * outside)
    # as fine for the pins as the sum in space
    free = free_receptance(np.arange(2000.0), outside, NU)
    spread = np.sinc(np.arange(2000.0) * half_angle / np.pi)
    place = 2.0 * np.pi * np.arange(pins) / pins
    own = np.block(
        [[_space(free[:, 2:, 2:] * spread[:, None, None] ** 2, i - j) for j in place] for i in place]
    )
    off = free[: count + 1, 2:, :2] * spread[: count + 1, None, None]
    means = np.zeros((2, 2))
    steps = 2 * count // pins + 5  # no order is aliased
    for at in 2.0 * np.pi / pins * np.arange(steps) / steps:
        reach = np.concatenate([_space(off, pin - at) for pin in place])
        means += (_space(free[: count + 1, :2, :2], 0.0) - reach.T @ np.linalg.solve(own, reach)) / steps
    found = pinned_receptance(order, outside, NU, pins)
    np.testing.assert_allclose(_space(found, 0.0), means, rtol=2e-4, atol=1e-6 * means.max())


def test_many_pins_are_a_fit():
    order = np.arange(41.0)
    held = _ring_receptance(order, 1.3, NU) / (1.0 + NU)
    np.testing.assert_allclose(pinned_receptance(order, 1.3, NU, 400), held, rtol=1e-3, atol=1e-6)


def test_fewer_pins_hold_less_and_free_rims_yet_less():
    """Between neighbours too: the compliances' differences are positive for one load."""
    load = np.array([0.4, 1.0, -0.1])
    kept = [
        load @ ring_compliance(0.0, 0.02, 1.08, NU, 2048, pins) @ load
        for pins in (None, 96.0, 24.0, 8.0, 4.0)
    ]
    assert all(np.diff(kept) > 0.0)
    both = [ring_compliance(angle, 0.02, 1.08, NU, 256, 8.0) for angle in (0.07, -0.07)]
    np.testing.assert_allclose(both[0], both[1].T, atol=1e-9 * np.abs(both[0]).max())


def test_a_rim_as_thick_as_a_plane_is_one_with_a_hole():
    """Its outside far away: order n of a hole in a plane, by Kirsch's and Lamé's solutions."""
    receptance = _ring_receptance(np.arange(41.0), 300.0, NU)
    assert receptance[0] == pytest.approx(np.diag([1.0 + NU, 1.0 + NU]), rel=1e-4)
    # plane stress with a hole: radial cos 2θ traction and no shear
    kappa = (3.0 - NU) / (1.0 + NU)
    n = 2.0
    hole = (1.0 + NU) * ((kappa + 1.0) * n + kappa - 1.0) / (2.0 * (n**2 - 1.0))
    assert receptance[2, 0, 0] == pytest.approx(hole, rel=1e-4)
