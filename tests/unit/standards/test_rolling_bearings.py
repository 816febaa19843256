"""ISO 281: equivalent loads, lives; Palmgren's moment of the load."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq, root

from tribodyn.standards.rolling_bearings import (
    basic_life,
    contamination_factor,
    equivalent_load,
    fatigue_load_limit,
    life_factor,
    life_of_rows,
    reference_life_of_balls,
    reference_life_of_rollers,
    reference_viscosity,
    row_rating,
    running_time,
    static_load,
)
from tribodyn.train.elastic.bearing_types import paired, self_aligning_balls
from tribodyn.train.elastic.rolling_bearing import BallRow, answer, outer_conformity

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


def test_the_life_factor_against_readings_of_a_published_diagram():
    """SKF's diagram for radial ball bearings, as read off in a public program; η_c P_u/P, κ, a."""
    for relative, readings in {
        0.01: {0.8: 0.3, 2.0: 0.48, 3.0: 0.53, 4.0: 0.57},
        0.05: {0.3: 0.21, 0.6: 0.52, 0.8: 0.75, 2.0: 1.7, 3.0: 2.2, 4.0: 2.5},
        0.1: {0.3: 0.26, 0.6: 0.85, 2.0: 4.5, 4.0: 7.0},
    }.items():
        for ratio, read in readings.items():
            assert life_factor(BALL, ratio, relative) == pytest.approx(read, rel=0.1)


def test_modified_life_by_hand():
    """κ 1, e_C C_u/P 0.1: 0.1 (1 − 0.5684^0.83 0.1^⅓)^−9.3; rollers 0.1 (1 − 0.3511 0.1^0.4)^−9.185."""
    assert life_factor(BALL, 1.0, 0.1) == pytest.approx(0.1 * (1 - 0.5684**0.83 * 0.46416) ** -9.3, rel=1e-4)
    assert life_factor(ROLLER, 1.0, 0.1) == pytest.approx(0.1 * (1 - 0.3511 * 0.39811) ** -9.185, rel=1e-4)
    assert life_factor(BALL, 8.0, 0.1) == life_factor(BALL, 4.0, 0.1)
    assert life_factor(BALL, 4.0, 5.0) == 50.0
    # both branches of every curve meet; 1000 rpm and 64 mm: 4500/(31.62 · 8) mm²/s
    for kind in (BALL, ROLLER):
        for edge in (0.4, 1.0):
            below, above = life_factor(kind, edge - 1e-9, 0.3), life_factor(kind, edge, 0.3)
            assert below == pytest.approx(above, rel=0.02)
    assert reference_viscosity(64e-3, 1000.1 * math.pi / 30.0) == pytest.approx(17.788e-6, rel=1e-3)
    assert reference_viscosity(64e-3, 999.9 * math.pi / 30.0) == pytest.approx(18.2e-6, rel=2e-2)
    assert fatigue_load_limit(BALL, 22e3, 60e-3) == pytest.approx(1e3)
    assert fatigue_load_limit(BALL, 22e3, 400e-3) == pytest.approx(500.0)
    # 64 mm: 64^0.55 = 9.849, 64^(1/3) = 4
    by_hand = 0.0432 * 9.849 * (1 - 0.24968)
    assert contamination_factor(1.0, 64e-3, "-/15/12") == pytest.approx(by_hand, rel=1e-3)


def test_reference_life_of_the_distribution_that_the_ratings_stand_on():
    """Balls without clearance under a radial load: L_10r is L_10. Rollers by hand, the same load on all."""
    row = BallRow(9, 12e-3, 60e-3)
    load = 4e3

    def missing(moved: float) -> float:
        return float(answer(row, np.array([moved, 0.0, 0.0, 0.0, 0.0])).force[0]) - load

    moved = brentq(missing, 0.0, 1e-3)
    loads = answer(row, np.array([moved, 0.0, 0.0, 0.0, 0.0])).element_load
    life = reference_life_of_balls(loads.tolist(), 30e3, 12e-3, 60e-3)
    assert life == pytest.approx(basic_life(BALL, 30e3, load), rel=0.02)
    worse = reference_life_of_balls([float(sum(loads)), *[0.0] * 8], 30e3, 12e-3, 60e-3)
    assert worse < life
    assert reference_life_of_balls([0.0] * 9, 30e3, 12e-3, 60e-3) == math.inf
    # 20 rollers in 31 slices, each roller C/20 with γ = 0: ratings of both raceways, λ ν = 0.83
    even = [[30e3 / 20 / 31] * 31] * 20
    ends = [1 - 0.01 / math.log(1.985 * max(abs(k - 15), 0.5) / 31) for k in range(31)]
    concentrated = sum(each**4.5 for each in ends) / 31
    inner, outer = (
        by / 0.83 * (1 + 1.038**power) ** (2 / 9) for by, power in ((1 / 0.378, 4.5), (1 / 0.364, -4.5))
    )
    by_hand = 1e6 * (concentrated * (inner**-4.5 + outer**-4.5)) ** (-8 / 9)
    assert reference_life_of_rollers(even, 30e3, 1e-9, 66e-3) == pytest.approx(by_hand, rel=1e-4)
    tilted = [[30e3 / 20 / 31 * k / 15 for k in range(31)]] * 20
    assert reference_life_of_rollers(tilted, 30e3, 1e-9, 66e-3) < 0.5 * by_hand


@pytest.mark.parametrize(
    ("degrees", "relative", "one", "two"),
    [
        (15.0, 0.178, (0.44, 1.47, 0.38), (0.72, 2.39, 1.65)),
        (15.0, 1.43, (0.44, 1.19, 0.47), (0.72, 1.93, 1.34)),
        (10.0, 0.35, (0.46, 1.71, 0.32), (0.75, 2.78, 1.98)),
        (25.0, 9.0, (0.41, 0.87, 0.68), (0.67, 1.41, 0.92)),
        (30.0, 9.0, (0.39, 0.76, 0.80), (0.63, 1.24, 0.78)),
        (35.0, 9.0, (0.37, 0.66, 0.95), (0.60, 1.07, 0.66)),
        (40.0, 9.0, (0.35, 0.57, 1.14), (0.57, 0.93, 0.55)),
    ],
)
def test_angular_contact_bearings_by_the_printed_table(degrees, relative, one, two):
    """ISO 281, table 3: X, Y, e of one row; X_2, Y_2 and Y_1 of two, which follow from those here."""
    angle, rating = math.radians(degrees), 20e3
    for rows, (x, y, third) in ((1, one), (2, two)):
        axial = relative * rating / 14.0 / rows

        def factors(radial: float, axial: float = axial, rows: int = rows):
            return equivalent_load(
                "angular-contact-ball",
                radial,
                axial,
                static_rating=rating,
                contact_angle=angle,
                rows=rows,
            )

        beyond, within = factors(0.0), factors(100.0 * axial)
        assert (beyond.radial_factor, beyond.axial_factor) == pytest.approx((x, y), abs=0.012)
        last = beyond.limit if rows == 1 else within.axial_factor
        assert last == pytest.approx(third, abs=0.015)


def test_two_rows_of_catalogues():
    """Four-point and double row by makers: 35°: F_r + 0.66 F_a, e 0.95; 22210: e 0.24, Y_1 2.8, Y_2 4.2."""
    four = equivalent_load("four-point-contact-ball", 1000.0, 900.0, contact_angle=math.radians(35.0))
    assert (four.load, four.limit) == pytest.approx((1000.0 + 0.66 * 900.0, 0.95), rel=0.01)
    angle = math.atan(0.24 / 1.5)
    low, high = (equivalent_load("spherical-roller", 1e3, axial, contact_angle=angle) for axial in (1e2, 1e3))
    assert (low.axial_factor, high.axial_factor) == pytest.approx((2.8, 4.2), abs=0.05)
    assert static_load("spherical-roller", 1e3, 1e3, contact_angle=angle) == pytest.approx(3.8e3, rel=0.02)
    forty = math.radians(40.0)
    assert static_load("angular-contact-ball", 1e3, 3e3, contact_angle=forty) == pytest.approx(1280.0)
    assert static_load("angular-contact-ball", 1e3, 3e3, contact_angle=forty, rows=2) == pytest.approx(2560.0)
    assert static_load("toroidal-roller", 1e3, 5.0) == 1e3


@pytest.mark.parametrize(
    ("kind", "degrees", "axial", "within"),
    [
        ("self-aligning-ball", 11.0, 0.0, (0.97, 1.0)),
        ("angular-contact-ball", 15.0, 0.0, (0.95, 1.0)),
        ("angular-contact-ball", 15.0, 1.0, (1.3, 1.7)),
        ("angular-contact-ball", 40.0, 0.0, (0.8, 0.9)),
        ("angular-contact-ball", 40.0, 1.0, (0.9, 1.1)),
    ],
)
def test_reference_life_of_two_rows_beside_their_rating_life(kind, degrees, axial, within):
    """L_10r of the loads of all balls over L_10 by X and Y, whose fixed α leaves some per cent."""
    angle, radial = math.radians(degrees), 3e3
    row = BallRow(14, 12e-3, 60e-3, contact_angle=angle)
    bearing = self_aligning_balls(row) if kind == "self-aligning-ball" else paired(row, 18e-3, "O")

    def missing(moved):
        state = answer(bearing, np.array([moved[0], 0.0, moved[1], 0.0, 0.0]))
        return [state.force[0] / radial - 1.0, state.force[2] / radial - axial]

    moved = root(missing, [2e-5, 1e-5 * axial]).x
    loads = answer(bearing, np.array([moved[0], 0.0, moved[1], 0.0, 0.0])).element_load.reshape(2, -1)
    rating = row_rating(kind, 60e3, 2)
    grooves = bearing.rows[0].conformity, outer_conformity(bearing.rows[0])
    sizes = rating, 12e-3, 60e-3, angle
    lives = [reference_life_of_balls(each.tolist(), *sizes, *grooves) for each in loads]
    load = equivalent_load(kind, radial, axial * radial, static_rating=60e3, contact_angle=angle, rows=2).load
    ratio = life_of_rows(kind, lives) / basic_life(kind, 60e3, load)
    assert within[0] < ratio < within[1]


def test_rows_share_their_rating():
    """Two rows of one load each have the life of the whole at both loads: C ~ i^0.7, i^(7/9)."""
    for kind, exponent in (("angular-contact-ball", 3.0), ("spherical-roller", 4.0)):
        one = row_rating(kind, 30e3, 2)
        row = 1e6 * (one / 2e3) ** exponent
        whole = 1e6 * (30e3 / 4e3) ** exponent
        assert life_of_rows(kind, [row, row]) == pytest.approx(whole, rel=1e-9)
        assert life_of_rows(kind, [row, math.inf]) == pytest.approx(row)
