"""Reading a gear's compliances between radii that were solved; teeth that do not feel each other."""

import numpy as np

from tribodyn.compliance.fem.gear_compliance import (
    FreeEnds,
    GearCompliance,
    LeadHarmonics,
    at_radii,
    without_neighbours,
)

SOLVED = np.array([20.0, 20.7, 22.0, 22.5, 24.0, 25.0])


def test_a_cubic_is_read_exactly_and_ends_hold_beyond():
    powers = np.array([1.0, -0.3, 0.11, 0.02])
    at = np.array([[20.2, 21.9, 24.8], [19.0, 22.5, 26.0]])
    read = at_radii(SOLVED, at) @ np.polyval(powers, SOLVED - 22.0)
    np.testing.assert_allclose(read, np.polyval(powers, np.clip(at, 20.0, 25.0) - 22.0), rtol=1e-12)


def test_without_neighbours_only_what_is_between_teeth_is_gone(rng):
    lead = LeadHarmonics(
        *(rng.normal(size=size) for size in ((2,), (2, 2, 3), (2, 5, 3, 3), (2, 4), (2, 5, 2, 4, 3)))
    )
    ends = FreeEnds(
        *(
            rng.normal(size=size)
            for size in ((2,), (3,), (2, 2, 2, 3), (2, 2, 2, 5, 3, 3), (2, 2, 2, 5, 2, 4, 3))
        )
    )
    gear = GearCompliance(SOLVED[:3], rng.normal(size=(2, 3)), rng.normal(size=(5, 3, 3)), 1e-3, lead, ends)
    alone = without_neighbours(gear)
    for changed, original in ((alone, gear), (alone.lead, lead), (alone.ends, ends)):
        assert changed is not None
        assert original is not None
        for name in original._fields:
            if name in ("lead", "ends"):
                continue
            kept = 1.0
            if name == "between":  # the tooth itself alone, in the middle of five
                kept = np.array([0.0, 0.0, 1.0, 0.0, 0.0])[:, None, None]
            np.testing.assert_array_equal(getattr(changed, name), kept * np.asarray(getattr(original, name)))
    plane = without_neighbours(gear._replace(lead=None, ends=None))
    assert plane.lead is None
    assert plane.ends is None
