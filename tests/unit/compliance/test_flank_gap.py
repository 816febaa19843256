"""Gaps of modified flanks and inclined axes: where they are, how large, and what is refused."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from tests.support.faces_in_slices import DRIVE, WIDTH
from tribodyn.compliance.sharing.flank_gap import (
    check_modifications,
    flank_gap,
    lead_gap,
    maximum_along_lead,
    misalignment_gap,
    pitch_gap,
    profile_gap,
    relief_rolls,
)
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import cycloidal, family
from tribodyn.geometry.families.involute import FAMILY
from tribodyn.geometry.modification import (
    FlankModification,
    LeadRelief,
    Misalignment,
    Modifications,
    Relief,
    turned_round,
    vary_along_lead,
)
from tribodyn.geometry.tooth import flank_point, thickness_half_angle

ANGLE = np.radians(20.0)
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


def test_crowning_is_a_parabola_over_each_gear_s_own_face():
    wide = DRIVE._replace(gear=DRIVE.gear._replace(face_width=1.25 * WIDTH))
    pinion, gear = (FlankModification(lead=LeadRelief(crowning=crowning)) for crowning in (16e-6, 25e-6))
    where = np.array([-0.5, -0.25, 0.0, 0.125, 0.5]) * WIDTH
    found = lead_gap(assemble(FAMILY, wide), Modifications(pinion, gear), where)
    np.testing.assert_allclose(found, [32e-6, 8e-6, 0.0, 2e-6, 32e-6], rtol=1e-12)


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


@pytest.mark.parametrize("name", ["cycloidal", "circular-arc"])
def test_circles_on_inclined_axes_stand_apart_along_and_across_the_normal(name):
    """Paths of contact that are curved: each slice is moved in the plane of the pitch point's normal."""
    assembly = assemble(family(name), DRIVE._replace(shape=cycloidal.CycloidShape(28e-3, 33e-3)))
    roll = np.linspace(*assembly.roll_limits, 7)[[1, 2, 4, 5]]
    geometry, face = pair_geometry(assembly, roll), np.array([-0.5, 0.2, 0.5]) * WIDTH
    tilt = Misalignment(in_plane=0.03, out_of_plane=0.05)
    found = misalignment_gap(assembly, tilt, geometry, face)
    first = float(assembly.path.pressure_angle(0.0))
    turns = set()
    for n, k in np.ndindex(found.shape):
        motion = type(geometry.motion)(*(field[n] for field in geometry.motion))
        turn = motion.pressure_angle - first
        turns.add(round(float(turn), 6))
        moved = face[k] * np.array([tilt.in_plane, tilt.out_of_plane])
        normal, along = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)])
        radii = 1.0 / motion.pinion_curvature + 1.0 / motion.gear_curvature
        expected = moved @ normal + np.sign(radii) * (np.hypot(radii, moved @ along) - abs(radii))
        assert found[n, k] == pytest.approx(expected, rel=1e-6)
    assert len(turns) > 2


def test_pitch_errors_of_both_gears_add_up():
    pinion, gear = np.arange(18) * 1e-6, np.sin(np.arange(36)) * 1e-6
    modified = Modifications(
        FlankModification(pitch_error=tuple(pinion)), FlankModification(pitch_error=tuple(gear))
    )
    numbers = np.array([[0, 5], [-3, 41]])
    np.testing.assert_allclose(pitch_gap(modified, numbers), pinion[numbers % 18] + gear[numbers % 36])


def test_a_bias_twists_the_flank():
    """±b in the corners of the active flank, 0 along its middles; the gear's tip meets the pinion's root."""
    rolls, ends = at(START, 0.5 * (START + END), END), np.array([-WIDTH, 0.0, WIDTH]) / 2.0
    # an involute's place on the path goes in proportion to the roll
    twisted = np.array([[6.0, 0.0, -6.0], [0.0, 0.0, 0.0], [-6.0, 0.0, 6.0]]) * 1e-6
    for flank, sign in (("pinion", 1.0), ("gear", -1.0)):
        modified = Modifications(**{flank: FlankModification(bias=6e-6)})
        assert vary_along_lead(modified)
        np.testing.assert_allclose(flank_gap(ASSEMBLY, modified, rolls, ends), sign * twisted, atol=1e-12)
        from_behind = flank_gap(ASSEMBLY, turned_round(modified), rolls, -ends)
        np.testing.assert_allclose(from_behind, sign * twisted, atol=1e-12)


def test_a_helix_slope_opens_the_end_of_the_face():
    """Half of it missing at the end, half of it added at the start, from root to tip."""
    rolls, ends = at(START, END), np.array([-WIDTH, 0.0, WIDTH]) / 2.0
    for flank in ("pinion", "gear"):
        modified = Modifications(**{flank: FlankModification(lead=LeadRelief(slope=8e-6))})
        assert vary_along_lead(modified)
        for seen, places in ((modified, ends), (turned_round(modified), -ends)):
            gap = flank_gap(ASSEMBLY, seen, rolls, places)
            np.testing.assert_allclose(gap, [[-4e-6, 0.0, 4e-6]] * 2, atol=1e-12)


def test_everything_adds_up():
    flank = FlankModification(tip=Relief(20e-6, 2e-3), lead=LeadRelief(8e-6, 8e-6))
    modified = Modifications(flank, TIP, Misalignment(in_plane=1e-3))
    where = np.array([0.5 * WIDTH])
    assert flank_gap(ASSEMBLY, modified, at(END), where)[0, 0] == pytest.approx(
        20e-6 + 8e-6 + 1e-3 * WIDTH / 2
    )


@pytest.mark.parametrize(
    ("flank", "key"),
    [
        (FlankModification(tip=Relief(-1e-6, 2e-3)), "tip_relief"),
        (FlankModification(tip=Relief(1e-5, -1e-3)), "tip_relief_length"),
        (FlankModification(tip=Relief(1e-5, 0.0)), "tip_relief = .*how far"),
        (FlankModification(lead=LeadRelief(0.0, 1e-5, WIDTH)), "lead_unmodified"),
        (FlankModification(pitch_error=(1e-6, 2e-6)), "pitch_errors"),
    ],
)
def test_what_is_no_modification_is_refused(flank, key):
    with pytest.raises(InputError, match=rf"drive\.gear\.modification\.{key}"):
        check_modifications(ASSEMBLY, Modifications(gear=flank))


def test_only_reliefs_with_a_corner_make_kinks_and_on_the_path_alone():
    path = ASSEMBLY.r_end - ASSEMBLY.r_start
    rolls = {"pinion": {"root": START, "tip": END}, "gear": {"tip": START, "root": END}}
    for side, ends in rolls.items():
        for name, end in ends.items():
            sign = 1.0 if end == START else -1.0
            for relief, kink in (
                (Relief(9e-6, 3e-3, 1.0), True),
                (Relief(9e-6, 3e-3, 1.9), True),
                (Relief(9e-6, 3e-3, 2.0), False),
                (Relief(0.0, 3e-3, 1.0), False),
                (Relief(9e-6, 1.001 * path, 1.0), False),
            ):
                flank = FlankModification(**{name: relief})
                found = relief_rolls(ASSEMBLY, Modifications(**{side: flank}))
                np.testing.assert_allclose(found, [end + sign * 3e-3 / BASE] if kink else [])


@pytest.mark.parametrize("side", ["pinion", "gear"])
@pytest.mark.parametrize(("shift", "of_the_tip"), [(1.0, True), (-0.1, False)])
def test_a_relief_of_a_tip_leaves_half_of_its_thickness(side, shift, of_the_tip):
    """Of a pointed tooth; of others a tenth of the module, as everything else."""
    body = GearBody(23, shift, 1.1, 1.25, 0.25, WIDTH, 12e-3)
    assembly = assemble(FAMILY, Drive(3e-3, ANGLE, body, body))
    tooth = assembly.tooth(side)
    x, y = flank_point(tooth, np.array(tooth.tip_distance))
    thickness = 2.0 * tooth.tip_radius * float(np.arctan2(y, x))
    assert (thickness / 4 < 0.3e-3) == of_the_tip
    most = {"tip": min(thickness / 4, 0.3e-3), "root": 0.3e-3}
    length = float(assembly.r_end - assembly.r_start)
    for name, amount in most.items():
        good, deep, long = (
            FlankModification(**{name: Relief(share * amount, reach)})
            for share, reach in ((0.999, 0.999 * length), (1.001, 1e-3), (0.5, 1.001 * length))
        )
        check_modifications(assembly, Modifications(**{side: good}))
        with pytest.raises(InputError, match=f"{name}_relief = .*deepest relief"):
            check_modifications(assembly, Modifications(**{side: deep}))
        with pytest.raises(InputError, match=f"{name}_relief_length = .*path of contact"):
            check_modifications(assembly, Modifications(**{side: long}))


def test_errors_and_reliefs_of_the_lead_are_at_most_a_tenth_of_the_module():
    roll = np.linspace(START, END, 5)

    def flanks(most):
        yield "lead_relief_start", FlankModification(lead=LeadRelief(start=most))
        yield "lead_relief_end", FlankModification(lead=LeadRelief(end=most))
        yield "crowning", FlankModification(lead=LeadRelief(crowning=most))
        for sign in (1.0, -1.0):
            error = sign * most * np.array([0.0, 0.3, 1.0, 0.2, 0.1])
            yield "profile_error", FlankModification(profile_error=(roll, error))
            yield "pitch_errors", FlankModification(pitch_error=(*([0.0] * 35), sign * most))

    for (_, good), (key, bad) in zip(flanks(0.2999e-3), flanks(0.3001e-3), strict=True):
        check_modifications(ASSEMBLY, Modifications(gear=good))
        with pytest.raises(InputError, match=f"{key} = .*at most 300 um, the tenth of the module"):
            check_modifications(ASSEMBLY, Modifications(gear=bad))


@pytest.mark.parametrize(
    ("modified", "key", "value"),
    [
        # 13.35 mm to an end of the face: a milliradian is 13.35 µm there
        ((LeadRelief(), LeadRelief(), 4e-3), "mesh.misalignment.in_plane", "3.43775 arcmin"),
        (
            (LeadRelief(13e-6, 12e-6), LeadRelief(crowning=14e-6), 0.0),
            *("drive.gear.modification.crowning", "14 um"),
        ),
        (
            (LeadRelief(14e-6, 15e-6), LeadRelief(), 0.0),
            *("drive.pinion.modification.lead_relief_end", "15 um"),
        ),
    ],
)
def test_what_opens_the_flanks_most_is_named(modified, key, value):
    *leads, out_of_plane = modified
    flanks = [FlankModification(lead=lead) for lead in leads]
    modified = Modifications(*flanks, Misalignment(1e-3, out_of_plane))
    assert maximum_along_lead(ASSEMBLY, modified) == (key, value)


def test_profile_errors_are_read_at_the_roll_angle_where_each_flank_is_touched():
    roll = np.linspace(START, END, 9)
    errors = np.random.default_rng(3).normal(size=(2, 9)) * 1e-6
    modified = Modifications(*(FlankModification(profile_error=(roll, error)) for error in errors))
    inner, outside = at(*roll[1:-1]), at(END + 0.005)
    np.testing.assert_allclose(
        profile_gap(ASSEMBLY, modified, inner), np.sum(errors, axis=0)[1:-1], rtol=1e-9
    )
    # beyond the end the pinion's tip stays, and the gear is touched where an earlier contact was
    place = outside.gear_place[0] / BASE
    expected = errors[0, -1] + PchipInterpolator(roll, errors[1])(place)
    assert profile_gap(ASSEMBLY, modified, outside)[0] == pytest.approx(expected, rel=1e-6)


def test_a_flank_point_lies_where_its_place_says():
    """The coordinate of a relief: the tooth's own flank at the radius that the contact has there."""
    geometry = at(0.1)
    x, y = flank_point(ASSEMBLY.pinion, np.array([geometry.pinion_place[0]]))
    assert np.hypot(x, y)[0] == pytest.approx(geometry.pinion_radius[0], rel=1e-9)
