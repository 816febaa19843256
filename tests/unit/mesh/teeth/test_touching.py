"""Faces of which a part does not carry, against slices that hold each other by finite elements."""

import numpy as np
import pytest

from tests.support.cracked_pair import STEEL, pair
from tribodyn.compliance.energy import hertz_linear, tooth_compliance, under_uneven_load
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks, flexibility
from tribodyn.mesh.teeth.damage.gear import damaged_gear
from tribodyn.mesh.teeth.damage.patch import softer

SLICES, STRIPS = 40, 200


@pytest.fixture(scope="module")
def flanks():
    return LoadedFlanks(flexibility(pair(), (STEEL, STEEL), lead=True), slices=SLICES)


def parts(gear):
    at = np.zeros(1)
    uneven = [under_uneven_load(tooth) for tooth in gear.teeth]
    each = [tooth_compliance(tooth, STEEL, gear.width, at, "ring") for tooth in uneven]
    bodies = each[0].foundation + each[1].foundation
    teeth = each[0].total + each[1].total - bodies
    return teeth, bodies, float(hertz_linear(STEEL, STEEL, gear.width))


@pytest.mark.parametrize(("middle", "share"), [(0.0, 0.2), (0.0, 0.5), (0.25, 0.3)])
def test_a_spall_softens_the_pair_as_finite_elements_say(flanks, middle, share):
    """At the pitch point; 0.7 to 0.85 of it, since their contact is softer."""
    roll = pair().pitch_angle * np.array([[2.0, 1.0, 0.0, -1.0, -2.0]])
    gap = np.zeros((1, 5, SLICES))
    sound = flanks.share(roll, 300.0, 0.0, gap)
    spalled = np.abs(flanks.face() / flanks.flexible.width - middle) <= share / 2.0 + 1e-9
    gap[:, 2] = np.where(spalled, 0.2e-3, 0.0)
    damaged = flanks.share(roll, 300.0, 0.0, gap)
    assert sound.normal_load[0, [0, 1, 3, 4]].max() == 0.0
    softened = (damaged.deflection - sound.deflection)[0] * np.cos(np.radians(20.0))
    expected = softened / sound.normal_load[0, 2]

    gear = damaged_gear(pair(), (STEEL, STEEL), "pinion", solved=False)
    place = (np.arange(STRIPS) + 0.5) / STRIPS - 0.5
    carries = np.where(np.abs(place - middle) < share / 2.0, 1e-6, 1.0)[:, None]
    assert 0.7 * expected < softer(gear, *parts(gear), carries)[0] < 0.85 * expected


def test_a_face_that_carries_evenly_is_as_stiff_as_it_was():
    gear = damaged_gear(pair(), (STEEL, STEEL), "pinion", solved=False)
    teeth, bodies, contact = parts(gear)
    np.testing.assert_allclose(
        softer(gear, teeth, bodies, contact, np.ones((STRIPS, 1))), 0.0, atol=1e-9 * contact
    )
