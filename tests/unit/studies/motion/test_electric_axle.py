"""The shipped axle with a differential: both wheels bear one torque, in both gears, in curves too."""

import pytest

from tests.support.train_scenarios import train_case
from tribodyn.input.sources import find_scenario

SECOND = {"link.0.ends": ["wheel-2", "sun-1"], "load.0.speed_ratio": "-3/25"}


@pytest.mark.parametrize(
    ("changes", "left", "right"),
    [
        ({}, 400.0, 400.0),  # first gear, 6000/15
        (SECOND, 720.0, 720.0),
        ({"load.0.speed_ratio": "-1/12"}, 300.0, 500.0),  # to the left: speeds add up to 800
    ],
    ids=["first", "second", "curve"],
)
def test_both_wheels_bear_one_torque(changes, left, right):
    """By the power: 110 N m at 6000 rpm, less the drag of both pairs' wheels."""
    case = train_case(find_scenario("electric-axle"), changes)
    rpm = {body.name: 6000.0 * float(body.ratio) for body in case.bodies}
    assert (rpm["left-wheel"], rpm["ring-2"]) == pytest.approx((left, right))
    torque = (110.0 * 6000.0 - 0.5 * (rpm["wheel-1"] + rpm["wheel-2"])) / (left + right)
    on_left = next(load.torque for load in case.loads if case.bodies[load.body].name == "left-wheel")
    on_right = sum(m.pair.operating.gear_torque for m in case.meshes if m.name.startswith("right-ring"))
    assert (on_left, on_right) == pytest.approx((torque, torque), rel=1e-9)
