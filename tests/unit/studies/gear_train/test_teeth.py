"""Phases of meshes that share gears, by turning the outlines of all teeth."""

import re
from collections.abc import Sequence
from math import pi
from typing import NamedTuple

import numpy as np
import pytest

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly, normal_backlash
from tribodyn.geometry.body import half_profile, tooth_outline
from tribodyn.geometry.drive import Drive, GearBody, Side, body_of
from tribodyn.geometry.families import family
from tribodyn.geometry.path import position
from tribodyn.studies.gear_train.teeth import check_same_teeth, engagement
from tribodyn.train.phases import Phases, ToothedShaft, nominal_phases

ALPHA = 20 * pi / 180
MODULE = 4e-3


def body(teeth: int, shift: float = 0.0, allowance: float = 0.0) -> GearBody:
    return GearBody(float(teeth), shift, 1.0, 1.25, 0.25, 0.02, 0.2 * MODULE * teeth, None, allowance)


def pair(driver: GearBody, driven: GearBody, distance: float | None = None, angle: float = ALPHA) -> Assembly:
    return Assembly(family("involute"), Drive(MODULE, angle, driver, driven, (), distance))


class Gear(NamedTuple):
    """A gear of a train under test."""

    shaft: int
    sense: int
    teeth: int
    tooth_angle: float = 0.0


class Mesh(NamedTuple):
    gears: tuple[int, int]
    azimuth: float
    assembly: Assembly


def put_together(gears: Sequence[Gear], meshes: Sequence[Mesh]) -> Phases:
    shafts = [ToothedShaft(str(n), g.shaft, g.teeth, g.sense, g.tooth_angle) for n, g in enumerate(gears)]
    return nominal_phases(
        shafts, [engagement(str(n), mesh.gears, mesh.azimuth, mesh.assembly) for n, mesh in enumerate(meshes)]
    )


class Outline(NamedTuple):
    """A tooth as half thickness angle over radius, rising from root to tip."""

    radius: np.ndarray
    half_angle: np.ndarray
    teeth: int

    def clearance(self, points: np.ndarray, tooth: float) -> np.ndarray:
        """Distance along the circle (m) of points (n, 2) from the nearest tooth; negative inside it.

        A tooth's axis points in the direction `tooth`, counter-clockwise from x; infinite beyond the tip.
        """
        radius, angle = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
        pitch = 2 * pi / self.teeth
        beside = np.abs((angle - tooth + pitch / 2) % pitch - pitch / 2)
        gap = (beside - np.interp(radius, self.radius, self.half_angle)) * radius
        return np.where(radius < self.radius[-1], gap, np.inf)


def outline_of(assembly: Assembly, side: Side) -> Outline:
    shape, teeth = tooth_outline(assembly.tooth(side), 2000, 800), body_of(assembly.drive, side).teeth
    radius, angle = half_profile(shape, teeth)
    flank = len(radius) - 3  # less the points of the tip circle
    return Outline(np.asarray(radius)[3:flank], np.asarray(angle)[3:flank], round(float(teeth)))


def flanks(outline: Outline, tooth: float, centre: np.ndarray) -> np.ndarray:
    """Points of both flanks of all teeth, (n, 2) m, of a gear with its axis at `centre`."""
    index = np.arange(outline.teeth)[:, None] * 2 * pi / outline.teeth
    angles = np.concatenate([index + outline.half_angle, index - outline.half_angle]) + tooth
    radii = np.broadcast_to(outline.radius, angles.shape)
    return centre + np.stack([(radii * np.cos(angles)).ravel(), (radii * np.sin(angles)).ravel()], axis=-1)


def touching(mesh: Mesh, gears: Sequence[Gear], phases: Phases, turns: Sequence[float]) -> None:
    """Turn the outlines of a mesh: they touch, on the path of contact, and nowhere overlap.

    `turns` are angles of the driver in its own sense, rad, from turn 0.
    """
    number_1, number_2 = mesh.gears
    driver, driven = gears[number_1], gears[number_2]
    path = mesh.assembly.path
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    across = np.array([np.cos(mesh.azimuth), np.sin(mesh.azimuth)])
    along = driver.sense * np.array([-across[1], across[0]])  # motion at the pitch point
    centre = (radii[0] + radii[1]) * across
    one, two = outline_of(mesh.assembly, "pinion"), outline_of(mesh.assembly, "gear")
    for turn in turns:
        at_1 = phases.teeth[number_1] + driver.sense * turn
        at_2 = phases.teeth[number_2] + driven.sense * turn * driver.teeth / driven.teeth
        points = flanks(two, at_2, centre)
        points = points[np.hypot(*(points - radii[0] * across).T) < 4 * MODULE]
        clearance = one.clearance(points, at_1)
        assert np.min(clearance) > -0.1e-6, "teeth overlap"
        place = phase_at(mesh, phases, driver, turn)
        start, end = mesh.assembly.roll_limits
        rolls = start + (place + np.arange(4)) * 2 * pi / driver.teeth
        rolls = rolls[rolls < end]
        assert rolls.size
        for r in np.asarray(path.signed_distance(rolls)):
            x, y = position(path, r)
            contact = radii[0] * across + x * along + y * across
            near = np.hypot(*(points - contact).T) < 0.01 * MODULE
            assert np.min(clearance[near]) == pytest.approx(0.0, abs=0.1e-6), "no contact where it is due"


def phase_at(mesh: Mesh, phases: Phases, driver: Gear, turn: float) -> float:
    """Phase of the mesh after a turn of its driver, by the number that was worked out."""
    phase = phases.meshes[ORDER[id(mesh)]]
    return (phase + driver.teeth * turn / (2 * pi)) % 1.0


ORDER: dict[int, int] = {}


def check(gears: Sequence[Gear], meshes: Sequence[Mesh], turns: Sequence[float] = (0.0, 0.013, 0.61, 5.0)):
    """Every mesh, at the same turns of the first driver."""
    phases = put_together(gears, meshes)
    ORDER.clear()
    ORDER.update({id(mesh): place for place, mesh in enumerate(meshes)})
    speeds = {gears[meshes[0].gears[0]].shaft: 1.0}
    for mesh in meshes:
        driver, driven = (gears[end] for end in mesh.gears)
        speeds[driven.shaft] = speeds[driver.shaft] * driver.teeth / driven.teeth
    for mesh in meshes:
        touching(mesh, gears, phases, [turn * speeds[gears[mesh.gears[0]].shaft] for turn in turns])
    assert phases.meshes[0] == 0.0
    return phases


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(("teeth", "azimuth"), [(60, 0.0), (37, 40.0), (37, 73.3), (40, -61.7)])
def test_an_idler_at_any_angle(sense: int, teeth: int, azimuth: float):
    """With profile shifts on all gears; azimuth of the second mesh in degrees, the first stands at 15°."""
    a, i, b = body(23, 0.2), body(teeth, -0.11), body(31, 0.3)
    gears = [Gear(0, sense, 23), Gear(1, -sense, teeth), Gear(2, sense, 31)]
    meshes = [
        Mesh((0, 1), 15 * pi / 180, pair(a, i)),
        Mesh((1, 2), azimuth * pi / 180, pair(i, b)),
    ]
    check(gears, meshes)


@pytest.mark.parametrize(("teeth", "turned"), [(60, 180.0), (60, 120.0), (37, 140.0), (37, 213.3)])
def test_the_formula_of_an_idler(teeth: int, turned: float):
    """γ_2 − γ_1 = z (ψ_1 − ψ_3 + ν_1 + ν_2)/2π from pitch point to pitch point, ν of the involute.

    ν = (π/2 + 2 x tan α)/z + inv α − inv α_w; azimuths of its mates as the idler sees them, in its own sense.
    """
    sense, x = -1, 0.15
    a, i, b = body(23, 0.2), body(teeth, x), body(31, 0.1)
    first, second = pair(a, i), pair(i, b)
    azimuth_1 = 0.3
    azimuth_2 = azimuth_1 + pi - turned * pi / 180
    gears = [Gear(0, -sense, 23), Gear(1, sense, teeth), Gear(2, -sense, 31)]
    phases = put_together(gears, [Mesh((0, 1), azimuth_1, first), Mesh((1, 2), azimuth_2, second)])

    def inv(angle: float) -> float:
        return np.tan(angle) - angle

    nu = [
        (pi / 2 + 2 * x * np.tan(ALPHA)) / teeth + inv(ALPHA) - inv(float(one.path.pressure_angle(0.0)))
        for one in (first, second)
    ]
    psi_1, psi_3 = sense * (azimuth_1 + pi), sense * azimuth_2
    between = teeth * (psi_1 - psi_3 + sum(nu)) / (2 * pi)
    # from the pitch point to where the pairs enter, in cycles
    entries = [float(-one.roll_limits[0] / one.pitch_angle) for one in (first, second)]
    found = phases.meshes[1] - entries[1] - (phases.meshes[0] - entries[0])
    assert (found - between + 0.5) % 1.0 - 0.5 == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("tooth_angle", [0.0, 3.7])
def test_two_stages_over_a_shaft_whose_gears_are_turned_against_each_other(tooth_angle: float):
    """Odd numbers of teeth, a centre distance of its own, and another pressure angle in the second stage."""
    a, b, c, d = body(19, 0.4), body(51, 0.1), body(21, 0.25), body(43, -0.2)
    distance = MODULE * (19 + 51) / 2 + 2.2e-3
    gears = [Gear(0, -1, 19), Gear(1, 1, 51), Gear(1, 1, 21, tooth_angle * pi / 180), Gear(2, -1, 43)]
    meshes = [
        Mesh((0, 1), 1.1, pair(a, b, distance)),
        Mesh((2, 3), -0.4, pair(c, d, angle=25 * pi / 180)),
    ]
    assert float(normal_backlash(meshes[0].assembly)) > 0.0
    check(gears, meshes)


def test_thin_teeth_touch_with_their_driving_flanks():
    """With backlash through tooth thickness on both gears of an idler."""
    a, i, b = body(23, 0.0, -60e-6), body(41, 0.0, -80e-6), body(29, 0.0, -40e-6)
    gears = [Gear(0, 1, 23), Gear(1, -1, 41), Gear(2, 1, 29)]
    check(gears, [Mesh((0, 1), 0.0, pair(a, i)), Mesh((1, 2), 0.9, pair(i, b))])


def test_two_pinions_on_one_bull_gear():
    p, bull, q = body(20, 0.3), body(63), body(25, 0.1)
    gears = [Gear(0, 1, 63), Gear(1, -1, 20), Gear(2, -1, 25)]
    check(gears, [Mesh((0, 1), 0.4, pair(bull, p)), Mesh((0, 2), 2.6, pair(bull, q))])


CYCLOID = family("cycloidal")


def test_teeth_that_are_no_involutes():
    """Cycloidal teeth are cut by one rack, so that an idler has the same teeth in both meshes."""
    a, i, b = body(21), body(34), body(27)
    shape = CYCLOID.shape(3.0 * MODULE, 3.0 * MODULE)
    first = Assembly(CYCLOID, Drive(MODULE, 0.0, a, i, shape))
    second = Assembly(CYCLOID, Drive(MODULE, 0.0, i, b, shape))
    check_same_teeth("gear.idler", "idler", [(first, "gear"), (second, "pinion")])
    gears = [Gear(0, 1, 21), Gear(1, -1, 34), Gear(2, 1, 27)]
    check(gears, [Mesh((0, 1), 0.2, first), Mesh((1, 2), 1.0, second)])


def test_a_loop_whose_teeth_do_not_meet_says_how_to_turn_the_gear():
    """One pinion, two compound shafts, one bull gear: with the angle from the message it goes together."""
    p, b, c, bull = body(20), body(41), body(23), body(101)
    first, last = pair(p, b), pair(c, bull)
    distance, far = MODULE * 61 / 2, MODULE * 124 / 2
    # both axes of the outer gears on x, the shafts above and below
    inward = 2.0
    up = float(np.arcsin(distance * np.sin(inward) / far))

    def train(angle: float) -> tuple[list[Gear], list[Mesh]]:
        gears = [
            *(Gear(0, 1, 20), Gear(1, -1, 41), Gear(2, -1, 41)),
            *(Gear(1, -1, 23), Gear(2, -1, 23, angle), Gear(3, 1, 101)),
        ]
        meshes = [
            *(Mesh((0, 1), inward, first), Mesh((0, 2), -inward, first)),
            *(Mesh((3, 5), -up, last), Mesh((4, 5), up, last)),
        ]
        return gears, meshes

    with pytest.raises(InputError, match="do not meet") as caught:
        put_together(*train(0.01))
    said = re.search(r'turn 4 on its shaft: tooth_angle = "(.*) deg"', caught.value.remedy)
    assert said is not None
    gears, meshes = train(float(said[1]) * pi / 180)
    check(gears, meshes[:3], turns=[0.0])
    check(gears, [meshes[0], meshes[1], meshes[3]], turns=[0.0])
    phases = put_together(gears, meshes)
    for place, mesh in enumerate(meshes):
        ORDER[id(mesh)] = place
        touching(mesh, gears, phases, [0.0])


def test_one_gear_with_two_shapes_of_teeth_is_refused():
    first, second = pair(body(23), body(40)), pair(body(40), body(31), angle=25 * pi / 180)
    with pytest.raises(InputError, match="its 40 teeth differ by") as caught:
        check_same_teeth("gear.idler", "idler", [(first, "gear"), (second, "pinion")])
    assert caught.value.key == "gear.idler"
