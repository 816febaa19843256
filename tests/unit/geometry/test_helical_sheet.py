"""Helical teeth on the gear sheet: a published stage, contact lines, gauges on the helicoid, hands."""

import math

import ezdxf
import numpy as np
import pytest

from tribodyn.drawing.cad import write_pair
from tribodyn.errors import InputError
from tribodyn.geometry.backlash import circumferential_backlash, normal_backlash
from tribodyn.geometry.drive import SIDES, body_of
from tribodyn.geometry.families import family
from tribodyn.geometry.gauges import involute_of, over_pins, pin_contact_diameter, span, thickness_lines
from tribodyn.geometry.helix import (
    contact_line_lengths,
    contact_lines,
    lead,
    normal_section,
    pitch_slope,
    transverse_section,
)
from tribodyn.geometry.limits.checks import check
from tribodyn.geometry.path import position
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.geometry.tooth import flank_point
from tribodyn.studies.drive_file import as_spline, load_drive

PAIR = {
    "family": "involute",
    "module": "3 mm",
    "pressure_angle": "20 deg",
    "helix_angle": "25 deg",
    "mean_roughness": "0.8 um",
    "material": "16MnCr5",
    "pinion": {"teeth": 23, "face_width": "40 mm", "profile_shift": 0.3, "thickness_allowance": "-50 um"},
    "gear": {"teeth": 46, "face_width": "38 mm", "profile_shift": 0.1, "thickness_allowance": "-70 um"},
}


def model(table=PAIR, **changes):
    return load_drive(table, {f"drive.{key.replace('__', '.')}": value for key, value in changes.items()})


def pair(table=PAIR, **changes):
    loaded = model(table, **changes)
    return check(family(loaded.family), loaded.drive)


def test_a_published_helical_stage():
    """KISSsoft report of 2017 at 5000 kW and 1165.9 rpm; the centre distance is rounded to 0.15 µm of it."""
    stage = pair("helical-24-95")
    torque = 5e6 / (1165.9 * math.pi / 30.0) * 95.0 / 24.0
    sheet = geometry_sheet(stage, gear_torque=torque)
    assert sheet["contact ratio"][0] == pytest.approx(1.463, abs=5e-4)
    assert sheet["overlap ratio"][0] == pytest.approx(1.421, abs=5e-4)
    assert sheet["minimum length of contact lines"] == (pytest.approx(483.685, abs=5e-3), "mm")
    for name, newtons in (("tangential", 240_064.0), ("radial", 88_724.0)):
        assert sheet[f"{name} force on reference circle"] == (pytest.approx(newtons, rel=2e-5), "N")
    assert sheet["axial force"] == (pytest.approx(42_330.0, rel=2e-5), "N")
    # what bearings carry is normal to the flank, and has the torque
    tangential, radial = (
        sheet[f"{name} force on working pitch circle"][0] for name in ("tangential", "radial")
    )
    normal = math.hypot(tangential, radial, sheet["axial force"][0])
    base = math.asin(math.sin(math.radians(10.0)) * math.cos(math.radians(20.0)))
    radius = 95 * 14e-3 / math.cos(math.radians(10.0)) / 2.0
    angle = math.atan(math.tan(math.radians(20.0)) / math.cos(math.radians(10.0)))
    assert normal * math.cos(base) * radius * math.cos(angle) == pytest.approx(torque, rel=1e-9)


@pytest.mark.parametrize(("width", "angle"), [("30 mm", "8 deg"), ("38 mm", "25 deg"), ("70 mm", "31 deg")])
def test_contact_lines_of_an_involute_have_a_closed_form(width, angle):
    helical = pair(helix_angle=angle, pinion__face_width=width, gear__face_width=width)
    drive, found = helical.drive, contact_lines(helical)
    base = math.atan(math.tan(drive.helix_angle) * math.cos(drive.pressure_angle))
    across = math.pi * drive.module * math.cos(drive.pressure_angle) / math.sin(base)
    alpha, beta = helical.contact_ratio, drive.gear.face_width * math.tan(base) / across / math.sin(base)
    a, b = alpha % 1.0, beta % 1.0
    assert found.mean == pytest.approx(across * alpha * beta, rel=1e-12)
    assert found.minimum == pytest.approx(found.mean - across * (a * b - max(0.0, a + b - 1.0)), rel=1e-12)
    assert found.maximum == pytest.approx(found.mean - across * (a * b - min(a, b)), rel=1e-12)


def test_contact_lines_with_a_whole_overlap_are_constant():
    drive = pair().drive
    width = f"{2e3 * math.pi * 3e-3 / math.sin(drive.helix_angle):.15g} mm"
    found = contact_lines(pair(pinion__face_width=width, gear__face_width=width))
    assert found.minimum == pytest.approx(found.maximum, rel=1e-12)


@pytest.mark.parametrize("name", ["helical-23-47", "liu-ni-crc-23-47", "cycloidal-23-47"])
def test_contact_lines_are_as_long_as_their_points_are_apart(name):
    helical = pair(name, helix_angle="20 deg")
    late = pitch_slope(helical) / helical.path.pinion_pitch_radius  # rad per m of the face
    (start, end), width = helical.roll_limits, helical.common_width
    for phase in (0.0, 0.3, 0.77):
        length = 0.0
        for number in range(-4, 6):
            middle = start + (phase + number) * helical.pitch_angle
            first, last = max(-width / 2, (middle - end) / late), min(width / 2, (middle - start) / late)
            if first < last:
                z = np.linspace(first, last, 301)
                x, y = position(helical.path, helical.path.signed_distance(middle - z * late))
                length += np.sqrt(np.diff(x) ** 2 + np.diff(y) ** 2 + np.diff(z) ** 2).sum()
        assert contact_line_lengths(helical, np.array(phase)) == pytest.approx(length, rel=1e-5)


def half_angle(helical, side):
    """Half thickness angle (rad) of the tooth as cut over the radius (m)."""
    tooth = helical.tooth(side)
    x, y = flank_point(tooth, np.linspace(float(tooth.form_distance), float(tooth.tip_distance), 4001))
    return np.hypot(x, y), np.arctan2(y, x)


@pytest.mark.parametrize("side", SIDES)
def test_span_is_the_distance_of_base_helices(side):
    """k − 1 base pitches and a base thickness, in the tangent plane of the base cylinder, across β_b."""
    helical = pair()
    (gear, allowance), (radius, half) = involute_of(helical.drive, side), half_angle(helical, side)
    base = (
        body_of(helical.drive, side).teeth * helical.drive.module / 2 * math.cos(helical.drive.pressure_angle)
    )
    profile = np.arccos(base / radius)
    at_base = half + np.tan(profile) - profile
    assert np.ptp(at_base) < 1e-12
    arc = base * (2 * at_base[0] + 3 * 2 * math.pi / gear.teeth)
    leaning = math.atan(2 * math.pi * base / float(lead(helical.drive, side)))
    assert span(gear, 4, allowance) == pytest.approx(arc * math.cos(leaning), rel=1e-12)
    assert gear.base_helix_angle == pytest.approx(leaning, rel=1e-12)


@pytest.mark.parametrize("side", SIDES)
def test_balls_touch_the_helicoid(side):
    helical = pair()
    (gear, allowance), (radius, half) = involute_of(helical.drive, side), half_angle(helical, side)
    ball = 5.5e-3
    opposite = 1.0 if gear.teeth % 2 == 0 else math.cos(math.pi / (2 * gear.teeth))
    centre = (over_pins(gear, ball, allowance) - ball) / 2 / opposite
    z = np.linspace(-2e-3, 2e-3, 2001)[:, None]
    turned = math.pi / gear.teeth - half + z * 2 * math.pi / float(lead(helical.drive, side))
    distance = np.sqrt((radius * np.cos(turned) - centre) ** 2 + (radius * np.sin(turned)) ** 2 + z**2)
    assert distance.min() == pytest.approx(ball / 2, rel=1e-6)
    at = radius[np.unravel_index(distance.argmin(), distance.shape)[1]]
    assert 2 * at == pytest.approx(pin_contact_diameter(gear, ball, allowance), rel=1e-4)


def test_a_face_too_narrow_for_the_span():
    lines = thickness_lines(pair(gear__face_width="5 mm"), "gear")
    assert "span" not in lines
    assert lines["span that the face is too narrow to measure"][0] > 0.0
    assert lines["face width that the span needs"][0] > 5.0


def test_what_the_sheet_prints_of_a_helical_gear_is_taken_back():
    loaded = model()
    sheet = loaded.sheet(check(family("involute"), loaded.drive))["gear"]
    for keys in (
        {"span": f"{sheet['span'][0]!r} mm", "span_teeth": int(sheet["teeth of the span"][0])},
        {"over_pins": f"{sheet['dimension over balls'][0]!r} mm", "pin_diameter": "5.184 mm"},
    ):
        table = PAIR | {"gear": {"teeth": 46, "face_width": "38 mm", "profile_shift": 0.1} | keys}
        given = normal_section(load_drive(table).drive).gear.thickness_allowance
        assert given == pytest.approx(-70e-6, rel=1e-6)


def test_backlash_lies_along_the_true_normal():
    """Of thinner teeth at the tight centre distance: both allowances times cos α_n, to first order."""
    tight = {**PAIR["pinion"], "profile_shift": 0.0}, {**PAIR["gear"], "profile_shift": 0.0}
    helical = pair(PAIR | {"pinion": tight[0], "gear": tight[1]})
    assert normal_backlash(helical) == pytest.approx(120e-6 * math.cos(math.radians(20.0)), rel=1e-9)
    arc = 120e-6 / math.cos(math.radians(25.0))
    assert circumferential_backlash(helical) == pytest.approx(arc, rel=1e-9)


def test_sections_undo_each_other():
    drive = pair().drive
    again = transverse_section(normal_section(drive))
    for side in SIDES:
        assert body_of(again, side)[1:5] == pytest.approx(body_of(drive, side)[1:5], rel=1e-14)
    normal = normal_section(drive)
    assert (normal.module, normal.pressure_angle) == pytest.approx((3e-3, math.radians(20.0)), rel=1e-14)
    # the straight flank of the rack ends at the same height in both sections
    for section in (drive, normal):
        body = section.pinion
        height = body.dedendum - body.fillet_radius * (1.0 - math.sin(section.pressure_angle))
        assert section.module * height == pytest.approx(
            3e-3 * (1.25 - 0.25 * (1.0 - math.sin(math.radians(20.0)))), rel=1e-12
        )


def test_hands_mirror_the_pair_and_change_nothing_else():
    right, left = (geometry_sheet(pair(hand=hand)) for hand in ("right", "left"))
    assert [left[side].pop("hand of helix")[0] for side in SIDES] == ["left", "right"]
    assert [right[side].pop("hand of helix")[0] for side in SIDES] == ["right", "left"]
    assert left == right
    assert model(gear__hand="right").drive == model(hand="left").drive


def test_tolerances_take_the_normal_module():
    """Class 5 by hand: d = 46 · 3/cos 25°, f_pT = 0.001 d + 0.4 m_n + 5, f_HβT = 0.05 √d + 0.35 √b + 4."""
    loaded = model(quality=5)
    gear = loaded.sheet(check(family(loaded.family), loaded.drive))["gear"]
    diameter = 46 * 3 / math.cos(math.radians(25.0))
    assert gear["f_pT, single pitch"][0] == pytest.approx(0.001 * diameter + 6.2, abs=0.25)
    slope = 0.05 * math.sqrt(diameter) + 0.35 * math.sqrt(38.0) + 4.0
    assert gear["f_H beta T, helix slope"][0] == pytest.approx(slope, abs=0.25)


def test_messages_have_the_numbers_of_the_keys():
    with pytest.raises(InputError) as refused:
        pair(pinion__fillet_radius=0.9)
    most = float(refused.value.remedy.removeprefix("use at most "))
    assert refused.value.value == 0.9
    pair(pinion__fillet_radius=most)
    with pytest.raises(InputError, match="rounded corners"):
        pair(pinion__fillet_radius=most + 0.002)


def test_a_free_form_fit_keeps_helix_and_backlash():
    loaded = model(hand="left", pinion__thickness_allowance="-50 um")
    before = check(family("involute"), loaded.drive)
    fitted = load_drive(as_spline(loaded, 9).table)
    after = check(family("spline"), fitted.drive)
    assert float(lead(after.drive, "gear")) == pytest.approx(float(lead(before.drive, "gear")), rel=1e-9)
    assert after.drive.helix_angle < 0.0
    assert normal_backlash(after) == pytest.approx(normal_backlash(before), rel=1e-4)
    assert contact_lines(after) == pytest.approx(contact_lines(before), rel=1e-4)


def test_drawings_say_that_they_show_the_transverse_section(tmp_path):
    space = ezdxf.readfile(write_pair(tmp_path / "pair.dxf", pair())).modelspace()
    (text,) = (entity.dxf.text for entity in space.query('TEXT[layer=="TEXT"]'))
    assert text.startswith("Transverse section. Helix angle 25 deg; pinion right-hand, lead ")
    plain = ezdxf.readfile(write_pair(tmp_path / "spur.dxf", pair(helix_angle="0 deg"))).modelspace()
    assert not plain.query("TEXT")
