"""The laws on a contact whose radius and entrainment vanish at the pitch point."""

import numpy as np
import pytest

from tests.support.closures import MIXED, VECIANA, under
from tribodyn.tribology.contact import averaged_radius, local_contact
from tribodyn.tribology.surface_state import contact_friction, surface_state

#: M, m, and entrainment over radius, 1/s, of a cycloid; line load, N/m; sliding, m/s.
LENGTH, RATE, LINE_LOAD, SLIDING = 0.02, 300.0, 4e5, 0.4


@pytest.mark.parametrize("distance", [1e-6, 1e-4, 3e-3])
def test_entrainment_is_averaged_with_the_radius_to_which_it_is_proportional(distance):
    """Sliding is the geometry's; film and friction are those of a contact with the averaged speeds."""
    closure = under(MIXED, VECIANA)
    radius = np.array([distance])
    speeds = RATE * radius + SLIDING / 2.0, RATE * radius - SLIDING / 2.0
    found = contact_friction(closure, np.array([LINE_LOAD]), radius, *speeds, LENGTH, RATE)
    seen = averaged_radius(radius, LINE_LOAD, closure.surfaces.effective_modulus, LENGTH)
    assert abs(seen - radius) > 0.1 * radius
    np.testing.assert_allclose(found.radius, seen, rtol=1e-14)
    entrainment = RATE * seen
    np.testing.assert_allclose(found.entrainment, entrainment, rtol=1e-12)
    rolling = entrainment + SLIDING / 2.0, entrainment - SLIDING / 2.0
    contact = local_contact(np.array([LINE_LOAD]), 1.0 / seen, entrainment, SLIDING, *rolling)
    np.testing.assert_allclose(found.surface, surface_state(contact, closure), rtol=1e-10)


def test_nothing_is_averaged_where_nothing_vanishes():
    closure = under(MIXED, VECIANA)
    radius, speeds = np.array([5e-3]), (np.array([3.0]), np.array([2.0]))
    found = contact_friction(closure, np.array([LINE_LOAD]), radius, *speeds, 0.0, RATE)
    assert found.radius == radius
    assert found.entrainment == pytest.approx(2.5, rel=1e-15)
