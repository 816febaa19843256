"""Static equilibrium on either flank, and without load."""

import numpy as np
import pytest

from tests.support.states import TURN_G, TURN_M, altered
from tribodyn.dynamics.approach import NORMAL_LOAD
from tribodyn.dynamics.equations import derivatives
from tribodyn.errors import SimulationError
from tribodyn.solve.initial import accelerations, static_deflection, static_equilibrium
from tribodyn.solve.march.step_control import unbounded
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.train.layout import velocities
from tribodyn.train.structure import (
    rotational_error,
)

STILL = {"operating.gear_torque_harmonics": []}
SHAFT = {"operating.shaft_stiffness": "1e4 N*m/rad", "operating.drive_inertia": "0.01 kg*m**2"}
BACKLASH = 5e-5


def started(prepared, torque, **more):
    case = prepared("rattle", **STILL, **{"operating.gear_torque": torque}, **more)
    state = static_equilibrium(case.model)
    (work,) = works = contacts_of(case.model)
    derivatives(0.0, 0.0, 0, state, case.model, works, {})
    slots = range(case.cycle.slots)
    loads = np.array([float(work.get((NORMAL_LOAD, i), 0.0)) for i in slots])
    layout = case.model.layout
    rates = accelerations(state, 0.0, 0, case.model)
    rates[layout.half + TURN_G] *= case.cycle.gear_pitch_radius  # of the transmission error, m/s
    return case, state, loads, rates[velocities(layout)]


@pytest.mark.parametrize("torque", [500.0, 1e-3, 1e-9, -1e-9, -1e-3, -500.0])
@pytest.mark.parametrize("soft", [False, True])
def test_the_load_presses_the_flanks_that_it_turns_together(prepared, torque, soft):
    """Either sign, any size, bearings that give by more than the backlash; with friction."""
    bearings = {
        f"bearings.{gear}.stiffness_{axis}": "1e6 N/m" for gear in ("pinion", "gear") for axis in "xy"
    }
    law = {"friction.law": "coulomb", "friction.coefficient": 0.1}
    case, state, loads, rates = started(prepared, f"{torque} N*m", **law, **(bearings if soft else {}))
    assert np.max(np.abs(rates)) < 1e-9 * abs(torque)
    assert np.any(loads > 0.0)
    assert np.all(loads[case.cycle.side * torque < 0] == 0.0)
    # the flanks have crossed the backlash only under the negative load
    error = rotational_error(state, 0, case.model)
    assert error > 0.0 if torque > 0 else error < -BACKLASH


def test_without_load_the_driving_flanks_just_touch(prepared):
    """The limit of a vanishing load; where the flanks have errors, the first of them touches."""
    error = {"mesh.transmission_error.harmonics": [{"order": 1, "amplitude": "3 um"}]}
    for more in ({}, error):
        case, state, loads, rates = started(prepared, "0 N*m", **more)
        _, lightly, _, _ = started(prepared, "1e-9 N*m", **more)
        assert not np.any(loads)
        assert not np.any(rates)
        np.testing.assert_allclose(state, lightly, atol=1e-9)
    assert rotational_error(state, 0, case.model) > 2e-6


@pytest.mark.parametrize("shaft", [{}, SHAFT], ids=["rigid", "shaft"])
@pytest.mark.parametrize("torques", [(0, 100), (0, -100), (100, -500), (-100, 500), (-100, None), (0, None)])
def test_the_motor_presses_too(prepared, torques, shaft):
    """Which flanks carry follows from both torques and inertias; the relative motion stands still."""
    load, motor = torques
    given = {} if motor is None else {"operating.pinion_torque": f"{motor} N*m"}
    case, state, loads, rates = started(
        prepared, f"{load} N*m", **{"operating.source": "torque"}, **given, **shaft
    )
    pinion, gear, *_ = case.model.bodies.inertia
    driving = (load * 23 / 47 if motor is None else motor) / (pinion + (0.01 if shaft else 0.0))
    push = driving * case.cycle.pinion_pitch_radius + load / gear * case.cycle.gear_pitch_radius
    assert np.max(np.abs(rates)) < 1e-9 * (abs(load) + abs(motor or 0) + 1e-300)
    if push == 0.0:
        assert not np.any(state)
        return
    assert np.any(loads[case.cycle.side * push > 0] > 0.0)
    assert np.all(loads[case.cycle.side * push < 0] == 0.0)
    assert not shaft or np.sign(state[TURN_M]) == np.sign(motor or load)


def test_without_back_flanks_nothing_holds_a_negative_load(prepared):
    model = prepared("crc-23-47").model
    model = altered(model, bodies={"load": np.array([0.0, -100.0])}, operation={"drive_torque": -50.0})
    with pytest.raises(SimulationError, match="turns the flanks apart"):
        static_equilibrium(model)
    assert static_equilibrium(prepared("crc-23-47").model).shape == (model.layout.states,)


def test_the_scale_of_deflections_is_that_of_a_single_pair_between_rigid_bearings(prepared):
    rigid = {f"bearings.{gear}.stiffness_{axis}": "1e13 N/m" for gear in ("pinion", "gear") for axis in "xy"}
    model = prepared("jump-involute-23-47", **rigid).model
    state = static_equilibrium(model, float(model.schedule.end[0]), 1)
    scale = static_deflection(model.meshes[0], float(model.bodies.load[1]))
    assert rotational_error(state, 0, model) * np.cos(np.radians(20.0)) == pytest.approx(scale, rel=1e-3)


def moving(prepared, amplitude, damping):
    """A model whose flanks come together fast at the start, by an error of transmission."""
    error = [{"order": 1, "amplitude": amplitude, "phase": "90 deg"}]
    given = {"mesh.transmission_error.harmonics": error, "mesh.damping_ratio": damping}
    return prepared("jump-involute-23-47", **given, **{"operating.pinion_speed": "600 rad/s"}).model


def test_damping_of_a_moving_error_does_not_hide_the_equilibrium(prepared):
    """Its force alone is above the load, so that flanks barely touch; all the same nothing accelerates."""
    model = moving(prepared, "30 um", 0.5)
    state = static_equilibrium(model)
    gentle = static_equilibrium(moving(prepared, "30 um", 0.0))
    error, without = rotational_error(np.array([state, gentle]), 0, model)
    assert 0.0 < error < 0.5 * without
    rates, still = (accelerations(y, 0.0, 0, model)[velocities(model.layout)] for y in (state, gentle))
    assert np.max(np.abs(rates)) < 1e-6 * np.max(np.abs(still))


def test_damping_that_leaves_no_equilibrium_is_named(prepared):
    with pytest.raises(SimulationError, match="damping of the moving transmission error") as caught:
        static_equilibrium(moving(prepared, "200 um", 0.5))
    assert "gear_torque" not in str(caught.value)
    assert "mesh.damping_ratio" in str(caught.value)


def test_bearings_that_give_by_more_than_the_centre_distance(prepared):
    soft = {f"bearings.{gear}.stiffness_{axis}": "1e4 N/m" for gear in ("pinion", "gear") for axis in "xy"}
    with pytest.raises(SimulationError, match="stiffer bearings"):
        static_equilibrium(prepared("crc-23-47", **soft).model)
    model = prepared("crc-23-47", **soft, **{"operating.gear_torque": "1 N*m"}).model
    assert not unbounded(static_equilibrium(model), model)
