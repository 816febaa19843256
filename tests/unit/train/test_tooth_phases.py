"""Phases of meshes that share a gear, against drawn teeth that are turned."""

from fractions import Fraction
from math import cos, gcd, pi, sin, sqrt

import numpy as np
import pytest
from scipy.optimize import root_scalar

import tribodyn as td
from tests.support.tooth_phases import (
    DRIVEN,
    DRIVES,
    at_entry,
    common_period,
    half_tooth,
    idler_phase,
    involute,
    rates,
    rigid_shaft_phase,
    shared_gear_phase,
    turns_of_shared_shaft,
)

ALPHA = np.radians(20.0)


class Pair:
    """A drawn pair as a pair enters contact, module 1; the pinion below turns clockwise."""

    def __init__(self, teeth, shifts):
        names = ("pinion", "gear")
        changes = {
            "drive.module": "1 mm",
            "drive.pinion.bore_radius": "2 mm",
            "drive.gear.bore_radius": "2 mm",
        }
        changes |= {f"drive.{name}.teeth": z for name, z in zip(names, teeth, strict=True)}
        changes |= {f"drive.{name}.profile_shift": x for name, x in zip(names, shifts, strict=True)}
        self.drawn = td.drive("liu-ni-involute-23-47", changes).outlines
        self.teeth, self.shifts = teeth, shifts
        spread = 2 * np.tan(ALPHA) * sum(shifts) / sum(teeth)
        self.operating = root_scalar(
            lambda a: involute(a) - involute(ALPHA) - spread, bracket=(0.05, 0.8), xtol=1e-14
        ).root
        self.radii = [0.5e-3 * z * cos(ALPHA) / cos(self.operating) for z in teeth]

    def outline(self, gear):
        """About the gear's own axis, without the bore."""
        centre = np.array([0.0, (-1, 1)[gear] * self.radii[gear]])
        points = self.drawn[("pinion", "gear")[gear]] - centre
        return points[np.hypot(*points.T) > 3e-3]

    def axis(self, gear):
        """Polar angle of the axis of a tooth, counter-clockwise: from the harmonic of the outline."""
        points = self.outline(gear)
        polar, radius = np.unwrap(np.arctan2(points[:, 1], points[:, 0])), np.hypot(*points.T)
        weight = np.gradient(polar)
        wave = np.sum(weight * (radius - radius.mean()) * np.exp(1j * self.teeth[gear] * polar))
        return np.angle(wave * np.sign(weight.sum())) / self.teeth[gear]

    def half(self, gear):
        return half_tooth(self.teeth[gear], self.shifts[gear], ALPHA, self.operating)

    def drawn_half(self, gear):
        """Half the angle of a tooth where its flanks cut the operating pitch circle."""
        points = self.outline(gear)
        polar = np.unwrap(np.arctan2(points[:, 1], points[:, 0]))
        inside = np.hypot(*points.T) - self.radii[gear]
        at = np.flatnonzero(inside[:-1] * inside[1:] <= 0)
        share = inside[at] / (inside[at] - inside[at + 1])
        crossing = polar[at] + share * (polar[at + 1] - polar[at])
        from_axis = (crossing - self.axis(gear) + pi / self.teeth[gear]) % (2 * pi / self.teeth[gear])
        return np.mean(np.abs(from_axis - pi / self.teeth[gear]))

    def pitch_point_phase(self):
        """Cycles from entry to the pitch point: the path of approach over the base pitch."""
        tip, pitch = np.hypot(*self.outline(1).T).max(), self.radii[1]
        approach = sqrt(tip**2 - (pitch * cos(self.operating)) ** 2) - pitch * sin(self.operating)
        return approach / (pi * 1e-3 * cos(ALPHA))


def distance(a, b):
    """Of two phases on the circle."""
    return abs((a - b + 0.5) % 1.0 - 0.5)


CASES = [
    (31, 0.0, (23, 0.0), (37, 0.0)),
    (30, 0.2, (23, 0.1), (37, -0.3)),
    (29, -0.1, (41, 0.35), (26, 0.4)),
]


@pytest.mark.parametrize(("teeth", "shift", "before", "after"), CASES)
def test_teeth_are_as_thick_as_drawn(teeth, shift, before, after):
    pair = Pair((before[0], teeth), (before[1], shift))
    for gear in (0, 1):
        assert pair.half(gear) == pytest.approx(pair.drawn_half(gear), rel=1e-3)


@pytest.mark.parametrize(("teeth", "shift", "before", "after"), CASES)
@pytest.mark.parametrize(("psi_1", "psi_3"), [(0.3, 2.2), (-2.9, 1.1), (1.0, -1.3)])
def test_an_idler_with_its_teeth_drawn(teeth, shift, before, after, psi_1, psi_3):
    """It stands in either drawing as a pair enters; turned to the angle of its mate, tooth by tooth."""
    first = Pair((before[0], teeth), (before[1], shift))
    second = Pair((teeth, after[0]), (shift, after[1]))
    # above, it turns counter-clockwise, and its driver is below; below, it turns clockwise, its mate above
    entry_1 = first.axis(1) + psi_1 + pi / 2
    entry_2 = -second.axis(0) + psi_3 + pi / 2
    drawn = teeth * (entry_1 - entry_2) / (2 * pi)
    phase = idler_phase(teeth, psi_1, psi_3, first.half(1), second.half(0))
    phase = at_entry(phase, (first.pitch_point_phase(), second.pitch_point_phase()))
    assert distance(phase, drawn) < 1e-3


@pytest.mark.parametrize(("teeth", "shift", "before", "after"), CASES)
def test_two_mates_of_one_role_and_the_other(teeth, shift, before, after):
    """A bull gear with two pinions that drive it, a gear that drives two."""
    psi = (0.4, -1.7)
    first, second = (Pair((mate[0], teeth), (mate[1], shift)) for mate in (before, after))
    drawn = teeth * (first.axis(1) + psi[0] - second.axis(1) - psi[1]) / (2 * pi)
    phase = shared_gear_phase(teeth, psi, (first.half(1), second.half(1)), (DRIVEN, DRIVEN))
    phase = at_entry(phase, (first.pitch_point_phase(), second.pitch_point_phase()))
    assert distance(phase, drawn) < 1e-3
    first, second = (Pair((teeth, mate[0]), (shift, mate[1])) for mate in (before, after))
    drawn = teeth * (-first.axis(0) + psi[0] + second.axis(0) - psi[1]) / (2 * pi)
    phase = shared_gear_phase(teeth, psi, (first.half(0), second.half(0)), (DRIVES, DRIVES))
    phase = at_entry(phase, (first.pitch_point_phase(), second.pitch_point_phase()))
    assert distance(phase, drawn) < 1e-3


@pytest.mark.parametrize(("psi", "offset"), [((0.4, -1.7), 0.06), ((2.0, 0.9), 0.0), ((-0.8, -0.3), -0.11)])
def test_two_gears_on_one_shaft(psi, offset):
    """Driven on one, driving with the other, whose drawn tooth stands ahead of the first's."""
    first, second = Pair((23, 30), (0.1, 0.2)), Pair((19, 41), (0.3, -0.2))
    entry_1, entry_2 = first.axis(1) + psi[0] + pi / 2, -second.axis(0) + psi[1] + pi / 2
    drawn = 19 * (entry_1 + offset - entry_2) / (2 * pi)
    phase = rigid_shaft_phase(19, psi, (first.half(1), second.half(0)), (DRIVEN, DRIVES), offset)
    phase = at_entry(phase, (first.pitch_point_phase(), second.pitch_point_phase()), rate=19 / 30)
    # which tooth of the first gear touches is not said by the drawing's harmonic
    steps = [distance(phase + 19 * tooth / 30, drawn) for tooth in range(30)]
    assert min(steps) < 1e-3


def test_a_symmetric_idler_of_sixty_teeth_is_half_a_cycle_on():
    """At 180° and at 120°: there a wrong sign would not show."""
    half = half_tooth(60, 0.0, ALPHA, ALPHA)
    for angle in (pi, 2 * pi / 3):
        assert distance(idler_phase(60, 0.0, angle, half, half), 0.5) < 1e-12


@pytest.mark.parametrize(("driven", "driver"), [(50, 17), (48, 18), (51, 34), (30, 30)])
def test_the_common_period_is_that_of_the_shared_shaft(driven, driver):
    """In cycles of the first mesh; counted out tooth by tooth."""
    pair = rates([(23, driven), (driver, 61)])
    assert pair[1] == Fraction(driver, driven)
    counted = next(n for n in range(1, driven + 1) if (n * driver) % driven == 0)
    assert common_period(pair) == counted == turns_of_shared_shaft(driven, driver) * driven
    assert counted == driven // gcd(driven, driver)


def test_three_stages_repeat_together():
    of = rates([(20, 40), (15, 45), (21, 50)])
    assert of == [1, Fraction(3, 8), Fraction(7, 40)]
    counted = next(n for n in range(1, 400) if all((n * rate).denominator == 1 for rate in of))
    assert common_period(of) == counted == 40
