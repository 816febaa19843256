"""An internal gear pair by negative radii (ISO 21771) against a published sheet, KISSsoft (2017).

Planet and ring of a planetary stage, z 36/-93, m 21 mm: the report's figures to its last digit.
"""

import math
from itertools import product
from typing import Any

import jax
import numpy as np
import pytest

from tests.support.ring_outlines import penetration
from tests.support.soak_parameters import all_in_soak
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, lowest_contact_radius, tip_clearance
from tribodyn.geometry.backlash import circumferential_backlash, normal_backlash
from tribodyn.geometry.body import gear_polygon, mass_and_inertia
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family, involute
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.limits.limits import radial_assembly, trochoidal_gap
from tribodyn.geometry.path import distance_at_radius, kinematics, radius
from tribodyn.geometry.tooth import Tooth, fillet_point

jax.config.update("jax_enable_x64", True)

PLANET = GearBody(36.0, 0.5039, 1.0, 1.25, 0.3, 0.55, 0.15, tip_radius=407.8315e-3)
RING = GearBody(-93.0, 0.1171, 1.0, 1.25, 0.3, 0.55, -1.1, tip_radius=-953.0405e-3)
PAIR = Drive(21e-3, math.radians(20.0), PLANET, RING, centre_distance=-0.584)


@pytest.fixture(scope="module")
def pair() -> Assembly:
    return Assembly(family("involute"), PAIR)


def _angle(pair: Assembly) -> float:
    return float(pair.path.pressure_angle(0.0))


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
        x, y = r * math.cos(_angle(pair)), r * math.sin(_angle(pair))
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
    expected = 2 * (math.tan(_angle(pair))) * 0.05e-3
    assert circumferential_backlash(opened) == pytest.approx(expected, rel=1e-3)
    assert normal_backlash(opened) == pytest.approx(float(involute.normal_backlash(closer)), rel=1e-9)
    assert abs(normal_backlash(Assembly(family("involute"), PAIR._replace(centre_distance=None)))) < 1e-15


def test_a_cutter_leaves_the_published_root_and_form_circle():
    """x from the root circle, whose diameter has a digit more than x: m (z/2 + x − 1.25) = −2000.581 mm/2."""
    shift = 1.25 + 46.5 - 2000.581 / 42
    assert shift == pytest.approx(0.1171, abs=5e-5)
    ring = RING._replace(profile_shift=shift, cutter_teeth=30.0)
    tooth = Assembly(family("involute"), PAIR._replace(gear=ring)).gear
    assert 2e3 * tooth.root_radius == pytest.approx(-2000.581, abs=0.0005)
    assert 2e3 * tooth.form_radius == pytest.approx(-1987.879, abs=0.0005)
    assert not tooth.overrun > 0


def test_a_cutter_of_given_height_leaves_its_own_root_circle():
    """Centre distance of cutter and ring without backlash by bisection, plus the cutter's tip circle."""
    alpha, target = PAIR.pressure_angle, 2 * math.tan(PAIR.pressure_angle) * 0.1171 / -63
    low, high = 0.1, alpha
    for _ in range(80):
        middle = (low + high) / 2
        inv = math.tan(middle) - middle - math.tan(alpha) + alpha
        low, high = (middle, high) if inv < target else (low, middle)
    distance = 21e-3 * 63 / 2 * math.cos(alpha) / math.cos(low)
    ring = RING._replace(cutter_teeth=30.0, cutter_addendum=1.25)
    tooth = Assembly(family("involute"), PAIR._replace(gear=ring)).gear
    assert tooth.root_radius == pytest.approx(-(distance + 21e-3 * (15 + 1.25)), rel=1e-9)


def test_a_cutter_of_many_teeth_cuts_as_a_rack():
    def tooth(**changes: float) -> Tooth:
        planet = PLANET._replace(tip_radius=None, **changes)
        return Assembly(family("involute"), PAIR._replace(pinion=planet, centre_distance=None)).pinion

    rack, cutter = tooth(), tooth(cutter_teeth=1e7)
    for name in ("form_radius", "root_radius", "tip_radius"):
        assert getattr(cutter, name) == pytest.approx(float(getattr(rack, name)), abs=2e-8)
    normal = np.linspace(np.pi / 2, float(rack.form_angle), 9)
    assert np.array(fillet_point(cutter, normal)) == pytest.approx(
        np.array(fillet_point(rack, normal)), abs=2e-8
    )


def test_the_fillet_is_the_envelope_of_the_cutters_rounding():
    """Every point of it comes as near to the rounding's centre as its radius while ring and cutter roll."""
    ring = RING._replace(cutter_teeth=30.0, cutter_shift=0.1)
    tooth = Assembly(family("involute"), PAIR._replace(gear=ring)).gear
    r_g, r_0 = -float(tooth.path.pinion_pitch_radius), float(tooth.path.gear_pitch_radius)
    rolled = np.linspace(-0.09, 0.03, 120_001)  # arc of the pitch circles, m; they touch at the origin
    centre_radius, centre_angle = r_0 - tooth.corner_y, (tooth.corner_x + rolled) / r_0
    centre = centre_radius * np.sin(centre_angle), r_0 - centre_radius * np.cos(centre_angle)
    for normal in np.linspace(np.pi / 2, float(tooth.form_angle), 7):
        x, y = fillet_point(tooth, np.array(normal))
        size, angle = math.hypot(x, y), math.atan2(y, -x)
        turned = float(tooth.half_angle) + angle + rolled / r_g  # the tooth's axis left of the origin
        place = size * np.sin(turned), r_g - size * np.cos(turned)
        near = np.hypot(place[0] - centre[0], place[1] - centre[1]).min()
        assert near == pytest.approx(0.3 * 21e-3, abs=1e-9)


def test_gradients_by_the_cutter_are_those_of_differences():
    def sizes(shift: Any, rounding: Any) -> Any:
        ring = RING._replace(cutter_teeth=30.0, cutter_shift=shift, fillet_radius=rounding)
        tooth = Assembly(family("involute"), PAIR._replace(gear=ring)).gear
        return tooth.form_radius + tooth.half_angle * tooth.corner_x

    found = jax.grad(sizes, argnums=(0, 1))(0.0, 0.3)
    step = 1e-5
    by_shift = (sizes(step, 0.3) - sizes(-step, 0.3)) / (2 * step)
    by_rounding = (sizes(0.0, 0.3 + step) - sizes(0.0, 0.3 - step)) / (2 * step)
    assert np.array(found) == pytest.approx(np.array([by_shift, by_rounding]), rel=1e-7)


@pytest.mark.parametrize(
    ("shift", "off"),
    all_in_soak(product([0.1171, -0.2], [0.0, 0.2e-3]), [(0.1171, 0.2e-3), (-0.2, 0.0)], names=2),
)
def test_planet_and_ring_roll_without_penetration(shift: float, off: float):
    """On the flanks they touch: 0 within a nanometre; with backlash the back flanks are its width apart."""
    ring = RING._replace(profile_shift=shift, cutter_teeth=30.0, tip_radius=None, addendum=0.9)
    pair = PAIR._replace(gear=ring, centre_distance=None)
    tight = float(involute.tight_centre_distance(pair))
    deepest = penetration(Assembly(family("involute"), pair._replace(centre_distance=tight + off)))
    assert abs(deepest.max()) < 1e-9


def test_section_and_polygon_of_a_ring_agree():
    """The material between outside and hole: the polygon's shoelace against arcs and chords."""
    ring = RING._replace(cutter_teeth=30.0)
    pair = Assembly(family("involute"), PAIR._replace(gear=ring))
    x, y = gear_polygon(pair, "gear", 300).T
    hole = abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2
    mass, inertia = mass_and_inertia(pair, "gear", 1.0)
    assert mass == pytest.approx(0.55 * (math.pi * 1.1**2 - hole), rel=1e-5)
    assert mass * 0.97**2 < inertia < mass * 1.1**2


def _small(ring_teeth: int, addendum: float = 0.8) -> Drive:
    """36 teeth in a ring of hardly more, stub teeth, x = 0."""
    planet = GearBody(36.0, 0.0, addendum, 1.25, 0.3, 0.05, 0.02)
    ring = GearBody(-float(ring_teeth), 0.0, addendum, 1.25, 0.3, 0.05, -0.1, cutter_teeth=20.0)
    return Drive(3e-3, math.radians(20.0), planet, ring)


def test_tips_that_pass_run_into_each_other_where_the_distance_is_negative():
    """Outlines rolled, all teeth: for eight teeth more they pass, for six they do not."""
    kept, broken = (Assembly(family("involute"), _small(teeth)) for teeth in (44, 42))
    assert trochoidal_gap(kept, "gear") > 0 > trochoidal_gap(broken, "gear")
    assert penetration(kept).max() < 1e-9
    assert penetration(broken).max() > 0.2 * -trochoidal_gap(broken, "gear")


@pytest.mark.parametrize(
    ("drive", "key", "says"),
    [
        (_small(42), "drive.gear.addendum", "the tips run into each other"),
        (_small(30), "drive.gear.teeth", "more teeth than the pinion"),
        (_small(60)._replace(centre_distance=-0.0365), "drive.centre_distance", "the teeth overlap"),
        (_small(60)._replace(centre_distance=0.036), "drive.centre_distance", "greater than zero"),
        (
            _small(60)._replace(gear=_small(60).gear._replace(bore_radius=-0.093)),
            "drive.gear.outer_diameter",
            "reaches the outside",
        ),
        (
            _small(60)._replace(gear=_small(60).gear._replace(tip_radius=-0.084)),
            "drive.gear.tip_radius",
            "use at least 84.573 mm",  # the base circle: 90 mm cos 20°, 84.572,
        ),
        (
            _small(60)._replace(gear=_small(60).gear._replace(dedendum=0.7)),
            "drive.pinion.addendum",
            "below the root circle of the gear",
        ),
        (
            _small(44)._replace(gear=_small(44).gear._replace(cutter_teeth=11.0, fillet_radius=0.05)),
            "drive.gear.cutter_teeth",
            "the cutter's involute ends",
        ),
    ],
)
def test_what_cannot_be_made_or_run_is_refused(drive: Drive, key: str, says: str):
    with pytest.raises(InputError) as refused:
        check(family("involute"), drive)
    assert refused.value.key == key
    assert says in str(refused.value)


def test_radial_assembly_needs_more_teeth_than_running():
    """The more teeth the ring has more than the planet, the more room there is; few are too few."""
    room = [radial_assembly(Assembly(family("involute"), _small(teeth)), "gear") for teeth in range(42, 60)]
    assert all(np.diff(room) > 0)
    assert room[0] < 0 < room[-1]
