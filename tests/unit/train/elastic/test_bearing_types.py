"""Bearings by type: Harris's and Palmgren's numbers, Jones's closed form, pairs, aligning types."""

import numpy as np
import pytest
from scipy.optimize import brentq

from tribodyn.train.elastic.bearing_sizes import estimated, static_rating
from tribodyn.train.elastic.bearing_types import (
    four_point,
    paired,
    preload_of_force,
    self_aligning_balls,
    spherical_rollers,
    toroidal_rollers,
)
from tribodyn.train.elastic.rolling_bearing import (
    BallRow,
    BearingRows,
    RollerRow,
    answer,
    ball_constant,
    contact_pressure,
)

#: The 218 of Harris, Rolling Bearing Analysis: Z, D, d_m, f = 0.5232, α = 40°.
ANGULAR = BallRow(16, 22.23e-3, 125.26e-3, contact_angle=np.radians(40.0), thrust=1, conformity=0.5232)
#: The 22317 of the same book: Z, D, l, d_m, α = 12°.
SPHERICAL = RollerRow(14, 25e-3, 20.762e-3, 135.077e-3, contact_angle=np.radians(12.0))
TAPERED = RollerRow(16, 9e-3, 12e-3, 60e-3, contact_angle=0.25, preload=5e-6)
BEARINGS = {
    "O": paired(ANGULAR._replace(preload=10e-6), 30e-3, "O"),
    "X": paired(ANGULAR._replace(preload=10e-6), 30e-3, "X"),
    "floating": paired(ANGULAR._replace(preload=10e-6), 30e-3, "O")._replace(sliding=True),
    "tandem": paired(ANGULAR, 30e-3, "tandem"),
    "tapered": paired(TAPERED._replace(preload=60e-6), 20e-3, "X"),
    "four-point": four_point(BallRow(13, 12e-3, 60e-3, contact_angle=np.radians(35.0), clearance=10e-6)),
    "self-aligning": self_aligning_balls(BallRow(17, 8.73e-3, 60e-3, contact_angle=np.radians(11.0))),
    "spherical": spherical_rollers(SPHERICAL._replace(clearance=20e-6)),
    "sliding": spherical_rollers(SPHERICAL._replace(located=False)),
    "toroidal": toroidal_rollers(RollerRow(24, 12e-3, 20e-3, 70e-3), 115e-3),
    "needles": paired(RollerRow(28, 3e-3, 12e-3, 40e-3), 15e-3, "tandem"),
}


def along(axis: int, amount: float) -> np.ndarray:
    return amount * np.eye(5)[axis]


def settles(bearing, axis: int, load: float) -> np.ndarray:
    """Displacement in one direction under a load in it."""
    return along(axis, brentq(lambda by: answer(bearing, along(axis, by)).force[axis] - load, 0.0, 2e-3))


@pytest.mark.parametrize("name", BEARINGS)
def test_force_and_matrix_are_slopes_of_the_energy(name: str):
    bearing = BEARINGS[name]
    here = np.random.default_rng(4).normal(size=5) * [2e-5, 2e-5, 2e-5, 3e-4, 3e-4] + along(0, 3e-5)
    steps = np.diag([1e-9, 1e-9, 1e-9, 1e-8, 1e-8])
    ends = [(answer(bearing, here + h), answer(bearing, here - h), 2.0 * h.sum()) for h in steps]
    found = answer(bearing, here)
    assert found.stiffness == pytest.approx(found.stiffness.T, rel=1e-12)
    force = [(after.energy - before.energy) / by for after, before, by in ends]
    assert force == pytest.approx(found.force, rel=2e-6, abs=2e-6 * np.max(np.abs(found.force)))
    slope = np.array([(after.force - before.force) / by for after, before, by in ends])
    assert slope.T == pytest.approx(found.stiffness, rel=1e-5, abs=1e-5 * np.max(np.abs(found.stiffness)))


@pytest.mark.parametrize("name", BEARINGS)
def test_a_load_turned_by_one_pitch(name: str):
    """The same bearing again: forces turn with the displacement."""
    bearing = BEARINGS[name]
    elements = bearing.rows[0].elements if isinstance(bearing, BearingRows) else bearing.elements
    pitch = 2.0 * np.pi / elements
    turn = np.eye(5)
    turn[:2, :2] = turn[3:, 3:] = [[np.cos(pitch), -np.sin(pitch)], [np.sin(pitch), np.cos(pitch)]]
    here = np.array([4e-5, 1e-5, 1e-5, 2e-4, -1e-4])
    found, turned = answer(bearing, here), answer(bearing, turn @ here)
    assert turned.force == pytest.approx(turn @ found.force, rel=1e-9)
    assert turned.stiffness == pytest.approx(
        turn @ found.stiffness @ turn.T, rel=1e-9, abs=1e-9 * np.max(found.stiffness)
    )


def test_the_angular_contact_bearing_of_harris_under_thrust():
    """Harris: 17 800 N give 41.6° and 0.0386 mm, with K of a chart. Jones: F/(Z K) = sin α (…)^1.5, exact."""
    state = answer(ANGULAR, settles(ANGULAR, 2, 17800.0))
    angle = np.arcsin(17800.0 / 16.0 / state.element_load[0])
    assert np.degrees(angle) == pytest.approx(41.6, abs=0.15)
    assert settles(ANGULAR, 2, 17800.0)[2] == pytest.approx(0.0386e-3, rel=0.07)
    apart = (2 * 0.5232 - 1) * 22.23e-3
    stretched = apart * (np.cos(np.radians(40.0)) / np.cos(angle) - 1.0)
    assert 16 * ball_constant(ANGULAR) * stretched**1.5 * np.sin(angle) == pytest.approx(17800.0, rel=1e-6)
    axial = apart * np.sin(angle - np.radians(40.0)) / np.cos(angle)
    assert settles(ANGULAR, 2, 17800.0)[2] == pytest.approx(axial, rel=1e-6)
    # the mean pressure over the ellipse is 2/3 of the largest: p = 1.5 Q/(π a b), by Hertz' half axes
    assert contact_pressure(ANGULAR, 8.0) == pytest.approx(2.0 * contact_pressure(ANGULAR, 1.0))


@pytest.mark.parametrize("arrangement", ["O", "X"])
def test_tilting_stiffness_of_a_pair_by_its_effective_span(arrangement):
    """Rows act at their pressure centres: k_ϑ = 2 k_r (s/2)², s = a ± d_m tan α, with fixed lines."""
    row = RollerRow(40, 9e-3, 1e-6, 60e-3, contact_angle=0.25, preload=2e-5, profiled=False)
    distance = 25e-3
    span = distance + (1.0 if arrangement == "O" else -1.0) * 60e-3 * np.tan(0.25)
    stiffness = answer(paired(row, distance, arrangement), np.zeros(5)).stiffness
    assert stiffness[3, 3] == pytest.approx(stiffness[0, 0] * (span / 2.0) ** 2, rel=1e-6)
    assert stiffness[4, 4] == pytest.approx(stiffness[3, 3], rel=1e-9)
    assert abs(stiffness[0, 4]) < 1e-9 * stiffness[0, 0]


@pytest.mark.parametrize("row", [ANGULAR, TAPERED._replace(profiled=False)])
def test_a_preload_as_a_force(row):
    """Both rows of a pair are pressed together by it; to lift one off takes 2^1.5 of it, or 2^(10/9)."""
    pair = paired(row._replace(preload=preload_of_force(row, 500.0)), 30e-3, "X")
    rows = [answer(one, np.zeros(5)).force[2] for one in pair.rows]
    assert rows == pytest.approx([-500.0, 500.0], rel=1e-6)
    assert answer(pair, np.zeros(5)).force == pytest.approx(np.zeros(5), abs=1e-6)
    free = brentq(lambda z: answer(pair.rows[0], along(2, z)).force[2] + 1e-3, 0.0, 1e-3)
    needed = answer(pair, along(2, free)).force[2] / 500.0
    assert needed == pytest.approx(2.0**1.5 if row is ANGULAR else 2.0 ** (10.0 / 9.0), rel=0.15)


@pytest.mark.parametrize(("row", "factor"), [(ANGULAR, 1.216), (TAPERED._replace(thrust=1), 1.260)])
def test_thrust_of_half_a_row_under_load(row, factor: float):
    """F_a = 1.216 F_r tan α of balls, 1.260 of rollers, with the rings not displaced along the axis (NSK)."""
    many = row._replace(elements=120, diameter=2e-3, preload=0.0)
    if isinstance(many, RollerRow):
        many = many._replace(profiled=False)
    force = answer(many, along(0, 1e-7)).force
    assert force[2] == pytest.approx(factor * force[0] * np.tan(row.contact_angle), rel=0.01)


def test_a_pair_holds_thrust_both_ways_and_a_tandem_one_way():
    for arrangement in ("O", "X"):
        pair = paired(ANGULAR, 30e-3, arrangement)
        for way in (-1.0, 1.0):
            assert answer(pair, along(2, way * 2e-5)).force[2] * way > 1000.0
    tandem, single = answer(BEARINGS["tandem"], along(2, 2e-5)), answer(ANGULAR, along(2, 2e-5))
    assert tandem.force[2] == pytest.approx(2.0 * single.force[2])
    assert not np.any(answer(BEARINGS["tandem"], along(2, -2e-5)).force)


def test_a_pair_whose_outer_rings_slide():
    """It takes no thrust, and is where a locating one under no thrust is, the rings displaced or not."""
    fixed, floating = BEARINGS["O"], BEARINGS["floating"]
    here = np.array([2e-5, 1e-5, 0.0, 1e-4, 3e-4])
    place = brentq(lambda z: answer(fixed, here + along(2, z)).force[2], -1e-4, 1e-4)
    expected = answer(fixed, here + along(2, place))
    for thermal in (0.0, 3e-4):
        found = answer(floating, here + along(2, thermal))
        assert found.force == pytest.approx(expected.force * [1, 1, 0, 1, 1], rel=1e-7, abs=1e-6)
        assert found.element_load == pytest.approx(expected.element_load, rel=1e-6)
    assert abs(place) > 1e-7


def test_a_preloaded_pair_is_twice_as_stiff_until_one_row_is_free():
    """δ ∝ F^(2/3): the other row comes free at F = 2^1.5 F_0 of fixed lines of contact."""
    row = RollerRow(40, 9e-3, 5e-3, 60e-3, contact_angle=0.25, preload=1e-5, profiled=False)
    pair = paired(row, 25e-3, "O")
    alone = answer(row._replace(thrust=1), np.zeros(5))
    assert answer(pair, np.zeros(5)).stiffness[2, 2] == pytest.approx(2.0 * alone.stiffness[2, 2])
    free = answer(pair, along(2, 1e-5))
    assert free.force[2] == pytest.approx(2.0 ** (10 / 9) * alone.force[2], rel=1e-9)


def test_a_four_point_bearing_has_the_play_of_its_grooves():
    """Axial play A (sin α' − sin α), cos α' = cos α − c/(2 A); either diagonal then carries alone."""
    row = BallRow(13, 12e-3, 60e-3, contact_angle=np.radians(35.0), clearance=20e-6)
    apart = 0.04 * 12e-3
    opened = np.arccos(np.cos(row.contact_angle) - 20e-6 / 2.0 / apart)
    play = apart * (np.sin(opened) - np.sin(row.contact_angle))
    assert not np.any(answer(four_point(row), along(2, 0.999 * play)).force)
    for way in (-1.0, 1.0):
        loaded = answer(four_point(row), along(2, way * 1.2 * play))
        assert np.count_nonzero(loaded.element_load) == 13
        assert loaded.force[2] * way > 0.0


@pytest.mark.parametrize("name", ["self-aligning", "spherical", "toroidal"])
def test_aligning_bearings_let_the_shaft_tilt(name: str):
    state = answer(BEARINGS[name], np.array([5e-5, 0.0, 0.0, 5e-3, 3e-3]))
    assert state.force[:2] == pytest.approx(answer(BEARINGS[name], along(0, 5e-5)).force[:2])
    assert not np.any(state.force[3:])
    assert not np.any(state.stiffness[3:])


def test_self_aligning_balls_by_palmgren():
    """6.98e-4 mm (Q²/D)^(1/3) of both contacts, N and mm."""
    row = BEARINGS["self-aligning"].rows[0]
    palmgren = (8.73 ** (1.0 / 3.0) / 6.98e-4) ** 1.5 * 1e3**1.5
    assert ball_constant(row) == pytest.approx(palmgren, rel=0.06)


@pytest.mark.parametrize("load", [5e3, 2e4, 5e4])
def test_a_spherical_roller_by_palmgren(load: float):
    """1.81e-4 mm Q^0.75/l^0.5, N and mm, between point and line contact."""
    one = spherical_rollers(SPHERICAL._replace(elements=1)).rows[0]._replace(contact_angle=0.0)
    gap = settles(one, 0, load)[0]
    assert gap == pytest.approx(1.81e-7 * load**0.75 / 20.762**0.5, rel=0.1)


def test_a_spherical_bearing_under_radial_load():
    """Two rows share it: Q_max = F_r/(2 Z J cos α), π J = ∫ cos^(n+1) up to π/2 of many elements.

    n is 10/9 of line contact, and ½ more while a crowned roller's contact grows in length.
    """
    bearing = spherical_rollers(SPHERICAL._replace(elements=60))
    state = answer(bearing, settles(bearing, 0, 89e3))
    factor = np.max(state.element_load) * 120 * np.cos(SPHERICAL.contact_angle) / 89e3
    angle = np.linspace(0.0, np.pi / 2.0, 1001)
    line, crowned = (np.pi / np.trapezoid(np.cos(angle) ** (n + 1.0), angle) for n in (10 / 9, 29 / 18))
    assert line < factor < crowned
    assert state.force[2] == pytest.approx(0.0, abs=1e-6)


def test_the_toroidal_bearing_of_a_catalogue():
    """SKF, C 3052: B 104 mm, k_1 0.122, k_2 0.096: 6.5 mm take k_2 s²/B = 0.039 mm of the clearance.

    k_1 B per degree is how far a tilt moves the rings' profiles: ρ of k_2 must give it, too.
    """
    width, diameter, pitch = 104e-3, 40e-3, 330e-3
    raceway = (width / 0.096 + diameter) / 2.0
    bearing = toroidal_rollers(RollerRow(24, diameter, 90e-3, pitch, clearance=0.2e-3), raceway)
    touch = brentq(lambda x: answer(bearing, np.array([x, 0, 6.5e-3, 0, 0])).force[0] - 1e-3, 0.0, 2e-4)
    assert 2.0 * (1e-4 - touch) == pytest.approx(0.039e-3, rel=0.01)
    assert np.radians((pitch - diameter) / 2.0 + raceway) / width == pytest.approx(0.122, rel=0.04)
    # hardly any axial force: F_r s/A
    loaded = answer(bearing, np.array([1.5e-4, 0.0, 6.5e-3, 0.0, 0.0]))
    share = 6.5e-3 / (2.0 * raceway - diameter)
    assert loaded.force[2] == pytest.approx(share * np.sum(loaded.element_load), rel=1e-3)
    assert loaded.force[2] < 0.01 * loaded.force[0]


@pytest.mark.parametrize(
    ("gamma", "aligning", "factor"),
    [(0.09, False, 16.5), (0.18, False, 14.4), (0.26, False, 12.5), (0.1, True, 2.4), (0.2, True, 2.8)],
)
def test_the_static_rating_of_balls_has_the_factors_of_the_standard(gamma, aligning, factor):
    """ISO 76, table 1: f_0 of C_0 = f_0 Z D² cos α, N and mm."""
    row = BallRow(10, 10e-3, 10e-3 / gamma, conformity=0.53 if aligning else 0.52, aligning=aligning)
    assert static_rating(row) == pytest.approx(factor * 10 * 10.0**2, rel=0.03)


def test_the_static_rating_of_rollers_has_the_factor_of_the_standard():
    """ISO 76: C_0 = 44 (1 − γ) Z l D cos α."""
    row = RollerRow(16, 9e-3, 12e-3, 60e-3, contact_angle=0.25)
    by_hand = 44.0 * (1.0 - 9.0 * np.cos(0.25) / 60.0) * 16 * 12.0 * 9.0 * np.cos(0.25)
    assert static_rating(row) == pytest.approx(by_hand, rel=0.01)


@pytest.mark.parametrize(
    ("kind", "bore", "outside", "rating", "inside"),
    [
        ("deep-groove-ball", 25, 52, 7.8e3, (9, 7.94, 38.5)),  # 6205
        ("deep-groove-ball", 30, 62, 11.2e3, (9, 9.525, 46)),  # 6206
        ("deep-groove-ball", 50, 90, 23.2e3, (10, 12.7, 70)),  # 6210
        ("deep-groove-ball", 40, 90, 24.0e3, (8, 15.08, 65)),  # 6308
        ("angular-contact-ball", 90, 160, None, (16, 22.225, 125.26)),  # 218 of Harris
        ("cylindrical-roller", 25, 52, None, (13, 7.5, 38.5, 9)),  # N 205
        ("cylindrical-roller", 40, 80, 53e3, (14, 11, 60, 11)),  # NU 208
        ("cylindrical-roller", 45, 85, None, (14, 10, 65, 9.6)),  # 209 of Harris
        ("spherical-roller", 85, 180, None, (14, 25, 135.077, 20.762)),  # 22317 of Harris
    ],
)
def test_estimated_insides_beside_published_ones(kind, bore, outside, rating, inside):
    """Stiffness under a tenth of C_0, which is a catalogue's, or that of the inside itself."""
    angle = {"angular-contact-ball": np.radians(40.0), "spherical-roller": np.radians(12.0)}.get(kind, 0.0)
    rows = 2 if kind == "spherical-roller" else 1
    given = RollerRow(14, 1e-3, 1e-3, 1.0) if len(inside) == 4 else BallRow(14, 1e-3, 1.0)
    names = ("elements", "diameter", "pitch_diameter", "length")
    sizes = (inside[0], *(1e-3 * size for size in inside[1:]))
    given = given._replace(contact_angle=angle, **dict(zip(names, sizes, strict=False)))
    rating = rows * static_rating(given) if rating is None else rating
    found = estimated(kind, 1e-3 * bore, 1e-3 * outside, rating, angle, rows)
    sizes = {name: getattr(found, name) for name in names[: len(inside)]}

    def stiffness(row: BallRow | RollerRow) -> float:
        bearing = spherical_rollers(row) if rows == 2 else row
        if kind == "angular-contact-ball":
            bearing = paired(row._replace(preload=1e-5), 20e-3, "O")
        return float(answer(bearing, settles(bearing, 0, rating / 10.0)).stiffness[0, 0])

    assert stiffness(given._replace(**sizes)) == pytest.approx(stiffness(given), rel=0.1)
