"""Flanks pressed again at the same positions carry what the load contact model gives them."""

import numpy as np
import pytest

from tribodyn.compliance.sharing.held_flanks import HeldFlanks
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, extended_rolls, flexibility
from tribodyn.compliance.sharing.loaded_contact import face_shift, reach
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.checks import check
from tribodyn.studies.protocol.load import load_scenario

#: Scenario -> slices of the face: even, with misaligned axes, helical.
PAIRS = {"load-contact-18-36": 1, "load-contact-misaligned": 5, "helical-23-47": 5}


@pytest.fixture(scope="module", params=PAIRS)
def pair(request):
    case, slices = load_scenario(request.param).pair, PAIRS[request.param]
    assembly = check(family(case.family), case.drive)
    flexible = flexibility(assembly, case.materials, lead=slices > 1)
    flanks = LoadedFlanks(flexible, case.mesh.modifications, slices)
    torque, late = case.operating.gear_torque, face_shift(flanks)
    low, high = reach(flanks, torque)
    return flanks, torque, extended_rolls(assembly, (low - late, high + late), 12)


def test_they_share_as_the_load_contact_model(pair):
    flanks, torque, roll = pair
    pressed, drawn = HeldFlanks(flanks, roll), np.random.default_rng(1)
    gaps, friction = drawn.uniform(0.0, 5e-6, (3, *pressed.shape)), drawn.uniform(0.0, 0.1, (3, *roll.shape))
    found = pressed.share(torque, gaps, friction)
    for number, (gap, mu) in enumerate(zip(gaps, friction, strict=True)):
        alone = flanks.share(roll, torque, mu, flanks.gap(pressed.geometry) + gap)
        for name in ("slice_load", "deflection", "overlap"):
            np.testing.assert_allclose(
                getattr(found, name)[number], getattr(alone, name), rtol=1e-9, atol=1e-9 * torque
            )


def test_cycles_do_not_see_each_other(pair):
    flanks, torque, roll = pair
    pressed = HeldFlanks(flanks, roll)
    gaps = np.random.default_rng(2).uniform(0.0, 5e-6, (4, *pressed.shape))
    together = pressed.share(torque, gaps, np.zeros((4, *roll.shape)))
    apart = [pressed.share(torque, gap[None], np.zeros((1, *roll.shape))) for gap in gaps]
    np.testing.assert_allclose(
        together.slice_load, np.concatenate([one.slice_load for one in apart]), rtol=1e-12
    )
