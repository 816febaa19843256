"""Loads, slip and losses of the gear with rolling elements: statics, rigid-body motion, quadrature."""

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.errors import InputError
from tribodyn.studies.irefc.engagement import (
    RollingFriction,
    element_angles,
    element_speed,
    engage,
    pattern_period,
    published_angles,
    slip_speed,
    spin_speed,
)
from tribodyn.studies.irefc.geometry import (
    RollingDrive,
    check_drive,
    contact_points,
    element_centres,
    element_radius_limits,
    normal_direction,
)

DRIVE = RollingDrive(pitch_radius=0.020, elements=26, displacement=1.4, element_radius=0.002)
ODD = RollingDrive(0.05, 11, 1.2, 0.0015)
POWER, SPEED = 1500.0, 1500.0 * np.pi / 30.0
FRICTION = RollingFriction(rolling_arm=1e-5, sliding_coefficient=0.1)


def revolution(drive: RollingDrive, samples: int = 40, friction: RollingFriction = FRICTION):
    turn = np.linspace(0.0, 2.0 * np.pi, samples * (drive.elements + 1) + 1)
    return engage(drive, element_angles(drive, turn), POWER, SPEED, friction)


@pytest.mark.parametrize("drive", [DRIVE, ODD])
def test_the_circles_roll_on_each_other(drive):
    """About the shaft the crown stands still; seen from the eccentric all have one speed at P."""
    speed, cage = 30.0, drive.pitch_radius
    crown, cam = drive.crown_pitch_radius, drive.cam_pitch_radius
    assert crown - cage == pytest.approx(cage - cam) == pytest.approx(drive.centre_distance)
    assert drive.eccentricity == pytest.approx(2 * drive.centre_distance)
    at_pitch_point = -speed * crown
    assert element_speed(drive, speed) == pytest.approx(at_pitch_point / cage)
    assert (at_pitch_point / cam + speed) * drive.ratio == pytest.approx(-speed)
    angles = element_angles(drive, np.zeros(1))[0]
    np.testing.assert_allclose(np.diff(angles), 2 * np.pi / drive.elements)
    # one pitch of the crown after another
    assert pattern_period(drive, SPEED) * (drive.elements + 1) == pytest.approx(2 * np.pi / SPEED)


@pytest.mark.parametrize("drive", [DRIVE, ODD])
def test_speeds_are_those_of_the_bodies_at_the_contacts(drive):
    """Angular speeds: shaft ω, cam −2 ω/(Z2 − 1), cage −ω/Z2; no slip of the element on the crown."""
    angle = np.linspace(0.1, 6.2, 9)
    count = drive.elements
    on_cam, on_crown = contact_points(drive, angle)
    centres = element_centres(drive, angle)

    def carried(points: np.ndarray, about: np.ndarray, speed: np.ndarray | float) -> np.ndarray:
        arm = points - about
        return np.stack([-speed * arm[..., 1], speed * arm[..., 0]], axis=-1)

    shaft, origin = SPEED, np.zeros(2)
    cage_centre = np.array([drive.centre_distance, 0.0])
    cam_centre = np.array([drive.eccentricity, 0.0])
    centre_speed = carried(cage_centre, origin, shaft) + carried(centres, cage_centre, -SPEED / count)
    tangent = np.stack([-1.0, 1.0]) * normal_direction(drive, angle)[..., ::-1]
    # v_centre + ω r_b tangent = 0 at the crown
    spin = -np.sum(centre_speed * tangent, axis=-1) / drive.element_radius
    at_crown = centre_speed + carried(on_crown, centres, spin)
    assert np.sum(at_crown * tangent, axis=-1) == pytest.approx(0.0, abs=1e-12)
    on_element = centre_speed + carried(on_cam, centres, spin)
    of_cam = carried(cam_centre, origin, shaft) + carried(on_cam, cam_centre, -2 * SPEED / (count - 1))
    slip = np.sum((on_element - of_cam) * tangent, axis=-1)
    assert slip_speed(drive, angle, SPEED, "corrected") == pytest.approx(slip)
    assert np.sum((on_element - of_cam) * normal_direction(drive, angle), axis=-1) == pytest.approx(
        0.0, abs=1e-12
    )
    in_cage = spin + SPEED / count
    assert spin_speed(drive, angle, SPEED, "corrected") == pytest.approx(np.abs(in_cage))


def test_load_passes_from_element_to_element():
    run = revolution(ODD, 100)
    loaded = run.normal_load > 1e-9 * run.normal_load.max()
    assert set(loaded.sum(axis=1)) == {5, 6}  # half of eleven, and half more
    assert loaded.any(axis=0).all()  # each has its turn
    # no jump: what changes between neighbouring samples halves with their distance
    steps = [np.abs(np.diff(revolution(ODD, n).normal_load, axis=0)).max() for n in (100, 200, 400)]
    assert steps[0] / steps[1] == pytest.approx(2.0, rel=0.05)
    assert steps[1] / steps[2] == pytest.approx(2.0, rel=0.05)


def test_mean_loss_is_that_of_quadrature_over_one_pitch():
    def lost(turn: float) -> float:
        state = engage(ODD, element_angles(ODD, np.array([turn])), POWER, SPEED, FRICTION)
        return float(state.power_friction[0])

    period = 2 * np.pi / (ODD.elements + 1)
    exact = quad(lost, 0.0, period, points=[period / 2], epsabs=0.0, epsrel=1e-10)[0] / period
    first, last = (abs(revolution(ODD, n).power_friction[:-1].mean() / exact - 1) for n in (8, 64))
    assert last < 1e-4
    # trapezoids over a curve with kinks: second order, uneven because kinks fall between samples
    assert np.log2(first / last) / 3 == pytest.approx(2.0, abs=0.3)


def test_corrected_losses_in_the_position_of_the_table():
    """Two figures of a separate computation of the restored equations: 1434 W of 1500, and 0.984."""
    angle = element_angles(DRIVE, np.zeros(1))
    coarse, fine = (engage(DRIVE, angle, POWER, SPEED, RollingFriction(arm, 0.1)) for arm in (1e-3, 1e-5))
    assert coarse.power_friction[0] == pytest.approx(1434.0, abs=0.5)
    assert fine.efficiency[0] == pytest.approx(0.984, abs=0.0005)


def test_published_speeds_lack_the_factor_of_the_frame():
    angle = published_angles(DRIVE)
    assert angle.shape == (1, 14)
    assert (angle[0, 0], angle[0, -1]) == (0.0, pytest.approx(np.pi))
    for law in (slip_speed, spin_speed):
        ratio = law(DRIVE, angle, SPEED, "corrected") / law(DRIVE, angle, SPEED, "as_published")
        assert ratio == pytest.approx(13.5)


def test_slip_lowers_the_loss_only_as_published():
    angle = published_angles(DRIVE)
    for mode, sign in (("as_published", -1), ("corrected", 1)):
        total = [
            engage(DRIVE, angle, POWER, SPEED, RollingFriction(1e-3, f), mode).power_friction[0]
            for f in (0.0, 0.1)
        ]
        assert sign * (total[1] - total[0]) > 0


@pytest.mark.parametrize(
    ("change", "key", "rule", "remedy"),
    [
        ({"elements": 2}, "drive.elements", "too few", "use 3 or more"),
        ({"displacement": 1.0}, "drive.displacement", "cusps or loops", "more than 1"),
        ({"displacement": 0.7}, "drive.displacement", "cusps or loops", "more than 1"),
        ({"element_radius": 0.0034}, "drive.element_radius", "overlap (from 3.375 mm)", "less than 3.375 mm"),
        ({"element_radius": 0.005}, "drive.element_radius", "the crown are undercut", "less than 3.375 mm"),
        ({"elements": 80}, "drive.element_radius", "overlap", "fewer elements"),
        ({"displacement": 1.02}, "drive.element_radius", "the cam are undercut", "larger pitch_radius"),
    ],
)
def test_what_cannot_be_made_is_refused_with_a_remedy(change, key, rule, remedy):
    with pytest.raises(InputError) as caught:
        check_drive(DRIVE._replace(**change))
    assert caught.value.key == key
    assert rule in caught.value.rule
    assert remedy in caught.value.remedy


def test_the_radius_that_a_remedy_gives_is_accepted():
    for drive in (DRIVE, ODD):
        check_drive(drive)
        check_drive(drive._replace(element_radius=0.999 * min(element_radius_limits(drive).values())))
