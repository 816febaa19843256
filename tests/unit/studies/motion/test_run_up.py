"""A run-up: the torque that accelerates the load is no vibration, and the verdict speaks of the course."""

import numpy as np
import pytest

from tribodyn.post.verdict import of_gears
from tribodyn.record.reader import Record
from tribodyn.studies.motion.run import run
from tribodyn.studies.protocol.load import load_scenario


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """48 mesh cycles in which the motor has twice the torque that the load takes."""
    path = tmp_path_factory.mktemp("run-up") / "run-up.h5"
    run(load_scenario("run-up", {"solver.cycles": 48, "operating.pinion_torque": "98 N*m"}), path)
    with Record(path) as opened:
        yield opened


def test_the_dynamic_factor_is_over_the_force_that_the_teeth_carry(record):
    """Of an involute the mesh force goes with the sum of the normal loads, which the record has."""
    cycles = record.summary["averaging_cycles"]
    force = np.sum(record["normal_load"], axis=1)[-40 * cycles - 1 :]
    expected = np.max(force) / np.mean(force[:-1])
    assert record.summary["dynamic_factor"] == pytest.approx(expected, rel=0.02)


def test_the_course_is_that_of_the_recorded_motion(record):
    course = record.summary["course"]
    speed = record["velocity"][:, 4]
    assert course["last_speed"] == pytest.approx(np.mean(speed[-80:]), rel=0.02)
    assert course["first_speed"] == pytest.approx(np.mean(speed[:80]), rel=0.1)
    place = int(np.searchsorted(record["time"], course["dynamic_factor"]["time"]))
    assert course["dynamic_factor"]["speed"] == pytest.approx(
        np.mean(speed[place - 40 : place + 40]), rel=0.02
    )
    first, *_ = of_gears(record)
    assert first.startswith("On the way from ")
    assert f"to {course['dynamic_factor']['value']:.2f} times their mean" in first
