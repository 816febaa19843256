"""At creeping speed inertia and damping vanish: two or three pairs share the load as statics says."""

import numpy as np
import pytest

from tests.support.creeping_drive import SLOW, creep, statics
from tests.support.soak_parameters import all_in_soak


@pytest.mark.parametrize(
    ("name", "samples", "within", "compared", "coefficient"),
    all_in_soak(
        [
            (*case, coefficient)
            for coefficient in (0.0, 0.1)
            for case in (
                ("crc-23-47", 100, 2e-4, {1: 42, 2: 48}),
                ("high-contact-ratio", 60, 5e-4, {2: 5, 3: 5}),
                ("parabolic-23-47", 60, 5e-4, {2: 5, 3: 5}),
            )
        ],
        lambda case: case[0] == "crc-23-47" or case[-1] > 0.0,
        names=5,
    ),
)
def test_loads_at_creep_equal_the_quasi_static_ones(prepared, name, samples, within, compared, coefficient):
    law = (
        {"friction.law": "coulomb", "film.law": "masjedi-khonsari", "friction.coefficient": coefficient}
        if coefficient
        else {}
    )
    case = prepared(name, **SLOW, **({"friction.law": "none", "film.law": "masjedi-khonsari"} | law))
    assert case.cycle.front_pairs == max(compared)
    found = creep(case, samples=samples)
    boundary = np.asarray(case.model.meshes[0].table.boundary)
    width = 2 * case.model.operation.reversal_width
    count = dict.fromkeys(compared, 0)
    for k in range(samples):
        phase = k / samples
        segment = int(np.searchsorted(boundary, phase, side="right") - 1)
        if min(abs(phase - b) for b in boundary) < 0.02:
            continue  # the engagement's own ringing
        slots, expected = statics(case, phase, segment, [coefficient] * 3)
        at, distance = case.cycle.phase[segment], case.cycle.signed_distance[segment]
        if min(abs(np.interp(phase, at, distance[:, slot])) for slot in slots) < width:
            continue
        np.testing.assert_allclose(found["normal_load"][k, slots], expected, rtol=within)
        count[len(slots)] += 1
    assert all(count[pairs] > least for pairs, least in compared.items()), count


def test_single_contact_carries_the_torque(prepared):
    """F_n = T_g/(r_g cos α), frictionless."""
    case = prepared("crc-23-47", **SLOW, **{"friction.law": "none", "film.law": "masjedi-khonsari"})
    found = creep(case)
    single = (np.sum(found["normal_load"] > 0, axis=1) == 1) & (np.arange(101) > 55)
    arm = case.cycle.gear_pitch_radius * np.cos(found["pressure_angle"][single, 1])
    np.testing.assert_allclose(found["normal_load"][single, 1] * arm, 500.0, rtol=1e-5)


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
