"""Efficiency by the load contact model: energy, torques, limits, convergence."""

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.modification import (
    UNMODIFIED,
    FlankModification,
    Misalignment,
    Modifications,
    Relief,
)
from tribodyn.validation.papers.diez_ibarbia_study import drive, elastic, load_contact


@pytest.fixture(scope="module")
def pair():
    return elastic(drive(), 1)


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


def test_no_torque_is_refused(pair):
    with pytest.raises(InputError, match="gear_torque"):
        load_contact(pair, 0.0, 0.05)


def test_relieved_tips_lose_less(pair):
    """Load moves from the ends of the path, where flanks slide most, to the pitch point."""
    tip = FlankModification(tip=Relief(12e-6, 5.4e-3))
    plain, relieved = (
        load_contact(pair, 318.3, 0.05, modifications=modified)
        for modified in (UNMODIFIED, Modifications(tip, tip))
    )
    assert 1 - relieved.efficiency < 0.9 * (1 - plain.efficiency)
    assert relieved.contact_ratio < plain.contact_ratio


def test_tilted_axes_share_the_load_of_the_pairs_much_as_before(pair):
    """Friction sees the pairs' loads; how they lie along the face changes sharing by second order only."""
    tilted = Modifications(misalignment=Misalignment(2e-4))
    efficiencies = [
        load_contact(pair, 318.3, 0.05, 60, modified, slices, coupled=False).efficiency
        for modified, slices in ((UNMODIFIED, 1), (tilted, 7))
    ]
    assert efficiencies[0] == pytest.approx(efficiencies[1], abs=1e-4)
