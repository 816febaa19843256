"""Any gear with rolling elements that passes its checks: balance, energy, period, scaling."""

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tribodyn.studies.irefc.engagement import RollingFriction, element_angles, engage
from tribodyn.studies.irefc.geometry import (
    RollingDrive,
    cam_outline,
    check_drive,
    contact_points,
    crown_outline,
    element_centres,
    element_radius_limits,
    normal_direction,
)

POWER, SPEED = 1500.0, 157.0


@st.composite
def drives(draw: st.DrawFn) -> RollingDrive:
    shape = RollingDrive(
        pitch_radius=draw(st.floats(1e-3, 1.0)),
        elements=draw(st.integers(3, 60)),
        displacement=draw(st.floats(1.02, 3.0)),
        element_radius=1.0,
    )
    share = draw(st.floats(0.05, 0.95))
    return shape._replace(element_radius=share * min(element_radius_limits(shape).values()))


FRICTIONS = st.builds(RollingFriction, st.floats(0.0, 1e-5), st.floats(0.0, 0.3))
TURNS = st.lists(st.floats(0.0, 20.0), min_size=1, max_size=4).map(np.array)


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


@settings(max_examples=50, deadline=None)
@given(drives(), FRICTIONS, TURNS)
def test_torques_balance_and_energy_is_kept(drive: RollingDrive, friction: RollingFriction, turn: np.ndarray):
    check_drive(drive)
    run = engage(drive, element_angles(drive, turn), POWER, SPEED, friction)
    push = -run.normal_load[..., None] * normal_direction(drive, run.element_angle)
    on_cam, on_crown = contact_points(drive, run.element_angle)
    centre = np.array([drive.eccentricity, 0.0])
    torque = POWER / SPEED
    np.testing.assert_allclose(-cross(centre, push.sum(axis=-2)), torque, rtol=1e-9)
    np.testing.assert_allclose(-cross(on_cam - centre, push).sum(axis=-1), torque * drive.ratio, rtol=1e-9)
    np.testing.assert_allclose(cross(on_crown, -push).sum(axis=-1), torque * (1 + drive.ratio), rtol=1e-9)
    lost = run.power_in - run.power_out
    np.testing.assert_allclose(lost, run.power_friction, rtol=1e-9, atol=1e-9 * POWER)
    assert (run.power_cam >= 0).all()
    assert (run.power_crown >= 0).all()
    assert (run.normal_load >= 0).all()
    # half of the elements carry, up to the one that stands at a dead point
    loaded = np.sum(run.normal_load > 0, axis=-1)
    assert (np.abs(loaded - drive.elements / 2) <= 1).all()


@settings(max_examples=25, deadline=None)
@given(drives(), FRICTIONS, st.floats(0.0, 6.0))
def test_the_pattern_repeats_when_each_element_takes_its_neighbours_place(
    drive: RollingDrive, friction: RollingFriction, start: float
):
    turn = start + np.array([0.0, 2 * np.pi / (drive.elements + 1)])
    run = engage(drive, element_angles(drive, turn), POWER, SPEED, friction)
    for values in (run.normal_load, run.slip_speed, run.power_cam, run.power_crown):
        size = np.abs(values).max() + 1e-300
        np.testing.assert_allclose(np.roll(values[1], -1) / size, values[0] / size, atol=1e-9)


@settings(max_examples=25, deadline=None)
@given(drives(), FRICTIONS, st.floats(0.5, 4.0))
def test_losses_of_a_gear_of_another_size(drive: RollingDrive, friction: RollingFriction, factor: float):
    """At one torque loads fall as 1/size while slip grows with it, so that sliding keeps its loss."""
    larger = drive._replace(
        pitch_radius=factor * drive.pitch_radius, element_radius=factor * drive.element_radius
    )
    angle = element_angles(drive, np.array([0.3]))
    first, second = (engage(size, angle, POWER, SPEED, friction) for size in (drive, larger))
    np.testing.assert_allclose(second.normal_load * factor, first.normal_load, rtol=1e-9)
    np.testing.assert_allclose(second.power_crown * factor, first.power_crown, rtol=1e-9)
    sliding = [run.power_cam - run.power_crown for run in (first, second)]
    np.testing.assert_allclose(sliding[1], sliding[0], rtol=1e-6, atol=1e-9 * POWER)


@settings(max_examples=15, deadline=None)
@given(drives())
def test_profiles_close_and_keep_clear_of_every_element(drive: RollingDrive):
    assume(drive.elements <= 30)
    centres = element_centres(drive, drive.element_pitch * np.arange(drive.elements))
    cam_centre = np.array([drive.eccentricity, 0.0])
    for outline in (cam_outline(drive, 200) + cam_centre, crown_outline(drive, 200)):
        np.testing.assert_allclose(outline[0], outline[-1], atol=1e-9 * drive.pitch_radius)
        gaps = np.hypot(*(outline[None] - centres[:, None]).transpose(2, 0, 1))
        # touched, and never entered: what undercut or overlap would break
        assert gaps.min() > (1 - 1e-6) * drive.element_radius
