"""The gear with rolling elements: profiles that close, touch every element and are as curved as they look."""

import numpy as np
import pytest

from tribodyn.studies.irefc.geometry import (
    RollingDrive,
    cam_outline,
    centre_path_curvature,
    contact_points,
    crown_outline,
    element_centres,
    lever_arm,
    normal_direction,
    pitch_point_distance,
)

DRIVE = RollingDrive(pitch_radius=0.020, elements=26, displacement=1.4, element_radius=0.002)
DRIVES = [DRIVE, RollingDrive(0.05, 11, 1.2, 0.0015), RollingDrive(0.01, 3, 2.0, 0.0004)]
PITCH_POINT = np.array([DRIVE.crown_pitch_radius, 0.0])


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    turn = np.exp(1j * angle) * (points[..., 0] + 1j * points[..., 1])
    return np.stack([turn.real, turn.imag], axis=-1)


def test_distance_and_arm_are_those_of_the_points_in_the_plane():
    angle = np.linspace(0.0, 2 * np.pi, 13)
    from_pitch_point = element_centres(DRIVE, angle) - PITCH_POINT
    assert np.hypot(*from_pitch_point.T) == pytest.approx(pitch_point_distance(DRIVE, angle))
    normal = normal_direction(DRIVE, angle)
    assert from_pitch_point == pytest.approx(normal * pitch_point_distance(DRIVE, angle)[:, None], abs=1e-15)
    to_centre = element_centres(DRIVE, angle) - [DRIVE.centre_distance, 0.0]
    arm = to_centre[:, 1] * normal[:, 0] - to_centre[:, 0] * normal[:, 1]
    # the arm of a line about the cage's centre: the cross product of any of its points with its direction
    assert lever_arm(DRIVE, angle) == pytest.approx(-arm, abs=1e-15)


@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("outline", [cam_outline, crown_outline])
def test_outlines_close_and_repeat_from_tooth_to_tooth(drive, outline):
    teeth = drive.elements + (-1 if outline is cam_outline else 1)
    points = outline(drive, 40)
    assert points[0] == pytest.approx(points[-1], abs=1e-15)
    # while an element goes round once, it gains a tooth on the cam and loses one on the crown
    tooth = (-1 if outline is cam_outline else 1) * 2 * np.pi / teeth
    assert turned(points[:-40], tooth) == pytest.approx(points[40:], abs=1e-15)


@pytest.mark.parametrize("rotation", [0.0, 0.3, 1.7])
def test_every_element_touches_both_profiles_while_the_shaft_turns(rotation):
    """Bodies turned by their own speeds: cam −2 ω1/(Z2 − 1), cage −ω1/Z2, crown at rest: all stay tangent."""
    count = DRIVE.elements
    frame = rotation  # of the eccentric
    angle = DRIVE.element_pitch * np.arange(count) - rotation / count - frame
    centres = turned(element_centres(DRIVE, angle), frame)
    crown = crown_outline(DRIVE, 400)
    cam_turn = -2.0 * rotation / (count - 1)
    cam_centre = turned(np.array([DRIVE.eccentricity, 0.0]), frame)
    cam = cam_centre + turned(cam_outline(DRIVE, 400), cam_turn)
    for profile in (cam, crown):
        gaps = np.hypot(*(profile[None] - centres[:, None]).transpose(2, 0, 1)).min(axis=1)
        assert gaps == pytest.approx(DRIVE.element_radius, abs=2e-7)


@pytest.mark.parametrize("drive", DRIVES)
def test_curvature_is_that_of_the_profile_drawn(drive):
    """The profile is r_b off the path of the centre: its radius from the points and from Euler and Savary."""
    per_tooth = 4000
    for sign, outline, part in ((-1, cam_outline, 0), (1, crown_outline, 1)):
        points = outline(drive, per_tooth)
        z = (points[..., 0] + 1j * points[..., 1])[: per_tooth + 1]
        velocity = np.gradient(z)[2:-2]
        bend = np.gradient(np.gradient(z))[2:-2]
        curvature = (velocity.conjugate() * bend).imag / np.abs(velocity) ** 3
        angle = np.linspace(0.0, 2 * np.pi, per_tooth + 1)[2:-2]
        path = centre_path_curvature(drive, angle)[part]
        radius = 1.0 / path + sign * drive.element_radius
        assert np.abs(curvature) == pytest.approx(np.abs(1.0 / radius), rel=2e-3, abs=1.0)


def test_contacts_lie_one_element_radius_from_the_centre():
    angle = np.linspace(0.1, 6.0, 7)
    for contact in contact_points(DRIVE, angle):
        assert np.hypot(*(contact - element_centres(DRIVE, angle)).T) == pytest.approx(DRIVE.element_radius)
