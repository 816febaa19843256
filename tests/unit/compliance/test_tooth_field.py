"""Stress all over a loaded tooth, against the root stress that is read off the surface's own strains."""

import numpy as np
import pytest

from tribodyn.compliance.sharing.face_root_stress import root_stress
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.tooth_field import tooth_field
from tribodyn.geometry.drive import SIDES
from tribodyn.validation.papers.jia import elastic

SLICES = 5
#: A pair just before the pitch point, between two others that carry as well.
ROLL = np.array([0.34, -0.03, -0.40])
EVEN = np.full(SLICES, 1.0)
TILTED = np.linspace(1.6, 0.4, SLICES)


@pytest.fixture(scope="module")
def flexible():
    found = elastic("involute")
    # between planes of symmetry, as the field is
    pinion, gear = (one._replace(ends=None) for one in found.gears)
    return found._replace(gears=(pinion, gear))


@pytest.mark.parametrize("along", [EVEN, TILTED], ids=["even", "tilted"])
@pytest.mark.parametrize("side", SIDES)
def test_its_roots_are_those_of_the_root_stress(flexible, side, along):
    """By nodes and by the surface's strains: within the mesh's 5 %."""
    load = 1e5 * np.array([0.3, 1.0, 0.2])[:, None] * along
    flanks = LoadedFlanks(flexible, slices=SLICES)
    seen = flanks.contacts(ROLL[None])
    tension, compression = (part[SIDES.index(side), 0, 1] for part in root_stress(flexible, seen, load[None]))
    field = tooth_field(flanks, side, ROLL, load, 1)
    below = field.profile[: int(np.flatnonzero(field.profile == field.loaded)[0]) // 2]
    stress = field.along[:, below]
    np.testing.assert_allclose(np.max(stress, axis=(0, 1)), tension, rtol=0.05)
    np.testing.assert_allclose(np.min(stress, axis=(0, 1)), compression, rtol=0.05)


def test_free_surfaces_carry_along_the_profile_and_the_face_alone(flexible):
    """σ along the profile and ν σ along the face, in plane strain: von Mises σ √(1 − ν + ν²)."""
    flanks = LoadedFlanks(flexible, slices=1)
    field = tooth_field(flanks, "pinion", ROLL[1:2], np.array([[1e5]]), 0)
    other = np.flatnonzero(np.abs(field.along[1, :, 0]) == np.max(np.abs(field.along[1])))
    ratio = 0.29
    shape = np.sqrt(1.0 - ratio + ratio**2)
    assert field.von_mises[1, other, 0] == pytest.approx(shape * np.abs(field.along[1, other, 0]), rel=0.05)


def test_it_is_even_along_an_evenly_loaded_face_and_proportional(flexible):
    flanks = LoadedFlanks(flexible, slices=SLICES)
    one, two = (tooth_field(flanks, "gear", ROLL[1:2], load * EVEN[None], 0) for load in (1e5, 2e5))
    assert np.ptp(one.von_mises, axis=2).max() < 1e-9 * one.von_mises.max()
    np.testing.assert_allclose(two.von_mises, 2.0 * one.von_mises, rtol=1e-9)
