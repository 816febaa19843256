"""The back flanks of modified gears on deviating axes."""

import math

import pytest

from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
    back_flanks,
)

TIP = FlankModification(tip=Relief(20e-6, 2e-3), lead=LeadRelief(crowning=5e-6), pitch_error=(0.0, 1e-6))


@pytest.mark.parametrize(("inclination", "skew"), [(1e-3, 0.0), (0.0, 1e-3), (7e-4, -4e-4)])
def test_axes_open_the_back_flanks_along_their_own_normals(inclination, skew):
    """The gear's axis leans by these angles towards +y and +x; flanks part along their normals (x, y)."""
    angle = math.radians(22.0)
    cosine, sine = math.cos(angle), math.sin(angle)
    driving = Misalignment(skew * cosine + inclination * sine, inclination * cosine - skew * sine)
    found = back_flanks(Modifications(misalignment=driving), angle).misalignment
    # of the back flanks the normal from pinion to gear is (−cos α, sin α), across it (sin α, cos α)
    assert found.in_plane == pytest.approx(-skew * cosine + inclination * sine, abs=1e-16)
    assert found.out_of_plane == pytest.approx(skew * sine + inclination * cosine, abs=1e-16)


def test_back_flanks_are_modified_on_request():
    both = TIP._replace(both_flanks=True)
    found = back_flanks(Modifications(pinion=both, gear=TIP), 0.4)
    assert found.pinion == both._replace(pitch_error=())
    assert found.gear == FlankModification()
    # the back of the back is the front, but for what belongs to single teeth
    given = Modifications(both, both, Misalignment(1e-3, -2e-3))
    twice = back_flanks(back_flanks(given, 0.4), 0.4)
    assert twice.misalignment == pytest.approx(given.misalignment)
