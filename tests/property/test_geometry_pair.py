"""What holds for every gear pair of any family that passes the checks."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.support.involute_forms import closed_form_contact_ratio
from tests.support.random_drives import DEGENERATE, FAMILIES, drives
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import gear_polygon, section_area_and_inertia, tooth_outline
from tribodyn.geometry.drive import SIDES, tip_radius
from tribodyn.geometry.path import (
    contact_limits,
    contact_ratio,
    distance_at_radius,
    kinematics,
    position,
    radius,
    seen_from,
)
from tribodyn.geometry.tooth import cut_tooth, flank_point, thickness_half_angle


def limits_of(family, drive):
    path = family.working_path(drive)
    return path, *contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))


fraction = st.floats(0.0, 1.0)
over_pairs = settings(max_examples=16, deadline=None)


@over_pairs
@given(drives())
def test_speeds_are_radii_of_curvature_times_rotation_of_the_normal(pair):
    path, start, end = limits_of(*pair)
    step = 2e-5 * (end - start)
    r = np.linspace(start, end, 41)
    r = r[np.abs(r) > 3 * step]  # a path may have a corner at P
    state = kinematics(path, r)
    w = path.pinion_pitch_radius / path.gear_pitch_radius

    def rise(of):
        """Fourth-order central difference, times 12 steps: a path may end just before it turns back."""
        return 8 * (of(r + step) - of(r - step)) - (of(r + 2 * step) - of(r - 2 * step))

    # κ = dα/dφ, by difference along the path, independent of the slope that `kinematics` uses.
    kappa = rise(path.pressure_angle) / rise(path.rotation)
    module = pair[1].module
    np.testing.assert_allclose(
        state.pinion_speed * state.pinion_curvature, 1 + kappa, atol=1e-5, err_msg="u_p = ω ρ_p (1 + κ)"
    )
    np.testing.assert_allclose(
        state.gear_speed * state.gear_curvature, w - kappa, atol=1e-5, err_msg="u_g = ω ρ_g (w − κ)"
    )
    np.testing.assert_allclose(state.sliding, (1 + w) * r, atol=1e-12 * module)
    # Friction takes as much from the pinion's torque balance as it leaves out of the gear's, and slides away
    # with the rest: T_p − w T_g = F_f (L_p − w L_g) = F_f v_s/ω_p at any normal load.
    np.testing.assert_allclose(
        state.pinion_friction_arm - w * state.gear_friction_arm, state.sliding, atol=1e-12 * module
    )
    np.testing.assert_allclose(state.pinion_normal_arm, w * state.gear_normal_arm, rtol=1e-12)
    assert np.all(state.pinion_speed > 0)
    assert np.all(state.gear_speed > 0)


@over_pairs
@given(drives(), fraction)
def test_flanks_touch_along_a_common_normal_through_the_pitch_point(pair, where):
    """Rotate both teeth, as cut, to any phase: they meet in one point and nowhere overlap."""
    family, drive = pair
    path, start, end = limits_of(family, drive)
    r = start + where * (end - start)
    # At P itself a cycloid's flank stands still, and steps along it have no direction.
    assume(abs(r) > 0.05 * drive.module or family.name not in DEGENERATE)
    rotation = path.rotation(r)
    w = path.pinion_pitch_radius / path.gear_pitch_radius
    module = drive.module
    points = {}
    for side in SIDES:
        view, tooth = seen_from(path, side), cut_tooth(family, drive, side)
        turned = rotation if side == "pinion" else -w * rotation
        pitch = view.pinion_pitch_radius
        half_angle = thickness_half_angle(tooth, pitch)
        distance = np.linspace(tooth.form_distance, tooth.tip_distance, 400)
        x, y = position(view, r if side == "pinion" else -r)
        contact_distance = distance_at_radius(tooth.path, np.hypot(x, pitch + y))
        placed = []
        for along in (contact_distance, contact_distance + 1e-6 * module, distance):
            x, y = flank_point(tooth, along)
            # Angle of the point from the line of centres, in the body's own view.
            angle = half_angle - turned - np.arctan2(y, x)
            placed.append((-np.hypot(x, y) * np.sin(angle), np.hypot(x, y) * np.cos(angle) - pitch))
        sign = 1.0 if side == "pinion" else -1.0
        points[side] = [sign * np.array(p) for p in placed]
    contact = points["pinion"][0]
    np.testing.assert_allclose(contact, points["gear"][0], atol=1e-9 * max(1.0, module / 0.003))
    np.testing.assert_allclose(contact, position(path, r), atol=1e-12)
    normal = np.array([np.cos(path.pressure_angle(r)), np.sin(path.pressure_angle(r))])
    for side in SIDES:
        tangent = points[side][1] - points[side][0]
        assert tangent @ normal / np.linalg.norm(tangent) == pytest.approx(0, abs=1e-5)
    # No penetration: seen from the pinion, every point of the gear's flank lies outside the pinion's.
    tooth = cut_tooth(family, drive, "pinion")
    pitch = path.pinion_pitch_radius
    x, y = points["gear"][2]
    distance, angle = np.hypot(x, pitch + y), np.arctan2(x, pitch + y)
    beside = (distance > tooth.form_radius) & (distance < tooth.tip_radius)
    flank = thickness_half_angle(tooth, distance[beside])
    gap = (angle[beside] + thickness_half_angle(tooth, pitch) - rotation - flank) * distance[beside]
    assert gap.min() > -1e-9 * module / 0.003


@pytest.mark.parametrize("name", FAMILIES)
@settings(max_examples=10, deadline=None)
@given(st.data())
def test_every_radius_of_a_flank_is_found_on_its_path(name, data):
    family, drive = data.draw(drives((name,)))
    for side in SIDES:
        tooth = cut_tooth(family, drive, side)
        radii = np.linspace(tooth.form_radius, tooth.tip_radius, 60)
        distance = distance_at_radius(tooth.path, radii)
        np.testing.assert_allclose(radius(tooth.path, distance), radii, rtol=1e-14)
        assert np.all(np.diff(distance) > 0)  # not where the path comes back to the same radius


@over_pairs
@given(drives())
def test_nothing_slides_at_the_pitch_point(pair):
    family, drive = pair
    state = kinematics(family.working_path(drive), 0.0)
    assert state.sliding == pytest.approx(0, abs=1e-15)
    if family.name in DEGENERATE:
        assert state.entrainment == pytest.approx(0, abs=1e-15)
    else:
        assert state.entrainment > 0


@over_pairs
@given(drives())
def test_contact_ratio(pair):
    family, drive = pair
    path, start, end = limits_of(family, drive)
    ratio = contact_ratio(path, start, end, drive.pinion.teeth)
    assert ratio >= 1
    if family.shiftable:
        assert ratio == pytest.approx(closed_form_contact_ratio(drive), rel=1e-12)
    if family.name == "crc":
        curvature = kinematics(path, np.linspace(start, end, 101)).relative_curvature
        np.testing.assert_allclose(curvature, curvature[50], rtol=1e-9)


@over_pairs
@given(drives(), st.floats(0.05, 0.95))
def test_curvature_is_that_of_the_flank_as_cut(pair, where):
    family, drive = pair
    path, start, end = limits_of(family, drive)
    r = start + where * (end - start)
    # Not across a corner of the path at P, where the curvature jumps.
    assume(abs(r) > 0.15 * drive.module or not family.corner)
    state = kinematics(path, r)
    for side, curvature in (("pinion", state.pinion_curvature), ("gear", state.gear_curvature)):
        view, tooth = seen_from(path, side), cut_tooth(family, drive, side)
        x, y = position(view, r if side == "pinion" else -r)
        along = distance_at_radius(tooth.path, np.hypot(x, view.pinion_pitch_radius + y))
        step = 2e-3 * drive.module
        x, y = flank_point(tooth, along + step * np.arange(-2, 3))
        # Central differences of fourth order.
        first, second = np.array([1, -8, 0, 8, -1]) / 12, np.array([-1, 16, -30, 16, -1]) / 12
        dx, dy, ddx, ddy = first @ x, first @ y, second @ x, second @ y
        # The flank runs outwards with the body on its left as x goes along the tooth: convex turns inwards.
        measured = (dy * ddx - dx * ddy) / (dx**2 + dy**2) ** 1.5
        assert measured == pytest.approx(curvature, rel=1e-4, abs=1e-5 / drive.module)


@over_pairs
@given(drives())
def test_outline_is_continuous_and_narrows_outwards(pair):
    family, drive = pair
    for side in SIDES:
        shape = tooth_outline(cut_tooth(family, drive, side), 80, 80)
        tooth = cut_tooth(family, drive, side)
        assert shape.fillet_x[-1] == pytest.approx(shape.flank_x[0], abs=1e-12)
        assert shape.fillet_y[-1] == pytest.approx(shape.flank_y[0], abs=1e-12)
        x = np.concatenate([shape.fillet_x, shape.flank_x[1:]])
        y = np.concatenate([shape.fillet_y, shape.flank_y[1:]])
        assert np.all(np.diff(np.hypot(x, y)) > -1e-15)
        assert np.all(np.diff(x) > 0)
        # Otherwise the tooth has a waist: undercut, or a normal that passes the axis on the far side.
        arm = kinematics(tooth.path, tooth.form_distance).pinion_friction_arm
        if arm > 0 and tooth.overrun <= 0:
            assert np.all(np.diff(np.arctan2(y, x)) < 0)
        assert shape.tip_half_thickness > 0


@over_pairs
@given(drives())
def test_gears_are_closed_and_as_large_as_their_section(pair):
    """The polygon closes, runs once round the axis between root and tip, and encloses the section's area."""
    family, drive = pair
    for side in SIDES:
        polygon = np.asarray(gear_polygon(assemble(family, drive), side))
        np.testing.assert_array_equal(polygon[0], polygon[-1])
        shape = tooth_outline(cut_tooth(family, drive, side), 200, 200)
        distance = np.hypot(*polygon.T)
        assert distance.min() > shape.root_radius * (1 - 1e-9)
        assert distance.max() < shape.tip_radius * (1 + 1e-9)
        x, y = polygon.T
        cross = x[:-1] * y[1:] - x[1:] * y[:-1]
        turned = np.sum(np.arctan2(cross, x[:-1] * x[1:] + y[:-1] * y[1:]))
        assert abs(turned) == pytest.approx(2 * np.pi, rel=1e-9)
        teeth = drive.pinion.teeth if side == "pinion" else drive.gear.teeth
        area, _ = section_area_and_inertia(shape, teeth, 0.0)
        assert abs(np.sum(cross) / 2) == pytest.approx(area, rel=2e-3)
