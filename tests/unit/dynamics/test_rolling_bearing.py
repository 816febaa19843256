"""Radial stiffness of rolling bearings: Palmgren's deflections, orders of power."""

import math
from dataclasses import replace

import pytest

from tribodyn.dynamics.data import RollingBearing, radial_stiffness
from tribodyn.errors import InputError
from tribodyn.interface.scenario import scenario

BALLS = RollingBearing("deep-groove-ball", 10, 12e-3, 0.0, 0.0, 2000.0, 1)
ROLLERS = RollingBearing("cylindrical-roller", 14, 0.0, 12e-3, 0.0, 5000.0, 1)


def palmgren(bearing):
    """Palmgren's radial deflection, m, in N and mm (Harris, Rolling Bearing Analysis)."""
    load = 5 * bearing.radial_load / (bearing.elements * math.cos(bearing.contact_angle))
    if bearing.type.endswith("roller"):
        micron = 7.68e-5 * load**0.9 / (1e3 * bearing.length) ** 0.8
    else:
        micron = 4.36e-4 * load ** (2 / 3) / (1e3 * bearing.diameter) ** (1 / 3)
    return 1e-3 * micron / math.cos(bearing.contact_angle)


@pytest.mark.parametrize("angle", [0.0, 15.0, 30.0])
@pytest.mark.parametrize("bearing", [BALLS, ROLLERS])
def test_stiffness_is_the_slope_of_palmgrens_deflection(bearing, angle):
    bearing = replace(bearing, contact_angle=math.radians(angle))
    step = 1e-4 * bearing.radial_load
    more, less = (
        palmgren(replace(bearing, radial_load=bearing.radial_load + sign * step)) for sign in (1, -1)
    )
    # Palmgren's rounded factors in N and mm against Gargiulo's in lbf and inch
    assert radial_stiffness(bearing) == pytest.approx(2 * step / (more - less), rel=0.03)


def test_bearings_side_by_side_add():
    assert radial_stiffness(replace(BALLS, count=2)) == pytest.approx(2 * radial_stiffness(BALLS))


BEARING = {
    "rolling": {"type": "deep-groove-ball", "elements": 10, "diameter": "12 mm", "radial_load": "2 kN"},
    "damping_ratio": 0.05,
}
BEARINGS = {"title": "balls", "source": "size", "pinion": BEARING, "gear": BEARING}


def test_a_scenario_takes_it_in_place_of_a_stiffness():
    case = scenario("crc-23-47", {"bearings": BEARINGS})
    assert case.bearings[0].stiffness_x == case.bearings[1].stiffness_y == 2 * radial_stiffness(BALLS)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"bearings.pinion.rolling.length": "12 mm"}, "bearings.pinion.rolling.length"),
        ({"bearings.pinion.rolling.type": "tapered-roller"}, "bearings.pinion.rolling.diameter"),
        ({"bearings.pinion.rolling.contact_angle": "70 deg"}, "bearings.pinion.rolling.contact_angle"),
        ({"bearings.pinion.stiffness_x": "1e9 N/m"}, "bearings.pinion.stiffness_x"),
    ],
)
def test_what_contradicts_is_refused(changes, key):
    with pytest.raises(InputError) as refused:
        scenario("crc-23-47", {"bearings": BEARINGS, **changes})
    errors = getattr(refused.value, "errors", [refused.value])
    assert key in [error.key for error in errors]
