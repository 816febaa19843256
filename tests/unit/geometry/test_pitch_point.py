"""The contact at the pitch point of a path whose pressure angle is zero there."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from tribodyn.geometry.drive import Drive, GearBody
from tribodyn.geometry.families import circular_arc, cycloidal, involute, parabolic
from tribodyn.geometry.path import kinematics, pitch_point
from tribodyn.tribology.contact import averaged_radius, hertz_half_width

MODULUS = 226e9


def body(teeth):
    return GearBody(teeth, 0.0, 1.0, 1.25, 0.25, 0.02, 0.01)


def drive(shape, pinion=23.0, gear=47.0, angle=0.0):
    return Drive(0.003, angle, body(pinion), body(gear), shape)


CASES = [
    (cycloidal.FAMILY, drive(cycloidal.CycloidShape(0.0235, 0.0235))),
    (cycloidal.FAMILY, drive(cycloidal.CycloidShape(0.012, 0.03), 17.0, 90.0)),
    (parabolic.FAMILY, drive(parabolic.ParabolaShape(0.32, 0.32))),
    (parabolic.FAMILY, drive(parabolic.ParabolaShape(0.2, 0.4), 29.0, 17.0)),
]


def flank_curvatures(path):
    """(way along the flank, its curvature) of pinion and gear, after and before P, by quadrature of u."""
    found = []
    for half in (1.0, -1.0):
        r = half * np.geomspace(1e-6, 0.2, 6000) * path.pinion_pitch_radius
        at = kinematics(path, r)
        for speed, curvature in (
            (at.pinion_speed, at.pinion_curvature),
            (at.gear_speed, at.gear_curvature),
        ):
            rate = np.abs(speed / at.pinion_normal_arm)  # ds/d|r|
            way = np.concatenate([[0.0], np.cumsum(np.diff(np.abs(r)) * (rate[1:] + rate[:-1]) / 2)])
            way = way + np.abs(r[0]) * rate[0] / 2
            found.append((half, way, curvature))
    return found


def relative_curvature(path):
    """Relative curvature of the flanks touching at P, at the way s from P, s > 0 on the recess's side."""
    flanks = flank_curvatures(path)

    def at(s):
        # loglog interpolation of curvatures of either sign, which all go like 1/√s
        return sum(
            np.interp(np.log(abs(s)), np.log(way), curvature * np.sqrt(way)) / np.sqrt(abs(s))
            for half, way, curvature in flanks
            if half * s > 0
        )

    return at


@pytest.mark.parametrize(("family", "drive"), CASES)
def test_length_is_that_of_the_flanks_as_they_are(family, drive):
    """The mean of the flanks' relative curvature with the weight of Hertz's pressure."""
    path = family.working_path(drive)
    curvature = relative_curvature(path)
    a = 2e-6  # so narrow that the flanks still follow their limit
    mean = 0.0
    for sign in (1.0, -1.0):
        # s = a t², so that the integrand is smooth
        mean += quad(lambda t, sign=sign: np.sqrt(1 - t**4) * curvature(sign * a * t**2) * 2 * t, 1e-3, 1)[0]
    assert pitch_point(path).length * a == pytest.approx((2 / math.pi * mean) ** -2, rel=0.01)


@pytest.mark.parametrize(("family", "drive"), CASES)
def test_speed_per_radius_is_the_limit_of_the_kinematics(family, drive):
    path = family.working_path(drive)
    sides = kinematics(path, np.array([-1e-7, 1e-7]))
    limit = np.mean(sides.entrainment * sides.relative_curvature)
    assert pitch_point(path).speed_per_radius == pytest.approx(limit, rel=1e-4)


def test_nothing_vanishes_on_other_paths():
    arc = drive(circular_arc.ArcShape(0.06, 0.06), angle=math.radians(18))
    for family, pair in ((involute.FAMILY, arc._replace(shape=())), (circular_arc.FAMILY, arc)):
        assert pitch_point(family.working_path(pair)) == (0.0, 0.0)


def test_at_the_pitch_point_the_exact_load_is_carried_on_the_half_width():
    """Two flanks with the gap ∫∫ k/√x, symmetric: F' = E* ∫ x f'/√(a² − x²) dx over 0 … a (plane contact)."""
    family, drive = CASES[0]
    length = pitch_point(family.working_path(drive)).length
    line_load = 3e5
    radius = averaged_radius(0.0, line_load, MODULUS, length)
    a = hertz_half_width(line_load, 1 / radius, MODULUS)
    # k of a symmetric gap with the same mean: 1/√(M a) = (2J/π) 2k/√a, from the defining integral
    j = quad(lambda t: 2 * np.sqrt(1 - t**4), 0, 1)[0]
    k = math.pi / (4 * j * math.sqrt(length))
    slope = 2 * k  # f' = 2 k √x
    exact = MODULUS / 2 * slope * a**1.5 * quad(lambda t: 2 * t**4 / np.sqrt(1 - t**4), 0, 1)[0]
    assert exact == pytest.approx(line_load, rel=1e-6)


def test_far_from_the_pitch_point_nothing_changes():
    length, load = 0.03, 3e5
    half_width = hertz_half_width(load, 1 / 0.05, MODULUS)
    averaged = averaged_radius(0.05, load, MODULUS, length)
    assert averaged == pytest.approx(0.05, rel=4 * (length * half_width / 0.05**2) ** 2)
    assert averaged_radius(0.008, load, MODULUS, 0.0) == pytest.approx(0.008, rel=1e-14)


@pytest.mark.parametrize("radius", [0.0, 1e-9, 1e-5, 5e-4, 1e-3, 3e-3, 1e-2, 0.1])
def test_it_solves_its_equation(radius):
    length, load = 0.03, 3e5
    averaged = averaged_radius(radius, load, MODULUS, length)
    squared = length * hertz_half_width(load, 1 / averaged, MODULUS)
    found = averaged**4 + 14 * squared**2 - 15 * (squared / averaged) ** 4
    assert found == pytest.approx(radius**4, rel=1e-9, abs=1e-12 * averaged**4)


@pytest.mark.parametrize("share", [0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0, 1.1, 1.3, 2.0, 4.0])
def test_beside_the_pitch_point_it_is_the_mean_over_the_contact(share):
    """Curvature k/√|s|, contact from s − a to s + a, s = share × a: Hertz-weighted mean by quadrature."""
    half_width, k = 2e-4, 3.0

    def weight(x):
        return 2 / math.pi * np.sqrt(max(1 - x**2, 0.0))

    # x = −share ± t², so that the singularity at P goes away
    mean = quad(lambda t: 2 * weight(t**2 - share), np.sqrt(max(share - 1, 0)), np.sqrt(1 + share))[0]
    if share < 1:
        mean += quad(lambda t: 2 * weight(-(t**2) - share), 0, np.sqrt(1 - share))[0]
    mean *= k / np.sqrt(half_width)
    at_pitch_point = quad(lambda t: 8 / math.pi * np.sqrt(1 - t**4), 0, 1)[0] * k
    length = at_pitch_point**-2
    # the load that makes the contact this wide
    line_load = math.pi * MODULUS * half_width**2 * mean / 8
    radius = np.sqrt(share * half_width) / k
    averaged = averaged_radius(radius, line_load, MODULUS, length)
    assert averaged * mean == pytest.approx(1.0, rel=0.11 if 0.4 < share < 2 else 0.03)
