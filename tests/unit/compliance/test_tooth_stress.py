"""Stress of teeth under known loads: the load contact model's own, proportion, teeth through the cycles."""

import numpy as np
import pytest

from tests.support.faces_in_slices import WIDTH
from tribodyn.compliance.fem.gear_compliance import NEIGHBOURS
from tribodyn.compliance.sharing.face_root_stress import tooth_stress
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import roll_through
from tribodyn.geometry.modification import Misalignment, Modifications

POSITIONS, SLICES = 12, 7


@pytest.fixture(scope="module")
def flanks(pair):
    return LoadedFlanks(pair, Modifications(misalignment=Misalignment(2e-4)), SLICES)


@pytest.fixture(scope="module")
def loaded(flanks):
    return roll_through(flanks, 400.0, POSITIONS)


@pytest.fixture(scope="module")
def slice_load(loaded):
    return loaded.line_load[None] * WIDTH / SLICES


def test_loads_of_slow_rotation_have_its_stresses(flanks, loaded, slice_load):
    found = tooth_stress(flanks, loaded.roll, slice_load)
    np.testing.assert_allclose(found.pressure[0], loaded.pressure, rtol=1e-9)
    assert found.pressure_peak.value == pytest.approx(np.max(loaded.pressure))
    for peak, tension in zip(found.root_peak, loaded.root_tension, strict=True):
        assert peak.value == pytest.approx(np.max(tension))
        assert tension[peak.at[1:]] == pytest.approx(peak.value)
    assert found.pressure_peak.along_face > 1.0
    assert all(peak.along_face > 1.0 for peak in found.root_peak)


def test_a_tooth_is_followed_from_rest_to_rest(flanks, loaded, slice_load):
    """Its neighbours press its root together before and after it is bent itself."""
    found = tooth_stress(flanks, loaded.roll, slice_load)
    for course, peak in zip(found.root, found.root_peak, strict=True):
        assert course.shape == (1, POSITIONS * (loaded.roll.shape[1] + 2 * NEIGHBOURS))
        assert np.max(course) == pytest.approx(peak.value)
        assert np.min(course) < 0.0
        assert np.max(np.abs(course[0, [0, -1]])) < 0.05 * peak.value
        # nothing jumps where it passes from one place among the pairs to the next
        assert np.max(np.abs(np.diff(course[0]))) < 0.6 * peak.value


def test_twice_the_load_is_twice_the_stress_and_root_two_the_pressure(flanks, loaded, slice_load):
    once, twice = (tooth_stress(flanks, loaded.roll, factor * slice_load) for factor in (1.0, 2.0))
    np.testing.assert_allclose(twice.pressure, np.sqrt(2.0) * once.pressure, rtol=1e-9)
    for first, second in zip(once.root, twice.root, strict=True):
        np.testing.assert_allclose(second, 2.0 * first, rtol=1e-9, atol=1e-3)
    assert twice.pressure_peak.along_face == pytest.approx(once.pressure_peak.along_face)


def test_every_tooth_has_the_loads_of_its_own_cycles(flanks, loaded, slice_load):
    """Of three cycles one is loaded: its loads are met by the tooth that enters, and by those before it."""
    cycles = np.concatenate([0.0 * slice_load, slice_load, 0.0 * slice_load])
    apart = tooth_stress(flanks, loaded.roll, cycles).root
    together = tooth_stress(flanks, loaded.roll, slice_load).root
    for teeth, one in zip(apart, together, strict=True):
        assert teeth.shape[0] == 3
        np.testing.assert_allclose(np.sum(teeth, axis=0), one[0], rtol=1e-9, atol=1.0)
