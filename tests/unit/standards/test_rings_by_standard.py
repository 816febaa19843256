"""The path of contact of the standards for a ring and its planet, whichever drives."""

import numpy as np
import pytest

from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.standard import path_of
from tribodyn.geometry.path import kinematics
from tribodyn.standards.contact_path import (
    equivalent_radius,
    loss_factor,
    point_distances,
    rolling_speeds,
)
from tribodyn.studies.protocol.load import load_scenario

SPEED = 12.0


@pytest.fixture(scope="module", params=[False, True], ids=["planet drives", "ring drives"])
def pair(request: pytest.FixtureRequest):
    """The planet and the ring of the example of KISSsoft, whose pitch point lies beyond the path."""
    drive = load_scenario("wind-turbine-gearbox")
    mesh = next(mesh for mesh in drive.meshes if mesh.name == "second-ring-1")
    if request.param:
        return assembled(mesh.pair)
    return assembled(load_scenario("ring-36-93").pair)


def test_radii_and_speeds_are_those_of_the_geometry(pair):
    path = path_of(pair)
    assert path.contact_ratio == pytest.approx(float(pair.contact_ratio), rel=1e-9)
    places = point_distances(path)
    # the geometry counts from the pitch point, in the direction in which contact moves
    motion = kinematics(pair.path, places - places[3])
    assert equivalent_radius(path, places) == pytest.approx(1.0 / motion.relative_curvature, rel=1e-9)
    both = rolling_speeds(path, places, SPEED)
    own = SPEED * np.sign(float(pair.drive.pinion.teeth))  # a ring's own sense of rotation
    assert both[0] == pytest.approx(own * motion.pinion_speed, rel=1e-9)
    assert both[1] == pytest.approx(own * motion.gear_speed, rel=1e-9)
    assert np.all(np.array(both) > 0.0)


def test_the_loss_factor_is_the_integral_of_the_sliding(pair):
    """H_v = Σ∫ share |v_s| over the path in pitches, with half the load where two pairs are on it."""
    path = path_of(pair)
    x = np.linspace(0.0, path.length, 200_001)
    first, second = rolling_speeds(path, x, SPEED)
    pitch = path.base_pitch
    share = np.where((x < path.length - pitch) | (x > pitch), 0.5, 1.0)
    at_pitch_line = SPEED * abs(path.base_radius[0])
    integral = np.trapezoid(share * np.abs(first - second), x) / pitch / at_pitch_line
    assert loss_factor(path) == pytest.approx(integral, rel=1e-4)
