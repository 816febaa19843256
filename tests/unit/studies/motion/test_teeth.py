"""Phases of meshes that share gears, by turning the outlines of all teeth."""

from collections.abc import Sequence
from math import pi
from typing import NamedTuple

import numpy as np
import pytest

from tests.support.turning_outlines import Turning, assert_touching
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.backlash import normal_backlash
from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import family
from tribodyn.studies.motion.drivetrain.teeth import check_same_teeth, engagement
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


def check(gears: Sequence[Gear], meshes: Sequence[Mesh], turns: Sequence[float] = (0.0, 0.013, 0.61, 5.0)):
    """Turn every mesh, by the same turns of the first driver."""
    phases = put_together(gears, meshes)
    assert phases.meshes[0] == 0.0
    speeds = {gears[meshes[0].gears[0]].shaft: 1.0}
    for ((one, two), azimuth, assembly), phase in zip(meshes, phases.meshes, strict=True):
        speeds[gears[two].shaft] = speeds[gears[one].shaft] * gears[one].teeth / gears[two].teeth
        teeth = phases.teeth[one], phases.teeth[two]
        mesh = Turning(assembly, azimuth, gears[one].sense, teeth, phase)
        assert_touching(mesh, [turn * speeds[gears[one].shaft] for turn in turns])


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
