"""What is recorded, recomputed sample by sample from its definition."""

import numpy as np
import pytest

from tests.support.states import random_state
from tribodyn.dynamics import contact_forces as contact
from tribodyn.dynamics.equations import derivatives
from tribodyn.studies.gear_pair.outputs import outputs, segment_of
from tribodyn.dynamics.parameters import (
    LAG,
    MOTOR_SLIP,
    SLIP,
    WORK_DAMPING,
    WORK_FRICTION,
    WORK_IN,
    WORK_OUT,
    WORK_PARAMETRIC,
    XI,
    XI_RATE,
)

SHAFT = {
    "operating.source": "torque",
    "operating.shaft_stiffness": "1e4 N*m/rad",
    "operating.drive_inertia": "0.01 kg*m**2",
    "mesh.backlash": "12 um",
}


def test_a_boundary_belongs_to_the_segment_that_begins_there():
    boundary = np.array([0.0, 0.25, 0.5, 1.0])
    found = segment_of(np.array([0.0, 0.1, 0.25, 0.499, 0.5, 0.999, 1.0]), boundary)
    np.testing.assert_array_equal(found, [0, 0, 1, 1, 2, 2, 2])


@pytest.mark.parametrize("overrides", [{}, SHAFT], ids=["speed", "shaft"])
def test_every_sample_is_what_its_name_says(prepared, rng, overrides):
    case = prepared("crc-23-47", **overrides)
    model, table, mechanics = case.model, case.model.table, case.model.mechanics
    states = np.stack([random_state(rng, mechanics.nominal_speed) for _ in range(7)])
    cycles = rng.uniform(0.0, 5.0, 7)
    found = outputs(cycles, states, model)
    pitch, r_p, r_g = (
        float(table.pitch_angle),
        float(table.pinion_pitch_radius),
        float(table.gear_pitch_radius),
    )
    angle = cycles * pitch
    speed = mechanics.nominal_speed + states[:, SLIP]
    gear_speed = (r_p * speed - states[:, XI_RATE]) / r_g
    np.testing.assert_allclose(found["pinion_angle"], angle, rtol=1e-14)
    np.testing.assert_allclose(found["time"], angle / mechanics.nominal_speed + states[:, LAG], rtol=1e-12)
    turned = np.stack([angle, (r_p * angle - states[:, XI]) / r_g], axis=-1)
    np.testing.assert_allclose(found["displacement"], np.hstack([states[:, :4], turned]), rtol=1e-13)
    rates = np.stack([speed, gear_speed], axis=-1)
    np.testing.assert_allclose(found["velocity"], np.hstack([states[:, 7:11], rates]), rtol=1e-13)
    np.testing.assert_array_equal(found["transmission_error_rotational"], states[:, XI])
    works = {"in": WORK_IN, "out": WORK_OUT, "friction": WORK_FRICTION, "damping": WORK_DAMPING}
    for name, state in {**works, "parametric": WORK_PARAMETRIC}.items():
        np.testing.assert_array_equal(found[f"work_{name}"], states[:, state])
    driven = speed if not overrides else mechanics.nominal_speed + states[:, MOTOR_SLIP]
    np.testing.assert_allclose(found["power_in"], found["drive_torque"] * driven, rtol=1e-12)
    np.testing.assert_allclose(found["power_out"], mechanics.load_torque * gear_speed, rtol=1e-12)
    film = found["central_film_thickness"] / model.surfaces.roughness
    np.testing.assert_array_equal(found["film_parameter"], film)
    for k in range(7):
        phase, whole = cycles[k] % 1.0, np.floor(cycles[k])
        segment = int(segment_of(np.array([phase]), table.boundary)[0])
        work = {}
        derivatives(phase, whole, segment, states[k], model, work, {})
        for i in range(case.cycle.pairs):
            inside = table.in_contact[segment, i] > 0
            load = float(work[contact.NORMAL_LOAD, i]) if inside else 0.0
            touching = load > 0.0
            assert found["normal_load"][k, i] == pytest.approx(load, rel=1e-9, abs=1e-9)
            assert np.isfinite(found["transmission_error_normal"][k, i]) == inside
            assert np.isfinite(found["central_film_thickness"][k, i]) == touching
            assert (found["mesh_stiffness"][k, i] > 0.0) == touching
            if inside:
                force, sliding = (float(work[row, i]) for row in (contact.FRICTION_FORCE, contact.SLIDING))
                assert found["friction_force"][k, i] == pytest.approx(force, rel=1e-8, abs=1e-9)
                assert found["sliding_speed"][k, i] == pytest.approx(sliding, rel=1e-9)
                mean = (float(work[contact.PINION_SPEED, i]) + float(work[contact.GEAR_SPEED, i])) / 2.0
                assert found["entrainment_speed"][k, i] == pytest.approx(mean, rel=1e-9)
                radius = float(work[contact.RADIUS, i])
                assert found["equivalent_radius"][k, i] == pytest.approx(radius, rel=1e-9)
                slope = np.tan(found["pressure_angle"][k, i]) * float(work[contact.COS, i])
                assert slope == pytest.approx(float(work[contact.SIN, i]), rel=1e-9)


def test_the_smallest_load_is_a_contact(prepared):
    """A flank that presses with less than a newton has a film and a stiffness; one that is apart has none."""
    case = prepared("crc-23-47")
    states = np.zeros((2, random_state(np.random.default_rng(1)).size))
    states[:, XI] = 1e-9, -1e-9
    found = outputs(np.full(2, 0.6), states, case.model)
    inside = np.isfinite(found["transmission_error_normal"][0])
    assert np.all((found["normal_load"][0, inside] > 0.0) & (found["normal_load"][0, inside] < 1.0))
    assert np.all(np.isfinite(found["central_film_thickness"][0, inside]))
    assert np.all(found["mesh_stiffness"][0, inside] > 0.0)
    assert not np.any(found["normal_load"][1])
    assert not np.any(np.isfinite(found["central_film_thickness"][1]))
