"""Roots under loads on the face: sums over teeth, harmonics and places in plain loops; waves integrated."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tribodyn.compliance.fem.gear_compliance import (
    NEIGHBOURS,
    FreeEnds,
    at_radii,
    at_wave_numbers,
    spline_weights,
)
from tribodyn.compliance.sharing import face_root_stress
from tribodyn.compliance.sharing.face_root_stress import _of_free_ends, _of_one_gear
from tribodyn.compliance.sharing.loaded_contact import _ages
from tribodyn.compliance.sharing.section import oblique_faces
from tribodyn.compliance.sharing.slices import _add_free_ends, end_modes
from tribodyn.geometry.corner_contact import pair_geometry

POSITIONS, PAIRS, WAVES, POINTS, RADII, SLICES = 2, 4, 5, 2, 3, 4
SECTORS = 2 * NEIGHBOURS + 1


def sector(sign, read, loaded):
    """Pairs are counted from the one that entered first; None where the teeth are too far apart."""
    pitches = loaded - read
    return NEIGHBOURS + sign * pitches if abs(pitches) <= NEIGHBOURS else None


@pytest.mark.parametrize("sign", [1, -1])
def test_every_tooth_feels_its_own_load_and_its_neighbours(rng, sign):
    per_load = rng.normal(size=(WAVES, SECTORS, 2, POINTS, RADII))
    place = rng.normal(size=(POSITIONS, PAIRS, RADII))
    amplitude = rng.normal(size=(POSITIONS, PAIRS, WAVES))
    expected = np.zeros((2 * POINTS, POSITIONS, PAIRS, WAVES))
    for t, n, read, loaded in np.ndindex(POSITIONS, WAVES, PAIRS, PAIRS):
        if (there := sector(sign, read, loaded)) is not None:
            seen = per_load[n, there].reshape(2 * POINTS, RADII) @ place[t, loaded]
            expected[:, t, read, n] += seen * amplitude[t, loaded, n]
    amplitudes = place[..., None] * amplitude[:, :, None]
    np.testing.assert_allclose(_of_one_gear(per_load, amplitudes, sign), expected, rtol=1e-12)
    alike = _of_one_gear(per_load[:1], amplitudes, sign)
    np.testing.assert_allclose(alike[..., 0], expected[..., 0], rtol=1e-12)
    repeated = np.broadcast_to(per_load[:1], per_load.shape)
    np.testing.assert_allclose(alike, _of_one_gear(repeated, amplitudes, sign), rtol=1e-12)


@pytest.mark.parametrize(("slices", "coupled"), [(1, True), (3, False), (3, True)])
def test_roots_feel_all_loads_and_ends_at_once(monkeypatch, rng, pair, slices, coupled):
    """Of both gears and both fillets, at the middles of slices, in whatever batches."""
    monkeypatch.setattr(face_root_stress, "_BATCH", 1)
    roll = np.array([[0.11, -0.23], [0.2, -0.14]]) * [[1.0, 1.0]] + [0.0, 0.34 - 2 * np.pi / 18]
    line_load = rng.uniform(1e5, 3e5, (2, 2, slices)) * [[[1.0], [0.3]], [[0.5], [1.0]]]
    geometry = pair_geometry(pair.assembly, roll)
    faces = oblique_faces(pair.assembly, roll[..., None])
    tension, compression = face_root_stress.root_stress(pair, faces, line_load, coupled)
    count = slices if coupled else 1
    place = (np.arange(slices) + 0.5) / slices
    for body, (gear, reach) in enumerate(
        zip(pair.gears, (geometry.pinion_radius, geometry.gear_radius), strict=True)
    ):
        lead = at_wave_numbers(gear, np.arange(count) * np.pi / pair.width, 0.3)
        weight = at_radii(gear.radius, reach)
        points = 2 * lead.root_stress.shape[3]
        extra = end_modes(gear.ends, pair.width, slices)
        at_end = at_radii(gear.ends.radius, reach)
        for t, read in np.ndindex(2, 2):
            stress = np.zeros((points, slices))
            for loaded in range(2):
                there = sector((1, -1)[body], read, loaded)
                seen = lead.root_stress[:, there].reshape(count, points, -1) @ weight[t, loaded]
                for n in range(count):
                    if not coupled:
                        stress += seen[0][:, None] * line_load[t, loaded]
                        continue
                    # cosines from one end, which the loads of slices make in the mean
                    wave = np.cos(n * np.pi * place)
                    share = np.mean(wave * line_load[t, loaded]) / np.mean(wave**2)
                    stress += seen[n][:, None] * share * wave
                if coupled and slices > 1:
                    force = line_load[t, loaded] * pair.width / slices
                    for parity in (0, 1):
                        rows = gear.ends.root_stress[parity, :, :, there]
                        rows = rows.reshape(*rows.shape[:2], points, -1) @ at_end[t, loaded]
                        stress += np.einsum("sk,klp,l->ps", extra[parity], rows, extra[parity].T @ force)
            np.testing.assert_allclose(tension[body, t, read], stress.max(axis=0), rtol=1e-9)
            np.testing.assert_allclose(compression[body, t, read], stress.min(axis=0), rtol=1e-9)


@pytest.fixture
def ends(rng):
    return FreeEnds(
        np.linspace(0.0, 800.0, WAVES) ** 1.1,
        np.linspace(20e-3, 24e-3, RADII),
        rng.normal(size=(2, WAVES, WAVES, RADII)),
        rng.normal(size=(2, WAVES, WAVES, SECTORS, RADII, RADII)),
        rng.normal(size=(2, WAVES, WAVES, SECTORS, 2, POINTS, RADII)),
    )


@pytest.mark.parametrize("sign", [1, -1])
def test_free_ends_add_stress_of_either_parity(rng, ends, sign):
    along = rng.normal(size=(2, SLICES, WAVES))
    place = rng.normal(size=(POSITIONS, PAIRS, RADII))
    load = rng.normal(size=(POSITIONS, PAIRS, SLICES))
    expected = np.zeros((2 * POINTS, POSITIONS, PAIRS, SLICES))
    for t, parity, read, loaded in np.ndindex(POSITIONS, 2, PAIRS, PAIRS):
        if (there := sector(sign, read, loaded)) is not None:
            rows = ends.root_stress[parity, :, :, there].reshape(WAVES, WAVES, 2 * POINTS, RADII)
            counted = along[parity].T @ load[t, loaded]
            stress = np.einsum("klpm,m,l->pk", rows, place[t, loaded], counted)
            expected[:, t, read] += stress @ along[parity].T
    counted = [place[..., None] * (load @ along[parity])[:, :, None] for parity in (0, 1)]
    np.testing.assert_allclose(_of_free_ends(ends, along, counted, sign), expected, rtol=1e-11, atol=1e-11)


def test_waves_are_means_over_slices_of_cosines_from_one_end(ends):
    """By integration; a cosine to the half wave's parity, faded over the last octave, read off the spline."""
    width, slices = 30e-3, 6
    count = int(ends.wave_number[-1] * width / np.pi) + 1
    assert count > 8
    expected = np.zeros((2, slices, WAVES))
    fine = (np.arange(2000) + 0.5) / 2000 * width / slices
    for n in range(count):
        k = n * np.pi / width
        share = k / ends.wave_number[-1]
        fade = 1.0 if share <= 0.5 else np.cos(np.pi * (share - 0.5)) ** 2
        weight = spline_weights(ends.wave_number, np.array([k]))[0]
        for s in range(slices):
            mean = np.mean(np.cos(k * (s * width / slices + fine)))
            expected[n % 2, s] += (2.0 if n else 1.0) / width * fade * mean * weight
    np.testing.assert_allclose(end_modes(ends, width, slices), expected, rtol=1e-5, atol=1e-6 / width)


def test_free_ends_add_deflection_of_either_parity_and_neighbour(rng, ends):
    """Both gears, each other's teeth on opposite sides; a matrix that stays symmetric in places and pairs."""
    width, moduli = 21e-3, (2.0, 5.0)
    other = ends._replace(own=2.0 * ends.own + 1.0, between=ends.between[..., ::-1, :, :] - 0.3)
    gears = [SimpleNamespace(ends=free) for free in (ends, other)]
    materials = [SimpleNamespace(youngs_modulus=free) for free in moduli]
    reach = (
        ends.radius[[0, 2, 1, 0]][None].repeat(POSITIONS, axis=0),
        ends.radius[[1, 1, 2, 0]][None].repeat(2, 0),
    )
    flexible: Any = SimpleNamespace(gears=gears, materials=materials, width=width)
    geometry: Any = SimpleNamespace(pinion_radius=reach[0], gear_radius=reach[1])
    found = np.zeros((POSITIONS, PAIRS, SLICES, PAIRS, SLICES))
    _add_free_ends(found, flexible, geometry)
    expected = np.zeros_like(found)
    along = end_modes(ends, width, SLICES)
    numbers = [[0, 2, 1, 0], [1, 1, 2, 0]]
    for body, sign in ((0, 1), (1, -1)):
        free = (ends, other)[body]
        for parity in (0, 1):
            for later in range(PAIRS):
                at = numbers[body][later]
                wave = along[parity] @ free.own[parity, :, :, at] @ along[parity].T
                expected[:, later, :, later] += wave / moduli[body]
                for earlier in range(max(0, later - NEIGHBOURS), later):
                    there = NEIGHBOURS + sign * (later - earlier)
                    rows = free.between[parity, :, :, there, numbers[body][earlier], at]
                    wave = along[parity] @ rows @ along[parity].T / moduli[body]
                    expected[:, earlier, :, later] += wave
                    expected[:, later, :, earlier] += wave.T
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("limits", [(-0.31, 0.42), (-0.2, 0.2), (0.05, 0.12)])
def test_pairs_that_can_touch_are_counted_in_whole_pitches(limits):
    """Those whose angle lies between the limits at some time within a pitch, the oldest in front."""
    start, pitch = -0.17, 0.11
    phase = np.linspace(0.0, 1.0, 2000, endpoint=False)
    expected = [
        age
        for age in range(20, -20, -1)
        if np.any((start + (age + phase) * pitch > limits[0]) & (start + (age + phase) * pitch < limits[1]))
    ]
    assert _ages(cast(Any, limits), start, pitch).tolist() == expected
