"""Rings of the families of paths of contact beside the involute: outlines, motion, closed forms, limits."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Chebyshev

from tests.support.ring_families import MODULE, SHAPES, drive, ring_of
from tests.support.ring_outlines import penetration
from tests.support.soak_parameters import all_in_soak
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.families import family
from tribodyn.geometry.families.cycloidal import CycloidShape
from tribodyn.geometry.families.parabolic import ParabolaShape
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.limits.limits import radial_assembly, tool_margin, trochoidal_gap
from tribodyn.geometry.path import kinematics, pitch_point, position
from tribodyn.geometry.tooth import flank_point, polar, thickness_half_angle


@pytest.mark.parametrize("name", SHAPES)
def test_planet_and_ring_touch_at_every_roll_and_nowhere_overlap(name: str):
    assert np.abs(penetration(ring_of(name))).max() < 1e-9


def test_thicker_teeth_overlap_by_what_they_are_thicker():
    pair = drive("cycloidal")
    thicker = pair._replace(pinion=pair.pinion._replace(thickness_allowance=20e-9))
    assert penetration(Assembly(family("cycloidal"), thicker)).max() == pytest.approx(20e-9, rel=0.05)


@pytest.mark.parametrize("name", SHAPES)
def test_motion_along_the_flanks_is_that_of_the_outlines(name: str):
    """Speeds and curvatures by derivatives of the points of the teeth, on either side of the pitch point."""
    pair = ring_of(name)
    path, along = pair.path, np.linspace(0.25, 0.95, 12)
    for end in (pair.r_start, pair.r_end):
        domain = sorted((0.15 * end, end))
        r, nodes = along * end, np.cos(np.pi * (np.arange(40) + 0.5) / 40)
        nodes = domain[0] + (domain[1] - domain[0]) * (nodes + 1) / 2
        motion, curvatures = kinematics(path, r), []
        per_angle = motion.pinion_normal_arm  # dr/dφ
        for tooth, way, speed in ((pair.pinion, 1, motion.pinion_speed), (pair.gear, -1, motion.gear_speed)):
            fits = [Chebyshev.fit(nodes, v, 30, domain=domain) for v in flank_point(tooth, way * nodes)]
            (x1, y1), (x2, y2) = ([fit.deriv(order)(r) for fit in fits] for order in (1, 2))
            np.testing.assert_allclose(np.hypot(x1, y1) * per_angle, speed, rtol=1e-6)
            # the way from root to tip along a tooth above its axis: convex where it bends down
            curvatures.append(-way * (x1 * y2 - y1 * x2) / np.hypot(x1, y1) ** 3)
        np.testing.assert_allclose(curvatures[0], motion.pinion_curvature, rtol=1e-3, atol=1e-2)
        np.testing.assert_allclose(curvatures[1], motion.gear_curvature, rtol=1e-3, atol=1e-2)
        np.testing.assert_allclose(motion.sliding, r * (1 - 24 / 72), rtol=1e-9)
        # 1/ρ = (1 + w) r_p sin α/(u_p u_g): positive wherever both flanks exist
        product = motion.pinion_speed * motion.gear_speed
        closed = (1 - 24 / 72) * 36e-3 * np.sin(motion.pressure_angle) / product
        np.testing.assert_allclose(motion.relative_curvature, closed, rtol=1e-9)


@pytest.mark.parametrize("name", SHAPES)
def test_large_mates_of_either_kind_become_the_familys_rack(name: str):
    """External and internal mates stand on either side of the rack, at distances that fall like 1/N."""

    def numbers(teeth: int) -> np.ndarray:
        pair = Assembly(family(name), drive(name, (24, teeth)))
        at = kinematics(pair.path, np.array([-3e-3, 2e-3]))
        return np.array([pair.contact_ratio, *pair.limits, *at.relative_curvature, *at.gear_speed])

    outside, inside = ([numbers(sign * count) for count in (1000, 2000)] for sign in (1, -1))
    distances = [one - two for one, two in zip(outside, inside, strict=True)]
    means = [(one + two) / 2 for one, two in zip(outside, inside, strict=True)]
    np.testing.assert_allclose(distances[0], 2 * distances[1], rtol=2e-2, atol=1e-9)
    np.testing.assert_allclose(means[0], means[1], rtol=1e-3)


def test_flanks_of_a_cycloidal_ring_are_drawn_by_the_generating_circles():
    """Points of a circle that rolls inside (teeth's tips) and outside (roots) of the ring's pitch circle."""
    tooth, pitch = ring_of("cycloidal").gear, 108e-3
    middle = -float(thickness_half_angle(tooth, -pitch))
    for small, way in ((12e-3, -1.0), (15e-3, 1.0)):  # of the approach inside, of the recess outside
        centre = pitch + way * small
        roll = np.linspace(0.02, 0.24, 30)
        spun = roll * centre / small
        x = centre * np.cos(roll) - way * small * np.cos(spun)
        y = centre * np.sin(roll) - small * np.sin(spun)
        radius = np.hypot(x, y)
        kept = (radius > -tooth.tip_radius) & (radius < -tooth.form_radius)
        assert kept.sum() > 5
        half = -np.asarray(thickness_half_angle(tooth, -radius[kept]))
        np.testing.assert_allclose(half - middle, way * np.arctan2(y, x)[kept], atol=1e-9)


def test_curvatures_of_a_cycloidal_ring_are_veciana_s_with_a_negative_diameter():
    """R = 2 sin a (d2 + d_g)(d1 − d_g)/(d1 + d2) in approach, (d1 + d_g)(d2 − d_g) in recess; d2 < 0."""
    pair, d1, d2 = ring_of("cycloidal"), 72e-3, -216e-3
    for end, circle in ((pair.r_start, 24e-3), (pair.r_end, 30e-3)):
        way = -1 if end < 0 else 1
        at = kinematics(pair.path, 0.6 * end)
        sine = abs(0.6 * end) / circle
        closed = 2 * sine * (d2 - way * circle) * (d1 + way * circle) / (d1 + d2)
        assert 1 / at.relative_curvature == pytest.approx(closed, rel=1e-9)


def test_half_the_planets_pitch_circle_draws_radial_flanks():
    shape = CycloidShape(36e-3, 30e-3)
    tooth = Assembly(family("cycloidal"), drive("cycloidal")._replace(shape=shape)).pinion
    halves = thickness_half_angle(tooth, np.linspace(float(tooth.form_radius), 36e-3, 9))
    np.testing.assert_allclose(halves, halves[-1], atol=1e-9)


def test_constant_relative_curvature_in_a_ring_of_twice_the_teeth_is_an_arc_on_a_straight_line():
    """w = −1/2: sin α = sin α_P − r/(2 r_p) solves the equation; the planet's flank is an arc of ρ_0."""
    pair = check(family("crc"), drive("crc", (30, -60), addendum=0.7))
    r = np.linspace(pair.r_start, pair.r_end, 15)
    at, sine = kinematics(pair.path, r), math.sin(math.radians(24.0))
    np.testing.assert_allclose(np.sin(at.pressure_angle), sine - r / 90e-3, atol=1e-12)
    np.testing.assert_allclose(at.pinion_curvature, 1 / (90e-3 * sine), rtol=1e-8)
    np.testing.assert_allclose(at.gear_curvature, 0.0, atol=1e-6)
    x, y = flank_point(pair.gear, -r)
    assert np.abs(np.polyval(np.polyfit(x, y, 1), x) - y).max() < 1e-11


@pytest.mark.parametrize("teeth", [(24, -72), (30, -60), (20, -90)])
def test_relative_curvature_is_constant_in_a_ring(teeth: tuple[int, int]):
    pair = check(family("crc"), drive("crc", teeth, addendum=0.6))
    at = kinematics(pair.path, np.linspace(pair.r_start, pair.r_end, 25))
    ratio = teeth[0] / teeth[1]
    radius = MODULE * teeth[0] / 2 * math.sin(math.radians(24.0)) / (1 + ratio)
    np.testing.assert_allclose(1 / at.relative_curvature, radius, rtol=1e-9)


def test_tips_that_run_into_the_rings_flank_have_no_room():
    """Before the corners pass: a large circle leaves the ring nearly radial flanks."""
    pair = drive("cycloidal", (18, -42), addendum=0.6, cutter_teeth=22.0)
    shape = CycloidShape(15.8e-3, 195e-3)
    pair = pair._replace(pinion=pair.pinion._replace(addendum=0.55), shape=shape)
    broken, kept = (
        Assembly(family("cycloidal"), pair._replace(shape=shape._replace(recess_circle=circle)))
        for circle in (195e-3, 30e-3)
    )
    assert trochoidal_gap(broken, "gear") < 0 < trochoidal_gap(kept, "gear")
    assert penetration(broken).max() > 10e-6
    assert penetration(kept).max() < 1e-9
    assert radial_assembly(kept, "gear") > radial_assembly(broken, "gear")


@pytest.mark.parametrize("count", all_in_soak([14, 40], [14]))
def test_random_rings_that_pass_the_checks_roll_without_overlap(count: int):
    """Of cycloids and parabolas, whose flanks are the steepest."""
    draw, passed = np.random.default_rng(7), 0
    for number in range(count):
        name = ("cycloidal", "parabolic")[number % 2]
        planet = int(draw.integers(15, 50))
        ring = planet + int(draw.integers(8, 90))
        pair = drive(name, (planet, -ring), addendum=draw.uniform(0.4, 1.1), cutter_teeth=float(ring // 2))
        shape: Any = CycloidShape(draw.uniform(9e-3, 50e-3), draw.uniform(15e-3, 280e-3))
        if name == "parabolic":
            shape = ParabolaShape(draw.uniform(-0.5, -0.03), draw.uniform(0.1, 0.4))
        body = pair.pinion._replace(addendum=draw.uniform(0.4, 1.1))
        try:
            made = check(family(name), pair._replace(shape=shape, pinion=body))
        except InputError:
            continue
        passed += 1
        assert penetration(made).max() < 1e-9
    assert passed > count // 10


def test_a_cutter_smaller_than_the_generating_circle_has_no_flank():
    """The approach's circle rolls inside the cutter as it does inside the planet: d_0 > d_g1."""
    for teeth, kept in ((9.0, True), (8.0, False)):  # 27 and 24 mm against 24.5
        pair = drive("cycloidal", cutter_teeth=teeth)._replace(shape=CycloidShape(24.5e-3, 30e-3))
        assert bool(tool_margin(Assembly(family("cycloidal"), pair), "gear") > 0) is kept


def test_the_cutter_touches_the_ring_on_the_path_of_the_planet():
    """A point of the ring's flank, turned to where the path has it, is a point of the path."""
    pair = ring_of("spline")
    tooth, r = pair.gear, np.linspace(pair.r_start, pair.r_end, 9)
    distance, angle = polar(*position(tooth.path, -r), tooth.path.pinion_pitch_radius)
    x, y = flank_point(tooth, -r)
    np.testing.assert_allclose(np.hypot(x, y), -distance, rtol=1e-12)
    turned = float(tooth.half_angle) + angle - tooth.path.rotation(-r)
    np.testing.assert_allclose(np.arctan2(y, -x), -turned, atol=1e-12)


@pytest.mark.parametrize(
    ("name", "changes", "key", "says"),
    [
        (
            "crc",
            {"angle": math.radians(11.0), "fillet_radius": 0.1},
            "drive.pinion.addendum",
            "no rack cuts the tooth",
        ),
        ("parabolic", {"shape": ParabolaShape(0.12, 0.3)}, "drive.shape.k1", "use -0.12"),
        ("cycloidal", {"shape": CycloidShape(80e-3, 30e-3)}, "drive.shape.approach_circle", "pinion, whose"),
        ("cycloidal", {"cutter_teeth": 8.0}, "drive.gear.cutter_teeth", "cutter's flank ends"),
        ("cycloidal", {"cutter_shift": 0.1}, "drive.gear.cutter_profile_shift", "use 0"),
        ("s-gear", {"addendum": 1.2}, "drive.gear.addendum", "use at most 1"),
        ("spline", {"teeth": (24, -28)}, "drive.gear.addendum", "the tips run into each other"),
    ],
)
def test_what_a_ring_cannot_follow_is_refused(name: str, changes: dict[str, Any], key: str, says: str):
    of_pair = {key: value for key, value in changes.items() if key not in ("angle", "shape")}
    pair = drive(name, **of_pair)
    pair = pair._replace(
        pressure_angle=changes.get("angle", pair.pressure_angle), shape=changes.get("shape", pair.shape)
    )
    with pytest.raises(InputError) as refused:
        check(family(name), pair)
    assert refused.value.key == key
    assert says in str(refused.value)


def test_cycloids_vanish_at_the_pitch_point_alike_from_either_gear():
    """Averaged radius, and entrainment per rad of the pinion: a ring turns w times as far, and w < 0."""
    from_planet = pitch_point(ring_of("cycloidal").path)
    pair = drive("cycloidal")
    swapped = pair._replace(pinion=pair.gear, gear=pair.pinion, shape=CycloidShape(*pair.shape[::-1]))
    from_ring = pitch_point(Assembly(family("cycloidal"), swapped).path)
    assert from_ring.length == pytest.approx(from_planet.length, rel=1e-12)
    assert from_ring.speed_per_radius == pytest.approx(-3 * from_planet.speed_per_radius, rel=1e-12)
