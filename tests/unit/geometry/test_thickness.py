"""Span and dimension over pins against the tooth itself, drawn point by point."""

import math

import numpy as np
import pytest

from tests.support.sample_drives import SHIFTED, STANDARD
from tribodyn.errors import InputError
from tribodyn.geometry.assembly import assemble, tip_break
from tribodyn.geometry.drive import PROFILES, body_of
from tribodyn.geometry.families import involute
from tribodyn.geometry.gauges import (
    Gauge,
    Involute,
    allowance_of_pins,
    allowance_of_span,
    over_pins,
    over_rollers,
    pin_contact_diameter,
    span,
    span_contact_diameter,
    thickness_lines,
    usual_span_teeth,
)
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.tooth import flank_point
from tribodyn.studies.drive_file import load_drive

ALLOWANCE = -90e-6
CASES = [(drive, side) for drive in (STANDARD, SHIFTED) for side in ("pinion", "gear")]


def flank_of(drive, side):
    """Half thickness angle (rad) over radius (m) of one flank."""
    thin = drive._replace(**{side: body_of(drive, side)._replace(thickness_allowance=ALLOWANCE)})
    tooth = assemble(involute.FAMILY, thin).tooth(side)
    x, y = flank_point(tooth, np.linspace(float(tooth.form_distance), float(tooth.tip_distance), 20001))
    return np.hypot(x, y), np.arctan2(y, x)


def gear_of(drive, side):
    body = body_of(drive, side)
    return Involute(drive.module, drive.pressure_angle, body.teeth, body.profile_shift)


@pytest.mark.parametrize(("drive", "side"), CASES)
def test_span_is_the_widest_distance_of_parallel_tangents(drive, side):
    gear, (radius, half) = gear_of(drive, side), flank_of(drive, side)
    count = usual_span_teeth(gear)
    # the right flank of the last of k teeth, seen along the normal of the anvils
    angle = half + (count - 1) * math.pi / gear.teeth
    expected = 2 * np.max(radius * np.sin(angle)) if count == 1 else 2 * (radius * np.sin(angle))
    measured = span(gear, count, ALLOWANCE)
    at = np.argmin(np.abs(2 * radius - span_contact_diameter(gear, measured)))
    assert np.atleast_1d(expected)[at if count > 1 else 0] == pytest.approx(measured, rel=1e-6)
    # there the flank is parallel to the middle of the span
    across, along = radius * np.sin(angle), radius * np.cos(angle)
    slope = np.gradient(across, along)
    assert abs(slope[at]) < 2e-3
    assert allowance_of_span(gear, count, measured) == pytest.approx(ALLOWANCE, rel=1e-9)


@pytest.mark.parametrize(("drive", "side"), CASES)
def test_pins_touch_both_flanks_of_their_gap(drive, side):
    gear, (radius, half) = gear_of(drive, side), flank_of(drive, side)
    pin = 1.728 * gear.module
    measured = over_pins(gear, pin, ALLOWANCE)
    opposite = 1.0 if gear.teeth % 2 == 0 else math.cos(math.pi / (2 * gear.teeth))
    centre = (measured - pin) / 2 / opposite
    # distance of the pin's centre, in the middle of the gap, from the flank of the tooth beside
    gap = math.pi / gear.teeth - half
    distance = np.hypot(radius * np.cos(gap) - centre, radius * np.sin(gap))
    assert distance.min() == pytest.approx(pin / 2, rel=1e-6)
    nearest = 2 * radius[np.argmin(distance)]
    assert nearest == pytest.approx(pin_contact_diameter(gear, pin, ALLOWANCE), rel=1e-4)
    assert allowance_of_pins(gear, pin, measured) == pytest.approx(ALLOWANCE, rel=1e-9)


def test_a_measure_that_no_gear_has():
    assert math.isnan(allowance_of_pins(gear_of(STANDARD, "pinion"), 5e-3, 50e-3))


def test_a_rounding_touches_tip_circle_and_flank():
    """A circle of its radius, tangent to the flank at the break's height, reaches the tip circle."""
    rounding = 0.2e-3
    sharp = assemble(involute.FAMILY, STANDARD).pinion
    height = float(tip_break(involute.FAMILY, STANDARD, "pinion", rounding))
    distance = np.linspace(float(sharp.form_distance), float(sharp.tip_distance), 20001)
    x, y = flank_point(sharp, distance)
    at = np.argmin(np.abs(np.hypot(x, y) - (float(sharp.tip_radius) - height)))
    tangent = np.array([x[at + 1] - x[at - 1], y[at + 1] - y[at - 1]])
    tangent /= np.hypot(*tangent)
    inwards = np.array([tangent[1], -tangent[0]])
    inwards *= -np.sign(inwards[1])
    centre = np.array([x[at], y[at]]) + rounding * inwards
    assert np.hypot(*centre) + rounding == pytest.approx(float(sharp.tip_radius), abs=0.02 * rounding)


def test_racks_of_iso_53():
    """Clearance and rounding: 0.25 and 0.38, 0.30, 0.25 of A, B, C; 0.4 and 0.39 of D; 20 degrees."""
    found = {name[-1]: profile for name, profile in PROFILES.items()}
    assert {name: round(profile.dedendum - profile.addendum, 9) for name, profile in found.items()} == dict(
        A=0.25, B=0.25, C=0.25, D=0.4
    )
    assert {name: profile.fillet_radius for name, profile in found.items()} == dict(
        A=0.38, B=0.3, C=0.25, D=0.39
    )
    assert all(profile.pressure_angle == math.radians(20) for profile in found.values())


@pytest.mark.parametrize("side", ["pinion", "gear"])
def test_the_sheet_has_what_gauges_measure_in_millimetres(side):
    thin = SHIFTED._replace(**{side: body_of(SHIFTED, side)._replace(thickness_allowance=ALLOWANCE)})
    gear, pair = gear_of(SHIFTED, side), assemble(involute.FAMILY, thin)
    lines = thickness_lines(pair, side, Gauge(span_teeth=3, pin_diameter=7.5e-3))
    assert lines["deviation of tooth thickness"] == (pytest.approx(-0.09), "mm")
    assert lines["teeth of the span"] == (3.0, "")
    assert lines["span"] == (pytest.approx(1e3 * span(gear, 3, ALLOWANCE), rel=1e-12), "mm")
    assert lines["pin diameter"] == (pytest.approx(7.5), "mm")
    assert lines["dimension over pins"] == (pytest.approx(1e3 * over_pins(gear, 7.5e-3, ALLOWANCE)), "mm")
    # a pin that drops between the flanks, and a span beyond the tips, are said to measure nothing
    beside = thickness_lines(pair, side, Gauge(span_teeth=9, pin_diameter=2e-3))
    assert all(str(beside[name][0]).startswith("none: ") for name in ("span", "dimension over pins"))


def drawn(seed):
    """A random external pair or ring pair, standard or much shifted, thin teeth and all; None: refused."""
    draw = np.random.default_rng(seed)
    internal, helix = seed % 2 == 1, math.radians(25.0) if seed % 6 == 0 else 0.0
    teeth = int(draw.integers(17, 60)), int(draw.integers(65, 130))
    shifts = draw.uniform(-0.3, 0.9), draw.uniform(-0.3, 0.9)
    tight = draw.uniform(-0.04, 0.0)
    module, angle = draw.uniform(0.5, 8.0) * 1e-3, math.radians(draw.choice([15.0, 20.0, 25.0]))
    bodies = [
        {
            **{"teeth": z, "face_width": "20 mm", "profile_shift": round(x, 3)},
            "thickness_allowance": f"{tight * module * 1e6:.1f} um",
        }
        for z, x in zip(teeth, shifts, strict=True)
    ]
    bodies[1] |= {"internal": True} if internal else {}
    data = {"family": "involute", "module": f"{module * 1e3:.3f} mm", "pressure_angle": f"{angle} rad"}
    data |= {"helix_angle": f"{helix} rad"} if helix else {}
    data |= {"material": "18CrNiMo7-6", "roughness": "0.5 um", "pinion": bodies[0], "gear": bodies[1]}
    try:
        return check(involute.FAMILY, load_drive({"title": "drawn", **data}).drive)
    except InputError:
        return None


def test_what_the_sheet_prints_can_be_measured():
    """The pin lies on both drawn flanks and beyond the tip circle, of rings and external gears at random."""
    measured = none = 0
    for assembly in filter(None, map(drawn, range(40))):
        for side in ("pinion", "gear"):
            lines = thickness_lines(assembly, side)
            tooth, teeth = assembly.tooth(side), float(body_of(assembly.drive, side).teeth)
            (name,) = (name for name in lines if name.startswith("dimension") and "cylindrical" not in name)
            if isinstance(lines[name][0], str):
                none += 1
                continue
            measured += 1
            pin = 1e-3 * next(float(value) for key, (value, _) in lines.items() if key.endswith("diameter"))
            ring = teeth < 0
            halved = math.cos(math.pi / (2 * abs(teeth))) if round(teeth) % 2 else 1.0
            centre = (1e-3 * float(lines[name][0]) + (pin if ring else -pin)) / 2 / halved
            tip = abs(float(tooth.tip_radius))
            assert (centre - pin / 2 < tip) if ring else (centre + pin / 2 > tip)
            if assembly.drive.helix_angle:
                continue
            # distance of the pin's centre, in the middle of the gap, from the drawn flank
            x, y = flank_point(
                tooth, np.linspace(float(tooth.form_distance), float(tooth.tip_distance), 8001)
            )
            middle = math.pi / abs(teeth)
            reach = np.hypot(np.abs(x) - centre * math.cos(middle), np.abs(y) - centre * math.sin(middle))
            assert reach.min() == pytest.approx(pin / 2, rel=1e-4), (side, lines)
            assert 0 < reach.argmin() < len(reach) - 1
    assert measured > 30
    assert none < 0.1 * measured


@pytest.mark.parametrize(("teeth", "helix"), [(23, 0.5), (41, -0.3), (24, 0.5)])
def test_cylindrical_pins_of_helical_gears_lie_askew(teeth, helix):
    """The least common normal of two straight lines on the helices of the pins' centres, pins slid apart."""
    gear, pin = Involute(3e-3, math.radians(20.0), teeth, 0.2, helix), 5.2e-3
    balls = over_pins(gear, pin)
    radius = (balls - pin) / 2 / (1.0 if teeth % 2 == 0 else math.cos(math.pi / 2 / teeth))
    lead = math.pi * teeth * gear.module / math.sin(helix)  # of the helix, for a turn

    def axis(angle, height):
        turned = angle + 2 * math.pi * height / lead
        rise = 2 * math.pi * radius / lead
        point = np.array([radius * math.cos(turned), radius * math.sin(turned), height])
        return point, np.array([-rise * math.sin(turned), rise * math.cos(turned), 1.0])

    def apart(slid):
        (one, along), (other, beside) = axis(0.0, slid), axis(math.pi * (1.0 - (teeth % 2) / teeth), -slid)
        normal = np.cross(along, beside)
        return abs(normal @ (one - other)) / np.linalg.norm(normal)

    reach = 0.25 * abs(lead) / teeth
    slides = np.linspace(-reach, reach, 20001)
    assert over_rollers(gear, pin) == pytest.approx(min(map(apart, slides)) + pin, abs=1e-9)
    if teeth % 2:
        assert over_rollers(gear, pin) < balls - 0.5e-6
    else:
        assert over_rollers(gear, pin) == balls
