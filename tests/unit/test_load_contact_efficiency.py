"""Efficiency by the load contact model: energy, torques, limits, convergence."""

import numpy as np
import pytest

from tribodyn.efficiency.load_contact import load_contact
from tribodyn.errors import InputError
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.validation.diez_ibarbia_study import drive, elastic


@pytest.fixture(scope="module")
def pair():
    return elastic(drive(), 1)


def test_no_friction_no_loss(pair):
    assert load_contact(pair, 300.0, 0.0).efficiency == 1.0


def test_input_torque_pays_for_the_losses_on_the_path(pair):
    cycle = load_contact(pair, 300.0, 0.05)
    geometry = pair_geometry(pair.assembly, cycle.roll)
    motion, load = geometry.motion, cycle.normal_load
    side = np.sign(motion.signed_distance)
    torque = np.sum(load * (motion.pinion_normal_arm + side * 0.05 * motion.pinion_friction_arm), axis=1)
    ratio = 0.5
    np.testing.assert_allclose(torque, 300.0 * ratio + np.sum(cycle.loss, axis=1), rtol=1e-9)
    assert cycle.efficiency == pytest.approx(150.0 / np.mean(torque), rel=1e-9)


def test_positions_are_enough(pair):
    coarse, fine = (load_contact(pair, 318.3, 0.0473, positions).efficiency for positions in (240, 1920))
    assert coarse == pytest.approx(fine, abs=1e-6)


def test_loss_is_nearly_proportional_to_friction(pair):
    losses = [1 - load_contact(pair, 300.0, mu).efficiency for mu in (0.01, 0.02)]
    assert losses[1] / losses[0] == pytest.approx(2.0, rel=0.01)


def test_no_torque_is_refused(pair):
    with pytest.raises(InputError, match="gear_torque"):
        load_contact(pair, 0.0, 0.05)
