"""Coordinates that matrices couple: the same motion as by links, Lagrange's equations, energy, compilers."""

import numpy as np
import pytest

from tests.support.coupled_trains import pushed_by_mesh, random_structure, reducer_in_space, with_couplings
from tests.support.plain_kernels import interpreted
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.states import random_place, random_state, recorded
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import DRIVE_SPEED, with_shared_code
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import Place
from tribodyn.solve.right_hand_side import contacts_of, rhs, work_array
from tribodyn.solve.transient import TransientSettings

DRIVES = {
    "speed": {},
    "torque": {"operating.source": "torque", "operating.drive_inertia": "0.05 kg*m**2"},
}
MODES = 3


@pytest.fixture(scope="module", params=DRIVES)
def coupled_train(request):
    model = reducer_in_space(**DRIVES[request.param])
    rng = np.random.default_rng(3)
    model = with_couplings(model, [random_structure(model, MODES, rng)], MODES)
    return pushed_by_mesh(model, rng.uniform(-1.0, 1.0, (2, MODES)))


def rates(model, y, place):
    plain: dict = {}
    powers = derivatives(place[0], 0.0, place[1], y, model, contacts_of(model), plain)
    return np.array([plain[i] for i in range(model.layout.states)]), powers


def test_entries_act_as_the_links_that_they_replace(rng):
    model = reducer_in_space()
    other = with_couplings(model, [])
    y, place = random_state(rng, model), random_place(rng, model.schedule)
    expected, found = rates(model, y, place)[0], rates(other, y, place)[0]
    np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-11 * np.abs(expected).max())


def test_every_compiler_makes_the_same_of_them(coupled_train, rng):
    assert_right_hand_sides_agree(at_several_conditions(coupled_train), rng, rtol=1e-9)


def test_the_jacobian_is_that_of_the_right_hand_side(coupled_train, rng):
    model, layout = with_shared_code(coupled_train), coupled_train.layout
    y, place = random_state(rng, model), random_place(rng, model.schedule)
    states, free = layout.states, [i for i in range(layout.mechanical) if i % layout.half != layout.lag]
    f, work = np.empty(states), work_array(model)
    rhs(place[0], 0.0, place[1], y, model, work, f)
    into = Differences(np.empty(states), np.empty((states, states)), np.empty(states))
    scale = np.full(states, 1e-5)
    scale[layout.half :] = 0.1
    end = float(model.schedule.end[place[1]])
    interpreted(differentiate, rhs)(Place(place[0], 0.0, place[1], end), y, f, scale, model, work, into)
    for j in free:
        by = 1e-4 * scale[j]
        ahead, behind = (rates(model, y + sign * by * np.eye(states)[j], place)[0] for sign in (1.0, -1.0))
        expected = (ahead - behind) / (2.0 * by)
        size = 2e-4 * np.abs(expected[: layout.mechanical]).max()
        np.testing.assert_allclose(
            into.jacobian[: layout.mechanical, j], expected[: layout.mechanical], atol=size
        )


def test_energy_balances(coupled_train):
    settings = TransientSettings("rodas4", 1e-8, 3, 10**6, 40)
    run = recorded(coupled_train, settings)
    into = run["work_in"] - run["work_out"] - run["work_friction"] - run["work_damping"]
    into = into + run["work_parametric"]
    stored = run["stored_energy"] - run["stored_energy"][0]
    scale = np.ptp(run["work_in"])
    assert np.ptp(run["work_damping"]) > 1e-4 * scale
    np.testing.assert_allclose(stored, into - into[0], atol=1e-6 * scale)


def test_a_prescribed_acceleration_needs_the_torque_that_gives_it(rng):
    """Driven by a torque, and at a prescribed speed with the acceleration that it gives: one motion."""
    model = reducer_in_space(**{"operating.source": "torque"})
    structure = random_structure(model, MODES, np.random.default_rng(3))
    by_torque = with_couplings(model, [structure], MODES)
    options = model.options._replace(drive=DRIVE_SPEED)
    by_speed = with_couplings(model._replace(options=options), [structure], MODES)
    y, place = random_state(rng, by_torque), random_place(rng, model.schedule)
    expected, powers = rates(by_torque, y, place)
    slip, operation = by_torque.layout.half + by_torque.layout.lag, model.operation
    rate = float(operation.pitch_angle) / (float(operation.nominal_speed) + y[slip])
    acceleration = expected[slip] / rate
    assert abs(acceleration) > 1.0
    moved = by_speed._replace(operation=operation._replace(acceleration=acceleration))
    found, found_powers = rates(moved, y, place)
    mechanical = by_torque.layout.mechanical
    size = np.abs(expected[:mechanical]).max()
    np.testing.assert_allclose(found[:mechanical], expected[:mechanical], rtol=1e-9, atol=1e-11 * size)
    assert found_powers[-1] == pytest.approx(powers[-1], rel=1e-8)
