"""Teeth against the involute's closed forms, the rack that cut them, and simple solids."""

import numpy as np
import pytest

from tests.support.sample_drives import (
    DRIVES,
    HEAVILY_UNDERCUT,
    LIU_NI,
    SHIFTED,
    SOUND,
    STANDARD,
    UNDERCUT,
    bodies,
    body,
    root_radius,
)
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import (
    ToothOutline,
    gear_polygon,
    mass_and_inertia,
    section_area_and_inertia,
    tooth_outline,
)
from tribodyn.geometry.drive import SIDES, body_of, reference_radius, tip_radius
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.path import contact_limits, kinematics, seen_from
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.geometry.tooth import (
    contact_in_tooth_frame,
    cut_tooth,
    fillet_point,
    flank_point,
    thickness_half_angle,
)


@pytest.mark.parametrize("drive", [SHIFTED, STANDARD, UNDERCUT, HEAVILY_UNDERCUT])
@pytest.mark.parametrize("side", SIDES)
class TestInvolute:
    def test_thickness_at_every_radius(self, drive, side):
        tooth = cut_tooth(involute.FAMILY, drive, side)
        alpha, pitch = drive.pressure_angle, reference_radius(drive, side)
        at = np.linspace(tooth.form_radius, tooth.tip_radius, 9)
        alpha_at = np.arccos(pitch * np.cos(alpha) / at)
        teeth, shift = body_of(drive, side).teeth, body_of(drive, side).profile_shift
        # ISO 21771: s/(2r) = π/(2z) + 2 x tan α/z, then inv α − inv α_y more.
        expected = (np.pi / 2 + 2 * shift * np.tan(alpha)) / teeth
        expected = expected + (np.tan(alpha) - alpha) - (np.tan(alpha_at) - alpha_at)
        np.testing.assert_allclose(thickness_half_angle(tooth, at), expected, atol=1e-13)

    def test_flank_is_the_involute_of_the_base_circle(self, drive, side):
        tooth = cut_tooth(involute.FAMILY, drive, side)
        x, y = flank_point(tooth, np.linspace(tooth.form_distance, tooth.tip_distance, 9))
        at = np.hypot(x, y)
        np.testing.assert_allclose(np.arctan2(y, x), thickness_half_angle(tooth, at), atol=1e-13)


@bodies(DRIVES)
class TestOutline:
    def test_ends_on_root_and_tip_circles(self, family, drive, side):
        shape = tooth_outline(cut_tooth(family, drive, side))
        assert np.hypot(shape.fillet_x[0], shape.fillet_y[0]) == pytest.approx(
            root_radius(drive, side), rel=1e-14
        )
        assert np.hypot(shape.flank_x[-1], shape.flank_y[-1]) == pytest.approx(
            tip_radius(drive, side), rel=1e-14
        )
        assert np.arctan2(shape.fillet_y[0], shape.fillet_x[0]) == pytest.approx(
            shape.root_half_angle, rel=1e-13
        )
        assert shape.root_half_angle < np.pi / body_of(drive, side).teeth
        assert 0 < shape.tip_half_thickness < shape.flank_y[0]

    def test_rack_touches_the_fillet_and_never_cuts_it(self, family, drive, side):
        """Roll the corner past the tooth: the fillet is the envelope of its points, by no law of gearing."""
        tooth = cut_tooth(family, drive, side)
        pitch = tooth.path.pinion_pitch_radius
        normal = np.linspace(tooth.form_angle, np.pi / 2, 200)[:, None]
        roll = np.linspace(-0.6, 0.6, 1501)[None, :] * 4 * drive.module / pitch
        x = tooth.corner_x - tooth.corner_radius * np.cos(normal) + pitch * roll
        y = tooth.corner_y - tooth.corner_radius * np.sin(normal) + 0 * roll
        distance = np.hypot(x, pitch + y)

        def height(at):
            return np.sqrt(np.maximum(at - tooth.root_radius, 0.0))

        angle = tooth.half_angle + np.arctan2(x, pitch + y) - roll
        shape_x, shape_y = fillet_point(tooth, np.linspace(np.pi / 2, tooth.form_angle, 2000))
        # At the root circle the angle goes with the root of the height above it.
        shape_height, shape_angle = height(np.hypot(shape_x, shape_y)), np.arctan2(shape_y, shape_x)
        gap = (angle - np.interp(height(distance), shape_height, shape_angle)) * distance
        gap = np.where(distance <= tooth.form_radius, gap, np.inf)
        assert gap.min() > -1e-5 * drive.module
        assert gap.min() < 1e-5 * drive.module
        assert distance.min() == pytest.approx(tooth.root_radius, rel=1e-6)

    def test_load_has_the_arm_of_the_path(self, family, drive, side):
        path = family.working_path(drive)
        r = np.linspace(-1, 1, 5) * drive.module
        sign = 1 if side == "pinion" else -1
        view = seen_from(path, side)
        half_angle = thickness_half_angle(cut_tooth(family, drive, side), view.pinion_pitch_radius)
        contact = contact_in_tooth_frame(view, half_angle, sign * r)
        moment = contact.x * np.cos(contact.load_angle) - contact.y * np.sin(contact.load_angle)
        state = kinematics(path, r)
        arm = state.pinion_normal_arm if side == "pinion" else state.gear_normal_arm
        np.testing.assert_allclose(moment, arm, rtol=1e-12)


@bodies(SOUND)
class TestOutlineWithoutUndercut:
    def test_radius_grows_and_angle_falls_from_root_to_tip(self, family, drive, side):
        shape = tooth_outline(cut_tooth(family, drive, side), 200, 200)
        x = np.concatenate([shape.fillet_x, shape.flank_x[1:]])
        y = np.concatenate([shape.fillet_y, shape.flank_y[1:]])
        assert np.all(np.diff(np.hypot(x, y)) > 0)
        assert np.all(np.diff(np.arctan2(y, x)) < 0)

    def test_fillet_runs_tangentially_into_flank_and_root_circle(self, family, drive, side):
        tooth = cut_tooth(family, drive, side)
        step = 1e-6
        angle, r = tooth.form_angle, tooth.form_distance
        np.testing.assert_allclose(fillet_point(tooth, angle), flank_point(tooth, r), atol=1e-16)
        fillet = np.subtract(fillet_point(tooth, angle), fillet_point(tooth, angle + step))
        flank = np.subtract(flank_point(tooth, r + step * drive.module), flank_point(tooth, r))
        between = np.arctan2(fillet[1], fillet[0]) - np.arctan2(flank[1], flank[0])
        assert between == pytest.approx(0, abs=1e-4)
        start = fillet_point(tooth, np.pi / 2)
        along = np.subtract(fillet_point(tooth, np.pi / 2 - step), start)
        assert np.dot(along, start) / np.linalg.norm(along) / np.linalg.norm(start) < 1e-4

    def test_contact_lies_on_the_outline(self, family, drive, side):
        path = family.working_path(drive)
        limits = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
        sign = 1 if side == "pinion" else -1
        tooth, view = cut_tooth(family, drive, side), seen_from(path, side)
        half_angle = thickness_half_angle(tooth, view.pinion_pitch_radius)
        contact = contact_in_tooth_frame(view, half_angle, sign * np.linspace(*limits, 9))
        at = np.hypot(contact.x, contact.y)
        np.testing.assert_allclose(
            np.arctan2(contact.y, contact.x), thickness_half_angle(tooth, at), atol=1e-11
        )
        assert at.max() == pytest.approx(tooth.tip_radius, rel=1e-12)


class TestUndercut:
    @pytest.mark.parametrize("teeth", [6.0, 9.0, 12.0, 16.0, 18.0])
    @pytest.mark.parametrize("fillet_radius", [0.0, 0.25])
    def test_flank_ends_where_the_fillet_crosses_it(self, teeth, fillet_radius):
        drive = STANDARD._replace(pinion=body(teeth)._replace(fillet_radius=fillet_radius))
        tooth = cut_tooth(involute.FAMILY, drive, "pinion")
        assert tooth.overrun > 0
        base = reference_radius(drive, "pinion") * np.cos(drive.pressure_angle)
        assert tooth.form_radius > base
        np.testing.assert_allclose(
            fillet_point(tooth, tooth.form_angle), flank_point(tooth, tooth.form_distance), atol=1e-15
        )

    def test_vanishes_at_the_textbook_number_of_teeth(self):
        # z sin² α/2 = h, the height of the rack's straight flank: here exactly one module
        sine = np.sin(np.radians(20.0))
        rounding = 0.25 / (1 - sine)
        for teeth, undercut in ((2 / sine**2 - 0.01, True), (2 / sine**2 + 0.01, False)):
            drive = STANDARD._replace(pinion=body(teeth)._replace(fillet_radius=rounding))
            assert bool(cut_tooth(involute.FAMILY, drive, "pinion").overrun > 0) is undercut


@bodies(DRIVES)
class TestBody:
    def test_mass_of_the_polygon(self, family, drive, side):
        mass, inertia = mass_and_inertia(assemble(family, drive), side, 7850.0)
        points = gear_polygon(assemble(family, drive), side, 200)
        x, y = points[:, 0], points[:, 1]
        cross = x[:-1] * y[1:] - x[1:] * y[:-1]
        square = x[:-1] ** 2 + x[1:] ** 2 + x[:-1] * x[1:] + y[:-1] ** 2 + y[1:] ** 2 + y[:-1] * y[1:]
        width, bore = body_of(drive, side).face_width, body_of(drive, side).bore_radius
        area = cross.sum() / 2 - np.pi * bore**2
        second = (cross * square).sum() / 12 - np.pi / 2 * bore**4
        assert mass == pytest.approx(7850 * width * area, rel=1e-5)
        assert inertia == pytest.approx(7850 * width * second, rel=2e-5)


def test_polygons_touch_at_the_pitch_point():
    """The body frame is the drive's while a pair touches at P, so both polygons pass through P."""
    for family, drive in DRIVES:
        path = family.working_path(drive)
        for side, centre in (("pinion", -path.pinion_pitch_radius), ("gear", path.gear_pitch_radius)):
            points = gear_polygon(assemble(family, drive), side, 400) + np.array([0.0, centre])
            assert np.hypot(points[:, 0], points[:, 1]).min() < 0.01 * drive.module


def test_section_of_a_plain_ring():
    """A tooth outline without a tooth is a ring."""
    radius, teeth = 0.03, 20
    angle = np.linspace(0.9, 0.3, 4000) * np.pi / teeth
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    ring = ToothOutline(x[:2000], y[:2000], x[1999:], y[1999:], radius, radius, radius, angle[0], y[-1])
    area, inertia = section_area_and_inertia(ring, teeth, 0.01)
    assert area == pytest.approx(np.pi * (radius**2 - 0.01**2), rel=1e-8)
    assert inertia == pytest.approx(np.pi / 2 * (radius**4 - 0.01**4), rel=1e-8)


def test_geometry_sheet_of_liu_ni():
    sheet = geometry_sheet(assemble(crc.FAMILY, LIU_NI))
    assert sheet["contact ratio"][0] == pytest.approx(1.5233, abs=5e-4)
    assert sheet["centre distance"] == (pytest.approx(105.0), "mm")
    assert sheet["equivalent radius at end of contact"] == (pytest.approx(8.980, abs=5e-4), "mm")
    parts = sheet["approach contact ratio"][0] + sheet["recess contact ratio"][0]
    assert parts == pytest.approx(sheet["contact ratio"][0])
    assert sheet["pinion"]["tip diameter"][0] == pytest.approx(75.0)
    assert sheet["gear"]["root diameter"][0] == pytest.approx(133.5)
