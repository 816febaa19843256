"""Distances of involutes from the limits of their existence, by closed forms of the basic rack."""

import math

import numpy as np
import pytest

from tests.support.sample_drives import LIU_NI, SHIFTED, STANDARD, body
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.drive import SIDES, Drive, body_of, reference_radius, tip_radius
from tribodyn.geometry.families import involute
from tribodyn.geometry.limits.limits import LIMITS, beyond, distances, smooth_minimum

#: No shift: the working circles are the reference circles.
PLAIN = (STANDARD, LIU_NI, Drive(0.002, np.radians(17.5), body(31.0), body(52.0)))


def tip_distance(drive, side):
    """From the tangent point on the base circle to the tip circle, m."""
    return math.sqrt(
        tip_radius(drive, side) ** 2 - (reference_radius(drive, side) * math.cos(drive.pressure_angle)) ** 2
    )


@pytest.mark.parametrize("drive", PLAIN)
def test_distances_are_those_of_involutes(drive):
    found = distances(assemble(involute.FAMILY, drive))
    assert set(found) == set(LIMITS)
    alpha, module = drive.pressure_angle, drive.module
    radii = {side: reference_radius(drive, side) for side in SIDES}
    line = sum(radii.values()) * math.sin(alpha)
    reach = {side: tip_distance(drive, side) for side in SIDES}
    for side, mate in zip(SIDES, SIDES[::-1], strict=True):
        own, r = body_of(drive, side), radii[side]
        base = r * math.cos(alpha)
        lowest = line - reach[mate]  # distance along the line of action from this gear's tangent point
        # the contact moves along a flank as its radius of curvature per rad of this gear
        ratio = 1.0 if side == "pinion" else radii["pinion"] / radii["gear"]
        speed = ratio * lowest
        assert speed - 0.005 * module <= found[f"undercut_{side}"] <= speed * (1 + 1e-12)
        rounding, depth = module * own.fillet_radius, module * own.dedendum
        form = r * math.sin(alpha) - (depth - rounding * (1 - math.sin(alpha))) / math.sin(alpha)
        expected = math.hypot(base, lowest) - math.hypot(base, form)
        assert found[f"interference_{side}"] == pytest.approx(expected, rel=1e-9)
        tip = tip_radius(drive, side)
        at_tip = math.acos(base / tip)
        half = math.pi / (2 * own.teeth) + math.tan(alpha) - alpha - math.tan(at_tip) + at_tip
        assert found[f"tip_thickness_{side}"] == pytest.approx(2 * tip * math.sin(half), rel=1e-9)
        clearance = sum(radii.values()) - tip - (radii[mate] - module * body_of(drive, mate).dedendum)
        assert found[f"clearance_{side}"] == pytest.approx(clearance, rel=1e-9)
        left = math.pi * module / 4 - depth * math.tan(alpha)
        left -= rounding * (1 - math.sin(alpha)) / math.cos(alpha)
        assert found[f"rack_tip_{side}"] == pytest.approx(left, rel=1e-9)
        assert 0.0 < found[f"tip_corner_{side}"] <= module
    ratio = (sum(reach.values()) - line) / (math.pi * module * math.cos(alpha))
    assert found["contact_ratio_above_1"] == pytest.approx(ratio - 1.0, rel=1e-9)


def test_an_undercut_pinion_is_beyond_its_limits():
    few = STANDARD._replace(pinion=body(9.0))
    found = distances(assemble(involute.FAMILY, few))
    assert found["undercut_pinion"] < 0.0 < found["undercut_gear"]
    pointed = distances(assemble(involute.FAMILY, SHIFTED._replace(pinion=body(17.0, 1.4))))
    assert pointed["tip_thickness_pinion"] < 0.0 < pointed["tip_thickness_gear"]


def test_the_minimum_is_blended_from_below():
    values = np.array([3.0, 1.0, 1.0 + 1e-3, 2.0])
    width = 1e-3
    exact = -width * math.log(sum(math.exp(-(value - 1.0) / width) for value in values)) + 1.0
    assert smooth_minimum(values, width) == pytest.approx(exact, rel=1e-14)
    alone = smooth_minimum(np.array([5.0, 1.0]), 1e-6)
    assert alone == pytest.approx(1.0, abs=1e-12)
    assert 1.0 - 4e-3 * math.log(4) <= smooth_minimum(values, 4e-3) < 1.0


def test_what_does_not_exist_is_a_module_beyond():
    assert beyond("m", STANDARD) == -STANDARD.module
    assert beyond("1", STANDARD) == -1.0
