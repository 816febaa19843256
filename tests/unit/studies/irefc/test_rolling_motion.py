"""Times and angles of the gear with rolling elements, from the turning of its circles on each other."""

import numpy as np
import pytest

from tribodyn.studies.irefc.engagement import element_angles, element_speed, pattern_period, published_angles
from tribodyn.studies.irefc.geometry import RollingDrive

DRIVE = RollingDrive(0.05, 26, 1.4, 0.0035)


def test_the_circles_roll_on_each_other():
    """About the shaft the crown stands still; seen from the eccentric all have one speed at P."""
    speed, cage = 30.0, DRIVE.pitch_radius
    crown, cam = DRIVE.crown_pitch_radius, DRIVE.cam_pitch_radius
    assert crown - cage == pytest.approx(cage - cam) == pytest.approx(DRIVE.centre_distance)
    assert DRIVE.eccentricity == pytest.approx(2 * DRIVE.centre_distance)
    at_pitch_point = -speed * crown
    assert element_speed(DRIVE, speed) == pytest.approx(at_pitch_point / cage)
    relative_cam = at_pitch_point / cam
    assert (relative_cam + speed) * DRIVE.ratio == pytest.approx(-speed)


def test_elements_take_the_place_of_their_neighbours_once_a_period():
    period = pattern_period(DRIVE, 30.0)
    start, later = element_angles(DRIVE, np.array([0.0, 30.0 * period]))
    assert start[0] == 0.0
    np.testing.assert_allclose(np.diff(start), 2 * np.pi / 26)
    np.testing.assert_allclose(np.exp(1j * later), np.exp(1j * np.roll(start, 1)), atol=1e-12)
    assert 30.0 * period * 27 == pytest.approx(2 * np.pi)
    table = published_angles(DRIVE)
    assert table.shape == (1, 14)
    assert (table[0, 0], table[0, -1]) == (0.0, pytest.approx(np.pi))
