"""Along the path of contact: positions, given loads, loads that balance the torque, jumps spread."""

import math

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.path import kinematics
from tribodyn.studies.ehl import along_path
from tribodyn.studies.ehl.along_path import PairWay, PreparedEhl, prepare
from tribodyn.studies.protocol.load import load

POSITIONS = 6


@pytest.fixture(scope="module")
def study() -> PreparedEhl:
    return prepare(load("ehl-crc-23-47", {"output.positions": POSITIONS}).case)


@pytest.fixture(scope="module")
def over(study: PreparedEhl) -> PairWay:
    return along_path._way(study, POSITIONS, None)


def test_given_loads_are_those_of_the_way(study: PreparedEhl):
    start, end = float(study.cycle.roll_start), float(study.cycle.roll_end)
    span = end - start
    roll, load = along_path.given_loads(
        (np.array([start, 0.0, end]), np.array([-3.0, 4.0, 0.0])), (start, end)
    )
    assert (list(roll), list(load)) == ([start, 0.0, end], [0.0, 4.0, 0.0])
    for low, high, good in (
        (0.019, -0.019, True),
        (-0.019, 0.019, True),
        (0.021, 0.0, False),
        (-0.021, 0.0, False),
        (0.0, 0.021, False),
        (0.0, -0.021, False),
    ):
        ends = np.array([start + low * span, end + high * span]), np.array([1.0, 0.0])
        if good:
            along_path.given_loads(ends, (start, end))
        else:
            with pytest.raises(InputError, match=f"where a pair touches at {math.degrees(start):.4g}"):
                along_path.given_loads(ends, (start, end))
    with pytest.raises(InputError, match="nowhere above 0"):
        along_path.given_loads((np.array([start, end]), np.array([0.0, -1.0])), (start, end))


def test_the_way_is_divided_evenly_and_its_loads_balance_the_torque(study: PreparedEhl, over: PairWay):
    cycle, path = study.cycle, study.assembly.path
    span = float(cycle.roll_end - cycle.roll_start)
    expected = [float(cycle.roll_start) + (i + 0.5) * span / POSITIONS for i in range(POSITIONS)]
    np.testing.assert_allclose(over.roll, expected, rtol=1e-12)
    for at, roll in enumerate(expected):
        motion = kinematics(path, path.signed_distance(np.array([roll])))
        assert over.radius[at] == pytest.approx(1.0 / float(motion.relative_curvature[0]))
        assert over.speeds[0][at] == pytest.approx(10.0 * float(motion.pinion_speed[0]))
        assert over.speeds[1][at] == pytest.approx(10.0 * float(motion.gear_speed[0]))
    nodes, line_loads = over.table
    np.testing.assert_allclose(over.line_load, np.interp(expected, nodes, line_loads))
    np.testing.assert_allclose(over.normal_load, over.line_load * float(cycle.face_width))
    # all loads over a way turn the gear through a pitch: mean of load times arm over the pitch is the torque
    arms = kinematics(path, path.signed_distance(nodes)).gear_normal_arm
    turned = np.trapezoid(line_loads * float(cycle.face_width) * np.asarray(arms), nodes)
    assert turned / float(cycle.pitch_angle) == pytest.approx(500.0, rel=2e-3)


def test_the_oil_is_drawn_through_half_a_contact(study: PreparedEhl, over: PairWay):
    found = along_path.jump_width(study, 3e5, over.radius, over.speeds)
    half = math.sqrt(8.0 * 3e5 * float(np.median(over.radius)) / (math.pi * 226.37e9))
    speeds = np.abs(over.speeds[0] + over.speeds[1]) / 2.0
    assert found == pytest.approx(10.0 * half / float(np.median(speeds)), rel=1e-4)


def test_a_step_becomes_two_parabolas():
    """Averaged twice over half the width: once differentiable, over the whole width."""
    width, at = 0.02, 0.11
    fine, values = along_path._spread(np.array([0.0, at, at, 0.3]), np.array([2.0, 2.0, 5.0, 5.0]), width)
    assert (fine[0], fine[-1]) == (0.0, 0.3)
    away = np.clip((fine - at) / width, -0.5, 0.5)
    share = np.where(away < 0.0, 2.0 * (0.5 + away) ** 2, 1.0 - 2.0 * (0.5 - away) ** 2)
    assert values.shape == fine.shape
    np.testing.assert_allclose(values, 2.0 + 3.0 * share, atol=0.1)
    assert np.trapezoid(values, fine) == pytest.approx(2.0 * at + 5.0 * (0.3 - at), rel=2e-3)
