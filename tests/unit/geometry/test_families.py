"""Every family's path of contact: its derivatives and inverses, and what it is called after."""

import math
from functools import cache

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.drive import reference_radius, tip_radius
from tribodyn.geometry.families import (
    circular_arc,
    crc,
    cycloidal,
    involute,
    parabolic,
    points,
    s_gear,
    spline,
)
from tribodyn.geometry.path import contact_limits, kinematics, mirrored, position
from tribodyn.studies.drive_file import load_drive

SHIPPED = {
    "circular-arc-23-47": circular_arc,
    "cycloidal-23-47": cycloidal,
    "jia-parabolic-17-29": parabolic,
    "liu-ni-crc-23-47": crc,
    "liu-ni-involute-23-47": involute,
    "points-23-47": points,
    "s-gear-23-47": s_gear,
    "spline-23-47": spline,
}
STEP = 1e-7


@cache
def path_of(name):
    """Drive, path and places on it, off the pitch point, where slopes of some jump."""
    drive = load_drive(name).drive
    path = SHIPPED[name].FAMILY.working_path(drive)
    start, end = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    inner = np.array([0.93, 0.41, 0.11])
    return drive, path, np.concatenate([start * inner, end * inner[::-1]])


@pytest.mark.parametrize("name", SHIPPED)
def test_a_path_turns_the_pinion_as_its_normal_asks(name):
    """dr = r_p cos α dφ: the contact moves along the normal as fast as the pinion's flank does."""
    _, path, r = path_of(name)
    r_p = float(path.pinion_pitch_radius)
    around = (path.rotation(r + STEP) - path.rotation(r - STEP)) / (2 * STEP)
    np.testing.assert_allclose(around, 1.0 / (r_p * np.cos(path.pressure_angle(r))), rtol=1e-6)
    slope = (path.pressure_angle(r + STEP) - path.pressure_angle(r - STEP)) / (2 * STEP)
    np.testing.assert_allclose(path.pressure_angle_slope(r), slope, rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(path.signed_distance(path.rotation(r)), r, rtol=1e-9)
    assert float(path.rotation(0.0)) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("name", SHIPPED)
def test_seen_from_the_gear_it_is_the_same_path_turned_round(name):
    _, path, r = path_of(name)
    seen = mirrored(path)
    assert float(seen.pinion_pitch_radius) == float(path.gear_pitch_radius)
    np.testing.assert_allclose(seen.pressure_angle(-r), path.pressure_angle(r), rtol=1e-12)
    ratio = float(path.pinion_pitch_radius) / float(path.gear_pitch_radius)
    np.testing.assert_allclose(seen.rotation(-r), -ratio * path.rotation(r), rtol=1e-12)
    np.testing.assert_allclose(seen.signed_distance(seen.rotation(-r)), -r, rtol=1e-9)


@pytest.mark.parametrize("name", SHIPPED)
def test_speeds_and_curvatures_from_the_motion_of_the_contact(name):
    """Velocity of the contact in either gear's frame by differences of its position, per pinion speed."""
    _, path, r = path_of(name)
    motion = kinematics(path, r)
    r_p, r_g = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    turn = 1e-5

    def place(angle):
        return np.stack(position(path, path.signed_distance(path.rotation(r) + angle)))

    velocity = (place(turn) - place(-turn)) / (2 * turn)
    alpha = path.pressure_angle(r)
    x, y = position(path, r)
    # axes at (0, -r_p) and (0, r_g); the pitch point moves along +x on both
    own = velocity - np.stack([y + r_p, -x])
    other = velocity - r_p / r_g * np.stack([r_g - y, x])
    normal, along = np.stack([np.cos(alpha), np.sin(alpha)]), np.stack([-np.sin(alpha), np.cos(alpha)])
    np.testing.assert_allclose(np.sum(own * normal, axis=0), 0.0, atol=1e-9)
    np.testing.assert_allclose(np.sum(other * normal, axis=0), 0.0, atol=1e-9)
    speeds = [np.sum(velocity * along, axis=0) for velocity in (own, other)]
    np.testing.assert_allclose(np.abs(speeds[0]), motion.pinion_speed, rtol=1e-6)
    np.testing.assert_allclose(np.abs(speeds[1]), motion.gear_speed, rtol=1e-6)
    np.testing.assert_allclose(np.abs(speeds[0] - speeds[1]), np.abs(motion.sliding), rtol=1e-5, atol=1e-9)


def test_arcs_are_circles_and_parabolas_parabolas():
    drive, path, r = path_of("jia-parabolic-17-29")
    x, y = position(path, r)
    for half, p in ((r > 0, 2 * drive.shape.k1 * reference_radius(drive, "gear")),
                    (r < 0, 2 * drive.shape.k2 * reference_radius(drive, "pinion"))):  # fmt: skip
        np.testing.assert_allclose(x[half] ** 2, 2 * p * np.abs(y[half]), rtol=1e-12)
    drive, path, r = path_of("circular-arc-23-47")
    x, y = position(path, r)
    for half, diameter in ((r < 0, drive.shape.approach_diameter), (r > 0, drive.shape.recess_diameter)):
        sign = -1.0 if np.all(r[half] < 0) else 1.0
        # the centre stands off the pitch point across the tangent under α
        centre = (
            0.5 * diameter * sign * np.array([-np.sin(drive.pressure_angle), np.cos(drive.pressure_angle)])
        )
        np.testing.assert_allclose(
            np.hypot(x[half] - centre[0], y[half] - centre[1]), abs(diameter) / 2, rtol=1e-12
        )
    drive, path, r = path_of("cycloidal-23-47")
    x, y = position(path, r)
    for half, diameter in ((r < 0, -drive.shape.approach_circle), (r > 0, drive.shape.recess_circle)):
        np.testing.assert_allclose(x[half] ** 2 + (y[half] - diameter / 2) ** 2, diameter**2 / 4, rtol=1e-12)
    _, path, r = path_of("liu-ni-crc-23-47")
    curvature = kinematics(path, r).relative_curvature
    np.testing.assert_allclose(curvature, curvature[0], rtol=1e-9)


@pytest.mark.parametrize(("half", "name"), [(1, "k1"), (-1, "k2")])
def test_the_largest_parabola_reaches_zero_speed_at_the_mates_tip(half, name):
    """Beyond it the contact turns back on the flank of the gear in whose pitch circle the parabola lies."""
    drive, _, _ = path_of("jia-parabolic-17-29")
    most = parabolic.maximum_coefficient(drive, half)
    path = parabolic.working_path(drive._replace(shape=drive.shape._replace(**{name: most})))
    start, end = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    at = kinematics(path, np.array([end if half > 0 else start]))
    speed = at.gear_speed if half > 0 else at.pinion_speed
    assert speed[0] == pytest.approx(0.0, abs=1e-9)
    parabolic.check(drive._replace(shape=drive.shape._replace(**{name: 0.999 * most})))
    for wrong in (1.001 * most, 0.0, -0.1):
        with pytest.raises(InputError, match=name):
            parabolic.check(drive._replace(shape=drive.shape._replace(**{name: wrong})))


@pytest.mark.parametrize(
    ("module", "name", "value", "message"),
    [
        (circular_arc, "approach_diameter", 0.0, "needs a diameter"),
        (circular_arc, "recess_diameter", 2e-3, "use a larger one"),
        (circular_arc, "recess_diameter", -8e-3, "more negative"),
        (cycloidal, "approach_circle", 0.07, "of the pinion, whose diameter is 69 mm"),
        (cycloidal, "recess_circle", 0.142, "of the gear, whose diameter is 141 mm"),
        (cycloidal, "approach_circle", -0.01, "use less, such as 23 mm"),
        (cycloidal, "recess_circle", 3e-3, "another circle"),
    ],
)  # fmt: skip
def test_arcs_that_draw_no_flank_are_refused(module, name, value, message):
    drive, _, _ = path_of("circular-arc-23-47" if module is circular_arc else "cycloidal-23-47")
    with pytest.raises(InputError) as error:
        module.check(drive._replace(shape=drive.shape._replace(**{name: value})))
    assert message in str(error.value)
    assert error.value.key == f"drive.shape.{name}"


@pytest.mark.parametrize("module", [circular_arc, cycloidal, parabolic, crc])
def test_other_families_than_involutes_take_no_shift(module):
    name = next(name for name, family in SHIPPED.items() if family is module)
    drive = path_of(name)[0]
    module.check(drive)
    with pytest.raises(InputError, match="profile-shifted"):
        module.check(drive._replace(gear=drive.gear._replace(profile_shift=0.2)))


def test_an_arc_serves_until_its_angle_is_a_right_one_or_zero():
    angle = 0.3
    path = circular_arc.ArcPath(0.03, 0.05, angle, 0.02, -0.04)
    low, high = circular_arc.arc_ends(path)
    assert float(path.pressure_angle(low)) == pytest.approx(math.pi / 2, abs=0.06)
    assert float(path.pressure_angle(high)) == pytest.approx(0.0, abs=1e-3)
    assert low < 0.0 < high
