"""ISO 281: equivalent loads, lives; Palmgren's moment of the load."""

import math

import pytest

from tribodyn.standards.rolling_bearings import basic_life, equivalent_load, load_moment, running_time

BALL, ROLLER, TAPERED = "deep-groove-ball", "cylindrical-roller", "tapered-roller"


@pytest.mark.parametrize(
    ("relative", "limit", "factor"), [(0.172, 0.19, 2.30), (1.03, 0.28, 1.55), (6.89, 0.44, 1.00)]
)
def test_axial_factors_of_balls(relative: float, limit: float, factor: float):
    """Rows of the standard's table; between them linear."""
    axial = relative * 20e3 / 14.0
    found = equivalent_load(BALL, axial / (1.2 * limit), axial, static_rating=20e3)
    assert (found.limit, found.axial_factor) == pytest.approx((limit, factor))
    assert found.load == pytest.approx(0.56 * axial / (1.2 * limit) + factor * axial)


def test_little_axial_load_does_not_count():
    assert equivalent_load(BALL, 3000.0, 500.0, static_rating=20e3).load == 3000.0
    assert equivalent_load(TAPERED, 3000.0, 500.0, contact_angle=math.radians(14.0)).load == 3000.0
    assert equivalent_load(ROLLER, 3000.0, 0.0).load == 3000.0


def test_a_tapered_bearing():
    """A 30207 has e = 0.37 and Y = 1.6 in catalogues: α = 14°."""
    found = equivalent_load(TAPERED, 1000.0, 1000.0, contact_angle=math.radians(14.0))
    assert found.limit == pytest.approx(0.37, abs=0.005)
    assert found.axial_factor == pytest.approx(1.6, abs=0.01)
    assert found.load == pytest.approx(400.0 + 1000.0 * found.axial_factor)


def test_without_a_static_rating_the_largest_factor_is_taken():
    assert (
        equivalent_load(BALL, 1000.0, 1000.0).load
        >= equivalent_load(BALL, 1000.0, 1000.0, static_rating=8e3).load
    )


def test_the_life_by_hand():
    """C/P = 10 at 1500 rpm: balls 1000 million, 11 111 h; rollers 10^(10/3) million."""
    balls = basic_life(BALL, 30e3, 3e3)
    assert balls == pytest.approx(1e9)
    assert running_time(balls, 1500.0 * math.pi / 30.0) == pytest.approx(11111.1 * 3600.0, rel=1e-5)
    assert basic_life(ROLLER, 30e3, 3e3) == pytest.approx(10 ** (10 / 3) * 1e6)
    assert basic_life(BALL, 30e3, 0.0) == math.inf


def test_moments_of_the_load_by_hand():
    """N and mm: 0.0003 · 5000 N · 60 mm = 90 N mm; 0.0005 (2/20)^0.55 · 2000 · 60 = 16.9 N mm."""
    assert load_moment(ROLLER, 5000.0, 0.0, 60e-3) == pytest.approx(0.09)
    assert load_moment(BALL, 2000.0, 0.0, 60e-3, static_rating=20e3) == pytest.approx(0.01691, rel=1e-3)
    assert load_moment(BALL, 2000.0, 0.0, 60e-3) is None
    angle = math.radians(14.0)
    expected = 0.0004 * 2.0 * (0.4 / math.tan(angle)) * 2000.0 * 0.053
    assert load_moment(TAPERED, 3000.0, 2000.0, 53e-3, contact_angle=angle) == pytest.approx(expected)
