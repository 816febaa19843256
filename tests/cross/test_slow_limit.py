"""At creeping speed inertia and damping vanish: the loads are those of statics."""

import numpy as np
import pytest

from tribodyn.dynamics.outputs import outputs
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import SampledStates, TransientSettings, transient

SLOW = {"operating.pinion_speed": "0.01 rad/s"}


def creep(case, cycles=1, samples=100):
    model = case.model
    parts = transient(
        model, static_equilibrium(model), TransientSettings("radau", 1e-8, cycles, 100000, samples)
    )
    chunks = [part for part in parts if isinstance(part, SampledStates)]
    return outputs(
        np.concatenate([c.cycles for c in chunks]), np.concatenate([c.states for c in chunks]), model
    )


def statics(case, phase, segment, friction):
    """Loads from the linear equations of statics, with the given friction coefficients; unknown x, y, ξ."""
    cycle, m = case.cycle, case.model.mechanics
    slots = np.flatnonzero(cycle.in_contact[segment])
    at = [np.interp(phase, cycle.phase[segment], cycle.pressure_angle[segment, :, i]) for i in slots]
    r = np.array(
        [np.interp(phase, cycle.phase[segment], cycle.signed_distance[segment, :, i]) for i in slots]
    )
    matrix = np.array(
        [
            [np.interp(phase, cycle.phase[segment], cycle.coupling[segment, :, i, j]) for j in slots]
            for i in slots
        ]
    )
    matrix += np.diag(
        [np.interp(phase, cycle.phase[segment], cycle.compliance[segment, :, i]) for i in slots]
    )
    rg = cycle.gear_pitch_radius
    n = len(slots)
    # unknown: F (n), x_p, y_p, x_g, y_g, ξ
    system = np.zeros((n + 5, n + 5))
    right = np.zeros(n + 5)
    for k in range(n):
        c, s = np.cos(at[k]), np.sin(at[k])
        system[k, :n] = matrix[k]
        system[k, n:] = [-c, -s, c, s, -c]
        f = friction[k] * np.sign(r[k])
        system[n, k] = -(c + f * s)
        system[n + 1, k] = -(s - f * c)
        system[n + 2, k] = c + f * s
        system[n + 3, k] = s - f * c
        system[n + 4, k] = rg * c + f * (rg * s - r[k])
    for row, k in enumerate(
        (m.pinion_stiffness_x, m.pinion_stiffness_y, m.gear_stiffness_x, m.gear_stiffness_y)
    ):
        system[n + row, n + row] = -k
    right[n + 4] = m.load_torque
    return slots, np.linalg.solve(system, right)[:n]


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
