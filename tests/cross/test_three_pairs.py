"""A contact ratio above 2: three pairs share the load as statics says."""

import numpy as np
import pytest

from tests.support.creeping_drive import SLOW, creep, statics


@pytest.mark.parametrize("name", ["high-contact-ratio", "parabolic-23-47"])
@pytest.mark.parametrize("friction", ["none", "coulomb"])
def test_loads_at_creep_equal_the_quasi_static_ones(prepared, name, friction):
    overrides = {**SLOW, "friction.law": friction}
    coefficient = 0.0
    if friction == "coulomb":
        coefficient = overrides["friction.coefficient"] = 0.1
    case = prepared(name, **overrides)
    assert case.cycle.front_pairs == 3
    assert case.cycle.contact_ratio > 2
    samples = 60
    found = creep(case, samples=samples)
    boundary = np.asarray(case.model.table.boundary)
    width = 2 * case.model.mechanics.reversal_width
    compared = {2: 0, 3: 0}
    for k in range(samples):
        phase = k / samples
        segment = int(np.searchsorted(boundary, phase, side="right") - 1)
        if min(abs(phase - b) for b in boundary) < 0.02:
            continue  # the engagement's own ringing
        slots, expected = statics(case, phase, segment, [coefficient] * 3)
        distance = [
            np.interp(phase, case.cycle.phase[segment], case.cycle.signed_distance[segment, :, i])
            for i in slots
        ]
        if min(abs(d) for d in distance) < width:
            continue
        np.testing.assert_allclose(found["normal_load"][k, slots], expected, rtol=5e-4)
        compared[len(slots)] += 1
    assert compared[2] > 5
    assert compared[3] > 5


def test_three_pairs_couple_through_the_bodies(prepared):
    """Neighbours give way together; pairs two pitches apart less so, and every pair more than with others."""
    cycle = prepared("high-contact-ratio").cycle
    three = np.flatnonzero(cycle.in_contact.sum(axis=1) == 3)
    for segment in three:
        coupling = cycle.coupling[segment]
        near = np.minimum(coupling[:, 0, 1], coupling[:, 1, 2])
        assert np.all(np.abs(coupling[:, 0, 2]) < near)
        assert np.all(near > 0)
        assert np.all(near < 0.5 * cycle.compliance[segment].min(axis=-1))
