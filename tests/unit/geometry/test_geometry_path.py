"""Paths of contact against closed forms, an independent integrator, and Liu & Ni's drive."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tribodyn.geometry.drive import Drive, GearBody, reference_radius, tip_radius
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.path import (
    contact_limits,
    distance_at_radius,
    kinematics,
    mirrored,
    position,
    radius,
    seen_from,
)


def body(teeth, shift=0.0, addendum=1.0):
    return GearBody(teeth, shift, addendum, 1.25, 0.25, 0.02, 0.01)


def limits(family, drive):
    path = family.working_path(drive)
    return path, *contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))


LIU_NI = Drive(0.003, np.radians(22.81), body(23.0), body(47.0))
COMPARISON = Drive(0.003, np.radians(20.0), body(23.0), body(47.0))
SHIFTED = Drive(0.004, np.radians(20.0), body(17.0, 0.45), body(41.0, -0.12))
CRC_DRIVES = [
    LIU_NI,
    Drive(0.002, np.radians(20.0), body(30.0), body(30.0)),
    Drive(0.005, np.radians(18.0), body(40.0), body(21.0)),
    Drive(0.003, np.radians(24.0), body(17.0), body(110.0)),
]


def test_pressure_angles_at_both_ends_of_liu_ni_s_path():
    """From the integration of the defining quadratic, independent of this code."""
    path, start, end = limits(crc.FAMILY, LIU_NI)
    assert np.degrees(path.pressure_angle(start)) == pytest.approx(25.395, abs=1e-3)
    assert np.degrees(path.pressure_angle(end)) == pytest.approx(21.424, abs=1e-3)


@pytest.mark.parametrize("drive", CRC_DRIVES)
class TestCRC:
    def test_agrees_with_an_adaptive_integrator(self, drive):
        r_p, r_g = reference_radius(drive, "pinion"), reference_radius(drive, "gear")
        w, arm0 = r_p / r_g, r_p * np.sin(drive.pressure_angle)

        def rate(r, state):
            """dα/dr and dφ/dr with the root of the printed quadratic that is continuous at P."""
            alpha, _ = state
            a, b = r_p * np.sin(alpha), r**2
            linear = 2 * a * r + b * (1 - w)
            constant = a**2 + a * r * (1 - w) - b * w - a * arm0
            # (−q + √(q² − 4pc))/2p written so that nothing cancels on either side of P.
            kappa = -2 * constant / (linear + np.sign(r) * np.sqrt(linear**2 - 4 * b * constant))
            return [kappa / (r_p * np.cos(alpha)), 1 / (r_p * np.cos(alpha))]

        path, start, end = limits(crc.FAMILY, drive)
        for direction, last in ((-1, start), (1, end)):
            # So near to P that the second-order error of the series is below rounding.
            r0 = direction * 1e-7 * r_p
            phi0 = r0 / (r_p * np.cos(drive.pressure_angle))
            start_state = [drive.pressure_angle + (w - 1) / 3 * phi0, phi0]
            r = np.linspace(r0, last, 9)
            solution = solve_ivp(rate, (r0, last), start_state, "DOP853", t_eval=r, rtol=2.3e-14, atol=1e-15)
            np.testing.assert_allclose(path.pressure_angle(r), solution.y[0], atol=1e-11)
            np.testing.assert_allclose(path.rotation(r), solution.y[1], atol=1e-11)

    def test_is_known_a_tenth_beyond_where_the_racks_reach(self, drive):
        """Their tips are above the pitch point by r sin α, here by the dedendum of either body."""
        path = crc.FAMILY.working_path(drive)
        ends = np.array([path.lower, path.upper]) / 1.1
        height = ends * np.sin(path.pressure_angle(ends)) / drive.module
        np.testing.assert_allclose(height, [-1.25, 1.25], rtol=0.01)
        held = path.pressure_angle(np.array([path.lower, 2.0 * path.lower, 2.0 * path.upper, path.upper]))
        np.testing.assert_allclose(held[:2], held[0])
        np.testing.assert_allclose(held[2:], held[3])
        assert held[3] == pytest.approx(path.pressure_angle(0.999999 * path.upper), abs=1e-5)

    def test_series_at_the_pitch_point(self, drive):
        path = crc.FAMILY.working_path(drive)
        w = path.pinion_pitch_radius / path.gear_pitch_radius
        assert path.pressure_angle(0.0) == pytest.approx(drive.pressure_angle, abs=1e-13)
        kappa = path.pinion_pitch_radius * np.cos(drive.pressure_angle) * path.pressure_angle_slope(0.0)
        assert kappa == pytest.approx((w - 1) / 3, abs=1e-12)

    def test_equivalent_radius_is_constant(self, drive):
        """ρ_0 = r_p r_g sin α_p/(r_p + r_g)."""
        path, start, end = limits(crc.FAMILY, drive)
        equivalent = 1 / kinematics(path, np.linspace(start, end, 501)).relative_curvature
        r_p, r_g = reference_radius(drive, "pinion"), reference_radius(drive, "gear")
        np.testing.assert_allclose(
            equivalent, r_p * r_g * np.sin(drive.pressure_angle) / (r_p + r_g), rtol=1e-9
        )

    def test_swapping_the_bodies_mirrors_the_path(self, drive):
        swapped = drive._replace(pinion=drive.gear, gear=drive.pinion)
        path, other = crc.FAMILY.working_path(drive), crc.FAMILY.working_path(swapped)
        r = np.linspace(-1.5, 1.5, 7) * drive.module
        np.testing.assert_allclose(mirrored(path).pressure_angle(r), other.pressure_angle(r), atol=1e-12)
        np.testing.assert_allclose(mirrored(path).rotation(r), other.rotation(r), atol=1e-12)
        np.testing.assert_allclose(
            mirrored(path).pressure_angle_slope(r), other.pressure_angle_slope(r), atol=1e-8
        )


@pytest.mark.parametrize("drive", [COMPARISON, SHIFTED])
class TestInvolute:
    def test_curvatures_and_speeds(self, drive):
        path, start, end = limits(involute.FAMILY, drive)
        r = np.linspace(start, end, 21)
        state = kinematics(path, r)
        base = reference_radius(drive, "pinion") * np.cos(drive.pressure_angle)
        # On an involute the radius of curvature is the tangent from the contact to the base circle.
        rho_p = np.sqrt(radius(path, r) ** 2 - base**2)
        length = (path.pinion_pitch_radius + path.gear_pitch_radius) * np.sin(path.angle)
        np.testing.assert_allclose(1 / state.pinion_curvature, rho_p, rtol=1e-12)
        np.testing.assert_allclose(1 / state.gear_curvature, length - rho_p, rtol=1e-12)
        w = drive.pinion.teeth / drive.gear.teeth
        np.testing.assert_allclose(state.pinion_speed, rho_p, rtol=1e-12)
        np.testing.assert_allclose(state.gear_speed, w * (length - rho_p), rtol=1e-12)


@pytest.mark.parametrize("angle", np.radians([0.5, 3.0, 10.0, 20.0, 35.0, 50.0, 65.0]))
def test_inverse_involute(angle):
    assert involute.inverse_involute(np.tan(angle) - angle) == pytest.approx(angle, rel=1e-11)


@pytest.mark.parametrize(
    ("family", "drive"), [(crc.FAMILY, LIU_NI), (involute.FAMILY, COMPARISON), (involute.FAMILY, SHIFTED)]
)
class TestAnyPath:
    def test_contact_limits_lie_on_the_tip_circles(self, family, drive):
        path, start, end = limits(family, drive)
        x, y = position(path, end)
        assert np.hypot(x, y + path.pinion_pitch_radius) == pytest.approx(
            tip_radius(drive, "pinion"), rel=1e-14
        )
        x, y = position(path, start)
        assert np.hypot(x, y - path.gear_pitch_radius) == pytest.approx(tip_radius(drive, "gear"), rel=1e-14)
        assert start < 0 < end

    def test_no_sliding_at_the_pitch_point(self, family, drive):
        state = kinematics(family.working_path(drive), np.array([0.0]))
        np.testing.assert_allclose(state.sliding, 0.0, atol=1e-16)
        ratio = drive.pinion.teeth / drive.gear.teeth
        np.testing.assert_allclose(state.pinion_normal_arm / state.gear_normal_arm, ratio, rtol=1e-14)

    def test_curvature_of_both_bodies_agrees_from_either_side(self, family, drive):
        path, start, end = limits(family, drive)
        r = np.linspace(start, end, 7)
        ours, theirs = kinematics(path, r), kinematics(seen_from(path, "gear"), -r)
        np.testing.assert_allclose(ours.gear_curvature, theirs.pinion_curvature, rtol=1e-10)
        np.testing.assert_allclose(ours.pinion_curvature, theirs.gear_curvature, rtol=1e-10)

    def test_distance_at_radius_inverts_radius(self, family, drive):
        path, start, end = limits(family, drive)
        r = np.linspace(start, end, 7)
        np.testing.assert_allclose(distance_at_radius(path, radius(path, r)), r, atol=1e-14)
