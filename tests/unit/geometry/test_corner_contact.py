"""Contact of a tip's corner off the path: its motion from the line of action, its gap from drawn flanks."""

import numpy as np
import pytest

from tests.support.sample_drives import LIU_NI, STANDARD
from tribodyn.geometry.assembly import assemble, tip_corner_gap
from tribodyn.geometry.corner_contact import pair_geometry
from tribodyn.geometry.drive import Drive, GearBody, reference_radius
from tribodyn.geometry.families import crc, involute, spline
from tribodyn.geometry.tooth import fillet_point, flank_point

OFF = (-1.5e-3, -0.4e-3, 0.5e-3, 1.2e-3)


def beside(assembly):
    """Pinion angles before and beyond the path, by distances on the pitch circle."""
    start, end = assembly.roll_limits
    return np.array([(start if off < 0 else end) + off / assembly.path.pinion_pitch_radius for off in OFF])


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


#: Little clearance above a wide fillet: the tip cuts into it deep below the flank.
CUT = STANDARD._replace(
    pinion=STANDARD.pinion._replace(addendum=1.15, dedendum=1.2, fillet_radius=0.46),
    gear=STANDARD.gear._replace(addendum=1.15, dedendum=1.2, fillet_radius=0.46),
)


@pytest.mark.parametrize("drive", [STANDARD, CUT], ids=["clear", "cut"])
@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_the_tip_passes_the_fillet_at_the_gap_that_drawn_teeth_leave(side, drive):
    """The corner of the mate's tip, turned with its gear from the lowest contact to the line of centres."""
    assembly = assemble(involute.FAMILY, drive)
    mate = "gear" if side == "pinion" else "pinion"
    tooth, tip = assembly.tooth(side), float(assembly.tooth(mate).tip_radius)
    own, other = (float(reference_radius(STANDARD, body)) for body in (side, mate))
    base, other_base = (r * np.cos(STANDARD.pressure_angle) for r in (own, other))
    # the corner on the line of action, where contact begins on this flank
    reach = (own + other) * np.sin(STANDARD.pressure_angle) - np.sqrt(tip**2 - other_base**2)
    radius = np.hypot(base, reach)
    along = own * np.sin(STANDARD.pressure_angle) - reach
    x, y = along * np.cos(STANDARD.pressure_angle), other + along * np.sin(STANDARD.pressure_angle)
    begin = np.arctan2(x, y)
    assert np.hypot(x, y) == pytest.approx(tip, rel=1e-12)
    at = np.linspace(begin, 0.0, 4001)
    x, y = tip * np.sin(at), own + other - tip * np.cos(at)
    # in the frame of this gear, from where the corner touches its flank
    turned = (begin - at) * other / own
    angle = np.arctan2(x, y) - np.arctan2(x[0], y[0]) + turned
    profile = np.linspace(float(tooth.form_distance), float(tooth.tip_distance), 4001)
    flank_x, flank_y = flank_point(tooth, profile)
    touched = np.interp(radius, np.hypot(flank_x, flank_y), np.arctan2(flank_y, flank_x))
    fillet = fillet_point(tooth, np.linspace(np.pi / 2, float(tooth.form_angle), 4001))
    distance = np.hypot(x, y)
    half = np.interp(distance, np.hypot(*fillet), np.arctan2(fillet[1], fillet[0]))
    below = distance < float(tooth.form_radius)
    # it is the flank on the other side of the tooth, seen from there
    gap = np.min(((touched - angle - half) * distance)[below])
    assert float(tip_corner_gap(assembly, side)) == pytest.approx(gap, rel=0.03)  # of 129 places
    assert gap > 1e-6 if drive is STANDARD else gap < -5e-5


def test_the_gap_falls_evenly_with_every_higher_tip():
    """Where the corner leaves the flank the gap changes fast: samples beside that place made a saw of it."""
    angles = [18.035, 18.7279, 19.2733, 20.257, 21.0364, 21.2197, 22.025, 22.9261, 23.484, 24.0855]
    shape = spline.SplineShape(np.radians(angles), None, 36.9235e-3, 0.0)
    pinion = GearBody(19.0, 0.0, 0.8257, 1.25, 0.1005, 0.06, 0.027)
    gaps = []
    for addendum in np.arange(0.700, 0.745, 0.001):
        gear = GearBody(72.0, 0.0, addendum, 1.25, 0.1725, 0.06, 0.041)
        drive = Drive(4.735e-3, 0.0, pinion, gear, shape)
        gaps.append(float(tip_corner_gap(assemble(spline.FAMILY, drive), "pinion")))
    assert gaps[0] > 0.0 > gaps[-1]
    slopes = np.diff(gaps)
    assert np.max(slopes) < 0.0
    assert np.all(np.abs(np.diff(slopes)) < 0.1 * np.abs(slopes[1:]))
