"""Where torques and slices are refused, by Hertz's width; which slices carry the heaviest pair."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tests.support.faces_in_slices import DRIVE, STEEL, WIDTH
from tribodyn.compliance.fem.gear_compliance import GearCompliance
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import check_contact, check_resolved, check_torque
from tribodyn.compliance.sharing.slices import PairFlexibility
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.modification import UNMODIFIED, Misalignment, Modifications

ANGLE = np.radians(20.0)
NONE = GearCompliance(np.empty(0), np.empty(0), np.empty(0), 1e-3)
PAIR = PairFlexibility(assemble(FAMILY, DRIVE), (STEEL, STEEL), WIDTH, (NONE, NONE))
TILTED = Modifications(misalignment=Misalignment(1e-4))


def contact_width(torque):
    """Width of the contact at the pitch point, m."""
    curvature = (1 / 27e-3 + 1 / 54e-3) / np.sin(ANGLE)
    line_load = torque / (54e-3 * np.cos(ANGLE)) / WIDTH
    return 2 * np.sqrt(8 * line_load * (1 - 0.3**2) / 207e9 / (np.pi * curvature))


def test_a_torque_that_flattens_the_contact_beyond_the_face_is_refused():
    most = 300.0 * (WIDTH / contact_width(300.0)) ** 2  # the width grows with the square root
    check_contact(LoadedFlanks(PAIR, UNMODIFIED, 1), 0.999 * most)
    with pytest.raises(InputError, match=r"flattens the contact to 27 mm, wider than the face"):
        check_contact(LoadedFlanks(PAIR, UNMODIFIED, 1), 1.001 * most)


@pytest.mark.parametrize("torque", [80.0, 700.0])
def test_slices_are_at_least_as_wide_as_the_contact(torque):
    most = int(WIDTH / contact_width(torque))
    check_contact(LoadedFlanks(PAIR, TILTED, most), torque)
    message = f"at {torque:g} N m, {contact_width(torque) * 1e3:.2g} mm"
    with pytest.raises(InputError, match=message) as refused:
        check_contact(LoadedFlanks(PAIR, TILTED, most + 1), torque)
    assert refused.value.remedy == f"give at most {most}"


def test_a_torque_must_press():
    check_torque(1e-3)
    for torque in (0.0, -5.0):
        with pytest.raises(InputError, match="presses no flanks together"):
            check_torque(torque)


def resolved(slices, first, second, modified=TILTED):
    """Check loads of two positions: the pairs' slices that carry, of which the second pair is heavier."""
    load = np.zeros((2, 2, slices))
    for position, (light, heavy) in enumerate((first, second)):
        load[position, 0, :light] = 1.0
        load[position, 1, :heavy] = 100.0
    shared: Any = SimpleNamespace(slice_load=load, normal_load=load.sum(axis=-1))
    check_resolved(LoadedFlanks(PAIR, modified), shared, 250.0)


def test_the_heaviest_pair_must_stand_on_enough_slices_everywhere():
    least = 3
    resolved(9, (1, least), (2, 9))
    for first, second in (((9, least - 1), (9, 9)), ((9, 9), (0, least - 1))):
        with pytest.raises(InputError, match=rf"at 250 N m only {least - 1} of 9 slices") as refused:
            resolved(9, first, second)
        assert refused.value.key == "mesh.misalignment.in_plane"
        resolved(9, first, second, UNMODIFIED)  # nothing varies along the face
    resolved(least - 1, (1, 1), (2, 2))
    with pytest.raises(InputError):
        resolved(least, (1, 1), (2, 2))
