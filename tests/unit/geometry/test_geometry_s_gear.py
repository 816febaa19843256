"""S-gear paths whose ends are steep: the rack's height from r, and rotation, to rounding."""

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.geometry.drive import Drive, GearBody, tip_radius
from tribodyn.geometry.families.s_gear import PowerRackPath, SGearShape, working_path
from tribodyn.geometry.path import contact_limits, radius, seen_from

MODULE, PITCH_RADIUS = 0.003, 0.05
# Form factors down to where r would turn back at one module: 1.2730221010… for the exponent 1.9.
STEEP = [(1.31, 1.9), (1.2731, 1.9), (1.273023, 1.9), (1.2368, 1.8), (1.1397, 1.5)]


def cotangent(height, form, exponent):
    return exponent * form * (1 - height / form) ** ((exponent - 1) / exponent)


@pytest.mark.parametrize(("form", "exponent"), STEEP)
def test_pressure_angle_and_rotation_up_to_the_end_of_the_power_law(form, exponent):
    path = PowerRackPath(PITCH_RADIUS, 0.1, MODULE, form, exponent)
    height = np.linspace(0.0, 1.0, 101)[1:-1]
    cot = cotangent(height, form, exponent)
    r = MODULE * height * np.hypot(1.0, cot)
    np.testing.assert_allclose(path._height(r), MODULE * height, rtol=1e-12)
    np.testing.assert_allclose(path.pressure_angle(r), np.arctan2(1.0, cot), rtol=1e-12)
    # r_p φ = ∫ dr/cos α, over the height, in which nothing is steep:
    # dr/cos α = dy (tan α + cot α) − y dα/sin² α
    for at in (20, 60, -1):

        def rate(h):
            cot = cotangent(h, form, exponent)
            return 1 / cot + cot - h * cot * (exponent - 1) / exponent / (form - h)

        turned, _ = quad(rate, 0.0, height[at], epsabs=0.0, epsrel=1e-13)
        found = path.rotation(np.array([r[at], -r[at]])) * PITCH_RADIUS / MODULE
        np.testing.assert_allclose(found, [turned, -turned], rtol=1e-12)
    np.testing.assert_allclose(path.signed_distance(path.rotation(r)), r, rtol=1e-11)


def test_the_rack_goes_on_straight_above_one_module():
    path = PowerRackPath(PITCH_RADIUS, 0.1, MODULE, 1.31, 1.9)
    cot = cotangent(1.0, 1.31, 1.9)
    r = MODULE * np.array([1.0, 1.1, 1.3]) * np.hypot(1.0, cot)
    np.testing.assert_allclose(path.pressure_angle(r), np.arctan2(1.0, cot), rtol=1e-12)
    # on a straight path the rack moves by dr/cos α
    moved = np.diff(path.rotation(r)) * PITCH_RADIUS
    np.testing.assert_allclose(moved, np.diff(r) * np.hypot(1.0, cot) / cot, rtol=1e-12)


@pytest.mark.parametrize("shape", [SGearShape(1.31, 1.9), SGearShape(1.2731, 1.9), SGearShape(1.6, 1.8)])
def test_contact_ends_on_the_tip_circles_where_the_path_is_steep(shape):
    """From the left of a steep end Newton's step to a radius leads past it."""
    bodies = [GearBody(z, 0.0, 1.0, 1.25, 0.1, 0.02, 0.01) for z in (23.0, 47.0)]
    drive = Drive(MODULE, 0.0, bodies[0], bodies[1], shape)
    path = working_path(drive)
    start, end = contact_limits(path, tip_radius(drive, "pinion"), tip_radius(drive, "gear"))
    assert radius(path, end) == pytest.approx(tip_radius(drive, "pinion"), rel=1e-12)
    assert radius(seen_from(path, "gear"), -start) == pytest.approx(tip_radius(drive, "gear"), rel=1e-12)
