"""What is recorded, recomputed sample by sample from its definition."""

import numpy as np
import pytest

from tests.support.pair_outputs import outputs
from tests.support.states import LAG, TURN_G, TURN_M, X_G, X_P, Y_G, Y_P, random_state
from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.equations import derivatives
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.train.layout import work_of, work_of_mesh
from tribodyn.train.schedule import interval_of, of_one_mesh
from tribodyn.train.structure import (
    DAMPING,
    FRICTION,
    IN,
    OUT,
    PARAMETRIC,
)

SHAFT = {
    "operating.source": "torque",
    "operating.shaft_stiffness": "1e4 N*m/rad",
    "operating.drive_inertia": "0.01 kg*m**2",
    "mesh.backlash": "12 um",
}


def test_a_boundary_belongs_to_the_segment_that_begins_there():
    boundary = np.array([0.0, 0.25, 0.5, 1.0])
    cycles = np.array([0.0, 0.1, 0.25, 0.499, 0.5, 0.999, 1.0])
    whole, phase, found = interval_of(cycles, of_one_mesh(boundary))
    np.testing.assert_array_equal(found, [0, 0, 1, 1, 2, 2, 0])
    np.testing.assert_array_equal(whole + phase, cycles)
    np.testing.assert_array_equal(whole, cycles == 1.0)


@pytest.mark.parametrize("overrides", [{}, SHAFT], ids=["speed", "shaft"])
def test_every_sample_is_what_its_name_says(prepared, rng, overrides):
    case = prepared("crc-23-47", **overrides)
    model, table, operation = case.model, case.model.meshes[0].table, case.model.operation
    layout = model.layout
    states = np.stack([random_state(rng, model, operation.nominal_speed) for _ in range(7)])
    places, rates = states[:, : layout.half], states[:, layout.half : layout.mechanical]
    cycles = rng.uniform(0.0, 5.0, 7)
    found = outputs(cycles, states, model)
    r_p, r_g = float(case.cycle.pinion_pitch_radius), float(case.cycle.gear_pitch_radius)
    angle = cycles * float(table.pitch_angle)
    speed = operation.nominal_speed + rates[:, LAG]
    gear_speed = r_p * speed / r_g + rates[:, TURN_G]
    np.testing.assert_allclose(found["pinion_angle"], angle, rtol=1e-14)
    np.testing.assert_allclose(found["time"], angle / operation.nominal_speed + places[:, LAG], rtol=1e-12)
    shifts = [X_P, Y_P, X_G, Y_G]
    turned = np.stack([angle, r_p * angle / r_g + places[:, TURN_G]], axis=-1)
    np.testing.assert_allclose(found["displacement"], np.hstack([places[:, shifts], turned]), rtol=1e-13)
    speeds = np.stack([speed, gear_speed], axis=-1)
    np.testing.assert_allclose(found["velocity"], np.hstack([rates[:, shifts], speeds]), rtol=1e-13)
    error = -r_g * places[:, TURN_G]
    np.testing.assert_allclose(found["transmission_error_rotational"], error, rtol=1e-15)
    works = {"in": IN, "out": OUT, "damping": DAMPING, "parametric": PARAMETRIC}
    works = {name: work_of(layout, which) for name, which in works.items()}
    for name, state in {**works, "friction": work_of_mesh(layout, 0, FRICTION)}.items():
        np.testing.assert_array_equal(found[f"work_{name}"], states[:, state])
    driven = speed + rates[:, TURN_M] if overrides else speed
    np.testing.assert_allclose(found["power_in"], found["drive_torque"] * driven, rtol=1e-12)
    np.testing.assert_allclose(found["power_out"], model.bodies.load[1] * gear_speed, rtol=1e-12)
    film = found["central_film_thickness"] / model.meshes[0].surfaces.roughness
    np.testing.assert_array_equal(found["film_parameter"], film)
    for k in range(7):
        phase, whole = cycles[k] % 1.0, np.floor(cycles[k])
        segment = int(np.searchsorted(table.boundary, phase, side="right")) - 1
        (work,) = work_of_all = contacts_of(model)
        derivatives(phase, whole, segment, states[k], model, work_of_all, {})
        for i in range(case.cycle.slots):
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
                mean = (float(work[contact.DRIVER_SPEED, i]) + float(work[contact.DRIVEN_SPEED, i])) / 2.0
                assert found["entrainment_speed"][k, i] == pytest.approx(mean, rel=1e-9)
                radius = float(work[contact.RADIUS, i])
                assert found["equivalent_radius"][k, i] == pytest.approx(radius, rel=1e-9)
                slope = np.tan(found["pressure_angle"][k, i]) * float(work[contact.COS, i])
                assert slope == pytest.approx(float(work[contact.SIN, i]), rel=1e-9)


def test_the_smallest_load_is_a_contact(prepared):
    """A flank that presses with less than a newton has a film and a stiffness; one that is apart has none."""
    case = prepared("crc-23-47")
    states = np.zeros((2, case.model.layout.states))
    states[:, TURN_G] = np.array([-1e-9, 1e-9]) / case.cycle.gear_pitch_radius
    found = outputs(np.full(2, 0.6), states, case.model)
    inside = np.isfinite(found["transmission_error_normal"][0])
    assert np.all((found["normal_load"][0, inside] > 0.0) & (found["normal_load"][0, inside] < 1.0))
    assert np.all(np.isfinite(found["central_film_thickness"][0, inside]))
    assert np.all(found["mesh_stiffness"][0, inside] > 0.0)
    assert not np.any(found["normal_load"][1])
    assert not np.any(np.isfinite(found["central_film_thickness"][1]))
