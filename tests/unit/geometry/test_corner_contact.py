"""Contact of a tip's corner off the path: its motion from the line of action, its gap from drawn flanks."""

import numpy as np
import pytest

from tests.support.sample_drives import LIU_NI, STANDARD
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.families import crc, involute
from tribodyn.geometry.tooth import flank_point

OFF = (-1.5e-3, -0.4e-3, 0.5e-3, 1.2e-3)


def beside(assembly):
    """Pinion angles before and beyond the path, by distances on the pitch circle."""
    start, end = assembly.roll_limits
    return np.array([(start if one < 0 else end) + one / assembly.path.pinion_pitch_radius for one in OFF])


@pytest.mark.parametrize(("family", "drive"), [(involute.FAMILY, STANDARD), (crc.FAMILY, LIU_NI)])
def test_speeds_belong_together_on_and_off_the_path(family, drive):
    assembly = assemble(family, drive)
    roll = np.concatenate([beside(assembly), np.linspace(*assembly.roll_limits, 5)])
    motion = pair_geometry(assembly, roll).motion
    np.testing.assert_allclose(
        motion.entrainment, (motion.pinion_speed + motion.gear_speed) / 2.0, rtol=1e-12
    )
    np.testing.assert_allclose(motion.sliding, motion.pinion_speed - motion.gear_speed, atol=1e-12)


def test_off_the_path_involutes_still_move_along_the_line_of_action():
    """Arms and speeds of a point on the line of action, wherever on it."""
    assembly = assemble(involute.FAMILY, STANDARD)
    path, angle = assembly.path, STANDARD.pressure_angle
    r_p, r_g = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    found = pair_geometry(assembly, beside(assembly))
    s = found.motion.signed_distance
    assert s[0] < s[1] < assembly.r_start < assembly.r_end < s[2] < s[3]
    np.testing.assert_allclose(found.motion.pinion_friction_arm, r_p * np.sin(angle) + s, rtol=1e-9)
    np.testing.assert_allclose(found.motion.gear_friction_arm, r_g * np.sin(angle) - s, rtol=1e-9)
    np.testing.assert_allclose(found.motion.pinion_speed, r_p * np.sin(angle) + s, rtol=1e-9)
    np.testing.assert_allclose(found.motion.gear_speed, r_p / r_g * (r_g * np.sin(angle) - s), rtol=1e-9)


@pytest.mark.parametrize("place", range(len(OFF)))
def test_the_gap_is_what_the_pinion_must_turn_until_drawn_flanks_touch(place):
    """Flanks of both gears drawn point by point; the gap is the turn times the arm of the normal."""
    assembly = assemble(involute.FAMILY, STANDARD)
    roll = beside(assembly)[place]
    found = pair_geometry(assembly, np.array([roll]))
    r_p, r_g = float(assembly.path.pinion_pitch_radius), float(assembly.path.gear_pitch_radius)
    before = OFF[place] < 0
    # the corner belongs to the mate: the gear's tip before the path, the pinion's beyond it
    side, mate = ("pinion", "gear") if before else ("gear", "pinion")
    turn, own, other = (roll, r_p, r_g) if before else (-roll * r_p / r_g, r_g, r_p)
    tooth, corner = assembly.tooth(side), assembly.tooth(mate)

    def polar(tooth, distance):
        x, y = flank_point(tooth, distance)
        return np.hypot(x, y), np.arctan2(y, x)

    def half_at(tooth, radius):
        distance = np.linspace(float(tooth.form_distance), float(tooth.tip_distance), 20001)
        radii, half = polar(tooth, distance)
        return np.interp(radius, radii, half)

    tip = float(corner.tip_radius)
    # both flanks touch the pitch point at no turn: measured from it on either pitch circle
    at = (half_at(corner, other) - half_at(corner, tip)) + turn * own / other
    x, y = tip * np.sin(at), own + other - tip * np.cos(at)
    reach = np.hypot(x, y)
    angle = half_at(tooth, own) + np.arctan2(x, y) - turn - half_at(tooth, reach)
    base = own * np.cos(STANDARD.pressure_angle)
    assert found.gap[0] == pytest.approx(angle * base, rel=1e-5)
    assert found.gap[0] > 1e-7
    reached = found.pinion_radius[0] if before else found.gear_radius[0]
    assert reached == pytest.approx(reach, rel=1e-7)
