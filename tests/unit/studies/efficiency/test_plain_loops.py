"""A mesh cycle of two involutes in plain loops: mesh at a phase, samples, datasets, quantities."""

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from tests.support.closures import of_case
from tribodyn.mesh.equilibrium import contacts
from tribodyn.standards.loss_factors import equal_loads
from tribodyn.studies.efficiency.along_path import record_arrays, samples
from tribodyn.studies.efficiency.mesh_positions import places
from tribodyn.studies.efficiency.published import tip_contact_ratios
from tribodyn.studies.efficiency.run import (
    PreparedEfficiency,
    _at_jumps,
    _quantities,
    _sampled,
    efficiencies,
    prepare,
)
from tribodyn.studies.protocol.load import load_scenario

NAME = "efficiency-involute-18-36"
SHORT = {"output.samples_per_cycle": 23}


@pytest.fixture(scope="module", params=[410.0, -410.0], ids=["pinion", "gear"])
def study(request: pytest.FixtureRequest) -> PreparedEfficiency:
    law = {"friction.law": "masjedi-khonsari", "operating.gear_torque": f"{request.param} N*m"}
    return prepare(load_scenario(NAME, SHORT | law))


@pytest.mark.parametrize("name", [NAME, "efficiency-crc-23-47"])
def test_where_the_gear_drives_pairs_go_through_the_table_backwards(name: str):
    """The newest enters at the end of the path; the one that leaves at its beginning was the oldest."""
    cycle = prepare(load_scenario(name)).cycle
    count, pairs = 40, int(cycle.front_pairs)
    span = float((cycle.roll_end - cycle.roll_start) / cycle.pitch_angle)
    over = samples(cycle, count, -1.0)
    np.testing.assert_allclose(over.turned, np.arange(count + 1) / count, rtol=1e-15)
    assert np.all((over.phase >= 0.0) & (over.phase <= 1.0))
    # pitches from the beginning of the path, by the table's slots
    table = over.phase[:, None] + np.arange(pairs - 1.0, -1.0, -1.0)
    for turned, row, later in zip(over.turned, over.by_pair(table), over.later, strict=True):
        for number, place in enumerate(row):
            expected = span - turned - (pairs - 1 - number)
            # the oldest has left: its place is that of the pair which enters next
            expected += pairs if later and number == 0 else 0.0
            assert place == pytest.approx(expected, abs=2e-9)
    forward = samples(cycle, count, 1.0)
    np.testing.assert_array_equal(forward.phase, forward.turned)
    np.testing.assert_array_equal(forward.by_pair(table), table)
    assert not np.any(forward.later)


def test_the_mesh_at_a_phase_is_that_of_two_involutes(study: PreparedEfficiency):
    """Radii of curvature along the line of action; compliance by scipy's splines through the table."""
    cycle, path = study.cycle, study.path
    phase = np.array([0.0, 0.013, 0.21, 0.37, 0.52, 0.68, 0.83, 0.997])
    mesh = places(cycle, path, phase)
    seen = contacts(mesh.cycle, 410.0, 100.0, study.duty.closure)
    angle = float(path.pressure_angle(0.0))
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    base = [radius * math.cos(angle) for radius in radii]
    pitch = 2.0 * math.pi / 18.0
    for k, at in enumerate(phase):
        segment = max(i for i in range(len(cycle.boundary) - 1) if cycle.boundary[i] <= at)
        for q in range(2):
            roll = float(cycle.roll_start) + pitch * (at + 1 - q)
            inside = cycle.roll_start <= roll < cycle.roll_end
            assert mesh.cycle.in_contact[k, q] == float(inside)
            assert mesh.roll[k, q] == pytest.approx(roll, abs=1e-14)
            for name, found in (("compliance", mesh.cycle.compliance), ("gap", mesh.cycle.gap)):
                spline = CubicSpline(cycle.phase[segment], getattr(cycle, name)[segment, :, q])
                assert found[k, 0, q] == pytest.approx(float(spline(at)), rel=1e-9, abs=1e-20)
            other = CubicSpline(cycle.phase[segment], cycle.coupling[segment, :, q, 1 - q])
            assert mesh.cycle.coupling[k, 0, q, 1 - q] == pytest.approx(float(other(at)), rel=1e-9)
            if not inside:
                continue
            distance = base[0] * roll
            curved = radii[0] * math.sin(angle) + distance, radii[1] * math.sin(angle) - distance
            assert mesh.cycle.signed_distance[k, 0, q] == pytest.approx(distance, rel=1e-9)
            assert mesh.cycle.pressure_angle[k, 0, q] == pytest.approx(angle, rel=1e-12)
            np.testing.assert_allclose(seen.normal_arm[:, k, 0, q], base, rtol=1e-12)
            np.testing.assert_allclose(seen.friction_arm[:, k, 0, q], curved, rtol=1e-9)
            assert seen.radius[k, 0, q] == pytest.approx(curved[0] * curved[1] / sum(curved), rel=1e-9)
            assert mesh.cycle.pinion_speed[k, 0, q] == pytest.approx(curved[0], rel=1e-9)
            assert mesh.cycle.gear_speed[k, 0, q] == pytest.approx(curved[1] * radii[0] / radii[1], rel=1e-9)
    alone = places(cycle, path, np.linspace(0.0, 0.999, 38), "single-pair")
    np.testing.assert_array_equal(alone.cycle.in_contact.sum(axis=1), 1.0)
    assert np.max(np.abs(alone.roll[alone.cycle.in_contact > 0.0])) <= pitch / 2.0 + 1e-12
    np.testing.assert_array_equal(mesh.cycle.side, [1.0, 1.0])


#: Datasets of a pair that are those of the state, where it touches.
OF_STATE = (
    "friction_coefficient",
    "asperity_load_ratio",
    "central_film_thickness",
    "flash_temperature_rise",
    "hertz_pressure",
    "closure_in_range",
    "friction_in_range",
)


def test_datasets_of_a_mesh_cycle_in_plain_loops(study: PreparedEfficiency):
    """By the record's pairs: the one that entered last is the last, whichever gear drives."""
    over, mesh, state = _sampled(study)
    duty, way = study.duty, study.duty.way
    found = record_arrays(over, mesh, state, duty)
    speed = float(duty.pinion_speed)
    roughness = float(duty.closure.surfaces.roughness)
    radius = float(study.cycle.gear_pitch_radius)
    for k, turned in enumerate(over.turned):
        angle = turned * 2.0 * math.pi / 18.0
        assert found["pinion_angle"][k] == pytest.approx(angle, rel=1e-14)
        assert found["time"][k] == pytest.approx(angle / speed, rel=1e-14)
        # the gear lags by what the teeth deflect
        lag = float(state.deflection[k]) / radius
        np.testing.assert_allclose(
            found["displacement"][k], [0.0, 0.0, 0.0, 0.0, angle, 0.5 * angle - lag], rtol=1e-13
        )
        np.testing.assert_allclose(found["velocity"][k], [0.0, 0.0, 0.0, 0.0, speed, 0.5 * speed], rtol=1e-14)
        assert found["transmission_error_rotational"][k] == state.deflection[k]
        torque_in, torque_out = float(state.pinion_torque[k]), float(state.gear_torque[k])
        assert found["drive_torque"][k] == torque_in
        assert found["power_in"][k] == pytest.approx(torque_in * speed, rel=1e-14)
        assert found["power_out"][k] == pytest.approx(torque_out * 0.5 * speed, rel=1e-14)
        lost = float(state.power_friction[k])
        assert found["power_friction"][k] == lost
        put_in = torque_in * speed if way > 0.0 else -torque_out * 0.5 * speed
        assert found["efficiency"][k] == pytest.approx(1.0 - lost / put_in, rel=1e-13)
        assert found["power_damping"][k] == found["power_parametric"][k] == 0.0
        for slot in range(2):
            # backwards the table counts the other way round, and later it has moved on by one
            own = slot if way > 0.0 or bool(over.later[k]) else 1 - slot
            load = float(state.normal_load[k, own])
            assert found["normal_load"][k, slot] == load
            assert found["friction_force"][k, slot] == state.friction_force[k, own]
            touches = load > 0.0 and mesh.cycle.in_contact[k, own] > 0.0
            stiffness = 1.0 / float(mesh.cycle.compliance[k, 0, own]) if touches else 0.0
            assert found["mesh_stiffness"][k, slot] == pytest.approx(stiffness, rel=1e-14)
            expected = {name: getattr(state, name)[k, own] for name in OF_STATE} | {
                "film_parameter": state.central_film_thickness[k, own] / roughness,
                "equivalent_radius": state.radius[k, own],
                "entrainment_speed": state.entrainment[k, own],
                "sliding_speed": state.sliding[k, own],
                "pressure_angle": float(study.path.pressure_angle(0.0)),
                "transmission_error_normal": way
                * state.deflection[k]
                * math.cos(study.path.pressure_angle(0.0)),
            }
            for name, value in expected.items():
                wanted = float(value) if touches else math.nan
                assert found[name][k, slot] == pytest.approx(wanted, rel=1e-12, nan_ok=True), name


def test_quantities_of_a_mesh_cycle_in_plain_loops(study: PreparedEfficiency):
    """Extremes of samples and of both sides of every jump; means over one cycle, the last sample left out."""
    over, mesh, state = _sampled(study)
    found = _quantities(study, over, mesh, state)
    phases = [
        min(max(float(boundary) + off, 1e-9), 1.0 - 1e-9)
        for boundary in study.cycle.boundary
        for off in (-1e-9, 1e-9)
    ]
    beside, jumps = _at_jumps(study)
    np.testing.assert_allclose(beside.phase, phases, rtol=0.0, atol=1e-15)
    loaded = [
        (at, solution, k, q)
        for at, solution in ((mesh, state), (beside, jumps))
        for k in range(len(solution.normal_load))
        for q in range(2)
        if solution.normal_load[k, q] > 0.0
    ]
    films = [
        (float(solution.central_film_thickness[k, q]), float(at.roll[k, q])) for at, solution, k, q in loaded
    ]
    film, roll = min(films)
    assert found["film_min"] == film
    assert found["film_parameter_min"] == pytest.approx(
        film / study.duty.closure.surfaces.roughness, rel=1e-14
    )
    assert found["film_parameter_min_roll_angle"] == pytest.approx(roll, abs=1e-12)
    for name, dataset in (
        ("normal_load_max", "normal_load"),
        ("hertz_pressure_max", "hertz_pressure"),
        ("flash_temperature_max", "flash_temperature_rise"),
    ):
        assert found[name] == max(float(getattr(solution, dataset)[k, q]) for _, solution, k, q in loaded)
    count = len(over.turned) - 1
    forces = [0.0, 0.0]
    for k in range(count):
        for slot, force in enumerate(over.by_pair(state.friction_force)[k]):
            forces[slot] += abs(float(force)) / count
    np.testing.assert_allclose(found["friction_force_mean"], forces, rtol=1e-13)
    inside = [float(state.closure_in_range[k, q]) for _, solution, k, q in loaded if solution is state]
    assert found["closure_in_range_fraction"] == pytest.approx(
        sum(flag == 1.0 for flag in inside) / len(inside)
    )
    speed = float(study.duty.pinion_speed)
    assert found["mesh_frequency"] == pytest.approx(18.0 * speed / (2.0 * math.pi), rel=1e-14)
    assert found["contact_ratio"] == float(study.cycle.contact_ratio)
    assert found["averaging_cycles"] == 1
    assert abs(found["energy_residual"]) < 1e-12
    assert found["efficiency"] == pytest.approx(
        1.0 - found["power_friction_mean"] / found["power_in_mean"], rel=1e-14
    )
    assert found["driving_gear"] == ("pinion" if study.duty.way > 0.0 else "gear")
    # the gear's torque is given: what it takes or gives is that at half the pinion's speed
    passed = 410.0 * 0.5 * speed + (found["power_friction_mean"] if study.duty.way > 0.0 else 0.0)
    assert found["power_in_mean"] == pytest.approx(passed, rel=1e-9)
    assert not any(inside)  # the film law is used beyond its range in the whole contact
    assert found["trust"] == "laws extrapolated"


def test_loss_factors_are_of_one_coefficient_alone(study: PreparedEfficiency):
    """1 − μ H_v, and Höhn's formula where the pitch point lies in single contact."""
    known: Any = {sharing: SimpleNamespace(efficiency=0.5) for sharing in ("elastic", "uniform")}
    duty = study.duty
    assert not {"loss_factor", "efficiency_hoehn"} & efficiencies(study, known).keys()
    coulomb = replace(study, duty=duty._replace(closure=of_case(study.case, "coulomb", coefficient=0.07)))
    found = efficiencies(coulomb, known)
    tips = tip_contact_ratios(coulomb.assembly.family, coulomb.case.drive)
    factor = equal_loads(*tips, 18.0, 2.0)
    assert found["loss_factor"] == factor
    assert found["efficiency_loss_factor"] == pytest.approx(1.0 - 0.07 * factor, rel=1e-14)
    assert max(tips) < 1.0 < sum(tips)
    closed = math.pi * 3.0 / 36.0 * (1.0 - sum(tips) + tips[0] ** 2 + tips[1] ** 2)
    assert found["efficiency_hoehn"] == pytest.approx(1.0 - 0.07 * closed, rel=1e-14)
    # one pair alone at constant torque: the same loss but for its square
    assert found["efficiency_torque_ratio"] == pytest.approx(found["efficiency_single_pair"], abs=2e-4)
    assert found["efficiency_uniform"] == 0.5
