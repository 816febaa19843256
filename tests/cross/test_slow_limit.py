"""At creeping speed inertia and damping vanish: the loads are those of statics."""

import numpy as np
import pytest

from tests.support.creeping_drive import SLOW, creep, statics


@pytest.mark.parametrize("friction", ["none", "coulomb"])
def test_loads_at_creep_equal_the_quasi_static_ones(prepared, friction):
    overrides = {**SLOW, "friction.law": friction}
    coefficient = 0.0
    if friction == "coulomb":
        coefficient = 0.1
        overrides["friction.coefficient"] = coefficient
    case = prepared("crc-23-47", **overrides)
    found = creep(case)
    boundary = case.model.table.boundary
    worst = compared = 0
    for k in range(100):
        phase = k / 100
        segment = 0 if phase < boundary[1] else 1
        if min(abs(phase - b) for b in boundary) < 0.02:
            continue  # the engagement's own ringing
        width = 2 * case.model.mechanics.reversal_width
        slots, expected = statics(case, phase, segment, [coefficient] * 2)
        distance = [
            np.interp(phase, case.cycle.phase[segment], case.cycle.signed_distance[segment, :, i])
            for i in slots
        ]
        if min(abs(d) for d in distance) < width:
            continue
        load = found["normal_load"][k, slots]
        worst = max(worst, float(np.max(np.abs(load / expected - 1))))
        compared += 1
    assert compared > 90
    assert worst < 2e-4


def test_single_contact_carries_the_torque(prepared):
    """F_n = T_g/(r_g cos α), frictionless."""
    case = prepared("crc-23-47", **SLOW, **{"friction.law": "none"})
    found = creep(case)
    single = (np.sum(found["normal_load"] > 0, axis=1) == 1) & (np.arange(101) > 55)
    arm = case.cycle.gear_pitch_radius * np.cos(found["pressure_angle"][single, 1])
    np.testing.assert_allclose(found["normal_load"][single, 1] * arm, 500.0, rtol=1e-5)
