"""Limits of internal pairs against the closed forms in tables of gear makers (α_a, θ of both tips)."""

import math

import pytest

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Drive, GearBody, tip_radius
from tribodyn.geometry.families import family
from tribodyn.geometry.limits.limits import base_circle_margin, radial_assembly, trochoidal_gap

#: z_p, |z_r|, α in degrees
PAIRS = ((36, 93, 20.0), (20, 36, 20.0), (22, 40, 20.0), (24, 41, 20.0), (30, 38, 25.0), (60, 68, 25.0))


def pair_of(planet: int, ring: int, angle: float) -> Assembly:
    bodies = (GearBody(teeth, 0.0, 1.0, 1.25, 0.3, 0.02, 0.0) for teeth in (float(planet), -float(ring)))
    planet_body, ring_body = bodies
    ring_body = ring_body._replace(cutter_teeth=18.0)
    return Assembly(family("involute"), Drive(1e-3, math.radians(angle), planet_body, ring_body))


def inv(angle: float) -> float:
    return math.tan(angle) - angle


def tip_angles(pair: Assembly) -> tuple[float, float, float, float, float]:
    """Tip radii, pressure angles at both, centre distance; all positive."""
    drive = pair.drive
    planet, ring = tip_radius(drive, "pinion"), -tip_radius(drive, "gear")
    cosine = drive.module / 2 * math.cos(drive.pressure_angle)
    of_planet = math.acos(drive.pinion.teeth * cosine / planet)
    of_ring = math.acos(-drive.gear.teeth * cosine / ring)
    return planet, ring, of_planet, of_ring, -(drive.pinion.teeth + drive.gear.teeth) * drive.module / 2


@pytest.mark.parametrize("numbers", PAIRS)
def test_trochoidal_interference_is_the_closed_form(numbers: tuple[int, int, float]):
    """θ_1 z_1/z_2 + inv α_w − inv α_a2 ≥ θ_2."""
    pair, share = pair_of(*numbers), numbers[0] / numbers[1]
    planet, ring, of_planet, of_ring, distance = tip_angles(pair)
    working = inv(pair.drive.pressure_angle)
    first = math.acos((ring**2 - planet**2 - distance**2) / (2 * distance * planet))
    second = math.acos((distance**2 + ring**2 - planet**2) / (2 * distance * ring))
    expected = ring * ((first + inv(of_planet) - working) * share + working - inv(of_ring) - second)
    assert trochoidal_gap(pair, "gear") == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("numbers", PAIRS)
def test_the_base_circle_is_that_of_the_closed_form(numbers: tuple[int, int, float]):
    """r_a2 − r_b2."""
    pair = pair_of(*numbers)
    base = -pair.drive.gear.teeth * pair.drive.module / 2 * math.cos(pair.drive.pressure_angle)
    expected = base / math.cos(tip_angles(pair)[3]) - base
    assert base_circle_margin(pair, "gear") == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("numbers", PAIRS)
def test_radial_assembly_has_the_sign_of_the_closed_form(numbers: tuple[int, int, float]):
    """θ_1 + inv α_a1 − inv α_w ≥ (z_2/z_1)(θ_2 + inv α_a2 − inv α_w): the least gap along the tip circle."""
    pair, ratio = pair_of(*numbers), numbers[1] / numbers[0]
    _, _, of_planet, of_ring, _ = tip_angles(pair)
    cosines = math.cos(of_planet) / math.cos(of_ring)
    first = math.asin(math.sqrt((1 - cosines**2) / (1 - ratio**-2)))
    second = math.asin(math.sqrt((cosines**-2 - 1) / (ratio**2 - 1)))
    working = inv(pair.drive.pressure_angle)
    margin = first + inv(of_planet) - working - ratio * (second + inv(of_ring) - working)
    # the form is of a tooth anywhere, and the room that of the planet's best position: hardly more
    room = radial_assembly(pair, "gear")
    assert room > 0 or margin < 0
    assert room < 0 or margin > -0.002
