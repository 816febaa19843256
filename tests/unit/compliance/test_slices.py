"""Slices of the face: closed forms of springs, Hertz's elliptical contact, and the algebra of the modes."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq, nnls
from scipy.special import ellipe, ellipk

from tests.support.faces_in_slices import WIDTH
from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS, half_space_surface
from tribodyn.compliance.sharing import slices as slices_of_faces
from tribodyn.compliance.sharing.active_set import press
from tribodyn.compliance.sharing.condensed import press_pairs
from tribodyn.compliance.sharing.load_sharing import half_width
from tribodyn.compliance.sharing.slices import by_slices, modes, pair_harmonics
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.helix import face_positions

SPRING = 2e-9  # m/N of the whole face


def springs(gap, force):
    """Press independent linear springs, equal ones, against a gap (slice,) with a force."""
    slices = len(gap)
    ones = np.ones((1, slices))

    def local(_, load):
        return 0.0 * load, 0.0 * load

    matrix = slices * SPRING * np.eye(slices)[None]
    return press(matrix, local, ones, ones, gap[None], np.array([force]))


@pytest.mark.parametrize("slices", [21, 84])
def test_a_tilted_face_on_springs_carries_a_triangle(slices):
    """δ = √(2 F c γ b), touching ℓ = δ/γ < b, from F = ∫ (δ − γ z) dz/(c b)."""
    tilt, force = 2e-3, 1000.0
    deflection = np.sqrt(2 * force * SPRING * WIDTH * tilt)
    position = face_positions(WIDTH, slices) + WIDTH / 2
    found = springs(tilt * position, force)
    line_load = found.load[0] * slices / WIDTH
    expected = np.maximum(deflection - tilt * position, 0.0) / (SPRING * WIDTH)
    assert deflection / tilt < WIDTH / 2  # more than half of the face lifts
    assert found.deflection[0] == pytest.approx(deflection, rel=1.0 / slices**2)
    np.testing.assert_allclose(line_load, expected, atol=expected.max() * 3 / slices**2)
    assert np.sum(found.load) == pytest.approx(force, rel=1e-12)


@pytest.mark.parametrize("slices", [15, 31, 61, 124])
def test_a_crowned_face_on_springs_carries_a_parabola(slices):
    """Gap C (2z/b)²: half length h = (b/2) √(δ/C) and F = (4/3) δ h/(c b).

    The midpoint rule leaves (w/h)²/8 of the parabola's integral and at most 3/8 (w/h)² of its two ends, which
    fall inside slices of the width w; δ goes like F^(2/3).
    """
    crown, force = 20e-6, 800.0
    deflection = (1.5 * force * SPRING * np.sqrt(crown)) ** (2 / 3)
    assert deflection < crown
    found = springs(crown * (2 * face_positions(WIDTH, slices) / WIDTH) ** 2, force)
    fineness = 2 / slices * np.sqrt(crown / deflection)
    assert abs(found.deflection[0] / deflection - 1) < fineness**2 / 3


def test_loads_are_those_of_least_energy(rng):
    """At the ξ found, min ½ fᵀΛf − fᵀ(ξ a − g) over f ≥ 0, by Lawson and Hanson's algorithm."""
    places, positions = 12, 40
    root = rng.normal(size=(positions, places, places))
    matrix = root @ root.swapaxes(1, 2) + 0.5 * np.eye(places)
    gap = rng.uniform(0.0, 20.0, (positions, places))
    arm, lever = rng.uniform(0.8, 1.0, (2, positions, places))
    torque = np.full(positions, 3.0)

    def local(_, load):
        return 0.0 * load, 0.0 * load

    found = press(matrix, local, arm, lever, gap, torque)
    np.testing.assert_allclose(np.sum(found.load * lever, axis=1), torque, rtol=1e-10)
    assert np.mean(found.load > 0) < 0.9
    for position in range(positions):
        factor = np.linalg.cholesky(matrix[position])
        pressed = found.deflection[position] * arm[position] - gap[position]
        expected, _ = nnls(factor.T, np.linalg.solve(factor, pressed))
        np.testing.assert_allclose(found.load[position], expected, atol=1e-8)


def test_stiffness_is_the_derivative_of_the_torque(rng):
    root = rng.normal(size=(1, 6, 6))
    matrix = root @ root.swapaxes(1, 2) + 0.5 * np.eye(6)
    gap, ones = rng.uniform(0.0, 2.0, (1, 6)), np.ones((1, 6))

    def local(_, load):
        return load**1.5, 1.5 * np.sqrt(load)

    low, middle, high = (press(matrix, local, ones, ones, gap, np.array([t])) for t in (2.999, 3.0, 3.001))
    assert middle.stiffness[0] == pytest.approx(0.002 / (high.deflection - low.deflection)[0], rel=1e-5)


@pytest.mark.parametrize("slices", [1, 5, 12])
@pytest.mark.parametrize("count", [1, 12])
def test_modes_are_orthogonal(slices, count):
    basis = modes(min(count, slices), slices)
    np.testing.assert_allclose(basis @ basis.T, slices * np.eye(slices), atol=1e-12)


def test_a_uniform_load_between_planes_of_symmetry_is_plane_strain(pair):
    geometry = pair_geometry(pair.assembly, np.array([[0.1, -0.2]]))
    plane = pair_harmonics(pair, geometry)[0]
    for coupled in (True, False):
        matrix = by_slices(pair_harmonics(pair, geometry, 7, coupled), 7)
        np.testing.assert_allclose(matrix.sum(axis=4) / 7, plane[:, :, None, :] * np.ones((7, 1)), rtol=1e-9)
        np.testing.assert_allclose(matrix, matrix.transpose(0, 3, 4, 1, 2), rtol=1e-9, atol=1e-20)


def test_slices_hold_each_other_the_less_the_further_apart(pair):
    geometry = pair_geometry(pair.assembly, np.zeros((1, 1)))
    matrix = by_slices(pair_harmonics(pair, geometry, 21), 21)[0, 0, :, 0]
    row = matrix[0]
    assert np.all(np.diff(row) < 0)
    assert row[1] > 0.2 * row[0]
    alone = by_slices(pair_harmonics(pair, geometry, 21, coupled=False), 21)[0, 0, :, 0]
    assert np.count_nonzero(alone) == 21


def elliptical_contact(radius, lead_radius, force):
    """Half length and width, m, and maximum pressure, Pa, of Hertz's contact (Johnson 1985, section 4.2)."""
    modulus = 207e9 / (2 * (1 - 0.3**2))

    def ratio(k):
        integral = ellipk(1 - k**2), ellipe(1 - k**2)
        return (integral[1] / k**2 - integral[0]) / (integral[0] - integral[1]) - lead_radius / radius

    k = brentq(ratio, 1e-4, 1 - 1e-9)
    first, second = ellipk(1 - k**2), ellipe(1 - k**2)
    half_length = (1.5 * force / (np.pi * modulus) * (first - second) / (1 - k**2) * 2 * lead_radius) ** (
        1 / 3
    )
    return half_length, k * half_length, 1.5 * force / (np.pi * k * half_length**2)


@pytest.mark.parametrize(
    ("lead_radius", "force", "slices"), [(2.0, 1000.0, 41), (2.0, 1000.0, 61), (1.0, 500.0, 61)]
)
def test_a_crowned_half_space_carries_hertzs_ellipse(pair, lead_radius, force, slices):
    """Weber-Banaschek's deflection of each slice and the half-space's harmonics are Hertz's slender ellipse.

    The contact is four to ten contact lengths away from its mirror images at the end faces.
    """
    radius = 6e-3
    half_length, width, pressure = elliptical_contact(radius, lead_radius, force)
    assert half_length < WIDTH / 6
    wave_number = np.pi * np.arange(1, slices) / WIDTH
    varying = 2 * half_space_surface(wave_number, pair.gears[0].depth, 0.3) / 207e9
    # the uniform part is a matter of where the half-space is held
    harmonics = np.concatenate([[1e-11], varying]).reshape(-1, 1, 1, 1) / WIDTH
    position = face_positions(WIDTH, slices)
    unit = np.ones((1, 1))
    gap = (position**2 / (2 * lead_radius)).reshape(1, 1, -1)
    matrix = by_slices(harmonics, slices)
    found = press_pairs(pair, unit / radius, matrix, unit, unit, gap, np.array([force]))
    line_load = found.slice_load[0, 0] * slices / WIDTH
    expected = 0.75 * force / half_length * np.maximum(1 - (position / half_length) ** 2, 0.0)
    whole = np.abs(position) < half_length - WIDTH / slices  # the end of the contact falls inside a slice
    np.testing.assert_allclose(line_load[whole], expected[whole], atol=3e-3 * expected.max())
    half = float(half_width(pair, np.array(1 / radius), line_load.max()))
    assert half == pytest.approx(width, rel=3e-3)
    assert 2 * line_load.max() / (np.pi * half) == pytest.approx(pressure, rel=3e-3)


@pytest.mark.parametrize("alike", [True, False])
def test_both_gears_add_their_own_and_their_neighbours_deflections(monkeypatch, rng, alike):
    """In plain loops, at radii that were solved; the earlier tooth is on opposite sides of both gears."""
    positions, pairs, count, width = 2, 4, 1 if alike else 3, 21e-3
    radii = np.array([[20.0, 21.0, 22.5, 24.0, 24.5], [40.0, 40.5, 42.0, 43.0, 44.0]]) * 1e-3
    own = rng.normal(size=(2, count, 5))
    between = rng.normal(size=(2, count, 2 * NEIGHBOURS + 1, 5, 5))
    moduli, ratios = (2.0, 5.0), (0.3, 0.25)
    gears = [SimpleNamespace(number=body, radius=radii[body]) for body in (0, 1)]

    def responses(gear, poisson_ratio, wave_number):
        assert poisson_ratio == ratios[gear.number]
        np.testing.assert_allclose(wave_number, np.arange(count) * np.pi / width)
        return own[gear.number], between[gear.number]

    monkeypatch.setattr(slices_of_faces, "responses", responses)
    materials = [
        SimpleNamespace(youngs_modulus=modulus, poisson_ratio=ratio)
        for modulus, ratio in zip(moduli, ratios, strict=True)
    ]
    at = rng.integers(0, 5, (2, positions, pairs))
    reach = [radii[body][at[body]] for body in (0, 1)]
    reach[1] = np.where(at[1] == 4, 50e-3, reach[1])  # beyond the last it counts as there
    flexible: Any = SimpleNamespace(gears=gears, materials=materials, width=width)
    geometry: Any = SimpleNamespace(
        gap=np.zeros((positions, pairs)), pinion_radius=reach[0], gear_radius=reach[1]
    )
    found = pair_harmonics(flexible, geometry, 3, coupled=not alike)
    expected = np.zeros((count, positions, pairs, pairs))
    for n, t, j, k, body in np.ndindex(count, positions, pairs, pairs, 2):
        scale = moduli[body] * width
        if j == k:
            expected[n, t, j, j] += own[body, n, at[body, t, j]] / scale
        elif abs(j - k) <= NEIGHBOURS:
            earlier, later = sorted((j, k))
            there = NEIGHBOURS + (1, -1)[body] * (later - earlier)
            expected[n, t, j, k] += between[body, n, there, at[body, t, earlier], at[body, t, later]] / scale
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
    matrix = by_slices(found, 3)
    for t, j, m, k, n in np.ndindex(positions, pairs, 3, pairs, 3):
        if alike:
            wanted = 3.0 * found[0, t, j, k] * (m == n)  # a third of the face is three times as soft
        else:
            wanted = found[0, t, j, k]
            for i in (1, 2):
                wave = np.cos(np.pi * i * (m + 0.5) / 3) * np.cos(np.pi * i * (n + 0.5) / 3)
                wanted += 2.0 * wave * found[i, t, j, k]
        assert matrix[t, j, m, k, n] == pytest.approx(wanted, rel=1e-9, abs=1e-12 * np.abs(found).max())


def test_without_waves_a_gear_answers_as_in_the_plane(pair):
    gear = pair.gears[0]
    own, between = slices_of_faces.responses(gear, 0.3, np.zeros(1))
    # what the tooth has more than a half-plane between both depths it has again above
    more = gear.inside[0] - gear.inside[1] - 2 * (1 - 0.3**2) / np.pi * np.log(2.0)
    np.testing.assert_allclose(own, (gear.inside[0] + more)[None], rtol=1e-12)
    np.testing.assert_allclose(between[0], gear.between, rtol=1e-12)
