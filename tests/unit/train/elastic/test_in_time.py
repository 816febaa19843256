"""Rolling bearings element by element: the static law, closed forms of variable compliance, smooth limits."""

import numpy as np
import pytest

from tests.support.bearings_in_time import alone
from tribodyn.train.elastic.bearing_types import self_aligning_balls, spherical_rollers
from tribodyn.train.elastic.in_time import passing_elements
from tribodyn.train.elastic.rolling_bearing import BallRow, RollerRow, answer, ball_constant, roller_constant

DEEP = BallRow(9, 12e-3, 60e-3, clearance=10e-6)
ANGULAR = BallRow(14, 9e-3, 55e-3, contact_angle=np.radians(25.0), thrust=-1, preload=4e-6)
CYLINDRICAL = RollerRow(14, 11e-3, 11e-3, 60e-3, clearance=8e-6)
TAPERED = RollerRow(
    16, 10e-3, 13e-3, 66e-3, contact_angle=np.radians(15.0), thrust=1, preload=5e-6, profiled=False
)
ALIGNING = self_aligning_balls(BallRow(9, 9e-3, 60e-3, contact_angle=np.radians(11.0), clearance=8e-6)).rows[
    1
]
SPHERICAL = spherical_rollers(
    RollerRow(14, 11e-3, 9e-3, 60e-3, contact_angle=np.radians(12.0), clearance=5e-6)
).rows[1]
ROWS = [DEEP, ANGULAR, CYLINDRICAL, TAPERED, ALIGNING, SPHERICAL]
MOVED = np.array([11e-6, -7e-6, 5e-6, 2e-4, -3e-4])


@pytest.mark.parametrize("row", ROWS)
def test_at_rest_it_is_the_static_bearing_with_its_stiffness(row: BallRow | RollerRow):
    """Force, energy and, by differences, stiffness matrix of `answer`; of a number as of arrays."""
    still = answer(row, MOVED)
    *forces, _, energy = alone(row, MOVED)
    assert forces == pytest.approx(still.force, rel=1e-10, abs=1e-6)
    assert energy == pytest.approx(still.energy, rel=1e-10)
    step = 1e-11 * np.array([1.0, 1.0, 1.0, 30.0, 30.0])
    ahead = np.array(alone(row, MOVED[:, None] + np.diag(step))[:5])
    behind = np.array(alone(row, MOVED[:, None] - np.diag(step))[:5])
    found = (ahead - behind) / (2.0 * step)
    assert found == pytest.approx(still.stiffness, rel=1e-4, abs=2e-4 * np.abs(still.stiffness).max())


@pytest.mark.parametrize("row", ROWS)
def test_the_cage_is_turned_by_what_the_energy_changes_with_it(row: BallRow | RollerRow):
    """∂V/∂θ at rest; turned by one element everything is as before."""
    at, step = 0.13, 1e-6
    energies = [alone(row, MOVED, at + sign * step)[6] for sign in (1.0, -1.0)]
    torque = alone(row, MOVED, at)[5]
    assert torque == pytest.approx((energies[0] - energies[1]) / (2.0 * step), rel=2e-4)
    assert abs(torque) > 1e-6
    whole = alone(row, MOVED, at + 2.0 * np.pi / row.elements)
    assert whole == pytest.approx(alone(row, MOVED, at), rel=1e-9)


@pytest.mark.parametrize(("angle", "loaded"), [(0.0, "under"), (np.pi / 8, "between")])
def test_closed_form_of_variable_compliance(angle: float, loaded: str):
    """Eight balls without clearance: one under the load and two at 45°, or two at 22.5° and two at 67.5°.

    C. S. Sunnersjö, J. Sound Vib. 58 (1978) 363: F = K δ^1.5 Σ cos^2.5 over the loaded balls.
    """
    row = BallRow(8, 12e-3, 60e-3)
    at = [0.0, 45.0, 45.0] if loaded == "under" else [22.5, 22.5, 67.5, 67.5]
    total = np.sum(np.cos(np.radians(at)) ** 2.5)
    found = alone(row, np.array([20e-6, 0.0, 0.0, 0.0, 0.0]), angle)
    force = ball_constant(row) * 20e-6**1.5 * total
    assert found[0] == pytest.approx(force, rel=1e-12)
    assert np.abs(found[1:6]).max() < 1e-9 * force
    assert found[6] == pytest.approx(force * 20e-6 / 2.5, rel=1e-12)


def test_closed_form_of_rollers_with_clearance():
    """Straight rollers: one under the load, two at 60° that carry beyond the clearance's half."""
    row = RollerRow(6, 11e-3, 11e-3, 60e-3, clearance=6e-6, profiled=False)
    pressed = np.array([20e-6 - 3e-6, 10e-6 - 3e-6])
    each = roller_constant(row) * pressed ** (10.0 / 9.0)
    found = alone(row, np.array([0.0, 20e-6, 0.0, 0.0, 0.0]), np.pi / 2.0)
    assert found[1] == pytest.approx(each[0] + 2.0 * 0.5 * each[1], rel=1e-12)


def test_many_balls_are_a_smooth_bearing():
    """Sjövall's integral of a half-loaded bearing, 0.2288 Z K δ^1.5; nothing of the cage is left."""
    moved = np.array([20e-6, 0.0, 0.0, 0.0, 0.0])
    variations = []
    for elements in (9, 18, 36):
        row = BallRow(elements, 3e-3, 60e-3)
        angles = np.linspace(0.0, 2.0 * np.pi / elements, 25)
        force = np.array([alone(row, moved, angle)[0] for angle in angles])
        smooth = elements * ball_constant(row) * 20e-6**1.5
        assert np.mean(force[:-1]) / smooth == pytest.approx(0.2288, rel=2e-3)
        variations.append(np.ptp(force) / smooth)
    assert variations[1] < 0.2 * variations[0]
    assert variations[2] < 0.2 * variations[1]


def test_elements_pass_as_published():
    """SKF 6205-2RS JEM, 9 balls of 7.94 mm on 39.04 mm: multiples of the shaft's speed as published.

    Case Western Reserve University, Bearing Data Center; of the ball its defect's, which meets both rings.
    """
    found = passing_elements(BallRow(9, 7.94e-3, 39.04e-3))
    assert found.outer_pass == pytest.approx(3.5848, abs=1e-3)
    assert found.inner_pass == pytest.approx(5.4152, abs=1e-3)
    assert found.cage == pytest.approx(0.39828, abs=1e-4)
    assert 2.0 * found.element_spin == pytest.approx(4.7135, abs=2e-3)
