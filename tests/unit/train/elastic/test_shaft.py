"""Shafts on bearings: statics by hand, the tangent about the load, and what is not held."""

import math

import numpy as np
import pytest

from tribodyn.train.elastic.beam import ShaftMetal, ShaftSection, shear_factor
from tribodyn.train.elastic.rolling_bearing import BallRow, RollerRow
from tribodyn.train.elastic.shaft import under_load
from tribodyn.train.elastic.system import NotHeld, PlacedShaft
from tribodyn.train.elastic.system import PlacedBearing as Bearing

STEEL = ShaftMetal(206e9, 0.3)
LENGTH, DIAMETER = 0.16, 0.035
RIGID = tuple(map(tuple, np.diag([1e14, 1e14, 1e14, 0.0, 0.0]).tolist()))
PINNED = tuple(map(tuple, np.diag([1e14, 1e14, 0.0, 0.0, 0.0]).tolist()))
BALL = BallRow(9, 12e-3, 60e-3, clearance=10e-6)
TAPERED = RollerRow(17, 8.5e-3, 12e-3, 53e-3, contact_angle=0.25, preload=5e-6)


def shaft(gear: float, *bearings: Bearing) -> PlacedShaft:
    return PlacedShaft((ShaftSection(LENGTH, DIAMETER),), STEEL, 7850.0, (gear,), bearings, 0.0)


BETWEEN = shaft(0.07, Bearing(0.01, BALL), Bearing(0.15, BALL._replace(located=False)))
OVERHUNG = shaft(0.15, Bearing(0.01, TAPERED._replace(thrust=-1)), Bearing(0.09, TAPERED._replace(thrust=1)))
LOAD = (-4000.0, -1500.0, -900.0, -28.0, 0.0)


def test_an_overhung_gear_by_hand():
    """Beyond two rigid bearings w = F c² (L + c)/(3 E I) + F c (L + c)/(κ G A L).

    Its slope is F c (2 L + 3 c)/(6 E I), and what the shear of the span turns the shaft by, F c/(κ G A L).
    """
    span, arm = 0.1, 0.05
    found = under_load(shaft(0.15, Bearing(0.0, RIGID), Bearing(span, PINNED)), (1000.0, 0, 0, 0, 0))
    bending = 206e9 * math.pi / 64.0 * DIAMETER**4
    shear = shear_factor(0.3, 0.0) * 206e9 / 2.6 * math.pi / 4.0 * DIAMETER**2
    deflection = 1000.0 * (arm**2 * (span + arm) / (3.0 * bending) + arm * (span + arm) / (shear * span))
    slope = 1000.0 * (arm * (2.0 * span + 3.0 * arm) / (6.0 * bending) + arm / (shear * span))
    assert found.displacement[0] == pytest.approx(deflection, rel=1e-3)
    assert found.displacement[4] == pytest.approx(slope, rel=1e-3)
    assert [state.force[0] for state in found.bearings] == pytest.approx([-500.0, 1500.0], rel=1e-6)


@pytest.mark.parametrize("case", [BETWEEN, OVERHUNG])
def test_bearings_carry_the_load(case: PlacedShaft):
    """Forces and moments about the start of the shaft are in balance."""
    found = under_load(case, LOAD)
    total = np.zeros(5)
    loads = [(case.points[0], np.array(LOAD))]
    loads += [
        (bearing.position, -state.force) for bearing, state in zip(case.bearings, found.bearings, strict=True)
    ]
    for z, force in loads:
        total += force + np.array([0.0, 0.0, 0.0, -z * force[1], z * force[0]])
    assert total == pytest.approx(np.zeros(5), abs=1e-5)


@pytest.mark.parametrize("case", [BETWEEN, OVERHUNG])
def test_the_matrix_is_the_slope_of_load_over_displacement(case: PlacedShaft):
    found = under_load(case, LOAD)
    assert found.stiffness == pytest.approx(found.stiffness.T, rel=1e-12)
    for more in np.diag([4.0, 4.0, 4.0, 0.05, 0.05]):
        ends = [under_load(case, tuple(np.add(LOAD, sign * more))).displacement for sign in (1.0, -1.0)]
        assert found.stiffness @ (ends[0] - ends[1]) == pytest.approx(
            2.0 * more, abs=3e-3 * float(np.max(more))
        )


def test_bearings_stiffen_under_load():
    light, heavy = (under_load(BETWEEN, tuple(factor * np.array(LOAD))).stiffness for factor in (0.3, 1.0))
    assert np.all(np.diag(heavy) > np.diag(light))


@pytest.mark.parametrize(
    ("case", "load", "words"),
    [
        (shaft(0.07, Bearing(0.01, PINNED), Bearing(0.15, PINNED)), LOAD, "along its axis"),
        (shaft(0.07, Bearing(0.01, RIGID)), LOAD, "tilts"),
        (BETWEEN, (0.0,) * 5, "holds it"),
        (
            shaft(0.15, *(Bearing(z, TAPERED._replace(thrust=1, preload=0.0)) for z in (0.01, 0.09))),
            LOAD,
            "hold",
        ),
    ],
)
def test_what_nothing_holds_is_refused(case: PlacedShaft, load: tuple[float, ...], words: str):
    with pytest.raises(NotHeld, match=words):
        under_load(case, load)


def test_preload_holds_a_shaft_without_load():
    found = under_load(OVERHUNG, (0.0,) * 5)
    assert np.linalg.eigvalsh(found.stiffness)[0] > 0.0
    assert found.bearings[0].force[2] < 0.0 < found.bearings[1].force[2]
