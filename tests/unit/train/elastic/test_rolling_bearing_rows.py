"""Rows of rolling elements: Stribeck, Hertz and Palmgren, the matrix as derivative, clearance, tilt."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from tribodyn.dynamics.data import RollingBearing, radial_stiffness
from tribodyn.train.elastic.rolling_bearing import BallRow, RollerRow, answer, ball_constant, roller_constant

BALLS = BallRow(9, 12.7e-3, 65e-3)
ROLLERS = RollerRow(14, 12e-3, 12e-3, 65e-3, profiled=False)
TAPERED = RollerRow(16, 9e-3, 12e-3, 60e-3, contact_angle=0.25, thrust=-1, preload=5e-6)
ROWS = [
    *(BALLS, BALLS._replace(clearance=12e-6), BALLS._replace(clearance=-4e-6)),
    BALLS._replace(contact_angle=0.4, thrust=1),
    BALLS._replace(located=False),
    *(ROLLERS, ROLLERS._replace(profiled=True), TAPERED, TAPERED._replace(thrust=1)),
]


def moved(*, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=5) * [2e-5, 2e-5, 2e-5, 3e-4, 3e-4]


@pytest.mark.parametrize("seed", [0, 1])
@pytest.mark.parametrize("row", ROWS)
def test_the_matrix_is_the_slope_of_the_force_and_symmetric(row, seed: int):
    here = moved(seed=seed)
    steps = np.diag([1e-9, 1e-9, 1e-9, 1e-8, 1e-8])
    slope = np.array(
        [(answer(row, here + h).force - answer(row, here - h).force) / (2.0 * h.sum()) for h in steps]
    )
    found = answer(row, here).stiffness
    assert found == pytest.approx(found.T, rel=1e-12)
    assert slope.T == pytest.approx(found, rel=1e-5, abs=1e-5 * np.max(np.abs(found)))


@pytest.mark.parametrize("row", ROWS)
def test_the_force_is_the_slope_of_the_energy(row):
    here = moved(seed=3)
    steps = np.diag([1e-9, 1e-9, 1e-9, 1e-8, 1e-8])
    slope = [(answer(row, here + h).energy - answer(row, here - h).energy) / (2.0 * h.sum()) for h in steps]
    assert slope == pytest.approx(answer(row, here).force, rel=1e-6, abs=1e-3)


@pytest.mark.parametrize(("row", "factor"), [(BALLS, 4.37), (ROLLERS, 4.08)])
def test_stribecks_load_of_the_most_loaded_element(row, factor: float):
    """Q_max = 4.37 F_r/Z of balls, 4.08 of rollers, without clearance and with many elements."""
    many = row._replace(elements=60, diameter=2e-3)
    state = answer(many, np.array([2e-5, 0.0, 0.0, 0.0, 0.0]))
    assert np.max(state.element_load) == pytest.approx(factor * state.force[0] / 60, rel=2e-3)


@pytest.mark.parametrize(
    ("row", "softer"), [(BALLS, (5.0 / 4.37) ** (2 / 3)), (ROLLERS, (5.0 / 4.08) ** 0.9)]
)
def test_radial_stiffness_by_gargiulos_formula(row, softer: float):
    """By Palmgren's deflections, whose contacts differ by some per cent, and 5 F/Z on the most loaded one."""
    load = 4000.0
    gap = brentq(lambda x: answer(row, np.array([x, 0, 0, 0, 0])).force[0] - load, 1e-7, 1e-3)
    found = answer(row, np.array([gap, 0, 0, 0, 0])).stiffness[0, 0]
    kind = "deep-groove-ball" if isinstance(row, BallRow) else "cylindrical-roller"
    length = getattr(row, "length", 0.0)
    formula = RollingBearing(kind, row.elements, row.diameter, length, 0.0, load, 1)
    assert found == pytest.approx(softer * radial_stiffness(formula), rel=0.08)


def test_a_ball_between_grooves_by_hertz():
    """Palmgren's 4.36e-4 mm (Q²/D)^(1/3) of both contacts, N and mm, of usual deep groove ball bearings."""
    palmgren = (12.7 ** (1.0 / 3.0) / 4.36e-4) ** 1.5 * 1e3**1.5
    assert ball_constant(BALLS) == pytest.approx(palmgren, rel=0.1)


def test_balls_between_flat_rings_are_spheres_on_planes():
    """Grooves of huge radius and a huge pitch circle: δ = (9 Q²/(16 R E*²))^(1/3) at each contact."""
    flat = BallRow(9, 10e-3, 1e4, conformity=1e6)
    plane = 206e9 / (1.0 - 0.09) / 2.0  # E* of two equal bodies
    each = (9.0 / (16.0 * 5e-3 * plane**2)) ** (1.0 / 3.0)
    assert ball_constant(flat) == pytest.approx((2.0 * each) ** -1.5, rel=1e-4)


def test_a_tapered_row_under_axial_load_alone():
    """All rollers carry F_a/(Z sin α), pressed by δ_a sin α; and thrust is a matter of direction."""
    row = TAPERED._replace(preload=0.0, profiled=False)
    state = answer(row, np.array([0.0, 0.0, -2e-5, 0.0, 0.0]))
    each = roller_constant(row) * (2e-5 * math.sin(0.25)) ** (10.0 / 9.0)
    assert state.element_load == pytest.approx(np.full(16, each), rel=1e-12)
    assert state.force[2] == pytest.approx(-16 * each * math.sin(0.25), rel=1e-12)
    assert not np.any(answer(row, np.array([0.0, 0.0, 2e-5, 0.0, 0.0])).force)


def test_a_tapered_row_holds_at_its_pressure_centre():
    """A motion of the shaft about the point where the normals meet the axis slides along the raceways."""
    centre = 30e-3 * math.tan(0.25)  # from the middle of a row that pushes towards −z, towards +z
    row = TAPERED._replace(length=1e-6, preload=2e-5, profiled=False)
    matrix = answer(row, np.zeros(5)).stiffness
    turn = np.array([0.0, centre, 0.0, 1.0, 0.0])
    assert abs(turn @ matrix @ turn) < 1e-7 * matrix[3, 3]
    other = np.array([0.0, -centre, 0.0, 1.0, 0.0])
    assert other @ matrix @ other > matrix[3, 3]


@pytest.mark.parametrize("row", [BALLS._replace(clearance=20e-6), ROLLERS._replace(clearance=20e-6)])
def test_nothing_within_the_clearance(row):
    assert not np.any(answer(row, np.array([9e-6, 0.0, 0.0, 0.0, 0.0])).force)
    assert answer(row, np.array([15e-6, 0.0, 0.0, 0.0, 0.0])).force[0] > 0.0


def test_a_tilted_roller_is_loaded_at_one_end():
    """Rollers hold a tilt, more under load; a profile makes them softer."""
    here = np.array([2e-5, 0.0, 0.0, 0.0, 1e-3])
    straight, profiled = answer(ROLLERS, here), answer(ROLLERS._replace(profiled=True), here)
    assert straight.force[4] > profiled.force[4] > 0.0
    assert straight.stiffness[0, 0] > profiled.stiffness[0, 0]


def test_a_sliding_ring_takes_no_axial_load():
    state = answer(BALLS._replace(located=False), np.array([2e-5, 0.0, 5e-5, 0.0, 0.0]))
    assert state.force[2] == 0.0
    assert not np.any(state.stiffness[2])
