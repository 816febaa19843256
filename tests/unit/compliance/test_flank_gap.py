"""Gaps of modified flanks and inclined axes: where they are, how large, and what is refused."""

import numpy as np
import pytest

from tribodyn.compliance.flank_gap import (
    check_modifications,
    flank_gap,
    lead_gap,
    misalignment_gap,
    pitch_gap,
    profile_gap,
    relief_rolls,
)
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.modification import (
    UNMODIFIED,
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
)
from tribodyn.geometry.tooth import flank_point, thickness_half_angle

WIDTH, ANGLE = 26.7e-3, np.radians(20.0)
DRIVE = Drive(
    3e-3,
    ANGLE,
    GearBody(18, 0.0, 1.0, 1.25, 0.25, WIDTH, 12e-3),
    GearBody(36, 0.0, 1.0, 1.25, 0.25, WIDTH, 25e-3),
)
ASSEMBLY = assemble(FAMILY, DRIVE)
BASE = 27e-3 * np.cos(ANGLE)
START, END = ASSEMBLY.roll_limits
TIP = FlankModification(tip=Relief(20e-6, 2e-3))


def at(*rolls):
    return pair_geometry(ASSEMBLY, np.array(rolls))


@pytest.mark.parametrize(("exponent", "half"), [(1.0, 0.5), (2.0, 0.25)])
def test_relief_of_a_tip_is_at_its_end_of_the_path(exponent, half):
    tip = FlankModification(tip=Relief(20e-6, 2e-3, exponent))
    middle = 1e-3 / BASE  # roll over half the relief's length along the line of action
    found = profile_gap(ASSEMBLY, Modifications(pinion=tip), at(START, END - 2 * middle, END - middle, END))
    np.testing.assert_allclose(found, [0, 0, 20e-6 * half, 20e-6], atol=1e-12)
    found = profile_gap(ASSEMBLY, Modifications(gear=tip), at(START, START + middle, START + 2 * middle, END))
    np.testing.assert_allclose(found, [20e-6, 20e-6 * half, 0, 0], atol=1e-12)


def test_relief_of_a_root_is_at_the_other_end():
    root = FlankModification(root=Relief(10e-6, 2e-3))
    np.testing.assert_allclose(
        profile_gap(ASSEMBLY, Modifications(pinion=root), at(START, END)), [10e-6, 0], atol=1e-12
    )
    np.testing.assert_allclose(
        profile_gap(ASSEMBLY, Modifications(gear=root), at(START, END)), [0, 10e-6], atol=1e-12
    )


def test_corners_stay_at_the_tips_and_move_up_the_mates_flank():
    early = at(START - 0.005)
    assert early.gear_place[0] == pytest.approx(ASSEMBLY.r_start, rel=1e-12)
    assert early.pinion_place[0] > ASSEMBLY.r_start + 1e-4
    # the gear's tip has all its relief there; the pinion's root has lost some
    gear = profile_gap(ASSEMBLY, Modifications(gear=TIP), early)
    np.testing.assert_allclose(gear, 20e-6, rtol=1e-12)
    pinion = profile_gap(ASSEMBLY, Modifications(pinion=FlankModification(root=Relief(20e-6, 2e-3))), early)
    assert 0.0 < pinion[0] < 20e-6
    late = at(END + 0.005)
    assert late.pinion_place[0] == pytest.approx(ASSEMBLY.r_end, rel=1e-12)
    assert late.gear_place[0] < ASSEMBLY.r_end - 1e-4


def gap_of_offset_flanks(roll, relief):
    """Minimum distance along the gear's normal from the pinion's relieved flank to the gear's, m.

    Each point of the pinion's flank is moved back along its normal and turned with the pinion; the gear's
    involute is where a normal through the point says, which is a difference of angles times its base radius.
    """
    pinion, gear = ASSEMBLY.pinion, ASSEMBLY.gear
    r_p, r_g = 27e-3, 54e-3
    place = np.linspace(roll * BASE - 1e-3, min(ASSEMBLY.r_end, roll * BASE + 1e-3), 20001)
    reach = np.sqrt((place + r_p * np.sin(ANGLE)) ** 2 + BASE**2)
    missing = relief(place)
    # an involute less e along the normal is the same involute turned back by e over the base radius
    angle = thickness_half_angle(pinion, reach) - thickness_half_angle(pinion, r_p) - missing / BASE + roll
    x, y = reach * np.sin(angle), reach * np.cos(angle) - r_p
    far = np.hypot(x, r_g - y)
    mate = np.arctan2(x, r_g - y) - roll * r_p / r_g
    flank = thickness_half_angle(gear, r_g) - thickness_half_angle(gear, far)
    return float(np.min((flank - mate) * r_g * np.cos(ANGLE)))


@pytest.mark.parametrize(("length", "share"), [(2e-3, 0.06), (4e-3, 0.02)])
def test_relief_is_the_gap_of_the_offset_flanks_but_for_its_slope(length, share):
    assert gap_of_offset_flanks(0.1, lambda place: 0.0 * place) == pytest.approx(0.0, abs=2e-10)
    relief = Relief(20e-6, length)
    modified = Modifications(pinion=FlankModification(tip=relief))
    roll = (ASSEMBLY.r_end - 0.6 * length) / BASE

    def missing(place):
        return 20e-6 * np.clip((place - ASSEMBLY.r_end + length) / length, 0.0, 1.0)

    exact = gap_of_offset_flanks(roll, missing)
    found = profile_gap(ASSEMBLY, modified, at(roll))[0]
    assert found == pytest.approx(8e-6, rel=1e-9)
    assert 0.0 < found - exact < share * 20e-6
    # e'² ρ/2 with the slope along the arc, which is ρ_1/r_b times the way along the line of action
    motion = at(roll).motion
    slope = 20e-6 / length * BASE * motion.pinion_curvature[0]
    assert found - exact == pytest.approx(slope**2 / motion.relative_curvature[0] / 2, rel=0.2)


def test_lead_relief_is_a_parabola_on_either_side_of_a_straight_part():
    lead = LeadRelief(start=8e-6, end=4e-6, unmodified=WIDTH / 2)
    where = np.array([-0.5, -0.375, -0.25, 0.0, 0.25, 0.375, 0.5]) * WIDTH
    found = lead_gap(ASSEMBLY, Modifications(pinion=FlankModification(lead=lead)), where)
    np.testing.assert_allclose(found, [8e-6, 2e-6, 0, 0, 0, 1e-6, 4e-6], atol=1e-18)


def test_in_plane_misalignment_is_the_gap_and_out_of_plane_only_what_curvature_makes():
    where = np.linspace(-0.5, 0.5, 5) * WIDTH
    roll = np.array([START, 0.0, 0.1, END])
    geometry = at(*roll)
    tilted = misalignment_gap(ASSEMBLY, Misalignment(in_plane=1e-3), geometry, where)
    np.testing.assert_allclose(tilted, np.broadcast_to(1e-3 * where, (4, 5)), rtol=1e-12)
    # two circles of the flanks' radii, one pushed across their common normal
    crossed = misalignment_gap(ASSEMBLY, Misalignment(out_of_plane=0.02), geometry, where)
    apart = 81e-3 * np.sin(ANGLE)
    expected = np.hypot(apart, 0.02 * where) - apart
    np.testing.assert_allclose(crossed, np.broadcast_to(expected, (4, 5)), atol=1e-12)
    assert np.max(misalignment_gap(ASSEMBLY, Misalignment(out_of_plane=1e-3), geometry, where)) < 4e-9


def test_pitch_errors_follow_the_teeth_around():
    errors = tuple(np.arange(18) * 1e-6)
    modified = Modifications(pinion=FlankModification(pitch_error=errors))
    np.testing.assert_allclose(pitch_gap(modified, np.array([0, 17, 18, -1])), [0, 17e-6, 0, 17e-6])


def test_everything_adds_up():
    flank = FlankModification(tip=Relief(20e-6, 2e-3), lead=LeadRelief(8e-6, 8e-6))
    modified = Modifications(flank, TIP, Misalignment(in_plane=1e-3))
    where = np.array([0.5 * WIDTH])
    assert flank_gap(ASSEMBLY, modified, at(END), where)[0, 0] == pytest.approx(
        20e-6 + 8e-6 + 1e-3 * WIDTH / 2
    )


def test_kinks_of_linear_reliefs_are_known():
    found = relief_rolls(ASSEMBLY, Modifications(TIP, TIP))
    np.testing.assert_allclose(found, [START + 2e-3 / BASE, END - 2e-3 / BASE])
    assert relief_rolls(ASSEMBLY, UNMODIFIED) == []


@pytest.mark.parametrize(
    ("flank", "key"),
    [
        (FlankModification(tip=Relief(1e-3, 2e-3)), "tip_relief"),
        (FlankModification(tip=Relief(-1e-6, 2e-3)), "tip_relief"),
        (FlankModification(tip=Relief(1e-5, 20e-3)), "tip_relief_length"),
        (FlankModification(tip=Relief(1e-5, -1e-3)), "tip_relief_length"),
        (FlankModification(tip=Relief(1e-5, 0.0)), "tip_relief = .*how far"),
        (FlankModification(root=Relief(1e-3, 2e-3)), "root_relief"),
        (FlankModification(lead=LeadRelief(1e-3, 0.0)), "lead_relief_start"),
        (FlankModification(lead=LeadRelief(0.0, 1e-5, WIDTH)), "lead_unmodified"),
        (FlankModification(lead=LeadRelief(crowning=1e-3)), "crowning"),
        (FlankModification(pitch_error=(1e-6, 2e-6)), "pitch_errors"),
    ],
)
def test_what_is_no_modification_is_refused(flank, key):
    with pytest.raises(InputError, match=rf"drive\.gear\.modification\.{key}"):
        check_modifications(ASSEMBLY, Modifications(gear=flank))


def test_a_flank_point_lies_where_its_place_says():
    """The coordinate of a relief: the tooth's own flank at the radius that the contact has there."""
    geometry = at(0.1)
    x, y = flank_point(ASSEMBLY.pinion, np.array([geometry.pinion_place[0]]))
    assert np.hypot(x, y)[0] == pytest.approx(geometry.pinion_radius[0], rel=1e-9)
