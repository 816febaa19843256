"""An internal gear pair by negative radii (ISO 21771) against a published sheet, KISSsoft (2017).

Planet and ring of a planetary stage, z 36/-93, m 21 mm: the report's figures to its last digit.
"""

import math

import pytest

from tribodyn.geometry.assembly import Assembly, lowest_contact_radius, tip_clearance
from tribodyn.geometry.backlash import circumferential_backlash, normal_backlash
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family, involute
from tribodyn.geometry.path import distance_at_radius, kinematics, radius

PLANET = GearBody(36.0, 0.5039, 1.0, 1.25, 0.3, 0.55, 0.15, tip_radius=407.8315e-3)
RING = GearBody(-93.0, 0.1171, 1.0, 1.25, 0.3, 0.55, -1.1, tip_radius=-953.0405e-3)
PAIR = Drive(21e-3, math.radians(20.0), PLANET, RING, centre_distance=-0.584)


@pytest.fixture(scope="module")
def pair() -> Assembly:
    return Assembly(family("involute"), PAIR)


def test_the_mesh_is_the_published_one(pair: Assembly):
    assert math.degrees(pair.path.pressure_angle(0.0)) == pytest.approx(15.63, abs=0.005)
    assert 1e3 * (pair.r_end - pair.r_start) == pytest.approx(100.284, abs=0.0005)
    assert pair.contact_ratio == pytest.approx(1.618, abs=0.0005)
    at = kinematics(pair.path, 0.0)
    assert 2e3 * at.pinion_normal_arm == pytest.approx(710.408, abs=0.0005)
    assert 2e3 * at.gear_normal_arm == pytest.approx(-1835.22, abs=0.005)


def test_the_published_points_of_contact(pair: Assembly):
    """Distance from the planet's base tangent point, where the ring drives: A is the planet's tip."""
    base_pitch = math.pi * 21e-3 * math.cos(PAIR.pressure_angle)
    points = (pair.r_end, pair.r_start + base_pitch, 0.0, pair.r_end - base_pitch, pair.r_start)
    published = (200.391, 162.102, 99.372, 138.396, 100.108)
    for r, distance in zip(points, published, strict=True):
        # the tip diameters, of three decimals, leave 0.001 mm in the ring's points
        assert 1e3 * kinematics(pair.path, r).pinion_friction_arm == pytest.approx(distance, abs=0.0015)


def test_the_ring_is_concave_and_its_speed_follows(pair: Assembly):
    """1/ρ = 1/ρ_p − 1/|ρ_r|, the radii from the tangent points of line of action and base circles."""
    tangent_p, tangent_r = (
        math.sqrt((0.584 * z / 57) ** 2 - (z * 21e-3 / 2 * math.cos(PAIR.pressure_angle)) ** 2)
        for z in (36, 93)
    )
    for r in (pair.r_start, 0.0, pair.r_end):
        at = kinematics(pair.path, r)
        assert 1 / at.pinion_curvature == pytest.approx(tangent_p + r, rel=1e-9)
        assert 1 / at.gear_curvature == pytest.approx(-(tangent_r + r), rel=1e-9)
        assert at.gear_speed == pytest.approx(36 / 93 * (tangent_r + r), rel=1e-9)
        assert at.sliding == pytest.approx((1 - 36 / 93) * r, abs=1e-12)


def test_radii_seen_from_the_ring_are_negative(pair: Assembly):
    view = pair.path_of("gear")
    assert view.pinion_pitch_radius == pytest.approx(-0.584 * 93 / 57, rel=1e-12)
    for r in (pair.r_start, pair.r_end):
        x, y = r * math.cos(pair.path.angle), r * math.sin(pair.path.angle)
        by_hand = math.hypot(x, y - float(pair.path.gear_pitch_radius))
        assert radius(view, -r) == pytest.approx(-by_hand, rel=1e-12)
        assert distance_at_radius(view, -by_hand) == pytest.approx(-r, rel=1e-9)


def test_the_active_root_and_clearances_are_published(pair: Assembly):
    assert 2e3 * lowest_contact_radius(pair, "gear") == pytest.approx(-1969.75, abs=0.005)
    assert 1e3 * tip_clearance(pair, "gear") == pytest.approx(6.709, abs=0.0005)


def test_backlash_closes_where_the_centre_distance_is_tight(pair: Assembly):
    tight = float(involute.tight_centre_distance(PAIR))
    assert tight == pytest.approx(-0.584, abs=1e-6)
    closer = PAIR._replace(centre_distance=tight + 0.05e-3)  # the planet nearer to the ring's axis
    opened = Assembly(family("involute"), closer)
    expected = 2 * (math.tan(pair.path.angle)) * 0.05e-3
    assert circumferential_backlash(opened) == pytest.approx(expected, rel=1e-3)
    assert normal_backlash(opened) == pytest.approx(float(involute.normal_backlash(closer)), rel=1e-9)
    assert abs(normal_backlash(Assembly(family("involute"), PAIR._replace(centre_distance=None)))) < 1e-15
